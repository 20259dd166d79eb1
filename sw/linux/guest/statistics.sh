# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Every error reported: the counters of the driver against those of the bus. Errors as sender and as
# receiver; after each step both are read at the same point of time. A third node acknowledges what
# can1 refuses.
tell bitrate 250000
tell peer start
up can0 250000 berr-reporting on
up can1 250000 berr-reporting on
sleep 0.001
status start
listen can0 can0.log ,0:0,#FFFFFFFF
listen can1 can1.log ,0:0,#FFFFFFFF
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"

# step NAME NODE FIELD BIT EFFECT TIMES: frames of can0 that are hit at NODE
number=0
step() {
  name=$1
  shift
  tell strike "$@"
  number=$((number + 1))
  cansend can0 30$number#55AA55AA
  wait_until 2 has_sent can0 $number
  sleep 0.002
  status "$name"
}
step tx-bit can0 DATA 9 flip 3
step tx-ack can0 ACK 0 recessive 2
step tx-form can0 EOF 2 dominant 1
step rx-crc can1 CRC 5 flip 2
step rx-data can1 DATA 12 flip 4
step rx-form can1 CRC_DEL 0 dominant 1
step clean can0 DATA 0 flip 0
hush
down can0
down can1
status stopped
ip link set can0 type can bitrate 250000 berr-reporting off
ip link set can1 type can bitrate 250000 berr-reporting off
