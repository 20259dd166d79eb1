# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A pair of interfaces, the programs at one end, the bridge at the other: programs that do without the
# kernel's loop-back (cangen -x) see their frames when these have been on the bus.
ip link add vx0 type vxcan peer name vx1 || complain "add vxcan"
ip link set vx0 up
ip link set vx1 up
for way in echo silent; do
  [ $way = echo ] && option=--echo frames=600 || option="" frames=300
  listen vx0 $way.log
  start_bridge $way --if vx1 --bus vxcan.yaml --fast --errors none --json --candump $way-bus.log \
    $option
  cangen vx0 -x -g 0 -n 300 -I i -L i -D i || complain "cangen"
  wait_until 60 has_lines $way.log $frames
  stop_bridge
  hush
done
