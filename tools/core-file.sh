#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# core-file.sh: prints can.core, the FuseSoC description, for the files of rtl/can.f.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/common.sh
version=$(sed -n 's/^project(verican VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
cat <<EOF
CAPI=2:
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.core: FuseSoC description; written by tools/core-file.sh from rtl/can.f (make lint compares).
name: verican:ip:can:$version
description: CAN 2.0 controller with FlexCAN registers on AHB-Lite

filesets:
  rtl:
    file_type: systemVerilogSource
    files:
$(rtl_files | sed 's/^/      - /')

parameters:
  NumMb:
    datatype: int
    description: Number of message buffers (16, 32 or 64)
    paramtype: vlogparam
    default: 64
  RegionBits:
    datatype: int
    description: Address bits of the region that hsel stands for (13 to 32)
    paramtype: vlogparam
    default: 16
  CheckHprot:
    datatype: int
    description: 1 to let MCR.SUPV close the registers to unprivileged accesses
    paramtype: vlogparam
    default: 0
  WakeFilter:
    datatype: int
    description: Clocks of dominant level that wake the core with MCR.WAK_SRC (1 to 255)
    paramtype: vlogparam
    default: 6

targets:
  default: &default
    filesets: [rtl]
    toplevel: can_ahb
    parameters: [NumMb, RegionBits, CheckHprot, WakeFilter]
  lint:
    <<: *default
    default_tool: verilator
    tools:
      verilator:
        mode: lint-only
        verilator_options: [-Wall, rtl/lint.vlt]
EOF
