# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.tcl: the pins, for Quartus; source it from the project's .qsf.
# Written by tools/constraints.py, which has options for an instance in a design, its ports and
# its clock. Not run in the vendor's tool (Quartus): tb/integration/constraints.py checks the
# commands, and that the ports and flip-flops that they name are there.
set_instance_assignment -name IO_STANDARD {3.3-V LVCMOS} -to {can_rx_i}
set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {can_rx_i}
set_instance_assignment -name IO_STANDARD {3.3-V LVCMOS} -to {can_tx_o}
set_instance_assignment -name WEAK_PULL_UP_RESISTOR ON -to {can_tx_o}
set_instance_assignment -name FAST_OUTPUT_REGISTER ON -to {can_tx_o}
