// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What is there, what is told and what is counted, on the model: RN-20 to RN-25, RN-30, RN-35.
#include <fmt/format.h>

#include <memory>

#include "remote/model_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Node 3, serial 11223344, profile full.
RemoteConfig full() {
  RemoteConfig config = RemoteConfig::profile("full");
  config.serial = 0x11223344;
  return config;
}

// RN-23: name 1 has no BLOCK, DATA and SETUP; correct ones are function, too.
TEST(RemoteModelCodes, PortsThatAllDoNotHave) {
  ModelNode node{full()};
  node.started();
  for (const char *text : {"0FA#017700031000", "0FB#0000", "0FC#02"}) {
    EXPECT_THAT(node.send(text), IsEmpty());
    EXPECT_EQ(node.last().first, 1U) << text;
  }
  EXPECT_EQ(node.model.status().refused, 3);
  EXPECT_THAT(node.send("0FE#R2"), ElementsAre("5FE#0200"));
  EXPECT_THAT(node.send("0FF#R1"), ElementsAre("5FF#01"));
  EXPECT_THAT(node.send("0F9#00025A"), IsEmpty());
  EXPECT_THAT(node.send("0F8#000201"), ElementsAre("5F8#00025A"));
}

// RN-25, 8: what a node does not have is an unknown function, an address that is not there, or
// memory without protection.
TEST(RemoteModelCodes, WhatASmallNodeDoesNotHave) {
  ModelNode node{RemoteConfig::profile("small")};
  node.started();
  const auto code = [&](const char *text) {
    (void)node.send(text);
    return node.last().first;
  };
  EXPECT_EQ(code("1FA#017700031000"), 1U);
  EXPECT_EQ(code("1FB#0000"), 1U);
  EXPECT_EQ(code("1F8#400F01"), 2U);
  EXPECT_EQ(code("1F8#800F01"), 2U);
  EXPECT_EQ(code("1F8#E80F08"), 3U);
  EXPECT_EQ(code("1F8#E80F06"), 2U);
  EXPECT_THAT(node.send("1F8#F00F01"), ElementsAre("5F8#F00F02"));
  node.user_write(0xF08, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF});
  EXPECT_EQ(code("1A0#5A"), 0U);
  EXPECT_EQ(node.bytes(0x20, 1)[0], 0x5A);
}

// 8: four entries of each kind; the others are not there.
TEST(RemoteModelCodes, TablesOfFourEntries) {
  RemoteConfig config = full();
  config.num_prod = config.num_map = 4;
  ModelNode node{config};
  node.started();
  EXPECT_THAT(node.send("1F8#5F0F01"), ElementsAre("5F8#5F0F00"));
  EXPECT_EQ(node.send("1F8#600F01").size(), 1U);
  EXPECT_EQ(node.last().first, 2U);
  EXPECT_THAT(node.send("1F8#9F0F01"), ElementsAre("5F8#9F0F00"));
  EXPECT_EQ(node.send("1F8#9F0F02").size(), 1U);
  EXPECT_EQ(node.last().first, 2U);
}

class Sizes : public ::testing::TestWithParam<std::pair<unsigned, unsigned>> {};

// 8: memory ends 512 bytes before its size; the rest keeps its addresses.
TEST_P(Sizes, MemoryEndsWhereItShould) {
  const auto [size, end] = GetParam();
  RemoteConfig config = full();
  config.mem_bytes = size;
  ModelNode node{config};
  node.started();
  const auto read = [&](unsigned address) {
    return node.send(fmt::format("1F8#{:02X}{:02X}01", address & 0xFF, address >> 8)).front();
  };
  EXPECT_TRUE(read(end - 1).starts_with("5F8#"));
  EXPECT_TRUE(read(end).starts_with("5FE#"));
  EXPECT_EQ(node.last().first, 2U);
  EXPECT_TRUE(read(0xDFF).starts_with(size == 4096 ? "5F8#" : "5FE#"));
  EXPECT_EQ(read(0xF01), "5F8#010F05");
  EXPECT_EQ(node.model.memory()[0xFFA], size == 1024 ? 0x3A : size == 2048 ? 0x3B : 0x3C);
}

INSTANTIATE_TEST_SUITE_P(Memory, Sizes,
                         ::testing::Values(std::pair(1024U, 0x200U), std::pair(2048U, 0x600U),
                                           std::pair(4096U, 0xE00U)));

// RN-22: the rows, the configuration and the tables, read where they stand.
TEST(RemoteModelCodes, EverythingThatMayBeReadIsRead) {
  ModelNode node{full()};
  node.started();
  EXPECT_THAT(node.send("1F8#F00F06"), ElementsAre("5F8#F00F020000000000"));
  EXPECT_THAT(node.send("1F8#FA0F06"), ElementsAre("5F8#FA0F3C0844332211"));
  EXPECT_THAT(node.send("1F8#000F06"), ElementsAre("5F8#000F030500000A0A"));
  EXPECT_THAT(node.send("1F8#060F02"), ElementsAre("5F8#060F3208"));
  EXPECT_THAT(node.send("1F8#7C0F06"), ElementsAre("5F8#7C0F000000000000"));
  EXPECT_THAT(node.send("1F8#E80F06"), ElementsAre("5F8#E80F000000000000"));
}

