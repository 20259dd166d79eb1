#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# synth.sh: area and clock rate by the open flow, the same steps for every block:
#   iCE40       yosys synth_ice40 -abc9 of the bare block, with plain abc where abc9 stops;
#               nextpnr-ice40 on an HX8K for the clock rate, the block between shift registers (all
#               inputs and outputs are flip-flops)
#   VersaTiles  of ProASIC3/SmartFusion: LUT3 + flip-flop after abc -lut 3, memories kept apart
# Writes docs/synthesis.md. SEEDS="1 2 3" (nextpnr), OUT=build/synth (intermediate files),
# BLOCKS="can_core remote_small ... can_apb_32 ... can_ahb_small can_ahb_standard can_ahb_32
# can_ahb_64" (what is measured, all profiles of can_remote among them, and of can_ahb by name or
# number of buffers),
# PAGE=docs/synthesis.md.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
read -r -a seeds <<<"${SEEDS:-1 2 3}"
for seed in "${seeds[@]:-none}"; do
  if [[ ! $seed =~ ^[0-9]{1,9}$ ]]; then
    echo "synth: SEEDS is '$SEEDS'; allowed: whole numbers of at most nine digits, at least one" >&2
    exit 2
  fi
done
out=${OUT:-build/synth}
page=${PAGE:-docs/synthesis.md}
mapfile -t rtl < <(rtl_files)

run_yosys() {  # DIR NAME SCRIPT
  yosys -q -l "$1/$2.log" -p "$3" >"$1/$2.out" 2>&1 || {
    tail -n 5 "$1/$2.out" >&2
    echo "synth: yosys failed at $2, see $1/$2.log" >&2
    exit 1
  }
}

# DIR/NAME.json: what READ reads, for iCE40. abc9 stops at some netlists ("Boxes are not in a
# topological order", a fault of abc's); they are made with plain abc: -noabc9 for newer Yosys, no
# option for older. That is said, and DIR/NAME.plain tells it to the page.
ice40_netlist() {  # DIR NAME READ TOP
  local file=$1/$2 plain options="-device hx -top $4 -json $1/$2.json"
  yosys -q -l "$file.log" -p "$3; synth_ice40 -abc9 $options" >"$file.out" 2>&1 && return
  plain=$(yosys -p 'help synth_ice40' | grep -o -m 1 -e -noabc9 || true)
  echo "synth: abc9 stops at $file; plain abc instead: $(grep -m 1 ERROR "$file.out")" >&2
  run_yosys "$1" "$2" "$3; synth_ice40 $plain $options"
  touch "$file.plain"
}

# Prepared like this the block is the same for every target.
elaborate() {  # DIR TOP PARAMETERS
  run_yosys "$1" elaborate "read_verilog -sv ${rtl[*]}; hierarchy -check -top $2 $3; proc -norom;
    write_rtlil $1/hierarchy.il; flatten; opt_clean; rename -top area_core;
    write_rtlil $1/core.il; write_json $1/ports.json"
}

# Memories as black boxes, so that block RAM is counted as such and not as flip-flops.
memories_apart() {  # TOP
  echo "setattr -unset init w:*; hierarchy -top $1; opt -full; opt_dff; wreduce; memory -nomap;
    opt_clean; read_verilog -lib tools/synth/memory_box.v; techmap -map tools/synth/memory_map.v;
    opt_clean"
}
# A VersaTile is one LUT3 or one D flip-flop with enable and asynchronous set or clear.
versatiles() {
  local cell legal=""
  for cell in DFF_?_ DFF_???_ DFFE_??_ DFFE_????_ DLATCH_?_ DLATCH_???_; do
    legal="$legal -cell \$_$cell 01"
  done
  echo "opt -fast -full; opt -undriven -fine; techmap; opt -fast; opt_merge; dfflegalize $legal;
    opt_clean; techmap; simplemap; opt_expr; opt_merge; opt_clean; abc -lut 3; opt_clean"
}

# DIR/alone.json: a bus wrapper around a core that is a black box, so that the few tiles of the bus
# do not drown in the mapper's noise over the core's 4,000.
wrapper_alone() {  # DIR TOP PARAMETERS
  run_yosys "$1" alone "read_verilog -sv ${rtl[*]}; hierarchy -check -top $2 $3;
    blackbox *can_top*; proc -norom; flatten; opt_clean; rename -top area_core; opt -full;
    synth -flatten -top area_core -run begin:fine; $(versatiles); write_json $1/alone.json"
}

