// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The paper's experiments (figures 11 to 18), one test for each.
#include <gtest/gtest.h>

#include <set>

#include "paper/paper.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

TEST(Paper, EveryExperimentAgrees) {
  const auto experiments = run_paper({});
  ASSERT_EQ(experiments.size(), 5U);
  std::set<std::string> figures;
  for (const PaperExperiment &experiment : experiments)
    for (const PaperCheck &check : experiment.checks) {
      EXPECT_TRUE(check.ok) << "figure " << check.figure << ": " << check.reported
                            << "; seen: " << check.seen;
      figures.insert(check.figure);
    }
  EXPECT_EQ(figures, (std::set<std::string>{"11", "12", "13", "14", "15", "16", "17", "18"}));
}

// The waveforms themselves, read by the passive decoder, show what the figures show.
TEST(Paper, WaveformsShowTheFrames) {
  const std::string folder = ::testing::TempDir() + "paper";
  const auto experiments = run_paper({.wave_folder = folder});
  const auto decode = [&](std::size_t i) {
    return decode_wave(experiments.at(i).files.wave, {"bus.can", 50e3, 800}).events;
  };
  const Frame frame{0b00000001010, false, false, 1, {0b10101010}};
  const auto reception = decode(0);
  ASSERT_EQ(reception.size(), 1U);
  EXPECT_EQ(reception[0].frame, frame);
  EXPECT_TRUE(reception[0].acked);
  const auto arbitration = decode(2);
  ASSERT_EQ(arbitration.size(), 2U);
  EXPECT_EQ(arbitration[0].frame.id, 0b00000001010U);
  EXPECT_EQ(arbitration[1].frame.id, 0b00000001011U);
  // 16 attempts end in an active error flag of six bits; the frames behind them, which a passive
  // node sends, look whole to a listener (MO-03).
  std::size_t flags = 0;
  for (const BusEvent &event : decode(3))
    if (event.kind == BusEventKind::kErrorFrame) flags += event.flag_bits == 6 ? 1 : 0;
  EXPECT_EQ(flags, 16U);
}

}  // namespace
}  // namespace vericansim
