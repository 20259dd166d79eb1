# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""What a check says that fails."""


class Failed(Exception):
    """A check failed; the text says what was expected and what was found."""


def expect(found, wanted, what):
    if found != wanted:
        raise Failed(f"{what}: {found!r}, expected {wanted!r}")


def expect_true(condition, what):
    if not condition:
        raise Failed(what)
