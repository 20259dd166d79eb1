# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.sdc: the clock, for GateMate, nextpnr (--sdc).
# Written by tools/constraints.py, which has options for an instance in a design, its ports and
# its clock. Not run in the vendor's tool (nextpnr): tb/integration/constraints.py checks the
# commands, and that the ports and flip-flops that they name are there.
# The clock of the core; a bit takes at least 8 clocks.
create_clock -name can_clock -period 20.000 [get_ports {hclk}]
