#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# wave.sh BUILD TEST: runs the tests whose name contains TEST (a GoogleTest filter also works) and
# keeps a waveform of each; VERICAN_WAVE_DIR tells the benches where.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-}
test=${2:-}
if [ -z "$test" ]; then
  echo "usage: make wave TEST=Suite.Name   (a part of the name is enough; '*' works)" >&2
  exit 2
fi
shopt -s nullglob
programs=("$build"/tb/*_test)
if [ "${#programs[@]}" -eq 0 ]; then
  echo "wave: no test program in $build/tb; run: make build" >&2
  exit 1
fi
waves=$(realpath "$build")/waves
mkdir -p "$waves"
stamp=$(mktemp)
trap 'rm -f "$stamp"' EXIT
case $test in *[*:]*) filter=$test ;; *) filter="*$test*" ;; esac

found=0
for program in "${programs[@]}"; do
  listed=$("$program" --gtest_list_tests "--gtest_filter=$filter") || continue
  if grep -q '^  ' <<<"$listed"; then
    found=1
    VERICAN_WAVE_DIR=$waves "$program" "--gtest_filter=$filter" --gtest_brief=1 || true
  fi
done
if [ "$found" -eq 0 ]; then
  echo "wave: no test matches '$test'; ctest --test-dir $build -N lists them" >&2
  exit 1
fi
mapfile -t written < <(find "$waves" -newer "$stamp" -type f | sort)
if [ "${#written[@]}" -eq 0 ]; then
  echo "wave: the test has no bus to draw (a pure unit test?)" >&2
  exit 1
fi
printf 'waveform: %s\n' "${written[@]}"
echo "look at it with: gtkwave ${written[0]}"
