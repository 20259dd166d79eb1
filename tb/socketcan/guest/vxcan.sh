# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A pair of interfaces, the programs at one end, the bridge at the other: programs that do without
# the kernel's loop-back (cangen -x) see their frames when these have been on the bus. Once as fast
# as possible, once in real time. Then what is refused.
ip link add vx0 type vxcan peer name vx1 || complain "add vxcan"
ip link set vx0 up
ip link set vx1 up
interface mon0
for way in echo silent; do
  [ $way = echo ] && options="--echo --fast" frames=600 || options="" frames=300
  listen vx0 $way.log
  before=$(cat /sys/class/net/mon0/statistics/tx_packets)
  start_bridge $way --if vx1 --monitor mon0 --bus vxcan.yaml --errors none --json \
    --candump $way-bus.log $options
  cangen vx0 -x -g 0 -n 300 -I i -L i -D i || complain "cangen"
  wait_until 60 has_passed mon0 $((before + 600))
  wait_until 60 has_lines $way.log $frames
  stop_bridge
  hush
done

# What is no frame of CAN 2.0 the kernel takes from programs all the same.
start_bridge strange --if vx1 --monitor mon0 --nodes 1 --errors none --json
before=$(cat /sys/class/net/mon0/statistics/tx_packets)
for frame in $VERICAN_STRANGE 123#CAFE; do
  cansend vx0 "$frame" || complain "cansend $frame"
done
wait_until 60 has_passed mon0 $((before + 1))
stop_bridge
