# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Both devices send as fast as they can, base frames one way and extended ones the other, and each
# log is compared with the bus. Lengths, identifiers and data are random; the first frames are
# remote ones.
# VERICAN_RATES: bit rates with commas. VERICAN_FRAMES: from each device at each rate.
# VERICAN_SABOTAGE: what to spoil after the first frames.
for rate in $(echo "$VERICAN_RATES" | tr , ' '); do
  tell bitrate "$rate"
  up can0 "$rate"
  up can1 "$rate"
  sleep 0.001
  tell log "$rate-bus.log"
  listen can0 "$rate-can0.log"
  listen can1 "$rate-can1.log"
  before0=$(sent can0) before1=$(sent can1)
  cangen can0 -g 0 -n 20 -I r -L r -D r -R
  [ -z "$VERICAN_SABOTAGE" ] || tell sabotage "$VERICAN_SABOTAGE"
  cangen can0 -g 0 -n "$VERICAN_FRAMES" -I r -L r -D r &
  cangen can1 -g 0 -n "$VERICAN_FRAMES" -e -I r -L r -D r &
  wait_until 10 has_sent can0 $((before0 + VERICAN_FRAMES + 20))
  wait_until 10 has_sent can1 $((before1 + VERICAN_FRAMES))
  status "$rate"
  hush
  tell log off
  down can0
  down can1
done
