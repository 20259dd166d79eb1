// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The boards of examples/remote/board, bit by bit and by their pins alone: RN-86, RN-87. One
// program a board and what it is made of; CMakeLists.txt says BOARD_MODEL, BOARD_HEADER and
// BOARD_PROFILE.
#include <gmock/gmock.h>

#include BOARD_HEADER
#include "boards/board_bus.hpp"
#include "boards/board_node.hpp"
#include "node/remote_model_node.hpp"
#include "remote/frame_texts.hpp"
#include "remote/golden_vectors.hpp"
#include "remote/random_host.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Device = BoardNode<BOARD_MODEL>;

class Board : public ::testing::Test {
 protected:
  std::vector<std::string> send(const std::string &text) { return bus.send(frame_of(text)); }
  /// Byte at `address`, by the port READ.
  unsigned read(unsigned address) {
    Frame frame = frame_of("1F8#000001");
    frame.data[0] = static_cast<std::uint8_t>(address);
    frame.data[1] = static_cast<std::uint8_t>(address >> 8);
    const auto said = bus.send(frame);
    if (said.size() != 1 || said[0].size() != 10) return ~0U;
    return static_cast<unsigned>(std::stoul(said[0].substr(8), nullptr, 16));
  }

  Device device{"board", BoardBus::clock()};
  BoardBus bus{device};
};

// RN-86: number 3, from its own or from its pins.
TEST_F(Board, GoldenVectors) {
  const golden::Life life = golden::load().front();
  const std::string profile = BOARD_PROFILE;
  for (const golden::Vector &vector : life.for_features(golden::features_of(profile))) {
    SCOPED_TRACE(::testing::PrintToString(vector));
    for (const golden::Step &step : vector.steps)
      EXPECT_EQ(bus.send(step.send, step.from_node), texts_of(step.answers_of(profile)));
    for (const auto &[address, bytes] : vector.memory)
      for (unsigned i = 0; i < bytes.size(); ++i) EXPECT_EQ(read(address + i), bytes[i]);
  }
}

// RN-46: the outputs change with TRIGGER, and are 0 but in OPERATE.
TEST_F(Board, OutputsActAtTrigger) {
  (void)send("000#01");
  (void)send("190#A5");
  EXPECT_EQ(device.outputs(), 0U);
  (void)send("001#01");
  EXPECT_EQ(device.outputs(), 0xA5U & Device::kOutputMask);
  (void)send("190#5A");
  EXPECT_EQ(device.outputs(), 0xA5U & Device::kOutputMask);
  (void)send("000#02");
  EXPECT_EQ(device.outputs(), 0U);
}

TEST_F(Board, InputsStandAt040) {
  for (unsigned bits = 0; bits <= Device::kInputMask; ++bits) {
    device.set_inputs(bits);
    bus.run_bits(2);
    EXPECT_THAT(send("1C0#R1"), ElementsAre("5C0#0" + std::to_string(bits)));
  }
}

// RN-87: beside the model of the rules. The board writes 0x040 in every clock that is free, so a
// write of the bus there is gone before the next frame.
TEST_F(Board, RandomCommandsAreAnsweredAsByTheModel) {
  RemoteConfig config = RemoteConfig::profile(BOARD_PROFILE);
  config.serial = 0xCAFE1234;
  RemoteModelNode model{"model", config, 3, BoardBus::timing(), BoardBus::clock()};
  BoardBus beside{model};
  model.on_pulse = [&](const RemotePulse &pulse) {
    if (pulse.apply && BOARD_PROFILE != std::string{"small"}) model.event(0);
  };
  model.start();
  (void)beside.settle();
  RandomHost dice{7};
  unsigned answers = 0;
  for (unsigned i = 0; i < 1000; ++i) {
    const Frame frame = dice.frame();
    const bool from_other = (frame.id & 0x400) != 0;
    const auto said = bus.send(frame, from_other);
    ASSERT_EQ(said, beside.send(frame, from_other)) << i << " " << candump_frame(frame);
    model.user_write(0x40 / 4, 0, 1);
    answers += static_cast<unsigned>(said.size());
  }
  EXPECT_GT(answers, 200U);
}

#if BOARD_NUMBER_PINS
// RN-07: no number, no answer; the pins of the HX8K board are its number.
TEST_F(Board, NumberComesFromPins) {
  for (const unsigned number : {0U, 1U, 5U, 7U}) {
    Device other{"board", BoardBus::clock()};
    other.set_number(number);
    BoardBus alone{other};
    const auto said = alone.send(frame_of("0C0#R1"));
    if (number < 2)
      EXPECT_THAT(said, IsEmpty());
    else
      EXPECT_THAT(said, ElementsAre(number == 5 ? "6C0#00" : "7C0#00"));
  }
}
#endif

}  // namespace
}  // namespace vericansim
