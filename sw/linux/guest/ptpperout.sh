# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The output: start, phase, half duty, a start far ahead, both ends of the period, jumps of the
# clock beneath it, refusals.
. "$VERICAN_GUEST/events.sh"
phc_ctl /dev/ptp0 set 1000000000.0 >/dev/null
request perout 1000000 start=1000000000500000000
sleep 0.6
request perout 0
mark start
request perout 10000000 phase=3000000 on=5000000
sleep 0.1
request perout 0
mark phase
request perout 1000000000 start=1000000006250000000
sleep 9
request perout 0
mark far
request perout 4000 phase=0
sleep 0.001
request perout 0
mark shortest
request perout 4294967294 phase=0
sleep 10
request perout 0
mark longest
request perout 100000000 phase=0
sleep 0.5
mark forth
phc_ctl /dev/ptp0 -- adj 7.0333 >/dev/null
sleep 0.5
mark back
phc_ctl /dev/ptp0 -- adj -17.7777 >/dev/null
sleep 0.5
mark set
phc_ctl /dev/ptp0 set 1500000000.05 >/dev/null
sleep 0.5
request perout 0
mark jumps
for bad in 1000001 3998 4294967296 5000000000 "1000000 on=250000" "1000000 once"; do
  request perout $bad
done
sleep 0.1
mark end
sim edges can0 edges.txt
