# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# clocks.sh: what the scripts with hardware clocks share: devices and their driver.
mount -t devtmpfs none /dev || echo "FAILED: no /dev"
load ptp_verican
for clock in 0 1; do
  [ -c /dev/ptp$clock ] || echo "FAILED: no /dev/ptp$clock"
done
