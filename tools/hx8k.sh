#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# hx8k.sh [OUT]: bitstream of examples/hx8k with yosys, nextpnr-ice40 and icepack; icetime tells its
# clock rate anew. Fails if it does not fit or is below the board's 12 MHz. Prints cells, RAM, clock
# rates and the checksum, which is the same each time with the same tools. Beside the bitstream for
# the simulator (tb/boards): can_hx8k_netlist.v, after synthesis, of the cells in cells.v.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
all_there yosys nextpnr-ice40 icepack icetime || exit 1
out=${1:-build/hx8k}
mkdir -p "$out"
mapfile -t rtl < <(rtl_files)
rtl+=(examples/hx8k/serial_apb.sv examples/hx8k/can_hx8k.sv)
plain=$(yosys -p 'help synth_ice40' | grep -o -m 1 -e -noabc9 || true)

fail() {  # MESSAGE [FILE]: what it says at its end
  [ $# -gt 1 ] && tail -n 3 "$2" >&2
  echo "hx8k: $1" >&2
  exit 1
}

# For Verilator: it takes no defaults at ports, and bits of one wire that depend on one another are
# a loop for it, hence splitnets.
{ echo '`define NO_ICE40_DEFAULT_ASSIGNMENTS'
  sed '/^`timescale/d' "$(dirname "$(command -v yosys)")/../share/yosys/ice40/cells_sim.v"
} >"$out/cells.v"
yosys -q -l "$out/can_hx8k.yosys" -p "read_verilog -sv ${rtl[*]}; hierarchy -check -top can_hx8k;
  synth_ice40 $plain -device hx -top can_hx8k -json $out/can_hx8k.json;
  splitnets; write_verilog -noattr $out/can_hx8k_netlist.v" >"$out/can_hx8k.out" 2>&1 ||
  fail "yosys failed, see $out/can_hx8k.yosys" "$out/can_hx8k.out"
nextpnr-ice40 --hx8k --package ct256 --seed 1 --freq 12 --json "$out/can_hx8k.json" \
  --pcf examples/hx8k/hx8k.pcf --asc "$out/can_hx8k.asc" --report "$out/can_hx8k.rpt" \
  --log "$out/can_hx8k.log" -q >/dev/null 2>&1 ||
  fail "it does not fit, or misses 12 MHz; see $out/can_hx8k.log" "$out/can_hx8k.log"
icepack "$out/can_hx8k.asc" "$out/can_hx8k.bin"
icetime -d hx8k -P ct256 -p examples/hx8k/hx8k.pcf -c 12 -m -r "$out/can_hx8k.tim" \
  "$out/can_hx8k.asc" >"$out/icetime.out" 2>&1 ||
  fail "icetime: below 12 MHz; see $out/can_hx8k.tim" "$out/icetime.out"

/usr/bin/python3 - "$out" <<'EOP'
import hashlib, json, pathlib, re, sys
out = pathlib.Path(sys.argv[1])
report = json.loads((out / "can_hx8k.rpt").read_text(encoding="utf-8"))
cells, rams = (report["utilization"][kind] for kind in ("ICESTORM_LC", "ICESTORM_RAM"))
clock, = report["fmax"].values()
icetime = re.findall(r"\(([\d.]+) MHz\)", (out / "icetime.out").read_text(encoding="utf-8"))[0]
digest = hashlib.sha256((out / "can_hx8k.bin").read_bytes()).hexdigest()
print(f"can_hx8k: {cells['used']} of {cells['available']} cells, {rams['used']} of "
      f"{rams['available']} RAM blocks, {clock['achieved']:.1f} MHz (icetime {icetime}) for 12 MHz")
print(f"{digest}  {out / 'can_hx8k.bin'}")
EOP
