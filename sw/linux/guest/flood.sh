# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A third node sends the shortest frames without a pause, then the longest: nothing may be lost.
for rate in $(echo "$VERICAN_RATES" | tr , ' '); do
  tell bitrate "$rate"
  tell peer start
  up can0 "$rate"
  up can1 "$rate"
  sleep 0.001
  tell log "$rate-bus.log"
  listen can0 "$rate-can0.log"
  listen can1 "$rate-can1.log"
  tell peer send "$VERICAN_FRAMES" 5A5#
  tell peer send "$VERICAN_FRAMES" 2AA#0000555555555555
  wait_until 5 peer_is_done
  status "$rate"
  hush
  tell log off
  down can0
  down can1
done
