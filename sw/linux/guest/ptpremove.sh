# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The driver goes while edges and pulses come, and comes back silent.
. "$VERICAN_GUEST/events.sh"

interrupts() {
  grep e0001000.clock /proc/interrupts
}

for turn in 1 2 3; do
  phc_ctl /dev/ptp0 set "$turn.9" >/dev/null
  request pps 1
  "$VERICAN_MODULES/testptp" -d /dev/ptp0 -e 1000000 >/dev/null &
  reader=$!
  sleep 0.2
  cat /sys/class/pps/pps0/assert >"pulse$turn.txt"
  # Edges for 6 ms, and with them what is left of this turn.
  tell pulse can0 $(($(sim now) + 100000)) 5003 1200
  sleep 0.001
  # Who is killed leaves the events on.
  kill -KILL $reader
  wait $reader 2>/dev/null
  before=$(interrupts)
  sleep 0.001
  [ "$before" != "$(interrupts)" ] || echo "FAILED: no events any more"
  busybox rmmod ptp_verican || echo "FAILED: rmmod ptp_verican"
  interrupts && echo "FAILED: an interrupt without a driver"
  sleep 0.001
  load ptp_verican
  before=$(interrupts)
  sleep 0.001
  [ "$before" = "$(interrupts)" ] || echo "FAILED: events unasked"
  sleep 0.01
done
