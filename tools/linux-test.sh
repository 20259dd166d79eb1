#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# linux-test.sh BUILD JOBS DIRECTORY [OPTION...]: Linux's own flexcan driver on the Verilated core.
# DIRECTORY keeps the kernel between runs; options are those of sw/linux/run.py.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 3 "linux-test.sh BUILD JOBS DIRECTORY [OPTION...]" "$@"
build=$1 jobs=$2 directory=$3
shift 3

unable() {
  echo "test-linux: cannot run here: $*" >&2
  exit 1
}

[ "$(uname -s)" = Linux ] && [ "$(uname -m)" = x86_64 ] ||
  unable "user-mode Linux 6.1 needs Linux on x86-64, this is $(uname -s) on $(uname -m)"
command -v dpkg-query >/dev/null || unable "the kernel's source comes from a Debian package"
python3 - <<'PROBE' || unable "processes may not trace each other (a container without ptrace?)"
import ctypes, os, sys
child = os.fork()
if child == 0:
    os._exit(0 if ctypes.CDLL(None).ptrace(0, 0, 0, 0) == 0 else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
PROBE

start=$SECONDS
tools/install-packages.sh packages-linux.txt
packages=$((SECONDS - start))
start=$SECONDS
tools/quiet.sh "Building the tool" cmake --build "$build" -j "$jobs" --target verican
tool=$((SECONDS - start))
start=$SECONDS
JOBS=$jobs sw/linux/build.sh "$directory"
kernel=$((SECONDS - start))
start=$SECONDS
status=0
sw/linux/run.py --verican "$build/verican" --build "$directory" --jobs "$jobs" "$@" || status=$?
guests=$((SECONDS - start))
echo "test-linux: packages $packages s, tool $tool s, kernel $kernel s, guests $guests s"
exit "$status"
