// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes of the profiles: see core_build.hpp.
#include "harness/core_build.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "Vcan_host_small.h"
#include "Vcan_host_small___024root.h"
#include "Vcan_host_standard.h"
#include "Vcan_host_standard___024root.h"
#include "harness/bus_builds.hpp"
#include "harness/single_nodes.hpp"
#include "node/rtl_node_of.hpp"

namespace vericansim {
namespace {

const char *test_variable(const char *name) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody sets variables here.
  return std::getenv(name);
}
const char *test_bus() { return test_variable("VERICAN_TEST_BUS"); }

bool is_single(const CoreBuild &build) {
  return std::any_of(std::begin(kSingleBuilds), std::end(kSingleBuilds),
                     [&](const CoreBuild &one) { return one.name == std::string{build.name}; });
}

}  // namespace

const CoreBuild &core_build(const std::string &name) {
  for (const CoreBuild &build : kCoreBuilds)
    if (name == build.name) return build;
  for (const CoreBuild &build : kSingleBuilds)
    if (name == build.name) return build;
  throw std::out_of_range("no build " + name);
}

const CoreBuild *build_under_test() {
  const char *name = test_variable("VERICAN_TEST_BUILD");
  return name == nullptr ? nullptr : &core_build(name);
}

const CoreBuild &build_of_test(const CoreBuild &build) {
  if (test_bus() != nullptr) return core_build("full");
  const CoreBuild *under_test = build_under_test();
  return under_test != nullptr && build.features == Features{} ? *under_test : build;
}

std::unique_ptr<RtlNode> make_node(std::string name, const CoreBuild &build,
                                   const ClockConfig &clock) {
  const CoreBuild *under_test = build_under_test();
  if (is_single(build)) return make_single_node(build.name, std::move(name), clock);
  if (under_test != nullptr && build.features == Features{} && build.num_mb == under_test->num_mb)
    return make_node(std::move(name), *under_test, clock);
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
