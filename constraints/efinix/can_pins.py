# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can_pins.py: the pins, for Efinity's Interface Designer: run it with its object `design`.
# Written by tools/constraints.py, which has options for an instance in a design, its ports and
# its clock. Not run in the vendor's tool (Efinity): tb/integration/constraints.py checks the
# commands, and that the ports and flip-flops that they name are there.
design.create_input_gpio("can_rx_i")
design.set_property("can_rx_i", "PULL_OPTION", "WEAK_PULLUP")
design.set_property("can_rx_i", "SCHMITT_TRIGGER", "1")
design.create_output_gpio("can_tx_o")
