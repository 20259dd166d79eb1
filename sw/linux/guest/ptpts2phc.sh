# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# ts2phc makes a clock follow pulses at its pin, which come with the seconds of the system's clock.
. "$VERICAN_GUEST/events.sh"
phc_ctl /dev/ptp0 set 1000000000.3 >/dev/null
ts2phc -c /dev/ptp0 -s generic -m -q >ts2phc.txt 2>&1 &
follower=$!
now=$(sim now) system=$(date +%s%N)
first=$((now + 2000000000 - system % 1000000000))
tell pulse can0 $first 1000000000 70
echo "$now $system" >system.txt
echo "$first" >pulses.txt
sleep 72
kill $follower
