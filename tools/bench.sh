#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# bench.sh BUILD: runs the benchmarks of tb/bench and writes docs/performance.md from their results.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
results=$build/bench
mkdir -p "$results"

shopt -s nullglob
programs=("$build"/tb/bench/*_bench)
if [ "${#programs[@]}" -eq 0 ]; then
  echo "bench: no benchmark in $build/tb/bench" >&2
  exit 1
fi
for program in "${programs[@]}"; do
  name=$(basename "$program")
  echo "Measuring: $name"
  "$program" --benchmark_repetitions=3 --benchmark_report_aggregates_only=true \
    --benchmark_out="$results/$name.json" --benchmark_out_format=json
done
/usr/bin/python3 tools/bench_page.py "$results" docs/performance.md
echo "Written: docs/performance.md"
