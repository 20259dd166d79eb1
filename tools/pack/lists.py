# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""lists: the file list for tools that want paths from the root of the archive, and for Tcl."""
from pack.wrappers import rtl_files

HEAD = """\
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
"""


def render():
    """path -> text."""
    names = rtl_files()
    tcl = " \\\n".join(f"    [file join $verican_root {name}]" for name in names)
    return {
        # No comment: not every tool that takes -f knows them.
        "lists/can_root.f": "".join(f"{name}\n" for name in names),
        "lists/can_abs.f": "".join(f"${{VERICAN_ROOT}}/{name}\n" for name in names),
        "lists/can_files.tcl": HEAD
        + "# can_files.tcl: sets verican_files, the RTL in the order to read it.\n"
        + "set verican_root [file dirname [file dirname [file normalize [info script]]]]\n"
        + f"set verican_files [list \\\n{tcl}]\n",
    }
