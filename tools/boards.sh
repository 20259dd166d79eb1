#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# boards.sh [OUT]: bitstreams of the boards in examples/remote/board with yosys, nextpnr-ice40 and
# icepack (RN-87). Fails if one does not fit its FPGA or misses the boards' 12 MHz. Beside each
# bitstream for the simulator (tb/boards): NAME_netlist.v, after synthesis, and NAME_bitstream.v,
# out of the bitstream again, of the cells in cells.v. BOARDS="icestick hx8k".
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
out=${1:-build/boards}
read -r -a boards <<<"${BOARDS:-icestick hx8k}"
if [ "${#boards[@]}" -eq 0 ]; then
  echo "boards: BOARDS='$BOARDS' names no board; allowed: icestick, hx8k" >&2
  exit 2
fi
for name in "${boards[@]}"; do
  case $name in
    icestick | hx8k) ;;
    *)
      echo "boards: unknown board '$name'; allowed: icestick, hx8k" >&2
      exit 2
      ;;
  esac
done
all_there yosys nextpnr-ice40 icepack icebox_vlog || exit 1
mkdir -p "$out"
mapfile -t rtl < <(rtl_files)
rtl+=(examples/remote/board/*.sv)
# For Verilator: it takes no defaults at ports, and bits of one wire that depend on one another are
# a loop for it, hence splitnets.
{ echo '`define NO_ICE40_DEFAULT_ASSIGNMENTS'
  sed '/^`timescale/d' "$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v"
} >"$out/cells.v"
plain=$(yosys -p 'help synth_ice40' | grep -o -m 1 -e -noabc9 || true)

figures() {  # REPORT of nextpnr
  /usr/bin/python3 - "$1" <<'EOF'
import json, sys
report = json.load(open(sys.argv[1], encoding="utf-8"))
cells, rams = (report["utilization"][kind] for kind in ("ICESTORM_LC", "ICESTORM_RAM"))
clock, = report["fmax"].values()
print(f"{cells['used']} of {cells['available']} cells, {rams['used']} of {rams['available']} RAM "
      f"blocks, {clock['achieved']:.1f} MHz for 12 MHz")
EOF
}

# What is in the bitstream, as Verilog for the simulator. Yosys merges what icebox_vlog declares
# twice. icebox_vlog knows no options of set_io.
bitstream_as_verilog() {  # NAME
  local file=$out/$1
  sed 's/-pullup yes //' "examples/remote/board/$1.pcf" >"$file.pins"
  icebox_vlog -s -c -n "remote_$1" -p "$file.pins" "$file.asc" >"${file}_icebox.v"
  yosys -q -p "read_verilog ${file}_icebox.v; hierarchy -top remote_$1; proc; opt_clean;
    write_verilog -noattr ${file}_bitstream.v" >"${file}_icebox.out" 2>&1
}

board() {  # NAME, and the FPGA as nextpnr names it
  local name=$1 start=$SECONDS dir=$out
  shift
  yosys -q -l "$dir/$name.yosys" -p "read_verilog -sv ${rtl[*]}; hierarchy -check -top remote_$name;
    synth_ice40 $plain -device hx -top remote_$name -json $dir/$name.json;
    splitnets; write_verilog -noattr $dir/${name}_netlist.v" >"$dir/$name.out" 2>&1 || {
    tail -n 5 "$dir/$name.out" >&2
    echo "boards: yosys failed at $name, see $dir/$name.yosys" >&2
    return 1
  }
  nextpnr-ice40 "$@" --json "$dir/$name.json" --pcf "examples/remote/board/$name.pcf" --freq 12 \
    --asc "$dir/$name.asc" --report "$dir/$name.rpt" --log "$dir/$name.log" -q >/dev/null 2>&1 || {
    grep -m 3 -e ERROR "$dir/$name.log" >&2 || true
    echo "boards: $name does not fit, or misses 12 MHz; see $dir/$name.log" >&2
    return 1
  }
  icepack "$dir/$name.asc" "$dir/$name.bin"
  bitstream_as_verilog "$name"
  echo "$name: $(figures "$dir/$name.rpt"); $dir/$name.bin, $((SECONDS - start)) s"
}

failed=0
for name in "${boards[@]}"; do
  case $name in
    icestick) board icestick --hx1k --package tq144 || failed=1 ;;
    hx8k) board hx8k --hx8k --package ct256 || failed=1 ;;
  esac
done
exit "$failed"
