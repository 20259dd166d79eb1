#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# dist.sh OUT: the archives of a release and all that is checked of them but is too long for
# make test: the figures of the families are of this RTL, all twelve Verilog-2005 builds equal their
# sources, the archive stands alone. With nextpnr-ice40 and icestorm the archive has the bitstream
# of examples/hx8k.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 1 "dist.sh OUT" "$@"
tools/families.py --check
bitstream=()
if all_there nextpnr-ice40 icepack icetime; then
  tools/hx8k.sh build/dist-hx8k
  bitstream=(--bitstream build/dist-hx8k/can_hx8k.bin)
else
  echo "dist: no bitstream of examples/hx8k" >&2
fi
tools/dist.py "$1" "${bitstream[@]}"
builds=()
for bus in ahb apb axil wb; do
  for size in 16 32 64; do builds+=("${bus}_$size"); done
done
/usr/bin/python3 -B tb/integration/flat_file.py "${builds[@]}"
/usr/bin/python3 -B tb/dist/archive.py "$1" "${builds[@]}"
echo "In $1:"
cat "$1/SHA256SUMS"
