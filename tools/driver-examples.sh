#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Compiles every C example of docs/driver.md, for the host and for a Cortex-M3: those with an
# #include as they are, the others as the body of a function that has `can` and `config`.
# usage: tools/driver-examples.sh
set -eu
cd "$(dirname "$0")/.."
out=build/driver-examples
rm -rf "$out"
mkdir -p "$out"
awk -v out="$out" '
  /^```c$/ {inside = 1; text = ""; whole = 0; line = NR + 1; next}
  /^```$/ && inside {
    inside = 0
    file = sprintf("%s/%03d.c", out, ++count)
    place = sprintf("#line %d \"docs/driver.md\"\n", line)
    if (whole) {
      printf "%s%s", place, text >file
    } else {
      printf "#include \"verican/timesync.h\"\n" \
             "void example(verican_t *can, verican_config_t *config);\n" \
             "void example(verican_t *can, verican_config_t *config) {\n" \
             "(void)can, (void)config;\n%s%s}\n", place, text >file
    }
    close(file)
  }
  inside {text = text $0 "\n"; if (/^#include/) whole = 1}
  END {if (count == 0) {print "driver-examples: docs/driver.md has none"; exit 1}}' docs/driver.md
flags="-std=c99 -Wall -Wextra -Wshadow -Wpedantic -Werror -Isw/driver/include"
for source in "$out"/*.c; do
  # shellcheck disable=SC2086
  ${CC:-cc} $flags -c "$source" -o "${source%.c}.o"
  # shellcheck disable=SC2086
  "${CROSS_COMPILE:-arm-none-eabi-}gcc" -mcpu=cortex-m3 -mthumb -ffreestanding $flags \
    -c "$source" -o "${source%.c}.arm.o"
done
echo "driver-examples: $(find "$out" -name '*.c' | wc -l) examples compile"
