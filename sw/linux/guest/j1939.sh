# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# J1939: two claimants of one address; single frames to sockets with and without a PGN; broadcast,
# TP and ETP transfers both ways under load and errors; time-outs.
# VERICAN_SABOTAGE: what to spoil before the transfers.
. "$VERICAN_GUEST/stacks.sh"
load can-j1939
A=8000000000000A01 B=8000000000000B02
open_bus j1939

# One has 80, then the other wants it, whose smaller NAME has the right to it.
j1939acd -r 0x80,0x90-0x93 -a 0x80 $B can0 2>acdB.txt &
claimers=$!
sleep 2
j1939acd -r 0x80,0x98-0x9B -a 0x80 $A can1 2>acdA.txt &
claimers="$claimers $!"
sleep 2
echo "$A $B" >names.txt

# hear FILE ADDRESS: what a socket at can1 receives.
ears=
hear() {
  stdbuf -oL testj1939 -B -r "can1:$2" >"$1" &
  ears="$ears $!"
}
hear all.txt 0x80
hear pgn.txt 0x80,0x12300
hear peer.txt 0x80,0x0FEF1
hear named.txt ",,0x$A"
hear elsewhere.txt 0x81
sleep 0.01
for pgn in 0x12300 0x12400 0x0FEF1 0x0FEF2; do
  for to in 0x80 0x81 0xFF; do
    testj1939 -B -s8 "can0:,,0x$B" ":$to,$pgn" || echo "FAILED: testj1939 $to $pgn"
  done
done
testj1939 -s5 -p3 "can0:,,0x$B" ":,0x12300,0x$A" || echo "FAILED: testj1939 by name"
sleep 0.05
kill $ears

# The guest has no memory for the longest message, hence -s.
# take FILE ADDRESS [OPTION]: what j1939cat receives.
takers=
take() {
  j1939cat -s 200000 $3 -r "$2" >"$1" 2>"$1.err" &
  takers="$takers $!"
}
take tp.out can1:0x98,0x12300
take etp.out can1:0x80,0x12500
take back.out can0:0x90,0x12400
take bam.out can1:0x81,0x0FEF1 -B
sleep 0.01
# send ADDRESS ADDRESS OPTIONS FILE...: one after the other. With -P 0 the j1939cat of can-utils
# 2020.11 ends when all is sent, with a wrong complaint; without it, it cannot read what newer
# kernels tell of a transfer (docs/stacks.md).
send() {
  by=$1 to=$2 options=$3
  shift 3
  for file in "$@"; do
    j1939cat -P 0 $options -i "$file" "$by" "$to" 2>"$file.err" ||
      grep -q "transferred 0 bytes" "$file.err" || echo "FAILED: j1939cat $file"
  done
}
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
in_background send can0:0x90 :0x80,0x12500 "" etp.bin
in_background send can0:0x90 :0x98,0x12300 "" tp-*.bin
in_background send can1:0x80 :0x90,0x12400 "" back-*.bin
in_background send can0:0x90 :0xFF,0x0FEF1 -B bam.bin
weather "$VERICAN_LOAD"
sleep 0.1
kill $takers $claimers
close_bus j1939
