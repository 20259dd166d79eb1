// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bench itself: frames pass between engines, the model follows, disturbances hit their bit.
#include <gtest/gtest.h>

#include "protocol/core_bench.hpp"
#include "protocol/lockstep.hpp"

namespace vericansim {
namespace {

Frame frame(std::uint32_t id, std::uint8_t dlc = 8) {
  Frame f{.id = id, .dlc = dlc};
  for (unsigned i = 0; i < f.payload_size(); ++i)
    f.data[i] = static_cast<std::uint8_t>(0x11 * i + id);
  return f;
}

TEST(CoreBenchTest, FrameReachesTheOtherEngine) {
  CoreBench bench{2};
  Lockstep judge{bench};
  judge.start();
  judge.request(0, frame(0x123));
  judge.request(0, frame(0x7F0, 3));
  ASSERT_TRUE(bench.run_until([&] { return bench.dut(1).received().size() == 2; }, 400));
  EXPECT_EQ(bench.dut(1).received()[0], frame(0x123));
  EXPECT_EQ(bench.dut(1).received()[1], frame(0x7F0, 3));
  bench.run_bits(10);
  EXPECT_EQ(bench.dut(0).sent().size(), 2u);
  EXPECT_TRUE(judge.agrees()) << judge.report();
}

// GV-1 and TL-03: a lone transmitter, no acknowledge: flag in the ACK delimiter, SOF 18 bits after
// the slot.
TEST(CoreBenchTest, TxHistoryShowsTheGoldenVector) {
  CoreBench bench{1};
  Lockstep judge{bench};
  judge.start();
  judge.request(0, {.id = 0x123, .dlc = 1, .data = {0x55}});
  bench.lt_acknowledges(true);
  ASSERT_TRUE(bench.run_until([&] { return !bench.dut(0).sent().empty(); }, 100));
  const std::string golden = "0001001000110000010101010101010001101100011";
  const std::size_t sof = bench.tx_history(0).find('0');
  ASSERT_NE(sof, std::string::npos);
  EXPECT_EQ(bench.tx_history(0).substr(sof, golden.size()), golden);
  EXPECT_TRUE(judge.agrees()) << judge.report();
}

TEST(CoreBenchTest, InversionHitsOneBitOfOneDut) {  // ST-06, EF-01
  CoreBench bench{2};
  Lockstep judge{bench};
  judge.start();
  bench.invert(1, {.field = Field::kDlc, .index = 3});
  judge.request(0, frame(0x555, 0));
  ASSERT_TRUE(bench.run_until([&] { return !bench.dut(0).sent().empty(); }, 400));
  EXPECT_TRUE(judge.agrees()) << judge.report();
  EXPECT_EQ(bench.dut(0).events().failed, 1u);
  EXPECT_EQ(bench.dut(1).received().size(), 1u);
}

TEST(CoreBenchTest, LtSendsAFrame) {  // GV-2
  CoreBench bench{1};
  Lockstep judge{bench};
  judge.start();
  bench.lt(
      "01010101010100000100110011101001100"
      "1"
      "1"
      "1"
      "1111111");
  ASSERT_TRUE(bench.run_until([&] { return !bench.dut(0).received().empty(); }, 100));
  EXPECT_EQ(bench.dut(0).received()[0], (Frame{.id = 0x555}));
  EXPECT_TRUE(judge.agrees()) << judge.report();
}

TEST(CoreBenchTest, JudgeSeesACounterThatIsWrong) {
  CoreBench bench{1};
  Lockstep judge{bench};
  judge.start();
  judge.model(0).preset_counters(3, 0);
  bench.run_bits(2);
  EXPECT_FALSE(judge.agrees());
  EXPECT_NE(judge.report().find("TEC 0, the rules say 3"), std::string::npos) << judge.report();
}

}  // namespace
}  // namespace vericansim
