# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a kernel's messages complain of."""
import re

_KERNEL = r"WARNING:|BUG:|Call Trace|Out of memory|segfault"
# The kernel repeats its command line, whose paths may hold any word.
_COMMAND_LINE = re.compile(r"kernel command line", re.I)


def complaints(text, also=None):
    """The lines of `text` (what dmesg prints) that tell of a fault of the kernel, in their order;
    `also` is a pattern of further words that a driver must not say, in any case."""
    pattern = re.compile(_KERNEL)
    further = re.compile(also, re.I) if also else None
    return [line for line in text.splitlines() if not _COMMAND_LINE.search(line)
            and (pattern.search(line) or (further and further.search(line)))]
