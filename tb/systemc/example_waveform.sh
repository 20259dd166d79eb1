#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# example_waveform.sh PLATFORM VERICAN: the example platform's VCD file, read by the tool, holds the
# frames that the two sides have sent, each with its data.
set -euo pipefail
platform=$1 verican=$2
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

"$platform" --frames 8 --quiet --vcd "$dir/platform"
"$verican" decode "$dir/platform.vcd" --signal level --candump "$dir/frames.log" >/dev/null
found=$(awk '{print $3}' "$dir/frames.log" | sort)
# Frame n of a side: identifier base + n, n bytes, byte i is 7 n + 29 i (examples/systemc).
expected=$(for base in 256 512; do
  for n in 0 1 2 3 4 5 6 7; do
    printf '%03X#' $((base + n))
    for ((i = 0; i < n; i++)); do printf '%02X' $(((7 * n + 29 * i) % 256)); done
    printf '\n'
  done
done | sort)
diff <(printf '%s\n' "$expected") <(printf '%s\n' "$found")
