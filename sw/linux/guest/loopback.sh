# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Loop-back: the device receives what it sends, and the bus sees nothing.
tell bitrate 500000
up can0 500000 loopback on
up can1 500000
sleep 0.001
tell log bus.log
listen can0 can0.log
listen can1 can1.log
cangen can0 -g 1 -n 20 -I i -L i -D i
cangen can0 -g 1 -n 20 -e -I i -L i -D i
sleep 0.005
status loopback
hush
down can0
ip link set can0 type can bitrate 500000 loopback off
up can0 500000
sleep 0.001
cansend can0 321#AA
sleep 0.002
status normal
down can0
down can1
