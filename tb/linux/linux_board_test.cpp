// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: what a guest finds behind its register window, without a guest.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "harness/scratch_folder.hpp"
#include "linux/board.hpp"
#include "linux/board_rig.hpp"
#include "model/registers.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/output_error.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kUs = 1'000, kMs = 1'000'000;
constexpr std::uint32_t kReset = 0xD890000F;  // flexcan.md 1.1

class BoardTest : public ::testing::Test {
 protected:
  BoardTest() {
    config.directory = folder.path();
    config.access_logs = true;
    board = std::make_unique<Board>(config);
    port = {[this](std::uint32_t address) { return board->access({.address = address}); },
            [this](std::uint32_t address, std::uint32_t value) {
              board->access({.address = address, .write = true, .value = value});
            }};
  }

  // Both controllers on the bus and integrated.
  void bring_up() {
    test::bring_up(port, 0);
    test::bring_up(port, 1);
    board->command("bitrate 1000000");
    (void)board->levels();
    ASSERT_FALSE(board->run_until(board->now() + kMs));
  }
  // Sends from controller 0 until its completion interrupts.
  void send(std::uint32_t id, std::uint32_t data) {
    test::send_frame(port, 0, id, data);
    while ((board->levels() & 1) == 0) ASSERT_TRUE(board->run_until(board->now() + 10 * kMs));
  }
  // Both controllers in freeze mode: the bus rests, and time passes without a clock edge.
  void fall_asleep() {
    for (const std::uint32_t window : {0x0000U, 0x1000U})
      port.write(window + reg::kMcr, reg::kMcrMdis | reg::kMcrFrz | reg::kMcrHalt | 63);
    (void)board->levels();
    ASSERT_FALSE(board->run_until(1'000 * kMs));
    ASSERT_GT(board->asleep(), 900 * kMs);
  }
  std::uint32_t read1(std::uint32_t offset) { return port.read(0x1000 + offset); }

  BoardConfig config;
  const ScratchFolder folder;
  std::unique_ptr<Board> board;
  test::RegisterPort port;
};

TEST_F(BoardTest, EachControllerHasAWindow) {
  EXPECT_EQ(port.read(0x0000), kReset);
  EXPECT_EQ(port.read(0x1000), kReset);
  port.write(0x1004, 0x01230000);
  EXPECT_EQ(port.read(0x0004), 0U);
  EXPECT_EQ(port.read(0x2000), 0xFFFFFFFF) << "there are two";
  EXPECT_THAT(board->command("report"), HasSubstr("access_errors=1"));
}

TEST_F(BoardTest, TheLoadIsThatOfAllTimeSinceTheRateWasTold) {
  bring_up();
  send(0x123, 0);
  fall_asleep();
  EXPECT_THAT(board->command("report"), HasSubstr(" load=0.0001 "));  // 90 of 10^6 bits
}

TEST_F(BoardTest, TheLogKeepsTheLastFrameBeforeAnotherRateOrThePeer) {
  bring_up();
  const auto pause = [this] {  // behind it a new observer has its eleven recessive bits
    (void)board->levels();
    ASSERT_FALSE(board->run_until(board->now() + kMs));
  };
  for (const char *command : {"bitrate 1000000", "peer start"}) {
    board->command("log bus.log");
    send(0x123, 0);
    port.write(reg::kIflag2, 1u << 31);
    pause();
    board->command(command);
    pause();
    board->command("log off");
    EXPECT_EQ(read_log(folder / "bus.log").entries.size(), 1U) << command;
  }
}

TEST_F(BoardTest, AFrameThatATimeWithoutClocksFollowsHasItsOwnTime) {
  bring_up();
  board->command("log bus.log");
  const std::uint64_t before = board->now();
  send(0x123, 0);
  const std::uint64_t after = board->now();
  fall_asleep();
  board->command("log off");
  const auto start = static_cast<std::uint64_t>(read_log(folder / "bus.log").start_ns);
  EXPECT_GE(start + kUs, kLogOriginNs + before);  // logs have whole microseconds
  EXPECT_LT(start, kLogOriginNs + after);
}

// PK-41, PK-47: bits of features that are not there read 0.
TEST_F(BoardTest, ALeanControllerKeepsTheFifoAndLacksAbort) {
  constexpr std::uint32_t kFreeze = reg::kMcrFrz | reg::kMcrHalt | 63;
  constexpr std::uint32_t kBoth = reg::kMcrFen | VERICAN_MCR_AEN_MASK;
  const auto kept = [](const BoardConfig &wanted) {
    Board on(wanted);
    const auto write = [&](std::uint32_t mcr) {
      on.access({.address = 0, .write = true, .value = mcr});
    };
    write(kFreeze);
    EXPECT_FALSE(on.run_until(kMs));
    EXPECT_NE(on.access({.address = 0}) & reg::kMcrFrzAck, 0U);
    write(kFreeze | kBoth);
    return on.access({.address = 0}) & kBoth;
  };
  BoardConfig lean;
  lean.lean = true;
  EXPECT_EQ(kept({}), kBoth);
  EXPECT_EQ(kept(lean), reg::kMcrFen) << "the driver looks whether it can be set";
}

TEST_F(BoardTest, TimePassesWithoutClocksWhileNoControllerIsEnabled) {
  const std::uint64_t before = board->controller(0).cycles();
  EXPECT_FALSE(board->run_until(3000 * kMs));
  EXPECT_EQ(board->now(), 3000 * kMs);
  EXPECT_LT(board->controller(0).cycles() - before, 10'000U);
  EXPECT_GT(board->asleep(), 2990 * kMs);
}

TEST_F(BoardTest, AnEnabledControllerIsClockedAllTheTime) {
  bring_up();
  const std::uint64_t before = board->controller(0).cycles();
  const std::uint64_t start = board->now();
  EXPECT_FALSE(board->run_until(start + 5 * kMs));
  EXPECT_EQ(board->now(), start + 5 * kMs);
  EXPECT_NEAR(static_cast<double>(board->controller(0).cycles() - before), 5 * 8000, 2);
}

TEST_F(BoardTest, ARisingLineStopsTime) {
  bring_up();
  test::send_frame(port, 0, 0x123, 0x11223344);
  const std::uint64_t goal = board->now() + 10 * kMs;
  ASSERT_TRUE(board->run_until(goal));
  // 4 bytes: 79 bits and a few stuff bits at 1 Mbit/s. The receiver has it a bit earlier (VA-01,
  // VA-02), and then moves it to a buffer.
  EXPECT_NEAR(static_cast<double>(goal - board->now()), 9.9e6, 0.03e6);
  while (board->levels() != 3U) ASSERT_TRUE(board->run_until(goal));
  EXPECT_FALSE(board->run_until(goal)) << "what is known does not stop it again";
  EXPECT_EQ(read1(reg::mb(1, 1)), 0x123U << 18);
  EXPECT_EQ(read1(reg::mb(1, 2)), 0x11223344U);
  port.write(0x1000 + reg::kIflag1, 2);
  EXPECT_EQ(board->levels(), 1U);
}

TEST_F(BoardTest, TheLogHoldsWhatTheDecoderSaw) {
  bring_up();
  board->command("log bus.log");
  send(0x123, 0x11223344);
  (void)board->run_until(board->now() + kMs);
  board->command("log off");
  const CanLog log = read_log(folder / "bus.log");
  ASSERT_EQ(log.entries.size(), 1U);
  EXPECT_EQ(log.entries[0].frame.id, 0x123U);
  EXPECT_EQ(log.entries[0].frame.data[3], 0x44);
  EXPECT_THAT(board->command("report"), HasSubstr("bus frames=1 unacked=0 errors=0"));
}

TEST_F(BoardTest, AFullDiskIsNoticed) {
  std::filesystem::create_symlink("/dev/full", folder / "bus.log");
  bring_up();
  board->command("log bus.log");
  send(0x123, 0x11223344);
  (void)board->run_until(board->now() + kMs);
  EXPECT_THAT(
      [&] { board->command("log off"); },
      ::testing::ThrowsMessage<OutputError>(
          (folder / "bus.log") + ": cannot be written to its end: No space left on device"));
  config.directory = folder / "full";
  std::filesystem::create_directories(config.directory);
  std::filesystem::create_symlink("/dev/full", config.directory + "/access-0.txt");
  board = std::make_unique<Board>(config);
  EXPECT_THROW((void)port.read(0), OutputError);
  EXPECT_THROW(board->close_logs(), OutputError);
}

// A board that ends early leaves no half of a log, and an older one as it was.
TEST_F(BoardTest, LogsAreWholeOrAbsent) {
  bring_up();
  std::ofstream(folder / "old.log") << "old";
  for (const char *name : {"bus.log", "old.log"}) {
    board->command("log " + std::string(name));
    send(0x123, 0x11223344);
    (void)board->run_until(board->now() + kMs);
    EXPECT_FALSE(std::filesystem::exists(folder / "bus.log")) << name;
    board = std::make_unique<Board>(config);
    bring_up();
  }
  board.reset();
  EXPECT_EQ(read_text_file(folder / "old.log"), "old");
  const std::filesystem::directory_iterator files{folder.path()};
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST_F(BoardTest, AccessesAreLogged) {
  (void)port.read(0x1000);
  port.write(0x1004, 0x00010000);
  EXPECT_FALSE(std::filesystem::exists(folder / "access-1.txt"));
  board->close_logs();
  const std::string log = read_text_file(folder / "access-1.txt");
  EXPECT_THAT(log, HasSubstr(" R 000 d890000f 0\n"));
  EXPECT_THAT(log, HasSubstr(" W 004 00010000 0\n"));
}

TEST_F(BoardTest, FaultsReachTheNodes) {
  bring_up();
  board->command("strike can0 DATA 3 flip 2");
  send(0x123, 0x11223344);
  EXPECT_EQ(port.read(reg::kEcr) & 0xFF, 15U) << "twice 8, and 1 back (FC-03, FC-07)";
  EXPECT_THAT(board->command("report"), HasSubstr("bus frames=1 unacked=0 errors=2"));

  port.write(reg::kImask2, 0);  // no interrupt ends the wait
  port.write(0x1000 + reg::kImask1, 0);
  board->command("hold recessive");
  test::send_frame(port, 0, 0x124, 0);
  (void)board->run_until(board->now() + 20 * kMs);
  EXPECT_THAT(board->command("report"), HasSubstr("busoff=1"));
}

TEST_F(BoardTest, ACutNodeIsHeardByNobody) {
  bring_up();
  board->command("cut can1 on");
  test::send_frame(port, 0, 0x123, 0);
  (void)board->run_until(board->now() + 20 * kMs);
  EXPECT_EQ(port.read(reg::kEcr) & 0xFF, 128U) << "nobody acknowledges";
  board->command("cut can1 off");
  (void)board->run_until(board->now() + kMs);
  EXPECT_EQ(port.read(reg::kIflag2), 1U << 31);
}

TEST_F(BoardTest, APeerSendsNumberedFrames) {
  bring_up();
  board->command("peer start");
  EXPECT_EQ(board->command("peer pending"), "0\n");
  board->command("log bus.log");
  board->command("peer send 3 5A5#0009AA");
  EXPECT_EQ(board->command("peer pending"), "1\n");
  for (int i = 0; i < 10; ++i) {
    (void)board->levels();
    (void)board->run_until(board->now() + kMs);
  }
  EXPECT_EQ(board->command("peer pending"), "0\n");
  board->command("log off");
  const CanLog log = read_log(folder / "bus.log");
  ASSERT_EQ(log.entries.size(), 3U);
  EXPECT_EQ(log.entries[2].frame.data[1], 11);
  EXPECT_EQ(log.entries[2].frame.data[2], 0xAA);
}

TEST_F(BoardTest, SabotageLies) {
  bring_up();
  board->command("sabotage lose-frame");
  send(0x123, 0x11223344);
  EXPECT_EQ(read1(reg::kIflag1), 0U) << "the frame is gone";
  port.write(reg::kIflag2, 1u << 31);
  send(0x124, 0x11223344);
  EXPECT_EQ(read1(reg::kIflag1), 2U) << "only one";
  board->command("sabotage corrupt-data");
  EXPECT_EQ(read1(reg::mb(1, 2)), 0x10223344U);
  EXPECT_EQ(read1(reg::mb(1, 2)), 0x11223344U);
  EXPECT_NE(board->levels(), 0U);
  board->command("sabotage deaf");
  EXPECT_EQ(board->levels(), 0U);
  board->command("sabotage off");
  EXPECT_NE(board->levels(), 0U);
  board->command("strike can0 DATA 3 flip 1");
  port.write(reg::kIflag2, 1u << 31);
  send(0x125, 0);
  EXPECT_NE(port.read(reg::kEcr), 0U);
  board->command("sabotage frozen-errors");
  EXPECT_EQ(port.read(reg::kEcr), 0U);
}

TEST_F(BoardTest, BadCommandsSayWhatIsAllowed) {
  const auto complaint = [&](const std::string &line) -> std::string {
    try {
      board->command(line);
    } catch (const InputError &error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint(""), HasSubstr("empty"));
  EXPECT_THAT(complaint("fly"), HasSubstr("'fly' is none of bitrate, log"));
  EXPECT_THAT(complaint("bitrate"), HasSubstr("'bitrate' needs a bit rate"));
  EXPECT_THAT(complaint("bitrate 9"), HasSubstr("10000 to 1000000, got '9'"));
  EXPECT_THAT(complaint("log ../x"), HasSubstr("directory of logs"));
  EXPECT_THAT(complaint("hold flip"), HasSubstr("dominant, recessive or off"));
  EXPECT_THAT(complaint("cut can7 on"), HasSubstr("no node is called 'can7'"));
  EXPECT_THAT(complaint("cut can1 maybe"), HasSubstr("on or off"));
  EXPECT_THAT(complaint("strike can0 NOSE 1 flip 1"), HasSubstr("no field"));
  EXPECT_THAT(complaint("strike can0 DATA 64 flip 1"), HasSubstr("0 to 63"));
  EXPECT_THAT(complaint("peer send 1 123#"), HasSubstr("has not been started"));
  EXPECT_THAT(complaint("sabotage me"), HasSubstr("lose-frame"));
  EXPECT_EQ(board->command("bitrate 125000\n"), "ok\n") << "a line end is no part of a command";
}

TEST(Board, SettingsOutOfRangeAreRefused) {
  const auto with = [](unsigned controllers, double clock_hz) {
    BoardConfig config;
    config.controllers = controllers;
    config.clock_hz = clock_hz;
    return config;
  };
  EXPECT_THROW(Board{with(0, 8e6)}, std::invalid_argument);
  EXPECT_THROW(Board{with(9, 8e6)}, std::invalid_argument);
  EXPECT_THROW(Board{with(2, 1.0)}, std::invalid_argument);
  BoardConfig nowhere = with(2, 8e6);
  nowhere.directory = "/nowhere/at/all";
  nowhere.access_logs = true;
  EXPECT_THROW(Board{nowhere}, OutputError);
  BoardConfig two_kinds = with(2, 8e6);
  two_kinds.lean = two_kinds.time_unit = true;
  EXPECT_THROW(Board{two_kinds}, std::invalid_argument);
}

}  // namespace
}  // namespace vericansim
