// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client's SocketCAN back end on a pair of sockets that carry struct can_frame (RN-90,
// RN-91). On a real kernel's CAN: tb/socketcan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>
#include <vector>

#include "verican_remote_socketcan.h"

namespace vericansim {
namespace {

class ClientSocketCan : public ::testing::Test {
 protected:
  ClientSocketCan() {
    int ends[2];
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
    verican_remote_socketcan_attach(&socket, ends[0]);
    other = ends[1];
    port = verican_remote_socketcan_port(&socket);
    EXPECT_EQ(verican_remote_init(&client, &port, 3), VERICAN_REMOTE_OK);
  }
  ~ClientSocketCan() override {
    verican_remote_socketcan_close(&socket);
    if (other >= 0) ::close(other);
  }

  void say(canid_t id, std::initializer_list<unsigned> bytes) const {
    can_frame frame{};
    frame.can_id = id;
    frame.can_dlc = static_cast<std::uint8_t>(bytes.size());
    unsigned i = 0;
    for (const unsigned byte : bytes) frame.data[i++] = static_cast<std::uint8_t>(byte);
    ASSERT_EQ(::write(other, &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
  }
  [[nodiscard]] can_frame heard() const {
    can_frame frame{};
    EXPECT_EQ(::read(other, &frame, sizeof frame), static_cast<ssize_t>(sizeof frame));
    return frame;
  }

  verican_remote_socketcan_t socket{};
  verican_remote_port_t port{};
  verican_remote_t client{};
  int other = -1;
};

TEST_F(ClientSocketCan, FramesLeaveAsTheyAre) {
  const std::uint8_t bytes[] = {1, 2, 3};
  EXPECT_EQ(verican_remote_write(&client, 3, 0x20, bytes, 3), VERICAN_REMOTE_OK);
  const can_frame data = heard();
  EXPECT_EQ(data.can_id, 0x1A0U);
  EXPECT_EQ(data.can_dlc, 3);
  EXPECT_EQ(std::memcmp(data.data, bytes, 3), 0);
  client.timeout_us = 1000;
  client.tries = 1;
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0x21, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  const can_frame remote = heard();
  EXPECT_EQ(remote.can_id, 0x1A1U | CAN_RTR_FLAG);
  EXPECT_EQ(remote.can_dlc, 1);
}

TEST_F(ClientSocketCan, TheAnswerIsFoundAmongOthers) {
  std::thread node{[this] {
    (void)heard();
    say(0x5A0U | CAN_EFF_FLAG, {1});
    say(0x5A0U | CAN_RTR_FLAG, {0});
    say(CAN_ERR_FLAG | CAN_ERR_CRTL, {0, 0, 0, 0, 0, 0, 0, 0});
    say(0x5A1U, {2});
    say(0x5A0U, {3});
  }};
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_OK);
  EXPECT_EQ(byte, 3);
  node.join();
}

/// A program's timer: SIGALRM each 5 ms. `node`: where the handler answers a read of node 3,
/// address 20, from the fourth signal on; -1: nowhere.
class Alarm {
 public:
  explicit Alarm(int node) {
    to = node;
    signals = 0;
    struct sigaction action {};
    action.sa_handler = handle;
    action.sa_flags = SA_RESTART;
    EXPECT_EQ(::sigaction(SIGALRM, &action, &before_), 0);
    const itimerval each = {{0, 5000}, {0, 5000}};
    EXPECT_EQ(::setitimer(ITIMER_REAL, &each, nullptr), 0);
  }
  Alarm(const Alarm &) = delete;
  Alarm &operator=(const Alarm &) = delete;
  ~Alarm() {
    const itimerval never{};
    ::setitimer(ITIMER_REAL, &never, nullptr);
    ::sigaction(SIGALRM, &before_, nullptr);
  }

