// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Who is meant and who may say what, on the model: RN-01 to RN-16.
#include <array>
#include <memory>
#include <random>
#include <stdexcept>

#include "remote/model_node.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

RemoteConfig with_name_bits(unsigned bits) {
  RemoteConfig config = RemoteConfig::profile("full");
  config.name_bits = bits;
  return config;
}

class EveryIdentifier : public ::testing::TestWithParam<unsigned> {
 protected:
  const unsigned bits = GetParam();
  const unsigned shift = 10 - bits;
  const unsigned numbers = 1U << bits;
};

// RN-02, RN-03, RN-07, RN-10, RN-34: a write of one byte to every identifier, for every number.
// Who obeys, what is written, and under which identifier anything is said.
TEST_P(EveryIdentifier, IsObeyedByThoseWhoAreMeant) {
  const unsigned window = (1U << shift) - 8;
  for (unsigned number = 0; number < numbers; ++number) {
    for (unsigned id = 0; id < 0x800; ++id) {
      ModelNode node{with_name_bits(bits), number};
      node.started();
      Frame frame;
      frame.id = id;
      frame.dlc = 1;
      frame.data[0] = 0x5A;
      node.model.receive(frame);
      const unsigned name = id >> shift;  // with dir on top
      const unsigned a = id & ((1U << shift) - 1);
      const bool meant = name == 0 || name == 1 || (name == number && number >= 2);
      const bool counted = node.model.status().accepted != 0 || node.model.status().refused != 0;
      // SELECT and TRIGGER with one byte: TRIGGER is right and not counted.
      ASSERT_EQ(counted, meant && !(name == 0 && (a == 1 || a == 3))) << number << ' ' << id;
      const bool write = meant && name != 0 && a < window && (a < 0x10 || a >= 0x18);
      ASSERT_EQ(node.bytes(a, 1)[0], write ? 0x5A : 0) << number << ' ' << id;
      ASSERT_EQ(node.model.status().duplicate, name == numbers + number && number >= 2);
      for (const std::string &text : node.drain())
        ASSERT_EQ(frame_of(text).id >> shift, numbers + number) << text;
    }
  }
}

// RN-14, RN-21: a remote frame of a request is answered, once, by the statement of the own number
// at its A; one to a port that has none by STATUS, but not if it went to all.
TEST_P(EveryIdentifier, IsAnsweredOnAnotherOne) {
  const unsigned window = (1U << shift) - 8, status = window + 6;
  for (unsigned number = 0; number < numbers; ++number) {
    ModelNode node{with_name_bits(bits), number};
    node.started();
    for (unsigned id = 0; id < 0x800; ++id) {
      Frame frame;
      frame.id = id;
      frame.remote = true;
      frame.dlc = 1;
      node.model.receive(frame);
      const Texts said = node.drain();
      const unsigned name = id >> shift;
      const unsigned a = id & ((1U << shift) - 1);
      const bool readable = a < window || a >= status;
      if (number < 2 || !(name == number || (name == 1 && readable))) {
        ASSERT_THAT(said, IsEmpty()) << number << ' ' << id;
        continue;
      }
      ASSERT_EQ(said.size(), 1U) << number << ' ' << id;
      ASSERT_EQ(frame_of(said[0]).id, (numbers + number) << shift | (readable ? a : status)) << id;
      ASSERT_EQ(frame_of(said[0]).dlc, readable ? 1 : 8) << id;
    }
    EXPECT_FALSE(node.model.status().duplicate);
  }
}

INSTANTIATE_TEST_SUITE_P(NameBits, EveryIdentifier, ::testing::Values(3U, 5U));

