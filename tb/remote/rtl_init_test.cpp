// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A node whose RAM has its first contents (RN-60): parameter InitFile, tools/remote_memory.py.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Vcan_remote_init.h"
#include "Vcan_remote_init___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "remote/rtl_bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

/// can_remote with the file of tb/CMakeLists.txt: number 5, 33 at 000, 5A 01 02 from 020.
class FilledNode : public Node {
 public:
  FilledNode() : Node{"filled", UnitBus::clock()} {
    top_.can_rx_i = 1;
    top_.node_i = 3;
    reset();
  }
  /// A reset; the node joins the bus as soon as its RAM may be used.
  void reset() {
    top_.start_i = 0;
    top_.rst_ni = 0;
    for (unsigned i = 0; i < 4; ++i) rising_edge(top_, top_.clk_i);
    top_.rst_ni = 1;
    for (waited = 0; waited < 10'000 && top_.usr_ready_o == 0; ++waited)
      rising_edge(top_, top_.clk_i);
    top_.start_i = 1;
  }
  void clock(Level rx) override {
    top_.can_rx_i = static_cast<std::uint8_t>(rx);
    rising_edge(top_, top_.clk_i);
    drive(static_cast<Level>(top_.can_tx_o));
  }
  unsigned waited = 0;  ///< clocks that the last reset took

 private:
  SerialContext context_;
  Vcan_remote_init top_{&context_, "filled"};
  ModelContext model_context_{context_};
};

class RtlInit : public ::testing::Test {
 protected:
  RtlInit() {
    bus_.add(host_);
    bus_.add(node_);
    host_.start();
    bus_.run_for(400 * UnitBus::kBit);
  }
  /// What the node says to a frame, or by itself.
  std::vector<std::string> send(const std::string &text) {
    if (!text.empty()) host_.request(frame_of(text));
    bus_.run_for(400 * UnitBus::kBit);
    std::vector<std::string> said;
    for (const Frame &frame : host_.received()) said.push_back(candump_frame(frame));
    host_.received().clear();
    return said;
  }
  Bus bus_;
  CoreNode host_{"host", {.timing = UnitBus::timing()}, UnitBus::clock()};
  FilledNode node_;
};

// RN-60: the file replaces the clearing: the node is ready at once, with what the file says, its
// number too; RN-25: IDENT.
TEST_F(RtlInit, TheFileReplacesTheClearing) {
  EXPECT_LE(node_.waited, 4U);
  EXPECT_THAT(send(""), ElementsAre("6FE#0200000000000000"));
  EXPECT_THAT(send("2A0#R4"), ElementsAre("6A0#5A010200"));
  EXPECT_THAT(send("280#R1"), ElementsAre("680#33"));
  EXPECT_THAT(send("2F8#FF0D01"), ElementsAre("6F8#FF0D77"));
  EXPECT_THAT(send("2F8#000F06"), ElementsAre("6F8#000F050500000A0A"));
  EXPECT_THAT(send("2FF#R8"), ElementsAre("6FF#01013C083412FECA"));
}

// RN-60: and no reset clears what has been written since.
TEST_F(RtlInit, AResetKeepsTheMemory) {
  EXPECT_THAT(send("2A0#11"), ElementsAre("6FE#0200000000000000"));
  node_.reset();
  EXPECT_THAT(send(""), ElementsAre("6FE#0200000020010000"));
  EXPECT_THAT(send("2A0#R3"), ElementsAre("6A0#110102"));
}

}  // namespace
}  // namespace vericansim
