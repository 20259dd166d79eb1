# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""Verilated CAN controllers on a simulated bus: docs/python.md."""
from ._bus import Bus
from ._core import Frame, InputError, Message, NodeState, response_times

__all__ = ["Bus", "Frame", "InputError", "Message", "NodeState", "response_times"]
