# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# plain_end: how a script ends whose output, or a file of it, cannot be written or read.
"""run(main): the exit code is what main() returns; what the system refuses is told in a line."""
import os
import sys
from pathlib import Path


def run(main):
    """Ends the program. A reader that has gone away, such as head, is no mistake to speak of."""
    try:
        code = main()
        sys.stdout.flush()
    except OSError as error:
        # What is left would be tried once more at the end, and fail with a traceback.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        place = f"{error.filename}: " if error.filename else ""
        code = 1
        if not isinstance(error, BrokenPipeError):
            code = f"{Path(sys.argv[0]).name}: {place}{error.strerror}"
    sys.exit(code)
