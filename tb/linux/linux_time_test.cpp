// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board with time units: what a guest finds there, without a guest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <sstream>

#include "harness/scratch_folder.hpp"
#include "linux/board.hpp"
#include "time/time_rig.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using namespace time_reg;

constexpr std::uint64_t kMs = 1'000'000;       // ns
constexpr std::uint64_t kSecond = 1000 * kMs;  // ns
constexpr std::uint32_t kWindow = 0x2000;
constexpr std::uint32_t kCompare = 1u << 13, kCompareInterrupt = 1u << 17, kOutput = 1u << 12;
constexpr std::uint32_t kRising = 1u << 8, kExternalInterrupt = 1u << 16;

class BoardTime : public ::testing::Test {
 protected:
  BoardTime() {
    config.directory = folder.path();
    config.time_unit = true;
    config.clock_ppm = {40, -25};
    board = std::make_unique<Board>(config);
  }
  std::uint32_t read(unsigned n, std::uint32_t offset) {
    return board->access({.address = kWindow * n + offset});
  }
  void write(unsigned n, std::uint32_t offset, std::uint32_t value) {
    board->access({.address = kWindow * n + offset, .write = true, .value = value});
  }
  std::uint64_t time(unsigned n) {
    const std::uint64_t low = read(n, kTimelo);
    return low | (std::uint64_t{read(n, kTimehi)} << 32);
  }

  BoardConfig config;
  const ScratchFolder folder;
  std::unique_ptr<Board> board;
};

TEST_F(BoardTime, EachControllerHasItsPages) {
  constexpr std::uint32_t kXid = 0x1000, kVcan = 0x5643414E;
  EXPECT_EQ(read(0, kXid), kVcan);
  EXPECT_EQ(read(1, kXid), kVcan);
  EXPECT_EQ(read(2, kXid), 0xFFFFFFFF) << "there are two";
  EXPECT_EQ(read(1, 0), 0xD890000F) << "flexcan.md 1.1";
}

TEST_F(BoardTime, TimeGoesOnWithItsOscillatorWhileNothingElseDoes) {
  const std::uint64_t start = board->now();
  const std::uint64_t before[] = {time(0), time(1)};
  EXPECT_FALSE(board->run_until(start + 100 * kSecond));
  EXPECT_EQ(board->now(), start + 100 * kSecond);
  EXPECT_EQ(board->asleep(), 0U);
  EXPECT_NEAR(static_cast<double>(time(0) - before[0]), 100e9 + 40e-6 * 100e9, 1000);
  EXPECT_NEAR(static_cast<double>(time(1) - before[1]), 100e9 - 25e-6 * 100e9, 1000);
}

TEST_F(BoardTime, CompareRaisesItsLine) {
  (void)board->levels();
  write(1, kTctrl, kCompare | kCompareInterrupt);
  const std::uint64_t now = board->now();
  write(1, kTcmp, static_cast<std::uint32_t>(time(1) + 5 * kMs));
  EXPECT_TRUE(board->run_until(now + 10 * kMs));
  EXPECT_NEAR(static_cast<double>(board->now() - now), 5e6, 5000);
  EXPECT_EQ(board->levels(), 1u << 9);
  EXPECT_FALSE(board->run_until(now + 20 * kMs)) << "what is known does not stop it again";
  write(1, kTstat, 0x3F);
  EXPECT_EQ(board->levels(), 0U);
}

TEST_F(BoardTime, PulsesComeInAtTheirTimes) {
  write(0, kTctrl, kRising | kExternalInterrupt);
  (void)board->levels();
  const std::uint64_t start = board->now() + 3 * kMs;
  EXPECT_EQ(board->command("pulse can0 " + std::to_string(start) + " 2000000 3"), "ok\n");
  for (const std::uint64_t wanted : {start, start + 2 * kMs, start + 4 * kMs}) {
    const std::uint64_t shown = time(0), now = board->now();
    ASSERT_TRUE(board->run_until(now + 100 * kMs));
    EXPECT_NEAR(static_cast<double>(board->now()), static_cast<double>(wanted), 800);
    EXPECT_NEAR(static_cast<double>(read(0, kTextlo)),
                static_cast<double>(shown + wanted - now) + 187.5, 700);
    EXPECT_EQ(board->levels(), 1u << 8);
    write(0, kTstat, 0x3F);
    (void)board->levels();
  }
  EXPECT_FALSE(board->run_until(board->now() + 100 * kMs));
}

TEST_F(BoardTime, EdgesOfTheOutputAreWritten) {
  write(1, kTctrl, kCompare | kOutput);
  write(1, kTcmph, 1'000'000);
  const std::uint64_t now = board->now(), shown = time(1);
  write(1, kTcmp, static_cast<std::uint32_t>(shown + 2 * kMs));
  (void)board->run_until(now + 4500 * kMs / 1000);
  EXPECT_EQ(board->command("edges can1 out.txt"), "ok\n");
  std::istringstream lines{read_text_file(folder / "out.txt")};
  double edge = 0;
  bool level = false;
  for (int n = 0; n < 3; ++n) {
    ASSERT_TRUE(lines >> edge >> level) << n;
    EXPECT_EQ(level, n % 2 == 0);
    EXPECT_NEAR(edge / 1e3, static_cast<double>(now) + (2e6 + n * 1e6) / (1 - 25e-6), 900);
  }
  EXPECT_FALSE(lines >> edge);
}

TEST_F(BoardTime, CommandsAreChecked) {
  for (const char *bad : {"pulse", "pulse can0 1", "pulse can7 5000000 10 1", "pulse can0 0 10 1",
                          "pulse can0 5000000 1 1", "pulse can0 5000000 10 0", "edges can0",
                          "edges can0 a/b", "edges can2 out.txt"}) {
    (void)board->run_until(kMs);
    EXPECT_THROW(board->command(bad), InputError) << bad;
  }
  Board plain{BoardConfig{.directory = folder.path()}};
  EXPECT_THROW(plain.command("edges can0 out.txt"), InputError);
}

}  // namespace
}  // namespace vericansim
