# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Verilated CAN controllers on a simulated bus: docs/python.md."""
from ._core import Bus, Frame, InputError, Message, NodeState

__all__ = ["Bus", "Frame", "InputError", "Message", "NodeState"]
