# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# cangw: from the bus to another network (vcan0), from there to the bus, and from the bus to the
# bus, with frames changed on the way, under errors. judge_gateway.py knows the rules.
. "$VERICAN_GUEST/stacks.sh"
load vcan
load can-gw
ip link add vcan0 type vcan
ip link set vcan0 up
open_bus gateway
listen vcan0 vcan0.log
rule() {
  cangw -A "$@" || echo "FAILED: cangw $*"
}
rule -s can1 -d vcan0 -e -f 100:700 -m "SET:IL:333.4.1122334455667788"
rule -s can1 -d vcan0 -e -f 200:700 -m "AND:D:000.0.0F0F0F0F0F0F0F0F" \
  -m "OR:D:000.0.8000000000000000" -m "XOR:ID:0FF.0.00000000000000FF"
rule -s can1 -d vcan0 -e -f 300:C0000700 -m "XOR:D:000.0.0000000000000000" -x 0:6:7:00
rule -s can1 -d vcan0 -e -f 12345600:1FFFFF00
rule -s vcan0 -d can1 -e -f 400:700 -m "XOR:I:001.0.0000000000000000"
rule -s can1 -d can1 -e -i -f 500:7FF -m "SET:I:501.0.0000000000000000"
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
traffic() {
  cangen can0 -g 1 -n 20 -I 151 -L 8 -D r
  for ident in 2 3; do
    cangen can0 -g 1 -n 20 -I ${ident}5$ident -L r -D r
    cangen can0 -g 1 -n 10 -I ${ident}0A -L 8 -D r
  done
  cangen can0 -g 1 -n 20 -e -I 12345678 -L r -D r
  cangen can0 -g 1 -n 10 -e -I 1234A678 -L r -D r
  cangen vcan0 -g 1 -n 20 -I 4C4 -L r -D r
  cangen can0 -g 1 -n 20 -I 500 -L r -D r
}
in_background traffic
weather "$VERICAN_LOAD"
sleep 0.05
cangw -L >rules.txt
cangw -F
close_bus gateway
