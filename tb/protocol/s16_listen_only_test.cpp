// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Rule book 16: a listening node after an error of its own, on a bus that never pauses.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "protocol/error_rig.hpp"

namespace vericansim {
namespace {

using model_bench::kGv1;
using model_bench::to_delimiter;
using model_bench::whole;

const std::string kGap = "111";  // a saturated bus: the next frame follows the intermission
const Frame kNext{.id = 0x2A5, .dlc = 2, .data = {0xC3, 0x0F}};

CoreConfig listen_only() {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = true;
  return config;
}

std::string with_flip(std::string wire, std::size_t bit) {
  wire[bit] = wire[bit] == '0' ? '1' : '0';
  return wire;
}

const std::vector<Frame> &frames() {
  static const std::vector<Frame> kFrames = {
      kGv1,
      {.id = 0x7FF, .remote = true, .dlc = 15},
      {.id = 0x000, .dlc = 8},
      {.id = 0x1FFFFFFF,
       .extended = true,
       .dlc = 8,
       .data = {255, 255, 255, 255, 255, 255, 255, 255}},
      {.id = 0x0ABCDEF, .extended = true, .dlc = 3, .data = {0x12, 0xF0, 0x77}}};
  return kFrames;
}

class ListenOnlyError : public ::testing::TestWithParam<Counters> {};

INSTANTIATE_TEST_SUITE_P(States, ListenOnlyError,
                         ::testing::Values(kActive, kPassive, kPassiveByRec));

// MO-02, RO-05: a bit that only the listener sees wrong, SOF to CRC delimiter, costs that frame and
// no other. A wrong length or a lost stuff bit is often noticed in the end of frame only: recessive
// bits seen before count.
TEST_P(ListenOnlyError, OneWrongBitCostsOneFrame) {
  for (const Frame &frame : frames()) {
    for (std::size_t n = 0; n < to_delimiter(frame).size(); ++n) {
      SCOPED_TRACE(to_delimiter(frame) + " bit " + std::to_string(n));
      ErrorRig rig(GetParam(), listen_only());
      rig.play(with_flip(whole(frame), n) + kGap + whole(kNext) + kGap);
      ASSERT_EQ(rig.delivered(), 1u);
      EXPECT_EQ(rig.dut().received()[0], kNext);
    }
  }
}

// MO-02: an error in the eleven recessive bits themselves leaves too few of them for the frame that
// follows; the one after is received. From EOF7 on the frame before is valid (VA-01).
TEST_P(ListenOnlyError, WrongBitInTheGapCostsTheNextFrame) {
  const std::size_t delimiter = to_delimiter(kGv1).size() + 1;
  for (std::size_t n = delimiter; n < delimiter + 11; ++n) {
    SCOPED_TRACE("recessive bit " + std::to_string(n - delimiter + 1));
    ErrorRig rig(GetParam(), listen_only());
    rig.play(with_flip(whole(kGv1) + kGap, n) + whole(kNext) + kGap + whole(kNext));
    const bool valid = n >= delimiter + 7;
    ASSERT_EQ(rig.delivered(), valid ? 2u : 1u);
    EXPECT_EQ(rig.dut().received().back(), kNext);
    if (valid) {
      EXPECT_EQ(rig.dut().received().front(), kGv1);
    }
  }
}

// MO-02, IN-01, IN-03: no flag, no delimiter: straight to integration, which any dominant bit
// begins anew; the bit after the eleventh recessive one may be a start of frame.
TEST_P(ListenOnlyError, IntegratesAtOnce) {
  ErrorRig rig(GetParam(), listen_only());
  rig.play("000000");  // the sixth equal bit
  EXPECT_EQ(rig.field(), Field::kInteg);
  rig.play(rep(10, "1") + "0" + rep(10, "1"));
  EXPECT_EQ(rig.field(), Field::kInteg);
  rig.play("1");
  EXPECT_EQ(rig.field(), Field::kIdle);
  rig.receive(kGv1);
  EXPECT_EQ(rig.delivered(), 1u);
  rig.play("10");  // INT2: others send an overload flag here (OV-03)
  EXPECT_EQ(rig.field(), Field::kInteg);
  rig.play("000000" + rep(10, "1"));
  EXPECT_EQ(rig.field(), Field::kInteg);
  rig.play("1");
  EXPECT_EQ(rig.field(), Field::kIdle);
}

// MO-02: recessive bits that the error itself ends are counted: six of a stuff error, the ACK
// delimiter of a CRC error.
TEST_P(ListenOnlyError, CountsRecessiveBitsUpToTheError) {
  ErrorRig stuff(GetParam(), listen_only());
  stuff.play("0" + rep(6, "1"));
  EXPECT_EQ(stuff.field(), Field::kInteg);
  stuff.play(rep(4, "1"));
  EXPECT_EQ(stuff.field(), Field::kInteg);
  stuff.play("1");
  EXPECT_EQ(stuff.field(), Field::kIdle);
  ErrorRig crc(GetParam(), listen_only());
  crc.play(with_flip(to_delimiter(kGv1), 42) + "0 1");
  EXPECT_EQ(crc.last().errors, kErrCrc);
  EXPECT_EQ(crc.field(), Field::kInteg);
  crc.play(rep(10, "1"));
  EXPECT_EQ(crc.field(), Field::kIdle);
  ErrorRig alone(GetParam(), listen_only());  // nobody acknowledges: delimiter, slot, delimiter
  alone.play(with_flip(to_delimiter(kGv1), 42).substr(0, 42) + "0 111");
  EXPECT_EQ(alone.last().errors, kErrCrc);
  alone.play(rep(7, "1"));
  EXPECT_EQ(alone.field(), Field::kInteg);
  alone.play("1");
  EXPECT_EQ(alone.field(), Field::kIdle);
}

Frame random_frame(std::mt19937 &random) {
  Frame frame{.extended = random() % 2 == 0, .dlc = static_cast<std::uint8_t>(random() % 9)};
  frame.id = static_cast<std::uint32_t>(random()) & (frame.extended ? 0x1FFFFFFFu : 0x7FFu);
  for (unsigned k = 0; k < frame.dlc; ++k) {
    const auto byte = static_cast<std::uint8_t>(random());
    frame.data[k] = random() % 3 == 0 ? std::uint8_t(0xFF * (byte & 1)) : byte;
  }
  return frame;
}

// MO-02: a thousand frames with nothing between them, one wrong bit in every fiftieth: 980 arrive.
TEST_P(ListenOnlyError, TwentyErrorsInAThousandFramesCostTwenty) {
  std::mt19937 random{GetParam().tec + 7u};
  ErrorRig rig(GetParam(), listen_only());
  std::vector<Frame> expected;
  for (unsigned n = 0; n < 1000; ++n) {
    const Frame frame = random_frame(random);
    std::string wire = whole(frame);
    if (n % 50 == 20) {
      wire = with_flip(wire, random() % to_delimiter(frame).size());
    } else {
      expected.push_back(frame);
    }
    rig.play(wire + kGap);
  }
  EXPECT_EQ(rig.delivered(), 980u);
  EXPECT_TRUE(rig.dut().received() == expected);
}

}  // namespace
}  // namespace vericansim
