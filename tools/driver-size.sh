#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Builds the C driver for a Cortex-M3 (-Os, all warnings are errors) and prints its size: per
# function, per file and in total. Fails above the limits of TM-90: the code of a time domain, with
# the compiler of packages.txt, and its memory.
# usage: tools/driver-size.sh [--check]     --check: only builds, prints the total
set -eu
cd "$(dirname "$0")/.."
case "$#${1:-}" in
  0 | 1--check) ;;
  *)
    echo "usage: tools/driver-size.sh [--check]" >&2
    exit 2
    ;;
esac
prefix=${CROSS_COMPILE:-arm-none-eabi-}
if ! command -v "${prefix}gcc" >/dev/null; then
  echo "driver-size: ${prefix}gcc not found; install gcc-arm-none-eabi" >&2
  exit 1
fi
out=build/driver-size
rm -rf "$out"
mkdir -p "$out"
flags="-mcpu=cortex-m3 -mthumb -Os -std=c99 -ffunction-sections -fdata-sections -ffreestanding"
flags="$flags -Wall -Wextra -Wconversion -Wshadow -Wpedantic -Werror -Isw/driver/include"
for source in sw/driver/src/*.c; do
  # shellcheck disable=SC2086
  "${prefix}gcc" $flags -fstack-usage -c "$source" -o "$out/$(basename "$source" .c).o"
done
if [ "${1:-}" != --check ]; then
  echo "Bytes per function (Cortex-M3, -Os, $("${prefix}gcc" -dumpversion)); stack of its own frame"
  cat "$out"/*.su | sed 's/^.*:\([a-z_A-Z0-9]*\)\t\([0-9]*\)\t.*/\1 \2/' | sort >"$out/stack"
  for object in "$out"/*.o; do
    "${prefix}nm" -S --size-sort "$object" | awk '$3 ~ /[tT]/ {print $4, $2}'
  done | sort | while read -r name size; do
    stack=$(awk -v n="$name" '$1 == n {print $2; exit}' "$out/stack")
    printf '%6d  stack %4s  %s\n' "0x$size" "${stack:--}" "$name"
  done | sort -k1,1nr
  echo
  "${prefix}size" "$out"/*.o | awk 'NR == 1 {print; next} {sub(/.*\//, "", $6); print}' OFS='\t'
fi
"${prefix}size" -t "$out"/*.o |
  awk 'END {print "total: text " $1 ", data " $2 ", bss " $3 " bytes"}'
# A device: its own structure and the ring, both of the caller.
cat >"$out/sizes.c" <<'SIZES'
#include "verican/timesync.h"
char device[sizeof(verican_t)], frame[sizeof(verican_frame_t)], domain[sizeof(verican_tsyn_t)];
SIZES
# shellcheck disable=SC2086
"${prefix}gcc" $flags -c "$out/sizes.c" -o "$out/sizes.o"
"${prefix}nm" -S "$out/sizes.o" | while read -r _ size _ name; do
  printf 'memory of the caller: %d bytes per %s\n' "0x$size" "$name"
done
# within WHAT LIMIT BYTES
within() {
  [ "$3" -le "$2" ] && return
  echo "driver-size: $1: $3 bytes, at most $2 are allowed (TM-90)" >&2
  exit 1
}
domain=$("${prefix}nm" -S "$out/sizes.o" | awk '$4 == "domain" {print $2}')
within "memory of a time domain" 700 "$((0x$domain))"
code=$("${prefix}size" -t "$out"/servo*.o "$out"/tsyn*.o "$out/masters.o" "$out/delay.o" |
  awk 'END {print $1}')
echo "of it servo, CanTSyn, several masters, delay: text $code bytes"
case $("${prefix}gcc" -dumpversion) in
  12.*) within "code of a time domain" 6144 "$code" ;;
esac
