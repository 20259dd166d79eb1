# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# stacks.sh: what the scripts with protocol stacks share: the bus at its highest rate, programs in
# the background, load and errors while they run.
rate=1000000
tell bitrate $rate
tell peer start

# open_bus NAME: devices up; logs of the bus and of both devices.
open_bus() {
  up can0 $rate
  up can1 $rate
  sleep 0.001
  tell log "$1-bus.log"
  listen can0 "$1-can0.log"
  listen can1 "$1-can1.log"
}

# close_bus NAME: what the devices counted is kept.
close_bus() {
  wait_until 10 peer_is_done
  sleep 0.001
  status "$1"
  hush
  tell log off
  down can0
  down can1
}

# in_background COMMAND...: its output goes where the caller's goes; await_all waits for these.
programs=
in_background() {
  "$@" &
  programs="$programs $!"
}

some_run() {
  for pid in $programs; do
    kill -0 "$pid" 2>/dev/null && return 0
  done
  return 1
}

await_all() {
  for pid in $programs; do
    wait "$pid" || echo "FAILED: a program in the background"
  done
  programs=
}

# order COMMAND...: tell without a process of its own, for what is done often.
attribute=$(echo /sys/bus/platform/devices/*.interrupt-controller/command)
order() {
  echo "$*" >"$attribute" && read -r answer <"$attribute" && [ "$answer" = ok ] ||
    echo "FAILED: sim $*: $answer"
}

# weather FRAMES [clear]: until all programs in the background have ended, a third node sends so
# many frames of 8 bytes each 5 ms, and one bit is flipped each 5 ms, where the list says: the
# sender's own bit, a receiver's, in data, CRC and end of frame.
# The burst has not begun then, and the bit is most often one of a device's frame. So many devices'
# frames are hit that at high load a device becomes error passive; and to whom an error happens then
# as the sender, 14 recessive bits for flag and delimiter are not there between the burst's frames
# (11 are): each costs it TEC + 8, as it should, up to bus-off. With spare=N only each Nth bit is
# flipped at once, the others 1 ms later, in the burst.
spare=1
weather() {
  frames=$1 clear=$2 turn=0
  set -- "can0 DATA 6" "can1 CRC 4" "peer DATA 3" "can1 DATA 7" "can0 CRC 11" "peer EOF 2" \
    "can0 EOF 3" "can1 EOF 1"
  while some_run; do
    [ "$frames" = 0 ] || order peer send "$frames" 081#0000C3A596E10F2D
    if [ -z "$clear" ]; then
      turn=$(((turn + 1) % spare))
      [ $turn = 0 ] || sleep 0.001
      order strike $1 flip 1
      last=$1
      shift
      set -- "$@" "$last"
    fi
    if [ $turn = 0 ]; then sleep 0.005; else sleep 0.004; fi
  done
  await_all
}
