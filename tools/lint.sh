#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# lint.sh BUILD: everything that can be said about the sources without running them. BUILD is a
# configured build directory, for clang-tidy. TIDY=--sample: see tidy.py.
set -uo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
needs 1 "lint.sh BUILD" "$@"
build=$1
failures=0
cores=$(nproc)
results=$(mktemp -d)
trap 'rm -rf "$results"' EXIT
names=() # of the checks, in the order in which they were begun
told=0   # how many of them have been reported

# check NAME COMMAND...: begins a check, as soon as a core is free for it.
check() {
  local number=${#names[@]}
  names+=("$1")
  shift
  while [ "$(jobs -pr | wc -l)" -ge "$cores" ]; do wait -n; done
  run "$results/$number" "$@" &
  report
}
run() {  # FILE COMMAND...; FILE.end is there when all is known
  local file=$1 start=$SECONDS status=0
  shift
  "$@" >"$file" 2>&1 </dev/null || status=$?
  echo "$status $((SECONDS - start))" >"$file.new"
  mv "$file.new" "$file.end"
}
# Of the checks that have ended, in order: one line if good, the output and a mark if not.
report() {
  local name status seconds
  while [ -f "$results/$told.end" ]; do
    name=${names[told]}
    read -r status seconds <"$results/$told.end"
    if [ "$status" -eq 0 ]; then
      echo "  ok    $name ($seconds s)"
    else
      failures=$((failures + 1))
      echo "  FAIL  $name"
      awk '{print "        " $0} NR == 100 {exit}' "$results/$told"
    fi
    told=$((told + 1))
  done
}
finish() {
  wait
  report
  if [ "$told" -ne "${#names[@]}" ]; then
    echo "lint: nothing is known of '${names[told]}': no room in ${TMPDIR:-/tmp}?" >&2
    exit 1
  fi
}

# The whole core in each size that is offered; the engine alone, because it is a product of its own.
mapfile -t rtl < <(rtl_files)
tops=()
has_module can_core && tops+=("can_core")
has_module can_ahb && tops+=("can_ahb NumMb=16" "can_ahb NumMb=32")
has_module can_wb && tops+=("can_apb NumMb=16 CheckProt=1" "can_axil NumMb=16 CheckProt=1"
                            "can_wb NumMb=16" "can_wb NumMb=16 Pipelined=1")
# The profiles, each feature away by itself, and all of them.
add_profiles() {
  local profiles features words
  profiles=$(/usr/bin/python3 tools/profiles.py) &&
    features=$(/usr/bin/python3 tools/profiles.py --features) &&
    [ -n "$profiles" ] && [ -n "$features" ] || { echo "lint: no profiles" >&2; exit 1; }
  while read -r words; do
    tops+=("can_ahb $words")
  done < <(sed 's/^[a-z]* //' <<<"$profiles"; printf '%s\n' "$features")
}
has_module can_ahb && add_profiles
has_module can_time_node && tops+=("can_time_node")
has_module can_remote && tops+=("can_remote" "can_remote NameBits=5" "can_remote MemBytes=1024"
                                "can_remote StageBytes=0" "can_remote StageBytes=16"
                                "can_remote TxDepth=4" "can_remote NumProd=4"
                                "can_remote NumProd=8" "can_remote NumMap=4"
                                "can_remote NumMap=8" "can_remote Protect=1"
                                "can_remote Block=1" "can_remote AutoRate=1"
                                "can_remote Counters=1" "can_remote SameId=1"
                                "can_remote TimeSync=1")

verilator_lint() {  # TOP [NAME=VALUE ...]
  local top=$1
  shift
  verilator --lint-only -Wall --top-module "$top" "${@/#/-G}" rtl/lint.vlt "${rtl[@]}"
}
yosys_check() {  # TOP [NAME=VALUE ...]; no latch, no loop, no wire without driver
  local parameter="" setting
  for setting in "${@:2}"; do parameter+=" -chparam ${setting%=*} ${setting#*=}"; done
  yosys -q -p "read_verilog -sv ${rtl[*]}; hierarchy -check -top $1 $parameter;
               proc; flatten; opt_clean; check -assert; select -assert-none t:\$dlatch"
}
iverilog_elaborate() {  # TOP [NAME=VALUE ...]
  local output status=0 top=$1
  shift
  output=$(iverilog -g2012 -o /dev/null -s "$top" "${@/#/-P$top.}" "${rtl[@]}" 2>&1) || status=$?
  # Icarus 11 says this of correct code: it then watches the whole vector, which is what is meant.
  output=$(grep -v 'sorry: constant selects in always_\*' <<<"$output")
  printf '%s' "$output"
  [ "$status" -eq 0 ] && [ -z "$output" ]
}
board_lint() {  # TOP
  verilator --lint-only -Wall --top-module "$1" rtl/lint.vlt "${rtl[@]}" \
    examples/remote/board/remote_io.sv "examples/remote/board/$1.sv"
}
core_file() {
  diff can.core <(tools/core-file.sh) || { echo "run: tools/core-file.sh >can.core"; return 1; }
}

echo "RTL: ${#rtl[@]} files"
for top in "${tops[@]}"; do
  read -r -a words <<<"$top"
  check "verilator -Wall $top" verilator_lint "${words[@]}"
  check "yosys           $top" yosys_check "${words[@]}"
  check "iverilog        $top" iverilog_elaborate "${words[@]}"
done
check "names are declared before they are used" tools/declared_first.py "${rtl[@]}"
check "verilator -Wall can_hx8k" verilator --lint-only -Wall --top-module can_hx8k rtl/lint.vlt \
  "${rtl[@]}" examples/hx8k/serial_apb.sv examples/hx8k/can_hx8k.sv
for top in remote_icestick remote_hx8k; do
  check "verilator -Wall $top" board_lint "$top"
done
finish
echo "Sources"
check "can.core agrees with rtl/can.f" core_file
check "can.core as FuseSoC reads it" tools/core_check.py
# No failure: whoever changes the RTL cannot measure all families each time; make dist refuses it.
if ! stale=$(tools/families.py --check 2>&1); then
  echo "  note  $stale"
fi
check "licence heads" tools/lint-sources.sh licence_heads
check "lines of at most 100 characters" tools/lint-sources.sh line_length
check "comments that stand by themselves" tools/lint-sources.sh comments
check "parameters that every tool reads alike" tools/lint-sources.sh parameters
check "registers that netlists lack" tools/lint-sources.sh registers
check "folders of sim/ include downwards only" tools/layers.py
check "clang-format" tools/lint-sources.sh format
finish # clang-tidy takes all cores
check "clang-tidy ${TIDY:-}" tools/tidy.py "$build" ${TIDY:+"$TIDY"}
finish

if [ "$failures" -ne 0 ]; then
  echo "lint: $failures checks failed" >&2
  exit 1
fi
echo "lint: all checks passed"
