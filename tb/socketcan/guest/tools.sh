# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Everyday programs on two interfaces of one bus: filters, canplayer, canbusload, python-can.
interface vcan0 vcan1
start_bridge bridge --if vcan0 --if vcan1 --bitrate 500k --nodes 1 --fast --errors none \
  --candump bus.log
listen vcan1 all.log
number=0
for filter in $VERICAN_FILTERS; do
  listen "vcan1,$filter" filter$number.log
  number=$((number + 1))
done
for frame in $VERICAN_SENT; do
  cansend vcan0 "$frame" || complain "cansend $frame"
done
wait_until 60 has_lines all.log "$(echo $VERICAN_SENT | wc -w)"
hush

listen vcan1 played.log
canplayer -t -I "$VERICAN_LOG" vcan0=can0 || complain canplayer
wait_until 60 has_lines played.log "$VERICAN_FRAMES"
hush

open=$(sockets vcan1)
canbusload -e vcan1@500000 >load.txt &
load=$!
wait_until 60 has_sockets vcan1 $((open + 1))  # or listen would take this socket for its own
listen vcan1 load.log
cangen vcan0 -g 1 -n 200 -I i -L i -D i || complain "cangen"
cangen vcan0 -g 0 -e -n 200 -I i -L i -D i || complain "cangen -e"
all_are_counted() {
  [ "$(awk '$1 == "vcan1@500000" { sum += $2 } END { print sum + 0 }' load.txt)" -ge 400 ]
}
wait_until 60 all_are_counted
kill -INT $load
wait $load
hush

/usr/bin/python3 "$VERICAN_GUEST/programs.py" >programs.json || complain "programs.py"
stop_bridge

# The bridge's own filters, written as candump's: NUMBER:FRAMES of them.
for choice in $VERICAN_OWN_FILTERS; do
  number=${choice%:*}
  options=$(echo "$VERICAN_FILTERS" | cut -d " " -f $((number + 1)) | sed 's/^\|,/ --filter /g')
  listen vcan1 own$number.log
  start_bridge own$number --if vcan0 --if vcan1 --nodes 0 --fast $options
  for frame in $VERICAN_SENT; do
    cansend vcan0 "$frame" || complain "cansend $frame"
  done
  wait_until 60 has_lines own$number.log "${choice#*:}"
  stop_bridge
  hush
done
