// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes of every kind work in the thread that runs their bus, however many CPUs the machine has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <thread>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "node/lean_core.hpp"
#include "node/remote_node.hpp"
#include "node/rtl_node.hpp"
#include "node/time_node.hpp"

namespace vericansim {
namespace {

std::ptrdiff_t threads() {
  return std::distance(std::filesystem::directory_iterator{"/proc/self/task"}, {});
}

TEST(NodeThreads, NoneOfTheirOwn) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "needs more than one CPU";
  const std::ptrdiff_t before = threads();
  const BitTiming timing{.prescaler = 1, .prop = 1, .ps1 = 4, .ps2 = 2, .sjw = 1};
  std::vector<std::unique_ptr<Node>> nodes;
  for (const unsigned num_mb : {16U, 32U, 64U}) nodes.push_back(RtlNode::create("mb", {}, num_mb));
  nodes.push_back(RtlNode::create_with_time("time"));
  nodes.push_back(create_lean_core("lean"));
  nodes.push_back(RemoteNode::create("remote", RemoteConfig::profile("small"), 2, timing));
  nodes.push_back(std::make_unique<CoreNode>("engine"));
  nodes.push_back(std::make_unique<TimeNode>("plain"));
  EXPECT_EQ(threads(), before);
}

}  // namespace
}  // namespace vericansim
