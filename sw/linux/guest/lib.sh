# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# lib.sh: what the guest's scripts share. What they find out goes to files in the current directory,
# where sw/linux/run.py judges it.

# load MODULE [OPTION...]
load() {
  module=$1
  shift
  busybox insmod "$VERICAN_MODULES/$module.ko" "$@" || echo "FAILED: insmod $module"
}

# sim COMMAND...: a command for the simulator (docs/software.md lists them); prints its answer.
sim() {
  attribute=$(echo /sys/bus/platform/devices/*.interrupt-controller/command)
  echo "$*" >"$attribute" || echo "FAILED: sim $*: $(cat "$attribute")"
  cat "$attribute"
}

# tell COMMAND...: the same, in silence if it goes well.
tell() {
  answer=$(sim "$@")
  [ "$answer" = ok ] || echo "FAILED: sim $*: $answer"
}

# up DEVICE RATE [OPTION...]: options as of ip link ... type can.
up() {
  device=$1 rate=$2
  shift 2
  ip link set "$device" txqueuelen 1000
  ip link set "$device" type can bitrate "$rate" "$@" || echo "FAILED: set $device"
  ip link set "$device" up || echo "FAILED: up $device"
}

down() {
  ip link set "$1" down || echo "FAILED: down $1"
}

# status NAME: what ip says of both devices, and what the simulator saw, at one point of time.
status() {
  ip -json -details -statistics link show can0 >"$1-can0.json"
  ip -json -details -statistics link show can1 >"$1-can1.json"
  sim report >"$1-bus.txt"
}

# listen DEVICE FILE [FILTER...]: logs what a device receives and sends, until hush.
listeners=
listen() {
  device=$1 file=$2
  shift 2
  candump -L "$device$*" >"$file" &
  listeners="$listeners $!"
}

hush() {
  sleep 0.002
  for pid in $listeners; do
    kill -TERM "$pid"
    wait "$pid" 2>/dev/null
  done
  listeners=
}

sent() {
  cat "/sys/class/net/$1/statistics/tx_packets"
}

# wait_until SECONDS COMMAND...: until the command succeeds; complains after that time, or after
# VERICAN_STEPS steps of 5 ms if that is set.
wait_until() {
  steps=${VERICAN_STEPS:-$(($1 * 200))}
  shift
  while ! "$@"; do
    steps=$((steps - 1))
    if [ $steps -le 0 ]; then
      echo "FAILED: waited for: $*"
      return 1
    fi
    sleep 0.005
  done
}

has_sent() {
  [ "$(sent "$1")" -ge "$2" ]
}

peer_is_done() {
  [ "$(sim peer pending)" = 0 ]
}

state_is() {
  ip -details link show "$1" | grep -q "can .*state $2 "
}
