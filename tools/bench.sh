#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# bench.sh BUILD: runs the benchmarks of tb/bench and writes docs/performance.md from their results.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 1 "bench.sh BUILD" "$@"
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
  "$program" --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
    --benchmark_out="$results/$name.json" --benchmark_out_format=json
done
# Real recordings, whole; they are not part of the project and may be absent.
replay() {  # NAME BITRATE FILE
  [ -f "$3" ] || return 0
  echo "Replaying: $1"
  "$build/verican" replay "$3" --nodes 2 --bitrate "$2" --fast --json >"$results/replay_$1.json"
}
traffic=../shared/data/traffic
rm -f "$results"/replay_*.json
replay candumpSample3 250k "$traffic/canboat_candumpSample3.txt"
replay sample3_PCAN-View 250k "$traffic/canboat_sample3_PCAN-View.trc"
replay nmea2000_can0-1 250k "$traffic/canboat_nmea2000_can0-1.pcap"
replay savvycan_GVRET 500k "$traffic/savvycan_GVRET_Log.csv"

[ -f "$build/ctest.log" ] && cp "$build/ctest.log" "$results/"
/usr/bin/python3 tools/bench_page.py "$results" docs/performance.md
echo "Written: docs/performance.md"
