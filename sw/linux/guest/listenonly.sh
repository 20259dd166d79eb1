# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Listen-only: without anybody else the sender gets no acknowledgement and turns error-passive, but
# never bus-off; with a third node the listener hears everything and drives nothing.
tell bitrate 500000
up can0 500000
up can1 500000 listen-only on
sleep 0.001
listen can1 can1.log
tell log bus.log
cansend can0 123#1122334455667788
wait_until 2 state_is can0 ERROR-PASSIVE
sleep 0.05
status alone
tell peer start
wait_until 2 has_sent can0 1
cangen can0 -g 0 -n 50 -I i -L i -D i
wait_until 2 has_sent can0 51
tell peer send 20 701#0001
wait_until 5 peer_is_done
sleep 0.001
status heard
hush
tell log off
down can0
down can1
ip link set can1 type can bitrate 500000 listen-only off
