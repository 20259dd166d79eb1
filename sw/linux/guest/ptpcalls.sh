# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Rate, phase and shift of a clock, at both ends of what is allowed and beyond.
. "$VERICAN_GUEST/clocks.sh"
phc_ctl /dev/ptp0 -- set 1000000000.0 freq 100000 wait 10.0 get >fast.txt
phc_ctl /dev/ptp0 -- adj -1.5 get adj 86400.25 get >shift.txt
phc_ctl /dev/ptp0 -- freq -100000000 wait 3.0 get freq 100000000 wait 3.0 get >ends.txt
phc_ctl /dev/ptp0 -- freq 12345.678 wait 1.0 get >odd.txt
phc_ctl /dev/ptp0 -- freq 100000001 >beyond.txt 2>&1
# The second change of the phase would take a second; the time that is set ends it.
phc_ctl /dev/ptp0 -- freq 0
"$VERICAN_MODULES/request" /dev/ptp0 phase -300000
phc_ctl /dev/ptp0 -- wait 1.0 get >phased.txt
"$VERICAN_MODULES/request" /dev/ptp0 phase 1000000
phc_ctl /dev/ptp0 -- set 5000000000.0 wait 0.5 get >set.txt
