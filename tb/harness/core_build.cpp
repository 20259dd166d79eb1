// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes of the profiles: see core_build.hpp.
#include "harness/core_build.hpp"

#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "Vcan_host_small.h"
#include "Vcan_host_small___024root.h"
#include "Vcan_host_standard.h"
#include "Vcan_host_standard___024root.h"
#include "harness/bus_builds.hpp"
#include "node/rtl_node_of.hpp"

namespace vericansim {
namespace {

const char *test_bus() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets variables here.
  return std::getenv("VERICAN_TEST_BUS");
}

}  // namespace

const CoreBuild &core_build(const std::string &name) {
  for (const CoreBuild &build : kCoreBuilds)
    if (name == build.name) return build;
  throw std::out_of_range("no profile " + name);
}

const CoreBuild &build_of_test(const CoreBuild &build) {
  return test_bus() != nullptr ? core_build("full") : build;
}

std::unique_ptr<RtlNode> make_node(std::string name, const CoreBuild &build,
                                   const ClockConfig &clock) {
  const std::string profile = build.name;
  if (profile == "small")
    return std::make_unique<RtlNodeOf<Vcan_host_small>>(std::move(name), clock, build.num_mb);
  if (profile == "standard")
    return std::make_unique<RtlNodeOf<Vcan_host_standard>>(std::move(name), clock, build.num_mb);
  if (build.features.time_unit) {
    if (build.num_mb != 64)
      throw std::invalid_argument("the core with the time unit has 64 buffers");
    return RtlNode::create_with_time(std::move(name), clock);
  }
  if (test_bus() != nullptr && build.num_mb == 64)
    return make_bus_node(test_bus(), std::move(name), clock);
  return RtlNode::create(std::move(name), clock, build.num_mb);
}

}  // namespace vericansim
