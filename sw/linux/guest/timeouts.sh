# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Transfers that cannot be: nobody answers, the sender falls silent, a frame is missing, too much is
# announced, the receiver's cable breaks in the middle. Nothing may be delivered, and each must end
# in the time that the protocol gives it.
. "$VERICAN_GUEST/stacks.sh"
load can-isotp
load can-j1939
open_bus timeouts

# timed NAME COMMAND...: what it prints, its exit code, and when it began and ended.
timed() {
  name=$1 began=$(sim now)
  shift
  "$@" >"$name.txt" 2>"$name.err"
  echo "$name $? $began $(sim now)" >>times.txt
}

# ISO-TP. The numbers of bytes that nobody may see are all 100 or more.
timed nobody isotpsend -b -D 100 -s 7A0 -d 7A8 can0
receiver="-s 7B8 -d 7B0 can1"
timed silent isotprecv $receiver &
sleep 0.001
cansend can0 7B0#1064000102030405
wait $!
timed missing isotprecv $receiver &
sleep 0.001
cansend can0 7B0#1064000102030405
sleep 0.01
cansend can0 7B0#21060708090A0B0C
cansend can0 7B0#230D0E0F10111213
wait $!
# 100,000 bytes are announced, in the form of 32 bits: more than the kernel takes.
isotprecv $receiver >toolong.txt &
sleep 0.001
cansend can0 7B0#1000000186A01122
sleep 0.01
kill $!
wait $!
in_background timed cut isotprecv -b 4 $receiver
in_background timed cutsender isotpsend -b -D 4000 -s 7B0 -d 7B8 can0
sleep 0.01
tell cut can1 on
await_all
tell cut can1 off
sleep 0.01

# J1939: no such address; a sender that falls silent after its announcement, and in the middle.
listen_j1939() {
  j1939cat -s 200000 -r "can1:$1,0x12300" >"$2" 2>/dev/null &
  ear=$!
  sleep 0.001
}
timed noaddress j1939cat -P 0 -i hundred.bin can0:0x90 :0xA5,0x12300
listen_j1939 0x98 announced.out
cansend can0 1CEC98B0#1064000FFF002301
sleep 2
cansend can0 1CEC98B1#1064000FFF002301
sleep 0.01
cansend can0 1CEB98B1#0101020304050607
sleep 2
kill $ear
close_bus timeouts
