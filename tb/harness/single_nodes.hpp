// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes that lack one feature of the core each, for the campaign (tb/features/run.py).
#pragma once

#include <memory>
#include <string>

#include "node/rtl_node.hpp"

namespace vericansim {

/// A node of one of kSingleBuilds (core_build.hpp), and says once that there is one;
/// std::invalid_argument if CMake was run without VERICAN_SINGLE_FEATURES.
std::unique_ptr<RtlNode> make_single_node(const std::string &build, std::string name,
                                          const ClockConfig &clock);

}  // namespace vericansim
