#!/bin/sh
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Line coverage of the C driver under its tests, by gcov: per file and in total; fails below the
# limit. The tests are those of tb/driver, linked anew with an instrumented driver.
# usage: tools/driver-coverage.sh [BUILD-DIR] [LIMIT]     defaults: build/release 95
set -eu
cd "$(dirname "$0")/.."
build=${1:-build/release}
limit=${2:-95}
case $limit in
  [0-9] | [1-9][0-9] | 100) ;;
  *)
    echo "driver-coverage: LIMIT is '$limit'; allowed: 0 to 100, whole percent" >&2
    exit 2
    ;;
esac
if [ ! -f "$build/build.ninja" ]; then
  echo "driver-coverage: $build is not configured; run: make build" >&2
  exit 1
fi
ninja -C "$build" driver_coverage
out=build/driver-coverage
rm -rf "$out"
mkdir -p "$out"
counts() { find "$build" -path '*verican_driver_coverage.dir*' -name '*.gcda' "$@"; }
counts -delete
"$build/tb/driver_coverage" --gtest_brief=1 >"$out/tests.log" 2>&1 || {
  tail -n 40 "$out/tests.log" >&2
  echo "driver-coverage: a test fails" >&2
  exit 1
}
counts -exec gcov --no-output {} + 2>/dev/null | awk -v limit="$limit" '
  /^File / {name = $2; gsub(/\x27/, "", name); wanted = name ~ /sw\/driver\/src\//
            sub(/.*\//, "", name)}
  /^Lines executed:/ && wanted {
    split($0, part, /[:% ]+/)
    lines = part[5]; hit = int(part[3] * lines / 100 + 0.5)
    # A header is seen by each file that includes it: the best of them counts.
    if (!(name in total) || hit > covered[name]) {total[name] = lines; covered[name] = hit}
    wanted = 0
  }
  END {
    for (name in total) {
      printf "%6.1f %%  %4d of %4d lines  %s\n", 100 * covered[name] / total[name],
             covered[name], total[name], name | "sort -k6"
      all += total[name]; sum += covered[name]
    }
    close("sort -k6")
    if (all == 0) {print "driver-coverage: no data"; exit 1}
    printf "%6.1f %%  %4d of %4d lines  in total (limit %d %%)\n", 100 * sum / all, sum, all, limit
    exit 100 * sum < limit * all
  }'
