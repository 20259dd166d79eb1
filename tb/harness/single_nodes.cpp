// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes that lack one feature each: see single_nodes.hpp.
#include "harness/single_nodes.hpp"

#include <iostream>
#include <set>
#include <stdexcept>
#include <utility>

#include "node/rtl_node_of.hpp"
#include "single_models.hpp"  // written by CMake

namespace vericansim {
namespace {

void tell_single(const std::string &build) {
  static std::set<std::string> told;
  if (told.insert(build).second) std::cout << "on " << build << "\n";  // for tb/features/run.py
}

}  // namespace

std::unique_ptr<RtlNode> make_single_node(const std::string &build,
                                          [[maybe_unused]] std::string name,
                                          [[maybe_unused]] const ClockConfig &clock) {
  tell_single(build);
#define VERICAN_SINGLE_NODE(single) \
  if (build == #single)             \
    return std::make_unique<RtlNodeOf<Vcan_host_##single>>(std::move(name), clock, 64);
  VERICAN_SINGLE_MODELS(VERICAN_SINGLE_NODE)
#undef VERICAN_SINGLE_NODE
  throw std::invalid_argument("no model of " + build + ": see VERICAN_SINGLE_FEATURES");
}

}  // namespace vericansim
