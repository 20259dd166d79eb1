# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Two interfaces are two nodes of one bus, on each two programs. The bridge is stopped until all
# have sent everything, so that both nodes have a frame to send all the time: the bus decides which.
interface vcan0 vcan1
listen vcan0 vcan0.log
listen vcan1 vcan1.log
start_bridge bridge --if vcan0 --if vcan1 --bitrate 1M --nodes 0 --fast --errors none \
  --candump bus.log
kill -STOP "$bridge"
players=
for program in vcan0-a vcan0-b vcan1-a vcan1-b; do
  canplayer -t -I $program.sent "${program%-?}=can0" &
  players="$players $!"
done
for player in $players; do
  wait "$player" || complain "canplayer"
done
kill -CONT "$bridge"
wait_until 200 has_lines vcan0.log 4000
wait_until 200 has_lines vcan1.log 4000
stop_bridge
statistics vcan0 vcan0.json
statistics vcan1 vcan1.json
hush
