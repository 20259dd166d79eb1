#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# test.sh BUILD JOBS: every test of a finished build, then ctest's own summary as the last lines.
# A test that leaves a temporary file behind is a failure.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 2 "test.sh BUILD JOBS" "$@"
build=$1
jobs=$2

echo "Running the tests of $build (one line per failure; the whole log: $build/Testing)"
# The progress lines of thousands of passing tests are for the log only.
log=$build/ctest.log
# Not below the build: the installed tree's tests lie apart from it, and names of sockets are short.
TMPDIR=$(mktemp -d)
export TMPDIR
export PYTHONDONTWRITEBYTECODE=1 # in what tests run, too: nothing beside the sources
trap 'rm -rf "$TMPDIR"' EXIT
status=0
# More at once than there are cores: many wait for the clock, a guest or a browser.
ctest --test-dir "$build" -j $((jobs + (jobs + 1) / 2)) --output-on-failure --no-tests=error \
  </dev/null >"$log" 2>&1 || status=$?
if [ "$status" -ne 0 ]; then
  grep -vE '^ *(Start +[0-9]+:|[0-9]+/[0-9]+ Test +#[0-9]+: .* Passed)' "$log" |
    sed '/tests passed, .* tests failed/,$d' | head -n 300
fi
left=$(find "$TMPDIR" -mindepth 1 -maxdepth 2 -printf '  %P\n' | sort | sed -n 1,40p)
if [ -n "$left" ]; then
  printf 'Tests left in their temporary folder (%s):\n%s\n' "$TMPDIR" "$left"
  [ "$status" -ne 0 ] || status=1
fi
echo "Rules and their tests: docs/rules.md"
sed -n '/tests passed, .* tests failed\|No tests were found/,$p' "$log"
exit "$status"
