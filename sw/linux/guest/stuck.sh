# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A bus that is stuck dominant, then one that is stuck recessive: the driver's mode changes have
# time limits, and each must be met. Afterwards everything works as before.
tell bitrate 500000
for level in dominant recessive; do
  tell hold $level
  up can0 500000
  sleep 0.005
  status "$level"
  down can0
  up can0 500000
  sleep 0.001
  tell hold off
  up can1 500000
  sleep 0.005
  goal=$(($(sent can0) + 1))
  cansend can0 123#44
  wait_until 1 has_sent can0 $goal
  status "after-$level"
  # In the middle of a frame, and while it cannot be sent.
  tell hold dominant
  cansend can0 124#55
  sleep 0.0003
  down can0
  tell hold off
  down can1
done
