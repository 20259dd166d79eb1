#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# skipped_test.sh CMAKE_FOLDER: a unittest case that skips itself is "Skipped" to ctest, too.
set -euo pipefail
folder=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(skipped LANGUAGES NONE)
enable_testing()
set(VERICAN_PYTHON python3)
add_executable(verican IMPORTED)
set_target_properties(verican PROPERTIES IMPORTED_LOCATION /bin/true)
include("${FOLDER}/unittest_cases.cmake")
verican_unittest_cases("${CMAKE_CURRENT_SOURCE_DIR}/few_cases.py" few)
TEXT
cat >"$work/few_cases.py" <<'TEXT'
import unittest


class Few(unittest.TestCase):
    def test_runs(self):
        pass

    @unittest.skip("nothing to run it with")
    def test_is_left_out(self):
        pass

    def test_fails(self):
        self.fail("OK (skipped=1)")
TEXT
cmake -S "$work" -B "$work/build" -DFOLDER="$folder" >"$work/log"
said=$(ctest --test-dir "$work/build" 2>&1) || true
for wanted in 'few.Few.runs .*Passed' 'few.Few.is_left_out .*Skipped' 'few.Few.fails .*Failed'; do
  grep -q "$wanted" <<<"$said" || { echo "not there: $wanted"; echo "$said"; exit 1; }
done
