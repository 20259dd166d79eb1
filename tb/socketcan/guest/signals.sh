# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The end in the middle of a flood: while the program still sends, and when it has sent everything.
interface vcan0 mon0
for signal in INT TERM; do
  listen mon0 $signal-mon.log
  start_bridge $signal --if vcan0 --monitor mon0 --bitrate 1M --nodes 1 --fast --json \
    --errors none --candump $signal-bus.log --pcap $signal.pcap
  cangen vcan0 -g 0 -n 10000 -I i -L i -D i &
  sender=$!
  wait_until 60 has_lines $signal-mon.log 300
  [ $signal = INT ] || wait $sender
  stop_bridge $signal
  [ $signal != INT ] || wait $sender
  hush
done
