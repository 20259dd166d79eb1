# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# events.sh: what the scripts with pins and pulses share.
. "$VERICAN_GUEST/clocks.sh"

# request WORD...: see request.c; one answer a line.
request() {
  echo "$*: $("$VERICAN_MODULES/request" /dev/ptp0 "$@")" >>answers.txt
}

# mark NAME: the simulated time, for the judge; the driver's worker has done by then what was asked.
mark() {
  sleep 0.001
  echo "$1 $(sim now)" >>marks.txt
}
