# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# A log of verican goes through canplayer onto a vcan: with its times, then as fast as it goes.
interface vcan0
for way in timed flat; do
  listen vcan0 $way.log
  [ $way = timed ] && option= || option=-t
  canplayer $option -I "$VERICAN_LOG" vcan0=can0 || complain "canplayer $option"
  wait_until 60 has_lines $way.log "$VERICAN_FRAMES"
  hush
done
