# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# ISO-TP: two streams of PDUs each way at once, with 11 bits, with extended addressing, with 29
# bits, while a third node takes 80 % of the bus and bits are flipped. The PDUs are files:
# STREAM-N.pdu. VERICAN_SABOTAGE: what to spoil after the first PDUs.
. "$VERICAN_GUEST/stacks.sh"
load can-isotp

# stream NAME SENDER RECEIVER OPTIONS-OF-SENDER OPTIONS-OF-RECEIVER
receivers=
stream() {
  name=$1 sender=$2
  stdbuf -oL isotprecv -l $5 "$3" >"$name.txt" &
  receivers="$receivers $!"
  in_background send_all "$name" "$sender" "$4"
}

send_all() {
  for pdu in "$1"-*.pdu; do
    isotpsend -b $3 "$2" <"$pdu" || echo "FAILED: isotpsend $pdu"
  done
}

open_bus isotp
isotpperf -s 7A0 -d 7A8 can1 >perf.txt &
perf=$!
stream plain can0 can1 "-s 7A0 -d 7A8" "-s 7A8 -d 7A0"
stream extended can1 can0 "-s 7B0 -d 7B8 -x 5A:A5" "-s 7B8 -d 7B0 -x A5:5A -b F"
stream wide can1 can0 "-s 18DAF110 -d 18DA10F1 -p AA:55" \
  "-s 18DA10F1 -d 18DAF110 -b 8 -m F5 -p 55:AA"
stream slow can0 can1 "-s 18DB33F1 -d 18DBF133 -x 11:22" \
  "-s 18DBF133 -d 18DB33F1 -x 22:11 -b 20 -m 1"
[ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
spare=3
weather "$VERICAN_LOAD"
sleep 0.1
kill $receivers
kill -INT $perf
close_bus isotp
