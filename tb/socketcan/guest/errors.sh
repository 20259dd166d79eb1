# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# What goes wrong on the bus, as error messages of the interfaces.
everything=0:0,#FFFFFFFF

# Nobody acknowledges.
interface vcan0 vcan1 mon0
listen vcan0,$everything noack.log
start_bridge noack --if vcan0 --bitrate 500k --nodes 0 --fast --candump noack-bus.log
cansend vcan0 123#1122
wait_until 60 has_lines noack.log 60
stop_bridge
hush

# Every attempt is falsified at the sender up to bus-off; it recovers and sends.
listen vcan0,$everything busoff.log
listen mon0 busoff-mon.log
start_bridge busoff --if vcan0 --monitor mon0 --bus busoff.yaml --fast --restart-ms 20 \
  --candump busoff-bus.log
cansend vcan0 123#80
wait_until 60 has_lines busoff-mon.log 1
cansend vcan0 124#80
wait_until 60 has_lines busoff-mon.log 2
stop_bridge
hush

# A receiver sees errors of four kinds, each in the retry of the frame before.
listen vcan0,$everything receiver.log
start_bridge receiver --if vcan0 --bus receiver.yaml --fast --candump receiver-bus.log
wait_until 60 has_text receiver.log " 123#"
stop_bridge
hush

# Arbitration: both interfaces have their frames before the bus goes on.
listen vcan0,$everything lost0.log
listen vcan1,$everything lost1.log
listen mon0 lost-mon.log
start_bridge lost --if vcan0 --if vcan1 --monitor mon0 --bitrate 500k --nodes 0 --fast \
  --candump lost-bus.log
kill -STOP "$bridge"
for frame in $VERICAN_LOSER; do
  cansend vcan0 "$frame" || complain "cansend $frame"
done
for frame in $VERICAN_WINNER; do
  cansend vcan1 "$frame" || complain "cansend $frame"
done
kill -CONT "$bridge"
wait_until 60 has_lines lost-mon.log "$(echo $VERICAN_LOSER $VERICAN_WINNER | wc -w)"
stop_bridge
hush

# The same choice of messages, but changes of state alone; then none.
for choice in state none; do
  listen vcan0,$everything $choice.log
  start_bridge $choice --if vcan0 --bitrate 500k --nodes 0 --fast --errors $choice --time "100 ms"
  cansend vcan0 123#1122
  wait_until 60 has_ended "$bridge"
  await_bridge
  hush
done