 private:
  static void handle(int) {
    const int error = errno;
    can_frame answer{};
    answer.can_id = 0x5A0;
    answer.can_dlc = 1;
    answer.data[0] = 7;
    signals = signals + 1;
    if (to >= 0 && signals >= 4) (void)::send(to, &answer, sizeof answer, MSG_DONTWAIT);
    errno = error;
  }
  static inline volatile std::sig_atomic_t to, signals;
  struct sigaction before_ {};
};

TEST_F(ClientSocketCan, SignalsDoNotShortenTheTimeOut) {
  client.timeout_us = 50'000;
  std::uint8_t byte = 0;
  const Alarm alarm{-1};
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds{150});
}

TEST_F(ClientSocketCan, AnAnswerAfterSignalsIsHeard) {
  client.timeout_us = 10'000'000;
  std::uint8_t byte = 0;
  const Alarm alarm{other};
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_OK);
  EXPECT_EQ(byte, 7);
}

// RN-91: no frame leaves; the socket itself would wait until somebody makes room.
TEST_F(ClientSocketCan, AFrameThatFindsNoRoom) {
  using std::chrono::seconds, std::chrono::steady_clock;
  while (::send(socket.fd, "full", 4, MSG_DONTWAIT) > 0) {
  }
  std::atomic<bool> stop = false;
  const auto start = steady_clock::now();
  std::thread late{[&] {
    while (!stop && steady_clock::now() - start < seconds{10}) ::usleep(1000);
    char text[4];
    while (::recv(other, text, sizeof text, MSG_DONTWAIT) > 0) {
    }
  }};
  const std::uint8_t byte = 1;
  EXPECT_EQ(verican_remote_write(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_GE(steady_clock::now() - start, seconds{1});
  stop = true;
  late.join();
}

// A bus that is full of frames of others holds nobody up, also where nothing is waited for: here a
// file of them, which ends long after the time-out.
TEST_F(ClientSocketCan, ABusFullOfExtendedFrames) {
  can_frame extended{};
  extended.can_id = CAN_EFF_FLAG | 1U;
  const std::vector<can_frame> frames(200'000, extended);
  const auto bytes = static_cast<ssize_t>(frames.size() * sizeof extended);
  verican_remote_socketcan_close(&socket);
  verican_remote_socketcan_attach(&socket, ::memfd_create("bus", 0));
  ASSERT_EQ(::write(socket.fd, frames.data(), static_cast<std::size_t>(bytes)), bytes);
  ASSERT_EQ(::lseek(socket.fd, 0, SEEK_SET), 0);
  for (const std::uint32_t timeout_us : {0U, 50'000U}) {
    verican_remote_frame_t frame;
    EXPECT_EQ(port.receive(port.context, &frame, timeout_us), VERICAN_REMOTE_TIMEOUT);
  }
}

TEST_F(ClientSocketCan, BusOffIsToldByTheKernel) {
  say(CAN_ERR_FLAG | CAN_ERR_BUSOFF, {0, 0, 0, 0, 0, 0, 0, 0});
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_BUS_OFF);
}

TEST_F(ClientSocketCan, AnInterfaceThatGoesAway) {
  ::close(other);
  other = -1;
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_BUS_OFF);
}

TEST_F(ClientSocketCan, AnInterfaceThatIsNotThere) {
  verican_remote_socketcan_t none;
  EXPECT_NE(verican_remote_socketcan_open(&none, "nocan"), 0);
  EXPECT_EQ(verican_remote_socketcan_open(&none, "a name that no interface has"), ENODEV);
}

// Whoever cleans up behind an interface that does not open closes nothing: descriptor 0 is that of
// a socket of zeros.
TEST(SocketCanOpen, NothingIsOpenBehindAFailure) {
  const char *const missing = nullptr;  // as getenv() may give it
  for (const char *name : {"nosuchcan0", "a name that is longer than any", missing}) {
    verican_remote_socketcan_t socket{};
    EXPECT_NE(verican_remote_socketcan_open(&socket, name), 0);
    EXPECT_EQ(socket.fd, -1) << (name != nullptr ? name : "none");
  }
}

}  // namespace
}  // namespace vericansim
