#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# netlist.sh KIND OUT.v TOP [Name=value ...] [--keep FILE ...] -- FILE...: the RTL as a netlist,
# for VERICAN_RTL_TRANSFORM (cmake/verilate.cmake). KIND:
#   word   after Yosys' front end: what Yosys reads, nothing mapped
#   gates  generic gates and flip-flops; memories stay memories
#   ice40  iCE40 cells, block RAMs too, with Yosys' simulation models of them
# Modules stay apart, so that instances keep their names.
set -euo pipefail
. "$(dirname "$0")/../common.sh"

syntax="netlist/netlist.sh KIND OUT.v TOP [Name=value ...] [--keep FILE ...] -- FILE..."
needs 5 "$syntax" "$@"
kind=$1 out=$2 top=$3
shift 3
[[ " $* " == *" -- "?* ]] || needs 1 "$syntax"
parameters="" keep=()
while [ "$1" != -- ] && [ "$1" != --keep ]; do
  parameters="$parameters -chparam ${1%%=*} ${1#*=}"
  shift
done
while [ "$1" != -- ]; do
  [ "$1" = --keep ] || keep+=("$1")
  shift
done
shift
files=()
for file in "$@"; do
  [[ " ${keep[*]} " == *" $file "* ]] || files+=("$file")
done

read_rtl="read_verilog -sv ${files[0]}"
# With its contents replaced by nothing: only its ports matter here.
[ ${#keep[@]} -eq 0 ] || read_rtl="$read_rtl; read_verilog -sv -lib ${keep[*]}"
read_rtl="$read_rtl; read_verilog -sv ${files[*]:1}; hierarchy -check -top $top $parameters"

case $kind in
  word) map="proc; opt_clean" ;;
  gates) map="synth -run begin:fine; opt -fast -full; techmap; opt -fast; dfflegalize 
    -cell \$_DFF_?_ 01 -cell \$_DFF_???_ 01 -cell \$_DFFE_??_ 01 -cell \$_DFFE_????_ 01;
    abc -g AND,OR,XOR,MUX; opt_clean" ;;
  ice40) map="synth_ice40 -noflatten -top $top" ;;
  *)
    echo "netlist.sh: KIND is '$kind'; allowed: word, gates, ice40" >&2
    exit 2
    ;;
esac

log=$out.log
write_out="check -assert; tee -o $out.stat stat; write_verilog -noattr -simple-lhs $out"
yosys -q -l "$log" -p "$read_rtl; ${map//$'\n'/ }; $write_out" >"$out.err" 2>&1 || {
  tail -n 5 "$out.err" >&2
  echo "netlist.sh: yosys failed, see $log" >&2
  exit 1
}
# Verilator takes no defaults at ports; Yosys connects every pin that matters.
if [ "$kind" = ice40 ]; then
  { echo '`define NO_ICE40_DEFAULT_ASSIGNMENTS'
    cells=$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v
    sed '/^`timescale/d' "$cells"; } >>"$out"
fi
