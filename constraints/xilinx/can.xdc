# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.xdc: for Vivado.
# Written by tools/constraints.py, which has options for an instance in a design, its ports and
# its clock. Not run in the vendor's tool (Vivado): tb/integration/constraints.py checks the
# commands, and that the ports and flip-flops that they name are there.
# The clock of the core; a bit takes at least 8 clocks.
create_clock -name can_clock -period 20.000 [get_ports {hclk}]

# The CAN bus has no clock: can_sync takes can_rx_i through two flip-flops.
set_false_path -from [get_ports {can_rx_i}] -to [get_cells {u_top/u_core/u_sync/meta_q_reg*}]
# Asynchronous; the design releases it in step with the clock.
set_false_path -from [get_ports {hresetn}]
# Straight from a flip-flop. Its way to the pin counts in the loop delay (BT-07).
set_max_delay -datapath_only 15.000 -from [get_cells {u_top/u_core/u_bsp/u_tx_frame/can_tx_o_reg*}] -to [get_ports {can_tx_o}]
set_property IOSTANDARD LVCMOS33 [get_ports {can_rx_i}]
set_property PULLTYPE PULLUP [get_ports {can_rx_i}]
set_property IOSTANDARD LVCMOS33 [get_ports {can_tx_o}]
set_property PULLTYPE PULLUP [get_ports {can_tx_o}]
set_property IOB TRUE [get_cells {u_top/u_core/u_bsp/u_tx_frame/can_tx_o_reg*}]
