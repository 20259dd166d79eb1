# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Probe, up, down, three times, with what the tools tell of a device.
status stopped
ethtool -i can0 >driver.txt
ethtool --show-priv-flags can0 >flags.txt
tell bitrate 500000
for round in 1 2 3; do
  up can0 500000
  up can1 500000
  sleep 0.001
  status "up$round"
  cansend can0 "10$round#0$round"
  sleep 0.001
  status "sent$round"
  down can0
  down can1
  status "down$round"
done
cat /proc/interrupts >interrupts.txt
