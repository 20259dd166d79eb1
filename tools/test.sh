#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# test.sh BUILD JOBS: every test of a finished build, then ctest's own summary as the last lines.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1
jobs=$2

echo "Running the tests of $build (one line per failure; the whole log: $build/Testing)"
# The progress lines of thousands of passing tests are for the log only.
log=$build/ctest.log
status=0
ctest --test-dir "$build" -j "$jobs" --output-on-failure --no-tests=error </dev/null >"$log" 2>&1 ||
  status=$?
if [ "$status" -ne 0 ]; then
  grep -vE '^ *(Start +[0-9]+:|[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed)' "$log" |
    sed '/tests passed, .* tests failed/,$d' | head -n 300
fi
echo "Rules and their tests: docs/rules.md"
sed -n '/tests passed, .* tests failed\|No tests were found/,$p' "$log"
exit "$status"
