#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# bus_run.sh BUS SHARDS PROGRAM FILTER: runs the tests of a filter with the core behind a bus
# (bus_builds.hpp), one in SHARDS of them, others for each bus. Fails too if no test ran, or none of
# them had that bus.
set -euo pipefail
bus=$1 shards=$2 program=$3 filter=$4
sum=$(printf '%d' "'${bus: -1}")
output=$(VERICAN_TEST_BUS=$bus GTEST_TOTAL_SHARDS=$shards GTEST_SHARD_INDEX=$((sum % shards)) \
  "$program" "--gtest_filter=$filter" 2>&1) || { printf '%s\n' "$output"; exit 1; }
grep -qx "behind $bus" <<<"$output" || { echo "no test of $filter ran behind $bus" >&2; exit 1; }
tail -n 3 <<<"$output"
