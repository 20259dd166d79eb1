# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Where guests keep what lasts as long as they do."""
import os
import shutil
import tempfile
from pathlib import Path


def scratch():
    """Where guests keep their memory, as files, and the simulator its sockets: short and fast."""
    shm = Path("/dev/shm")
    if os.access(shm, os.W_OK) and shutil.disk_usage(shm).free > 512 * 2**20:
        return str(shm)
    return tempfile.gettempdir()
