# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The kernel's testptp and linuxptp's phc_ctl, each option once.
. "$VERICAN_GUEST/events.sh"

# testptp NAME OPTION...: what it says goes to NAME.txt.
testptp() {
  name=$1
  shift
  "$VERICAN_MODULES/testptp" -d /dev/ptp0 "$@" >"$name.txt" 2>&1 || echo "FAILED: testptp $*"
}

testptp caps -c
echo "$(sim now) $(date +%s%N)" >system.txt
testptp set -s
testptp get1 -g
testptp shift -t 5
testptp get2 -g
testptp shiftns -n 250000000
testptp get3 -g
testptp rate -f 50000
testptp samples -k 5
testptp ppson -P 1
sleep 2
cat /sys/class/pps/pps0/assert >pulses.txt
testptp ppsoff -P 0
testptp perout -p 2000000 -H 500000 -w 1000000
mark on
sleep 0.1
testptp perout0 -p 0
mark off
sim edges can0 edges.txt
tell pulse can0 $(($(sim now) + 1000000)) 1000000 3
testptp events0 -e 3
phc_ctl /dev/ptp0 -- set get adj 1.5 get freq 0 freq wait 1.0 cmp >phc.txt