place_and_route() {  # DIR
  local dir=$1 seed
  /usr/bin/python3 tools/synth/report.py wrap "$dir"
  ice40_netlist "$dir" ice40_wrapped "read_rtlil $dir/core.il; read_verilog $dir/wrap.v" area_wrap
  echo "set_io clk_pin J3" >"$dir/wrap.pcf"
  for seed in "${seeds[@]}"; do
    nextpnr-ice40 --hx8k --package ct256 --json "$dir/ice40_wrapped.json" --pcf "$dir/wrap.pcf" \
      --pcf-allow-unconstrained --freq 100 --seed "$seed" --timing-allow-fail \
      --report "$dir/pnr_$seed.json" --log "$dir/pnr_$seed.log" -q >/dev/null 2>&1 || {
      tail -n 2 "$dir/pnr_$seed.log" >&2 || true
      echo "synth: nextpnr failed, see $dir/pnr_$seed.log" >&2
      exit 1
    }
  done
}

measure() {  # NAME TOP [PARAMETER=VALUE ...]
  local name=$1 top=$2 dir=$out/$1 parameters="" start=$SECONDS setting
  for setting in "${@:3}"; do
    parameters="$parameters -chparam ${setting%%=*} ${setting#*=}"
  done
  rm -rf "$dir"
  mkdir -p "$dir"
  elaborate "$dir" "$top" "$parameters"
  ice40_netlist "$dir" ice40 "read_rtlil $dir/core.il" area_core &
  run_yosys "$dir" versatile "read_rtlil $dir/core.il; $(memories_apart area_core);
    synth -flatten -top area_core -run begin:fine; $(versatiles); write_json $dir/versatile.json"
  wait $!
  run_yosys "$dir" modules "read_rtlil $dir/hierarchy.il; $(memories_apart "$top");
    synth -top $top -run begin:fine; opt -fast -full; techmap; opt -fast; abc -lut 4; opt_clean;
    write_json $dir/modules.json"
  if grep -q '\bcan_top #(' "rtl/host/$top.sv" 2>/dev/null; then
    wrapper_alone "$dir" "$top" "$parameters"
  fi
  place_and_route "$dir"
  echo "Measured $name in $((SECONDS - start)) s"
}

# Profiles of can_remote (RN-85), PROFILE PARAMETER=VALUE ..: the list that the simulator builds,
# without variants, whose names have digits, and without that which shows what SameId does.
profiles() {
  sed -n 's/^set(remote_\([a-z]*\) "*\([^")]*\)"*)$/\1 \2/p' cmake/remote_profiles.cmake |
    grep -v '^same '
}

measure_profile() {  # remote_PROFILE BLOCK [PARAMETER=VALUE ..]
  local line settings
  line=$(profiles | grep "^${1#remote_} ") || {
    echo "synth: cmake/remote_profiles.cmake has no profile ${1#remote_} of can_remote" >&2
    exit 1
  }
  read -r -a settings <<<"${line#* }"
  measure "$2" can_remote "${settings[@]}" "${@:3}"
}

remotes=$(profiles | sed 's/^\([a-z]*\) .*/remote_\1/' | tr '\n' ' ')
cores="can_ahb_small can_ahb_standard can_ahb_32 can_ahb_64"
times="remote_standard_time can_time can_time_sync can_time_node can_ahb_time_32 can_ahb_sync_32"
buses="can_apb_32 can_axil_32 can_wb_32 can_wb_pipelined_32"
read -r -a blocks <<<"${BLOCKS:-can_core $remotes $times $buses $cores}"
for block in "${blocks[@]}"; do
  case $block in
    can_ahb_time_[0-9]*) measure "$block" can_ahb "NumMb=${block#can_ahb_time_}" TimeUnit=1 ;;
    can_ahb_sync_[0-9]*)
      measure "$block" can_ahb "NumMb=${block#can_ahb_sync_}" TimeUnit=1 TimeSync=1
      ;;
    can_ahb_[0-9]*) measure "$block" can_ahb "NumMb=${block#can_ahb_}" ;;
    can_wb_pipelined_[0-9]*)
      measure "$block" can_wb "NumMb=${block#can_wb_pipelined_}" Pipelined=1
      ;;
    can_apb_[0-9]* | can_axil_[0-9]* | can_wb_[0-9]*)
      measure "$block" "${block%_*}" "NumMb=${block##*_}"
      ;;
    can_ahb_*)
      read -r -a settings < <(/usr/bin/python3 tools/profiles.py "${block#can_ahb_}")
      measure "$block" can_ahb "${settings[@]}"
      ;;
    remote_*_time) measure_profile "${block%_time}" "$block" TimeSync=1 ;;
    remote_*) measure_profile "$block" "$block" ;;
    *) measure "$block" "$block" ;;
  esac
done
/usr/bin/python3 tools/synth/report.py page "$out" "$page" "${blocks[@]}"
echo "Written: $page"