// RN-01, RN-34: extended frames are nobody's.
TEST(RemoteModelAddress, ExtendedFramesAreIgnored) {
  ModelNode node{RemoteConfig::profile("full")};
  node.started();
  const auto before = node.model.status().row();
  for (const char *text : {"06800000#FF", "00000000#02", "06800000#R1", "16800000#00"})
    EXPECT_THAT(node.send(text), IsEmpty());
  EXPECT_EQ(node.model.status().row(), before);
  EXPECT_EQ(node.bytes(0x20, 1)[0], 0);
}

// RN-04, RN-05: the window ends at 77 (NameBits 5: 17); beyond it the address is in the data.
TEST(RemoteModelAddress, WindowAndPorts) {
  ModelNode three{with_name_bits(3)};
  three.started();
  EXPECT_THAT(three.send("1F0#0102030405060708"), IsEmpty());
  EXPECT_THAT(three.bytes(0x70, 8), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(three.send("1F1#R7"), ElementsAre("5F1#02030405060708"));
  EXPECT_EQ(three.send("1F1#R8").size(), 1U);
  EXPECT_EQ(three.last(), std::pair(2U, 0x71U));
  ModelNode five{with_name_bits(5), 9};
  five.started();
  EXPECT_THAT(five.send("130#0102030405060708"), IsEmpty());  // 10..17: the stage
  EXPECT_THAT(five.send("12F#A1A2"), IsEmpty());
  EXPECT_THAT(five.bytes(0x0F, 2), ElementsAre(0xA1, 0));
  EXPECT_THAT(five.send("138#180001"), ElementsAre("538#180000"));
  EXPECT_EQ(five.send("137#A1A2").size(), 1U);
  EXPECT_EQ(five.last(), std::pair(2U, 0x17U));
}

// RN-06: each statement, asked for or published, has the bytes of its node; who listens to them
// alone knows every window.
TEST(RemoteModelAddress, AListenerRebuildsEveryWindow) {
  std::mt19937 dice{6};
  std::vector<std::unique_ptr<ModelNode>> nodes;
  for (unsigned number = 3; number <= 7; ++number) {
    nodes.push_back(std::make_unique<ModelNode>(RemoteConfig::profile("full"), number));
    nodes.back()->user_write(0xF40, {0x2C, 0x88});  // producer 0: eight bytes from 2C on
    nodes.back()->started().hear("000#01");
  }
  std::array<std::array<std::uint8_t, 0x78>, 8> mirror{};
  unsigned statements = 0;
  const auto listen = [&](ModelNode &node) {
    for (const std::string &text : node.drain()) {
      const Frame frame = frame_of(text);
      const unsigned a = frame.id & 0x7F;
      if (frame.remote || (frame.id & 0x400) == 0 || a >= 0x78) continue;
      ++statements;
      const std::vector<std::uint8_t> told{frame.data.begin(), frame.data.begin() + frame.dlc};
      EXPECT_EQ(told, node.bytes(a, frame.dlc)) << text;
      for (unsigned i = 0; i < frame.dlc; ++i) mirror[frame.id >> 7 & 7].at(a + i) = told[i];
    }
  };
  const auto to_all = [&](const Frame &frame) {
    for (auto &node : nodes) {
      node->model.receive(frame);
      listen(*node);
    }
  };
  for (int i = 0; i < 5000; ++i) {
    Frame frame;
    frame.id = dice() % 0x400;
    frame.remote = dice() % 2 != 0;
    frame.dlc = static_cast<std::uint8_t>(dice() % 9);
    if (!frame.remote)
      for (unsigned b = 0; b < frame.dlc; ++b) frame.data[b] = static_cast<std::uint8_t>(dice());
    if (frame.id < 5) continue;  // no system functions: a RESTART would end it
    to_all(frame);
    ModelNode &node = *nodes[dice() % nodes.size()];
    node.model.event(0);
    listen(node);
  }
  EXPECT_GT(statements, 7000U);
  for (unsigned a = 0; a < 0x78; a += 8) {
    Frame poll;
    poll.id = 0x080 | a;
    poll.remote = true;
    poll.dlc = 8;
    to_all(poll);
  }
  for (const auto &node : nodes)
    EXPECT_THAT(node->bytes(0, 0x78), ::testing::ElementsAreArray(mirror[node->model.number()]));
}

// RN-11: each data frame with the own number counts, remote and extended ones do not.
TEST(RemoteModelAddress, AnotherNodeWithThisNumberIsNoticed) {
  ModelNode node{RemoteConfig::profile("full")};
  node.started();
  for (const char *text : {"5A0#R1", "06800000#00", "620#00", "402#", "420#00"}) {
    EXPECT_THAT(node.send(text), IsEmpty());
    EXPECT_FALSE(node.model.status().duplicate) << text;
  }
  for (int i = 0; i < 300; ++i) EXPECT_THAT(node.send("5FE#00"), IsEmpty());
  EXPECT_TRUE(node.model.status().duplicate);
  EXPECT_EQ(node.bytes(0xFEC, 1)[0], 0xFF);  // RN-35: stops
  EXPECT_THAT(node.send("1FC#04"), IsEmpty());
  EXPECT_FALSE(node.model.status().duplicate);
  EXPECT_EQ(node.bytes(0xFEC, 1)[0], 0);
}

// RN-07: without a number a node says HERE and nothing else, but obeys what all obey.
TEST(RemoteModelAddress, WithoutANumber) {
  for (const unsigned number : {0U, 1U, 8U, 9U}) {  // 8 and 9 in three bits: 0 and 1
    ModelNode node{RemoteConfig::profile("full"), number};
    node.model.start();
    EXPECT_THAT(node.drain(), IsEmpty()) << number;
    EXPECT_THAT(node.send("0A0#5A"), IsEmpty());
    EXPECT_EQ(node.bytes(0x20, 1)[0], 0x5A);
    EXPECT_THAT(node.send("0A0#R1"), IsEmpty());
    EXPECT_THAT(node.send("0FE#R8"), IsEmpty());
    EXPECT_EQ(node.model.status().refused, 0);
    EXPECT_THAT(node.send("002#0000000000000000"), ElementsAre("402#"));
    EXPECT_THAT(node.send("003#06"), ElementsAre("77E#0200000003020000"));
  }
}

// RN-16: with SameId the answer to a direct read has the identifier of the request, others not.
TEST(RemoteModelAddress, SameId) {
  RemoteConfig config = RemoteConfig::profile("full");
  config.same_id = true;
  ModelNode node{config};
  node.started();
  EXPECT_THAT(node.send("1A0#R2"), ElementsAre("1A0#0000"));
  EXPECT_THAT(node.send("0A0#R2"), ElementsAre("0A0#0000"));
  EXPECT_THAT(node.send("1FE#R1"), ElementsAre("5FE#02"));
  EXPECT_THAT(node.send("1F8#200001"), ElementsAre("5F8#200000"));
}

// Section 10: parameters that are not allowed are refused.
TEST(RemoteModelAddress, ParametersOutOfRangeAreRefused) {
  using Change = void (*)(RemoteConfig &);
  for (const Change change : {Change{[](RemoteConfig &c) { c.name_bits = 4; }},
                              Change{[](RemoteConfig &c) { c.mem_bytes = 512; }},
                              Change{[](RemoteConfig &c) { c.stage_bytes = 4; }},
                              Change{[](RemoteConfig &c) { c.tx_depth = 2; }},
                              Change{[](RemoteConfig &c) { c.num_prod = 9; }},
                              Change{[](RemoteConfig &c) { c.num_map = 1; }},
                              Change{[](RemoteConfig &c) { c.rate_rows = 0; }}}) {
    RemoteConfig config;
    change(config);
    EXPECT_THROW(RemoteModel{config}, std::invalid_argument);
  }
  EXPECT_THROW((void)RemoteConfig::profile("large"), std::invalid_argument);
}

}  // namespace
}  // namespace vericansim
