# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A pulse a second as the system sees it, alone and beside the output, which shares its unit.
. "$VERICAN_GUEST/events.sh"

# pulses COUNT: what the system noted of each pulse, one a line.
pulses() {
  count=$1
  while [ "$count" -gt 0 ]; do
    sleep 1
    cat /sys/class/pps/pps0/assert >>pulses.txt
    count=$((count - 1))
  done
}

phc_ctl /dev/ptp0 set 1000000000.6 >/dev/null
# The system's time minus the simulator's does not change.
echo "$(sim now) $(date +%s%N)" >system.txt
request pps 1
pulses 5
request perout 1000000
request perout 1000000000 phase=250000000
request perout 1000000000 phase=0
mark both
pulses 5
mark shifted
phc_ctl /dev/ptp0 -- adj 100.25 >/dev/null
pulses 3
# Over a second: it is not told, nor let out, behind its time.
mark jumped
phc_ctl /dev/ptp0 set 2000000000.2 >/dev/null
phc_ctl /dev/ptp0 -- adj 1.0 >/dev/null
pulses 2
request pps 0
mark output
sleep 2
request perout 0
mark off
request perout 1000000 phase=0
request pps 1
request perout 0
request pps 0
sleep 1.5
cat /sys/class/pps/pps0/assert >last.txt
sim edges can0 edges.txt
