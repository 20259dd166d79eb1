#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# core-file.sh: prints can.core, the FuseSoC description, for the files of rtl/can.f and the
# profiles of sw/profiles.yaml.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh

# What any of this core's own targets may be given, besides what a profile sets.
parameters=(NumMb Fifo Abort Status OwnMasks Wake Extras ClearRam TimeUnit TimeSync SyncCtrl SyncId
            SyncDelay RegionBits CheckHprot WakeFilter)

# profile_targets TARGET TEXT: TARGET for each profile, TARGET_small and so on.
profile_targets() {
  local name values list parameter
  while read -r name values; do
    list=
    for parameter in "${parameters[@]}"; do
      case " $values " in
        *" $parameter="*) list+="$(tr ' ' '\n' <<<"$values" | grep "^$parameter="), " ;;
        *) list+="$parameter, " ;;
      esac
    done
    printf '  %s_%s:\n    <<: *%s\n    description: Profile %s; %s\n' "$1" "$name" "$1" "$name" "$2"
    fold -s -w 80 <<<"parameters: [${list%, }]" | sed 's/ *$//;1s/^/    /;2,$s/^/      /'
  done < <(tools/profiles.py)
}
version=$(sed -n 's/^project(verican VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
cat <<EOF
CAPI=2:
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.core: FuseSoC description; written by tools/core-file.sh from rtl/can.f and
# sw/profiles.yaml (make lint compares).
name: verican:ip:can:$version
description: CAN 2.0 controller with FlexCAN registers on AHB-Lite, APB, AXI4-Lite or Wishbone
license: Apache-2.0

filesets:
  rtl:
    file_type: systemVerilogSource
    files:
      - rtl/lint.vlt: {file_type: vlt}
$(rtl_files | sed 's/^/      - /')
  smoke:
    file_type: verilogSource-2005
    files:
$(for file in tb/smoke/*.v; do echo "      - $file"; done)
  hx8k:
    file_type: systemVerilogSource
    files:
      - examples/hx8k/serial_apb.sv
      - examples/hx8k/can_hx8k.sv
      - examples/hx8k/hx8k.pcf: {file_type: PCF}

# Without a value here each has the default of the RTL. TimeInc is not here: it has 40 bits, and not
# every tool takes more than 32 of them on its command line. A design that depends on the core, and
# software, can set it.
parameters:
  NumMb:
    datatype: int
    description: Number of message buffers (16, 32 or 64)
    paramtype: vlogparam
  Fifo:
    datatype: int
    description: 1 for the receive FIFO
    paramtype: vlogparam
  Abort:
    datatype: int
    description: 1 for aborts that are certain of their outcome (MCR.AEN)
    paramtype: vlogparam
  Status:
    datatype: int
    description: 1 for ESR2 and CRCR
    paramtype: vlogparam
  OwnMasks:
    datatype: int
    description: 1 for a mask for each buffer (RXIMR, MCR.BCC)
    paramtype: vlogparam
  Wake:
    datatype: int
    description: 1 for stop mode and waking from it
    paramtype: vlogparam
  Extras:
    datatype: int
    description: 1 for local priority, one-shot, FD tolerance, MAXMB, LBUF, remote answers and TSYN
    paramtype: vlogparam
  ClearRam:
    datatype: int
    description: 1 to have the RAM of the buffers cleared after a hard reset
    paramtype: vlogparam
  TimeUnit:
    datatype: int
    description: 1 for the time unit; its clock starts with 20 ns, for 50 MHz (TimeInc)
    paramtype: vlogparam
  TimeSync:
    datatype: int
    description: 1 for the follower that keeps the clock of the time unit to a master's
    paramtype: vlogparam
  SyncCtrl:
    datatype: int
    description: Value of TSCTRL after a hard reset
    paramtype: vlogparam
  SyncId:
    datatype: int
    description: Value of TSID after a hard reset (as in an ID word; bit 31 is IDE)
    paramtype: vlogparam
  SyncDelay:
    datatype: int
    description: Value of TSDLY after a hard reset (24 bits)
    paramtype: vlogparam
  RegionBits:
    datatype: int
    description: Address bits of the region that hsel stands for (13 to 32)
    paramtype: vlogparam
  CheckHprot:
    datatype: int
    description: 1 to let MCR.SUPV close the registers to unprivileged accesses
    paramtype: vlogparam
  WakeFilter:
    datatype: int
    description: Clocks of dominant level that wake the core with MCR.WAK_SRC (1 to 255)
    paramtype: vlogparam

# Top and parameters are those of this core alone: a design that depends on it has its own.
targets:
  default: &default
    description: The RTL, for designs that depend on it
    filesets: [rtl]
    toplevel: ["is_toplevel? (can_ahb)"]
    parameters:
$(printf '      - "is_toplevel? (%s)"\n' "${parameters[@]}")
  lint: &lint
    <<: *default
    description: Lint with Verilator, all warnings
    flow: lint
    flow_options:
      tool: verilator
      verilator_options: [-Wall]
$(profile_targets lint 'lint with Verilator, all warnings')
  # With --tool icarus, too, from Icarus 12 on (docs/errata.md, E-08).
  sim:
    description: A first frame in loop-back through each bus wrapper
    filesets: [rtl, smoke]
    toplevel: can_smoke
    flow: sim
    flow_options:
      tool: verilator
      mode: binary
      verilator_options: [--timing, -Wno-fatal]
      iverilog_options: [-g2012]
  synth_ice40: &synth_ice40
    <<: *default
    description: Synthesis for iCE40, no place and route
    flow: icestorm
    flow_options:
      pnr: none
      yosys_synth_options: [-device, hx]
$(profile_targets synth_ice40 'synthesis for iCE40, no place and route')
  # Edalize 0.6.8 starts nextpnr-ecp5 all the same, after the synthesis.
  synth_ecp5:
    <<: *default
    description: Synthesis for ECP5, no place and route
    flow: trellis
    flow_options:
      pnr: none
  hx8k:
    description: Bitstream of a CAN node at a serial port, for the iCE40 HX8K breakout board
    filesets: [rtl, hx8k]
    toplevel: can_hx8k
    flow: icestorm
    flow_options:
      yosys_synth_options: [-device, hx]
      nextpnr_options: [--hx8k, --package, ct256, --seed, "1", --freq, "12"]
EOF
