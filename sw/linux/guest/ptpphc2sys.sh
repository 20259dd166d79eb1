# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# phc2sys makes the second hardware clock follow the first.
. "$VERICAN_GUEST/events.sh"
phc_ctl /dev/ptp0 set 1000000000.0 >/dev/null
phc_ctl /dev/ptp1 set 1000000000.0004 >/dev/null
phc2sys -s /dev/ptp0 -c /dev/ptp1 -O 0 -m -q >toclock.txt 2>&1 &
follower=$!
sleep 60
sim now >minute.txt
sleep 10
kill $follower
