# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# lib.sh: what the guest's scripts share. What they find out goes to files in the current directory,
# where tb/socketcan/uml judges it; "FAILED" on the console fails the case.

complain() {
  echo "FAILED: $*"
}

# wait_until SECONDS COMMAND...: until the command succeeds; complains after that time.
wait_until() {
  steps=$(($1 * 10))
  shift
  while ! "$@"; do
    steps=$((steps - 1))
    if [ $steps -le 0 ]; then
      complain "waited for: $*"
      return 1
    fi
    sleep 0.1
  done
}

# interface NAME...: virtual CAN interfaces, up.
interface() {
  for name in "$@"; do
    ip link add "$name" type vcan || complain "add $name"
    ip link set "$name" up || complain "up $name"
  done
}

# sockets INTERFACE: number of filters by which raw sockets listen to it.
sockets() {
  cat /proc/net/can/rcvlist_* | grep -c "^ *$1 .* raw\$"
}

has_sockets() {
  [ "$(sockets "$1")" -ge "$2" ]
}

# count FILE: its lines; none if it is not there yet.
count() {
  if [ -f "$1" ]; then wc -l <"$1"; else echo 0; fi
}

has_lines() {
  [ "$(count "$1")" -ge "$2" ]
}

has_text() {
  grep -q -- "$2" "$1" 2>/dev/null
}

has_ended() {
  ! kill -0 "$1" 2>/dev/null
}

# listen INTERFACE[,FILTER...] FILE [OPTION...]: logs what programs there see, until hush. Returns
# when the socket is open.
listeners=
listen() {
  device=${1%%,*} before=$(sockets "${1%%,*}") what=$1 file=$2
  shift 2
  candump -L -r 33554432 "$@" "$what" >"$file" 2>"$file.err" &
  listeners="$listeners $!"
  wait_until 60 has_sockets "$device" $((before + 1))
}

# A process that sleeps has read what there was.
is_idle() {
  read -r status <"/proc/$1/stat" 2>/dev/null || return 0
  case $status in *") R "*) return 1 ;; esac
}

hush() {
  for pid in $listeners; do
    wait_until 60 is_idle "$pid"
    kill -TERM "$pid" 2>/dev/null
    wait "$pid" 2>/dev/null
  done
  listeners=
}

# has_passed INTERFACE PACKETS
has_passed() {
  [ "$(cat "/sys/class/net/$1/statistics/tx_packets")" -ge "$2" ]
}

# statistics INTERFACE FILE: what the kernel counted there.
statistics() {
  ip -json -statistics link show "$1" >"$2"
}

# start_bridge NAME OPTION...: returns when programs may send, or if it has ended before. Its output
# is NAME.out and NAME.err. It runs under the command $as, if that is set.
bridge=
as=
is_ready() {
  has_text "$bridge_name.err" "ready" || has_ended "$bridge"
}

start_bridge() {
  bridge_name=$1
  shift
  $as "$VERICAN" bridge "$@" >"$bridge_name.out" 2>"$bridge_name.err" &
  bridge=$!
  wait_until 60 is_ready
}

# await_bridge: until it has ended; its exit code is in NAME.code.
await_bridge() {
  wait "$bridge"
  echo $? >"$bridge_name.code"
  bridge=
}

# stop_bridge [SIGNAL]
stop_bridge() {
  kill -"${1:-TERM}" "$bridge" || complain "$bridge_name had ended before it was stopped"
  await_bridge
}
