// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GuestServer against a guest that is made of sockets: the same messages as those of a kernel with
// the glue module.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include "harness/scratch_folder.hpp"
#include "linux/board_rig.hpp"
#include "linux/guest_server.hpp"

namespace vericansim {
namespace {

using ::testing::StartsWith;

constexpr std::uint64_t kMs = 1'000'000;

/// A client socket that gives up after some seconds.
Channel connect_to(const std::string &path) {
  Descriptor fd{::socket(AF_UNIX, SOCK_STREAM, 0)};
  const timeval limit{20, 0};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  EXPECT_EQ(::connect(fd.get(), reinterpret_cast<const sockaddr *>(&address), sizeof address), 0);
  return Channel{std::move(fd)};
}

class GuestServerTest : public ::testing::Test {
 protected:
  GuestServerTest() {
    server = std::make_unique<GuestServer>(board, folder.path());
    thread = std::thread{[this] {
      try {
        server->serve([this] { return enough.load(); });
      } catch (const std::exception &error) {
        complaint = error.what();
      }
      ended = true;
    }};
    time = connect_to(folder / "time");
    registers = connect_to(folder / "registers");
    interrupts = connect_to(folder / "interrupts");
    port = {[this](std::uint32_t address) { return access(GuestOp::kRead, address, 0).value; },
            [this](std::uint32_t address, std::uint32_t value) {
              (void)access(GuestOp::kWrite, address, value);
            }};
  }
  ~GuestServerTest() override {
    leave();
    server.reset();
  }
  // The guest ends, and with it the server.
  void leave() {
    time = Channel{};
    registers = Channel{};
    interrupts = Channel{};
    if (thread.joinable()) thread.join();
  }

  std::uint64_t say(TimeOp op, std::uint64_t value = 0) {
    time.send(TimeMessage{static_cast<std::uint32_t>(op), ++seq, value});
    TimeMessage ack{};
    EXPECT_TRUE(time.read(ack));
    EXPECT_EQ(ack.op, static_cast<std::uint32_t>(TimeOp::kAck));
    EXPECT_EQ(ack.seq, seq);
    return ack.time;
  }
  // Says so without an end; true if the server has given up within 10 s.
  bool insist(TimeOp op) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds{10};
    while (!ended && Clock::now() < end) {
      time.send(TimeMessage{static_cast<std::uint32_t>(op), ++seq, 0});
      pollfd answered{time.get(), POLLIN, 0};
      TimeMessage ack{};
      while (!ended && ::poll(&answered, 1, 10) == 0) {
      }
      if (!ended) EXPECT_TRUE(time.read(ack));
    }
    return ended;
  }
  // Takes the grant that follows a wait.
  std::uint64_t granted() {
    TimeMessage run{};
    EXPECT_TRUE(time.read(run));
    EXPECT_EQ(run.op, static_cast<std::uint32_t>(TimeOp::kRun));
    time.send(TimeMessage{static_cast<std::uint32_t>(TimeOp::kAck), run.seq, 0});
    return run.time;
  }
  std::uint64_t sleep_until(std::uint64_t when) {
    (void)say(TimeOp::kRequest, when);
    (void)say(TimeOp::kWait);
    return granted();
  }
  GuestAnswer access(GuestOp op, std::uint32_t address, std::uint32_t value,
                     std::uint32_t size = 4) {
    registers.send(GuestRequest{static_cast<std::uint32_t>(op), address, value, size});
    GuestAnswer answer{};
    EXPECT_TRUE(registers.read(answer));
    return answer;
  }
  std::string command(const std::string &line) {
    registers.send(GuestRequest{static_cast<std::uint32_t>(GuestOp::kCommand), 0, 0,
                                static_cast<std::uint32_t>(line.size())});
    registers.write(line.data(), line.size());
    GuestAnswer answer{};
    EXPECT_TRUE(registers.read(answer));
    std::string reply(answer.value, '\0');
    EXPECT_TRUE(registers.read(reply.data(), reply.size()));
    return reply;
  }

