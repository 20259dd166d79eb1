#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# gates.sh OUT.v TOP ...: the netlist of generic gates, as VERICAN_RTL_TRANSFORM wants it.
exec "$(dirname "$0")/netlist.sh" gates "$@"