// RN-30: ERRS, ACKW and BOOT, as they were at the start.
TEST(RemoteModelCodes, FlagsSayWhenStatusFollows) {
  const auto node_with = [](unsigned flags) {
    auto node = std::make_unique<ModelNode>(full());
    node->user_write(0xF01, {flags});
    node->model.start();
    return node;
  };
  EXPECT_THAT(node_with(1)->drain(), IsEmpty());
  EXPECT_THAT(node_with(4)->drain(), ElementsAre("5FE#0200000000000000"));
  const auto silent = node_with(0);
  EXPECT_THAT(silent->send("1A0#"), IsEmpty());
  EXPECT_EQ(silent->last(), std::pair(3U, 0x20U));
  const auto talks = node_with(2);
  EXPECT_THAT(talks->send("1A0#5A"), ElementsAre("5FE#0200000020010000"));
  EXPECT_THAT(talks->send("1F9#00025A"), ElementsAre("5FE#0200000079020000"));
  EXPECT_THAT(talks->send("1FC#02"), IsEmpty());
  EXPECT_THAT(talks->send("0A0#5A"), IsEmpty());
  EXPECT_THAT(talks->send("000#0203"), IsEmpty());
  EXPECT_THAT(talks->send("1A0#"), IsEmpty());
}

// RN-30: one STATUS waits at most, with the newest result.
TEST(RemoteModelCodes, ANewerResultReplacesTheOneThatWaits) {
  ModelNode node{full()};
  node.started();
  node.hear("1A0#");
  node.hear("1FD#");
  node.hear("1A0#5A");
  EXPECT_THAT(node.drain(), ElementsAre("5FE#0200000020010200"));
}

// RN-24: what counts as accepted, and what does not.
TEST(RemoteModelCodes, WhatIsCounted) {
  ModelNode node{full()};
  node.started();
  unsigned accepted = 0;
  for (const char *text :
       {"1A0#5A", "0A0#5A", "1F9#00025A", "1FC#02", "000#02", "000#0203", "1FA#017700020100",
        "1FA#007700000000", "1FA#027700020100", "1FB#0055", "1FC#04", "1FC#03"}) {
    (void)node.send(text);
    EXPECT_EQ(node.model.status().accepted, ++accepted) << text;
  }
  for (const char *text : {"1A0#R1", "1F8#000201", "1FE#R1", "1FF#R1", "0A0#R1", "001#01", "001#",
                           "002#0000000000000000", "000#0104", "220#00", "620#00"}) {
    (void)node.send(text);
    EXPECT_EQ(node.model.status().accepted, accepted) << text;
  }
  EXPECT_EQ(node.model.status().refused, 0);
  for (int i = 0; i < 256; ++i) (void)node.send("1A0#5A");
  EXPECT_EQ(node.model.status().accepted, accepted);  // modulo 256
  for (int i = 0; i < 256; ++i) (void)node.send("1A0#");
  EXPECT_EQ(node.model.status().refused, 0);
}

// RN-35: which counter takes which code.
TEST(RemoteModelCodes, Counters) {
  ModelNode node{full()};
  node.started();
  for (const char *text : {"1FD#", "1A0#", "1F8#000E01", "1F9#F00F00", "1F9#000F00", "5A0#"})
    (void)node.send(text);
  for (int i = 0; i < 4; ++i) node.hear("1A0#R1");
  node.hear("1A0#R1");
  (void)node.drain();
  (void)node.send("1FB#0000");
  EXPECT_THAT(node.bytes(0xFE8, 8), ElementsAre(1, 1, 3, 1, 1, 0, 1, 0));
  for (const char *text : {"001#01", "001#02", "001#02", "001#", "001#05"}) (void)node.send(text);
  EXPECT_EQ(node.bytes(0xFEE, 1)[0], 3);  // 02 again and 05 are not the last + 1
  EXPECT_EQ(node.model.status().trigger, 5);
  for (int i = 0; i < 300; ++i) (void)node.send("1FD#");
  EXPECT_EQ(node.bytes(0xFE8, 1)[0], 0xFF);
  const auto counts = node.model.status();
  EXPECT_THAT(node.send("1FC#04"), IsEmpty());
  EXPECT_THAT(node.bytes(0xFE8, 8), ElementsAre(0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_EQ(node.model.status().refused, counts.refused);
  EXPECT_FALSE(node.model.status().duplicate);
}

// RN-24, bytes 0 to 2.
TEST(RemoteModelCodes, StatusShowsTheEnginesErrors) {
  ModelNode node{full()};
  node.started();
  node.model.set_errors(127, 127);
  EXPECT_THAT(node.send("1FE#R3"), ElementsAre("5FE#027F7F"));
  node.model.set_errors(128, 0);
  EXPECT_THAT(node.send("1FE#R3"), ElementsAre("5FE#0A8000"));
  node.model.set_errors(300, 128);
  EXPECT_THAT(node.send("1FE#R3"), ElementsAre("5FE#0AFF80"));
  node.unlock();
  EXPECT_THAT(node.send("1FE#R1"), ElementsAre("5FE#0E"));
}

}  // namespace
}  // namespace vericansim
