# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Stacks of the kernel on two buses, each with two interfaces: J1939 and the broadcast manager on
# the first, a gateway (cangw) between them. (This kernel has no ISO-TP.)
for module in can-bcm can-gw j1939/can-j1939; do
  busybox insmod "$modules/net/can/$module.ko" || complain "insmod $module"
done
interface vcan0 vcan1 vcan2 vcan3
start_bridge near --if vcan0 --if vcan1 --bitrate 1M --nodes 1 --fast --errors none \
  --candump near-bus.log
near=$bridge
start_bridge far --if vcan2 --if vcan3 --bitrate 1M --nodes 1 --fast --errors none \
  --candump far-bus.log
far=$bridge

# J1939: one has an address that another has the right to; then both send a message of many frames
# to the other.
A=8000000000000A01 B=8000000000000B02
listen vcan1 claims.log
j1939acd -r 0x80,0x90-0x93 -a 0x80 $B vcan0 2>acdB.txt &
claimers=$!
wait_until 60 has_text claims.log '18EEFF80#020B'
j1939acd -r 0x80,0x98-0x9B -a 0x80 $A vcan1 2>acdA.txt &
claimers="$claimers $!"
wait_until 60 has_text claims.log '18EEFF90#020B'
sleep 1
j1939cat -r vcan1:0x80,0x12500 >there.out 2>there.err &
takers=$!
j1939cat -r vcan0:0x90,0x12400 >back.out 2>back.err &
takers="$takers $!"
sleep 0.5
# With -P 0 the j1939cat of can-utils 2020.11 ends when all is sent, with a wrong complaint; without
# it, it cannot read what newer kernels tell of a transfer (docs/stacks.md).
send() {
  j1939cat -P 0 -i "$1.bin" "$2" "$3" 2>"$1.sent" ||
    has_text "$1.sent" "transferred 0 bytes" || complain "j1939cat $1"
}
send there vcan0:0x90 :0x80,0x12500 &
sender=$!
send back vcan1:0x80 :0x90,0x12400
wait $sender
received() {
  [ "$(wc -c <"$1")" -ge "$2" ]
}
wait_until 60 received there.out "$(wc -c <there.bin)"
wait_until 60 received back.out "$(wc -c <back.bin)"
kill $takers $claimers

# The broadcast manager.
/usr/bin/python3 "$VERICAN_BCM" vcan0 vcan1 >bcm.txt || complain "bcm.py"

# The gateway, with frames changed on the way.
cangw -A -s vcan1 -d vcan2 -e -f 123:7FF -m SET:IL:333.4.1122334455667788 || complain "cangw to"
cangw -A -s vcan2 -d vcan1 -e -f 444:7FF -m XOR:ID:001.0.FF000000000000FF || complain "cangw from"
listen vcan3 vcan3.log
listen vcan0 vcan0.log
cangen vcan0 -g 1 -n 100 -I 123 -L r -D r || complain "cangen to"
cangen vcan3 -g 1 -n 100 -I 444 -L r -D r || complain "cangen from"
has_frames() {
  [ "$(grep -c " $2#" "$1")" -ge 100 ]
}
wait_until 60 has_frames vcan3.log 333
wait_until 60 has_frames vcan0.log 445
cangw -L >rules.txt
cangw -F
hush
bridge=$near bridge_name=near
stop_bridge
bridge=$far bridge_name=far
stop_bridge
