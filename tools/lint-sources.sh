#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# lint-sources.sh CHECK: one of the checks of all source files that look at nothing but their text:
# licence_heads, line_length, comments, parameters, registers, format. It prints what is wrong;
# status 1 if something is, or if there are no files to look at.
set -uo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 1 "lint-sources.sh CHECK" "$@"

licence_heads() {
  local files bad licence head
  files=$(our_files '*.sv' '*.v' '*.vlt' '*.cpp' '*.hpp' '*.c' '*.h' '*.py' '*.sh' '*.cmake' \
                    '*.tcl' '*.js' '*.mjs' '*.sdc' '*.pdc' '*.pcf' '*.yaml' '*.core' \
                    '*CMakeLists.txt' Makefile .ci/run) || return 1
  bad=$(while read -r file; do
          # Kernel modules link with the kernel.
          [[ $file == sw/linux/@(glue|ptp)/* ]] && licence=GPL-2.0 || licence=Apache-2.0
          mapfile -n 5 head <"$file"
          [[ ${head[*]} == *"SPDX-License-Identifier: $licence"* ]] || echo "$file"
        done <<<"$files")
  printf '%s' "$bad"
  [ -z "$bad" ]
}
line_length() {
  local files
  files=$(our_files '*.sv' '*.cpp' '*.hpp' '*.c' '*.h' '*.py' '*.sh' '*.cmake' '*CMakeLists.txt' \
                    '*.js' '*.mjs') || return 1
  xargs awk 'length($0) > 100 {print FILENAME ":" FNR ": " length($0) " characters"; bad = 1}
             END {exit bad}' <<<"$files"
}
# A comment that begins with "..." goes on with another one, which is not there where it is read.
comments() {
  local files bad
  files=$(our_files '*.sv' '*.v' '*.cpp' '*.hpp' '*.c' '*.h' '*.py' '*.sh' '*.cmake' '*.js' \
                    '*.mjs' '*.yaml') || return 1
  bad=$(xargs grep -nE '(//|#|/\*)[/*! ]*\.\.\. ' <<<"$files")
  [ -z "$bad" ] || printf '%s\n' "$bad"
  [ -z "$bad" ]
}
# Yosys 0.23 takes '1 as the value of a parameter for 1, whatever the parameter's width.
parameters() {
  local files bad
  files=$(our_files 'rtl/*.sv' 'examples/*.sv') || return 1
  bad=$(xargs grep -nE "(parameter|localparam)[^=]*=[^,;]*'1|\.[A-Z]\w*\('1\)" <<<"$files")
  [ -z "$bad" ] || printf '%s\n' "$bad"
  [ -z "$bad" ]
}
# Unit tests run on netlists, too (tb/netlist), whose cells have no variables for registers.
registers() {
  local files bad
  files=$(our_files 'tb/unit/*.cpp') || return 1
  bad=$(xargs grep -l '__DOT__' <<<"$files" | xargs -r grep -L 'requires {')
  [ -z "$bad" ] || sed 's/$/: names a register without a look whether it is there/' <<<"$bad"
  [ -z "$bad" ]
}
format() {
  our_files '*.cpp' '*.hpp' '*.c' '*.h' | xargs -r clang-format --dry-run -Werror
}

case $1 in
  licence_heads | line_length | comments | parameters | registers | format) "$1" ;;
  *)
    echo "lint-sources.sh: no check '$1'; there are licence_heads, line_length, comments," \
      "parameters, registers, format" >&2
    exit 2
    ;;
esac
