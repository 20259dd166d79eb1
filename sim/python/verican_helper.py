# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican_helper: what the helper scripts of the tool share (sim/trace/python_helper.hpp): input on
# stdin, result on stdout, one line on stderr and exit code 2 for what cannot be used.
"""Exit codes: 0 done, 2 bad input or a missing package, 1 a mistake in the script."""
import contextlib
import importlib
import sys


class BadInput(Exception):
    """The input cannot be used; the text is one line: what is wrong and what is allowed."""


def need(module, package):
    """The Python module `module`, which Debian's `package` brings."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise BadInput(f"needs the Python package {module.split('.')[0]} (Debian: {package}): "
                       f"{error}") from error


@contextlib.contextmanager
def refusals():
    """A BadInput in here ends the program as it should."""
    try:
        yield
    except BadInput as error:
        print(" ".join(str(error).split()), file=sys.stderr)
        sys.exit(2)


def run(work):
    """Calls work(arguments); what it returns, bytes or text, goes to stdout."""
    with refusals():
        result = work(sys.argv[1:])
    sys.stdout.buffer.write(result.encode() if isinstance(result, str) else result)
    sys.stdout.buffer.flush()
