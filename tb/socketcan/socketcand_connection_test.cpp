// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// One connection: messages that the socket takes in parts, a peer that is gone.
#include "bridge/socketcand_connection.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <random>

namespace vericansim {
namespace {

class SocketcandConnections : public testing::Test {
 protected:
  SocketcandConnections() {
    int fds[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0, fds) != 0)
      std::abort();
    peer_ = fds[1];
    connection_ = std::make_unique<SocketcandConnection>(fds[0]);
  }
  ~SocketcandConnections() override {
    if (peer_ >= 0) ::close(peer_);
  }

  std::string read_peer() const {
    char bytes[3000];
    const ssize_t count = ::recv(peer_, bytes, sizeof bytes, 0);
    return {bytes, count < 0 ? 0 : static_cast<std::size_t>(count)};
  }

  std::unique_ptr<SocketcandConnection> connection_;
  int peer_ = -1;
};

TEST_F(SocketcandConnections, WhatTheSocketTakesInPartsArrivesWhole) {
  std::mt19937 random(1);
  std::string all;
  // Longer than any socket buffer, and short ones behind it.
  for (const std::size_t size : {3'000'000U, 5U, 100'000U, 4096U, 1U}) {
    std::string message(size, ' ');
    for (char &c : message) c = static_cast<char>('a' + random() % 26);
    all += message;
    connection_->put(message);
  }
  EXPECT_EQ(connection_->queued(), all.size());
  connection_->flush();
  EXPECT_GT(connection_->queued(), 0U);
  std::string got;
  while (got.size() < all.size()) {
    const std::string piece = read_peer();
    got += piece;
    connection_->flush();
    ASSERT_FALSE(piece.empty() && connection_->queued() == 0) << got.size();
  }
  EXPECT_EQ(got, all);
  EXPECT_EQ(connection_->queued(), 0U);
  EXPECT_EQ(connection_->messages_queued(), 0U);
  EXPECT_FALSE(connection_->wants_to_write());
}

TEST_F(SocketcandConnections, APeerThatIsGoneIsAStateAndNoSignal) {
  ::close(peer_);
  peer_ = -1;
  connection_->put("< hi >");
  connection_->flush();
  EXPECT_FALSE(connection_->output_open());
  EXPECT_EQ(connection_->messages_queued(), 1U);
  EXPECT_FALSE(connection_->wants_to_write());
  EXPECT_EQ(connection_->read(10), "");
  EXPECT_FALSE(connection_->input_open());
}

TEST_F(SocketcandConnections, WhatWasSentBeforeTheEndIsRead) {
  ASSERT_EQ(::send(peer_, "abcdef", 6, 0), 6);
  ::close(peer_);
  peer_ = -1;
  EXPECT_EQ(connection_->read(4), "abcd");
  EXPECT_TRUE(connection_->input_open());
  EXPECT_EQ(connection_->read(4), "ef");
  EXPECT_EQ(connection_->read(4), "");
  EXPECT_FALSE(connection_->input_open());
}

}  // namespace
}  // namespace vericansim
