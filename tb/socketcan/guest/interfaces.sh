# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Interfaces that are not there, down, and that come and go under traffic.
ip link add vcan7 type vcan
# refuse NAME OPTION...: a start that must fail
refuse() {
  name=$1
  shift
  "$VERICAN" bridge "$@" >"$name.out" 2>"$name.err"
  echo $? >"$name.code"
}
interface vcan0 vcan1 mon0
refuse missing --if nope0 --fast
refuse down --if vcan7 --fast
refuse no-can --if lo --fast
refuse monitor --if vcan0 --monitor nope1 --fast

# accept INTERFACE OPTION...: frames that the bridge has been handed, but not yet seen.
accept() {
  kill -STOP "$bridge"
  cangen "$@" -g 0 || complain "cangen $*"
}
come_and_go=0
has_said() {
  [ "$(grep -c -- "$1" traffic.err)" -ge "$come_and_go" ]
}

listen vcan1 vcan1.log
listen mon0 mon0.log
start_bridge traffic --if vcan0 --if vcan1 --monitor mon0 --bitrate 1M --nodes 1 --fast --json \
  --errors none --candump traffic-bus.log
come_and_go=1
accept vcan0 -n 1000 -I i -L i -D i
kill -CONT "$bridge"
ip link set vcan0 down
wait_until 60 has_said "vcan0 is down"
cangen vcan1 -g 0 -e -n 300 -I i -L i -D i
wait_until 60 grep -q 0000012B# mon0.log
ip link set vcan0 up
wait_until 60 has_said "vcan0 is back"
wait_until 60 has_lines mon0.log 1300
listen vcan0 vcan0-back.log
cangen vcan0 -g 0 -n 100 -I 7F0 -L 8 -D i
cangen vcan1 -g 0 -n 100 -I 7F1 -L 8 -D i
wait_until 60 has_lines vcan0-back.log 200
wait_until 60 has_lines mon0.log 1500
hush

# It vanishes, and another one of that name comes.
come_and_go=2
listen vcan1 vcan1-late.log
listen mon0 mon0-late.log
accept vcan0 -e -n 200 -I 1ABCDEF0 -L 8 -D i
kill -CONT "$bridge"
ip link del vcan0
wait_until 60 has_said "vcan0 is down or gone"
cangen vcan1 -g 0 -n 100 -I 7F3 -L 8 -D i
wait_until 60 grep -q 7F3#6300000000000000 mon0-late.log
interface vcan0
wait_until 60 has_said "vcan0 is back"
cangen vcan0 -g 0 -n 100 -I 7F2 -L 8 -D i
wait_until 60 has_lines mon0-late.log 400
wait_until 60 has_lines vcan1-late.log 400
stop_bridge
hush

start_bridge end --if vcan0 --fast --end-when-down
ip link set vcan0 down
wait_until 60 has_ended "$bridge"
await_bridge
ip link set vcan0 up

# Without automatic restart a node stays bus-off until its interface comes up again, or a signal.
for way in up signal; do
  listen mon0 $way-mon.log
  listen vcan0,0~0,#FFFFFFFF $way.log -D
  start_bridge $way --if vcan0 --monitor mon0 --bus busoff.yaml --fast --restart-ms 0 --json
  cansend vcan0 123#80
  wait_until 60 has_text $way.log " 200000C8#"
  if [ $way = up ]; then
    ip link set vcan0 down
    wait_until 60 has_text $way.err "vcan0 is down"
    ip link set vcan0 up
  else
    kill -USR1 "$bridge"
  fi
  wait_until 60 has_text $way-mon.log "123#80"
  stop_bridge
  hush
done

# Without CAP_NET_ADMIN the bridge gets a small buffer, and with a flood the kernel drops frames
# before the bridge can read them. It tells with the next frame, and the bridge counts them.
echo 212992 >/proc/sys/net/core/rmem_max
listen mon0 small-mon.log
as="setpriv --bounding-set -net_admin --inh-caps -net_admin"
start_bridge small --if vcan0 --monitor mon0 --bitrate 1M --nodes 1 --fast --json --errors none
accept vcan0 -n 2000 -I 7F0 -L 8 -D i
kill -CONT "$bridge"
wait_until 60 has_lines small-mon.log 100
cansend vcan0 123#
wait_until 60 has_text small-mon.log " 123#"
stop_bridge
hush
