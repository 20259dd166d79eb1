#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# leftover_test.sh TEST.SH: `make test` fails when a test leaves a temporary file, and names it.
set -euo pipefail
tool=$1
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT

echo 'add_test(leaves sh -c "touch $TMPDIR/left.log")' >"$build/CTestTestfile.cmake"
if said=$("$tool" "$build" 1); then
  echo "a file that was left is not noticed: $said"
  exit 1
fi
grep -q '^  left.log$' <<<"$said" || { echo "the file has no name: $said"; exit 1; }

echo 'add_test(clean true)' >"$build/CTestTestfile.cmake"
"$tool" "$build" 1 >/dev/null || { echo "nothing was left, and yet it fails"; exit 1; }
