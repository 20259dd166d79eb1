# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Error-active, warning, passive, bus-off, and back: by restart-ms, then by hand.
tell bitrate 500000
up can0 500000 restart-ms 100
up can1 500000
sleep 0.001
listen can0 can0.log ,0:0,#FFFFFFFF
# Eleven errors, 88: below the warning limit of 96.
tell strike can0 DATA 3 flip 11
cansend can0 123#55
wait_until 1 has_sent can0 1
status eleven
# The bus short-circuited: each attempt fails at once, up to bus-off.
tell hold recessive
cansend can0 124#66
wait_until 1 state_is can0 BUS-OFF
status off
sim now >off.txt
tell hold off
wait_until 1 state_is can0 ERROR-ACTIVE
sim now >restarted.txt
status restarted
cansend can0 125#77
wait_until 1 has_sent can0 2
status alive
hush

# By hand
down can0
ip link set can0 type can restart-ms 0
up can0 500000
sleep 0.001
listen can0 manual.log ,0:0,#FFFFFFFF
tell hold recessive
cansend can0 126#88
wait_until 1 state_is can0 BUS-OFF
tell hold off
sleep 0.3
status waits
ip link set can0 type can restart
wait_until 1 state_is can0 ERROR-ACTIVE
cansend can0 127#99
wait_until 1 has_sent can0 3
status manual
hush
down can0
down can1
