# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Nodes without a processor, the RTL, on a virtual CAN: the golden vectors through both clients, one
# bridge for each node of them and each profile, and `verican memory` (RN-93, RN-95).
interface vcan0
export VERICAN_INTERFACE=vcan0 VERICAN_VECTORS VERICAN_PROFILE VERICAN_LIFE

# vectors CLIENT COMMAND...: the client's name in those of the files, and what runs it.
vectors() {
  client=$1
  shift
  for VERICAN_PROFILE in small full; do
    for VERICAN_LIFE in 0 1; do
      name=$client-$VERICAN_PROFILE-$VERICAN_LIFE
      listen vcan0 $name.log
      start_bridge $name --if vcan0 --bus $VERICAN_PROFILE-$VERICAN_LIFE.yaml --fast --errors none
      wait_until 60 has_lines $name.log 1
      "$@" >$name.txt 2>&1
      echo $? >$name.client
      hush
      stop_bridge
    done
  done
}
vectors c "$VERICAN_CLIENT"
vectors python /usr/bin/python3 -B "$VERICAN_PYTHON_CLIENT"

# memory NAME ARGUMENT...: one use of the tool; its words and its exit code.
memory() {
  what=$1
  shift
  "$VERICAN" memory --if vcan0 --timeout 5000 "$@" >"$what.out" 2>"$what.err"
  echo $? >"$what.code"
}
start_bridge memory --if vcan0 --bus small-0.yaml --fast --errors none
memory scan scan --json
memory write write 3 0x20 5A A5
memory read read 3 0x20 3 --json
memory refused write 3 0xE00 01
stop_bridge

ip link set vcan0 down
memory down read 3 0x20 1
