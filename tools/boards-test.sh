#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# boards-test.sh BUILD BOARDS [JOBS [VARIABLE TARGET TESTS]]: runs what boards.sh has left in BOARDS
# on the simulated bus, beside the boards' RTL (tb/boards). BUILD is configured for it (VARIABLE)
# only as long as that takes: later tests of a changed RTL shall not meet netlists of the one
# before. TARGET builds the tests whose names begin with TESTS.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 2 "boards-test.sh BUILD BOARDS [JOBS [VARIABLE TARGET TESTS]]" "$@"
build=$1 boards=$(realpath "$2") jobs=${3:-2}
variable=${4:-VERICAN_BOARDS} target=${5:-boards_tests} tests=${6:-.}
trap 'cmake "-D$variable=" "$build" >/dev/null' EXIT
tools/quiet.sh "Configuring for the boards" cmake "-D$variable=$boards" "$build"
tools/quiet.sh "Building the boards' tests" cmake --build "$build" -j "$jobs" --target "$target"
ctest --test-dir "$build" -L boards -R "^$tests" -j "$jobs" --output-on-failure --no-tests=error
