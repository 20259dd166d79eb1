#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# boards-test.sh BUILD BOARDS [JOBS]: runs what boards.sh has left in BOARDS on the simulated bus,
# beside the boards' RTL (tb/boards). BUILD is configured for it only as long as that takes: later
# tests of a changed RTL shall not meet netlists of the one before.
set -euo pipefail
cd "$(dirname "$0")/.."
build=$1 boards=$(realpath "$2") jobs=${3:-2}
trap 'cmake -DVERICAN_BOARDS= "$build" >/dev/null' EXIT
tools/quiet.sh "Configuring for the boards" cmake -DVERICAN_BOARDS="$boards" "$build"
tools/quiet.sh "Building the boards' tests" cmake --build "$build" -j "$jobs" --target boards_tests
ctest --test-dir "$build" -L boards -j "$jobs" --output-on-failure --no-tests=error
