#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# ends_with.sh CODE PATTERN COMMAND...: whether the command ends with that exit code and its output
# holds the pattern, a regular expression of Perl's in which . is any character, ^ and $ are ends of
# lines. CTest's PASS_REGULAR_EXPRESSION does not look at the exit code.
code=$1
pattern=$2
shift 2
said=$("$@" 2>&1)
found=$?
printf '%s\n' "$said"
if [ "$found" -ne "$code" ]; then
  echo "ends_with.sh: exit code $found, expected $code"
  exit 1
fi
if ! printf '%s\n' "$said" | grep -Pzq "(?sm)$pattern"; then
  echo "ends_with.sh: the output lacks: $pattern"
  exit 1
fi
