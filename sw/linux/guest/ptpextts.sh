# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Edges at the pin of each clock, as testptp prints them.
. "$VERICAN_GUEST/events.sh"
phc_ctl /dev/ptp0 set 1000000000.999 >/dev/null
phc_ctl /dev/ptp1 -- set 2000000000.25 freq -50000000 >/dev/null
now=$(sim now)
# Pulses of odd lengths, not in step with any clock.
first0=$((now + 100000037)) first1=$((now + 150000411))
"$VERICAN_MODULES/testptp" -d /dev/ptp0 -e 40 >events0.txt &
"$VERICAN_MODULES/testptp" -d /dev/ptp1 -e 40 >events1.txt &
sleep 0.01
tell pulse can0 $first0 10000333 40
tell pulse can1 $first1 10000777 40
wait
# Nobody asked for these.
interrupts() {
  grep e0001000.clock /proc/interrupts
}
before=$(interrupts)
tell pulse can0 $(($(sim now) + 1000000)) 1000000 5
sleep 0.1
[ "$before" = "$(interrupts)" ] || echo "FAILED: events unasked"
echo "$first0 $first1" >pulses.txt