  Board board{BoardConfig{}};
  const ScratchFolder folder;
  std::unique_ptr<GuestServer> server;
  std::atomic<bool> enough = false, ended = false;
  std::thread thread;
  std::string complaint;
  Channel time;
  Channel registers;
  Channel interrupts;
  test::RegisterPort port;
  std::uint32_t seq = 0;
};

TEST_F(GuestServerTest, AGuestSleepsInSimulatedTime) {
  (void)say(TimeOp::kStart, 7);
  EXPECT_EQ(say(TimeOp::kGet), 0U);
  EXPECT_EQ(sleep_until(5 * kMs), 5 * kMs);
  EXPECT_EQ(say(TimeOp::kGet), 5 * kMs);
  EXPECT_EQ(sleep_until(3'600'000 * kMs), 3'600'000 * kMs) << "an hour, without a clock edge";
  leave();
  EXPECT_EQ(complaint, "");
  EXPECT_EQ(board.now(), 3'600'000 * kMs);
}

TEST_F(GuestServerTest, AccessesAndCommandsAreAnswered) {
  EXPECT_EQ(port.read(0x1000), 0xD890000F);
  EXPECT_EQ(access(GuestOp::kRead, 0x1000, 0, 1).value, 0x0FU);
  port.write(0x0028, 0x12340000);  // IMASK1
  EXPECT_EQ(port.read(0x0028), 0x12340000U);
  EXPECT_EQ(command("bitrate 250000"), "ok\n");
  EXPECT_THAT(command("bitrate x"), StartsWith("error: command: the bit rate must be"));
  EXPECT_THAT(command("report\n"), StartsWith("bus frames=0"));
  leave();
  EXPECT_EQ(server->accesses(), 7U);
}

TEST_F(GuestServerTest, AnInterruptWakesAGuestThatWaits) {
  test::bring_up(port, 0);
  test::bring_up(port, 1);
  EXPECT_EQ(sleep_until(kMs), kMs);
  port.write(0x0024, 0);  // IMASK2: the sender's, which comes at nearly the same time
  test::send_frame(port, 0, 0x123, 0x55555555);
  (void)say(TimeOp::kRequest, 50 * kMs);
  (void)say(TimeOp::kWait);

  // The kernel takes note from a signal handler: it asks the time, wants to run now, and answers.
  std::uint32_t level = 0;
  ASSERT_TRUE(interrupts.read(level));
  EXPECT_NE(level & 2U, 0U) << "the receiver's line";
  const std::uint64_t now = say(TimeOp::kGet);
  EXPECT_GT(now, kMs + 70'000) << "a frame of 4 bytes takes 79 bits and stuff bits";
  EXPECT_LT(now, kMs + 120'000);
  (void)say(TimeOp::kRequest, now);
  interrupts.send(level);
  EXPECT_EQ(granted(), now);
  EXPECT_EQ(port.read(0x1000 + 0x030), 2U) << "IFLAG1 of MB1";
  EXPECT_EQ(say(TimeOp::kGet), now) << "accesses take the guest no time";
  leave();
  EXPECT_EQ(server->interrupts(), 1U);
}

TEST_F(GuestServerTest, AnAnswerTellsTheLines) {
  test::bring_up(port, 0);
  test::bring_up(port, 1);
  EXPECT_EQ(sleep_until(kMs), kMs);
  test::send_frame(port, 0, 0x123, 0);
  GuestAnswer answer{};
  for (int polls = 0; polls < 2000 && answer.level != 3; ++polls)
    answer = access(GuestOp::kRead, 0x0008, 0);
  EXPECT_EQ(answer.level, 3U) << "a guest that polls needs no interrupt";
  leave();
  EXPECT_EQ(server->interrupts(), 0U);
}

TEST_F(GuestServerTest, ASleepForEverIsToldAndEndsTheRun) {
  (void)say(TimeOp::kWait);
  thread.join();
  EXPECT_EQ(complaint, "the guest: sleeps, and nothing will ever wake it");
}

TEST_F(GuestServerTest, AnAccessOfNoSizeEndsTheRun) {
  registers.send(GuestRequest{0, 0, 0, 3});
  thread.join();
  EXPECT_THAT(complaint, StartsWith("the guest: sent an access of 3 bytes, operation 0; allowed:"));
}

// The simulator's time ends after 106 days; found by fuzzing.
TEST_F(GuestServerTest, ASleepBeyondTheSimulatorsTimeEndsTheRun) {
  constexpr std::uint64_t kFar = 1ULL << 62U;
  (void)say(TimeOp::kUpdate, kFar);
  (void)say(TimeOp::kRequest, kFar + kMs);
  (void)say(TimeOp::kWait);
  thread.join();
  EXPECT_THAT(complaint, StartsWith("the guest: wants to sleep until"));
}

TEST_F(GuestServerTest, AGuestThatNeverFallsSilentIsGivenUp) {
  enough = true;
  EXPECT_TRUE(insist(TimeOp::kGet));
}

TEST_F(GuestServerTest, AGuestThatSleepsWhileTheBusRunsIsGivenUp) {
  constexpr std::uint64_t kLong = 60'000 * kMs;  // much longer in real time than the patience
  test::bring_up(port, 0);
  (void)say(TimeOp::kRequest, kLong);
  (void)say(TimeOp::kWait);
  enough = true;
  thread.join();
  EXPECT_LT(board.now(), kLong);
}

TEST(GuestServer, GivesUpWhenTold) {
  const ScratchFolder folder;
  {
    Board board{BoardConfig{}};
    GuestServer server{board, folder.path()};
    int asked = 0;
    server.serve([&] { return ++asked == 2; });
    EXPECT_EQ(asked, 2);
    EXPECT_THROW(GuestServer(board, folder.path() + std::string(120, 'x')), std::invalid_argument);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path())) << "the sockets are removed";
}

}  // namespace
}  // namespace vericansim
