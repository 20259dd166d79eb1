# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.sdc: timing of can_ahb in the fabric of an A2F500M3G. HCLK of the fabric is 50 MHz here; a bit of
# 1 Mbit/s needs at least 8 clocks, so anything from 8 MHz will do.
# Not run by Libero; tb/integration/smartfusion.py checks the names in it.
create_clock -name hclk -period 20.000 [get_ports {hclk}]

# The CAN bus has no clock: can_sync takes can_rx_i through two flip-flops. The reset is asynchronous.
set_false_path -from [get_ports {can_rx_i}]
set_false_path -from [get_ports {hresetn}]

# can_tx_o comes straight from a flip-flop. Its way to the pin counts in the loop delay that the
# propagation segment covers (rule BT-07), so it is bounded, not free.
set_max_delay 15.000 -to [get_ports {can_tx_o}]
