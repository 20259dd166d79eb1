# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.sdc: timing, for GateMate, nextpnr (--sdc).
# Written by tools/constraints.py, which has options for an instance in a design, its ports and
# its clock. Not run in the vendor's tool (nextpnr): tb/integration/constraints.py checks the
# commands, and that the ports and flip-flops that they name are there.
# The clock of the core; a bit takes at least 8 clocks.
create_clock -name can_clock -period 20.000 [get_ports {hclk}]

# The CAN bus has no clock: can_sync takes can_rx_i through two flip-flops.
set_false_path -from [get_ports {can_rx_i}] -to [get_cells {u_top/u_core/u_sync/meta_q*}]
# Asynchronous; the design releases it in step with the clock.
set_false_path -from [get_ports {hresetn}]
# Straight from a flip-flop. Its way to the pin counts in the loop delay (BT-07).
set_max_delay 15.000 -from [get_cells {u_top/u_core/u_bsp/u_tx_frame/can_tx_o*}] -to [get_ports {can_tx_o}]
