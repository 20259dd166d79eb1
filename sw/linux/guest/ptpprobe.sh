# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The driver binds to both time units, beside the CAN driver and without it; set and read.
. "$VERICAN_GUEST/clocks.sh"
phc_ctl /dev/ptp0 caps >caps.txt
cat /sys/class/ptp/ptp0/clock_name /sys/class/ptp/ptp1/clock_name >names.txt
ethtool -i can0 >driver.txt
busybox rmmod flexcan || echo "FAILED: rmmod flexcan"
phc_ctl /dev/ptp0 set 1000000000.5 wait 2.0 get >set0.txt
phc_ctl /dev/ptp1 set 2000000000.25 get >set1.txt
phc_ctl /dev/ptp0 get >get0.txt
busybox rmmod ptp_verican || echo "FAILED: rmmod ptp_verican"
[ -e /dev/ptp0 ] && echo "FAILED: a clock without a driver"
load ptp_verican
# The time goes on through all of that.
phc_ctl /dev/ptp0 get >again0.txt
sim now >now.txt
cat /proc/interrupts >interrupts.txt
