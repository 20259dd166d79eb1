# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""upstream_runner.py DIR TEST...: runs python-can's own tests (DIR/test), with the interface
"virtual", which they use, replaced by ours: eight nodes a channel, since some never shut a bus
down."""
import os
import sys
import unittest

import can.interfaces

from verican.python_can import VericanBus

NOT_APPLICABLE = {
    "test_fd_message": "CAN FD",
    "test_fd_message_with_brs": "CAN FD",
}


class EightNodes(VericanBus):
    def __init__(self, channel=None, **settings):
        settings.pop("fd", None)
        super().__init__(channel, nodes=8, **settings)


def tests_of(suite):
    for entry in suite:
        if isinstance(entry, unittest.TestSuite):
            yield from tests_of(entry)
        else:
            yield entry


def main():
    directory, *modules = sys.argv[1:]
    os.environ["CI"] = "1"  # no waiting for exact host times
    sys.path.insert(0, directory)
    sys.modules["upstream_runner"] = sys.modules["__main__"]
    can.interfaces.BACKENDS["virtual"] = ("upstream_runner", "EightNodes")
    chosen = unittest.TestSuite()
    for test in tests_of(unittest.defaultTestLoader.loadTestsFromNames(modules)):
        name = test.id().split(".")[-1]
        if name in NOT_APPLICABLE:
            print(f"not applicable, {NOT_APPLICABLE[name]}: {test.id()}")
        else:
            chosen.addTest(test)
    result = unittest.TextTestRunner(verbosity=2).run(chosen)
    return 0 if result.wasSuccessful() and result.testsRun else 1


if __name__ == "__main__":
    sys.exit(main())
