// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole core with mailboxes alone, as a node.
#pragma once

#include <memory>
#include <string>

#include "node/rtl_node.hpp"

namespace vericansim {

/// A core of 64 buffers without Rx FIFO, ESR2, CRCR and aborts that are certain of their outcome:
/// all that Linux's driver needs as fsl,ls1021ar2-flexcan (PK-47). It has been reset.
std::unique_ptr<RtlNode> create_lean_core(std::string name, const ClockConfig &clock = {});

}  // namespace vericansim
