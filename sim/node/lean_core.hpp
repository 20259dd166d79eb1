// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole core with the features alone that Linux' driver needs, as a node.
#pragma once

#include <memory>
#include <string>

#include "node/rtl_node.hpp"

namespace vericansim {

/// A core of 64 buffers with Rx FIFO and own masks, without abort, status registers, stop mode and
/// extras (docs/integration.md, features; PK-47). It has been reset.
std::unique_ptr<RtlNode> create_lean_core(std::string name, const ClockConfig &clock = {});

}  // namespace vericansim
