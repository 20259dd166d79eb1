# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The driver is unloaded and loaded again in the middle of traffic.
tell bitrate 500000
tell peer start
for round in 1 2 3; do
  up can0 500000
  up can1 500000
  tell peer send 400 181#0001020304050607
  cangen can0 -g 0 -n 400 -I 300 -L 8 -D i 2>cangen$round.txt &
  sleep 0.02
  status "before$round"
  busybox rmmod flexcan || echo "FAILED: rmmod in round $round"
  wait $!
  load flexcan
  up can0 500000
  up can1 500000
  sleep 0.001
  # The logs begin on a bus at rest: of a frame on its way one log would have the end alone.
  tell peer stop
  sleep 0.001
  tell log "bus$round.log"
  listen can0 "can0-$round.log"
  listen can1 "can1-$round.log"
  tell peer send 400 181#8001020304050607
  cangen can1 -g 0 -n 50 -e -I i -L i -D i
  wait_until 5 has_sent can1 50
  status "after$round"
  tell peer stop
  sleep 0.002
  hush
  tell log off
  down can0
  down can1
done
