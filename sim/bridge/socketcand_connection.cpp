// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Plain non-blocking sockets; a vanished peer is a state, not an error.
#include "socketcand_connection.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace vericansim {

SocketcandConnection::SocketcandConnection(int fd) : fd_{fd} {
  const int on = 1;
  ::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  // A host that has vanished without a word is noticed by the kernel in the end.
  ::setsockopt(fd_, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
}

SocketcandConnection::~SocketcandConnection() { ::close(fd_); }

std::string SocketcandConnection::read(std::size_t most) {
  std::string bytes(most, '\0');
  const ssize_t count = ::recv(fd_, bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count > 0) {
    // A client that leaves Nagle's algorithm on (python-can does) holds its next frame back until
    // this one is acknowledged; without this that takes 40 ms. The kernel forgets it with time.
    const int on = 1;
    ::setsockopt(fd_, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
    bytes.resize(static_cast<std::size_t>(count));
    return bytes;
  }
  const bool later = count < 0 && (errno == EAGAIN || errno == EINTR);
  if (!later) input_open_ = false;
  if (count < 0 && !later) output_open_ = false;
  return {};
}

void SocketcandConnection::put(std::string message) {
  if (!output_open_) return;
  queued_ += message.size();
  messages_.push_back(std::move(message));
}

void SocketcandConnection::pause(std::chrono::milliseconds time) {
  paused_ = time.count() > 0;
  before_pause_ = messages_.size();
  pause_end_ = std::chrono::steady_clock::now() + time;
}

std::optional<std::chrono::steady_clock::time_point> SocketcandConnection::pause_end() const {
  if (!paused_ || !output_open_ || queued_ == 0) return std::nullopt;
  return pause_end_;
}

std::size_t SocketcandConnection::messages_queued() const {
  return messages_.size() + piece_messages_;
}

bool SocketcandConnection::wants_to_write() const {
  const bool may_go = !paused_ || before_pause_ > 0 || !piece_.empty();
  return output_open_ && queued_ > 0 && may_go;
}

bool SocketcandConnection::writable() const {
  pollfd poll{.fd = fd_, .events = POLLOUT, .revents = 0};
  return ::poll(&poll, 1, 0) == 1;
}

void SocketcandConnection::next_piece() {
  piece_.clear();
  piece_messages_ = 0;
  piece_sent_ = 0;
  while (!messages_.empty() && (!paused_ || before_pause_ > 0) &&
         (piece_.empty() || piece_.size() + messages_.front().size() <= kPiece)) {
    piece_ += messages_.front();
    messages_.pop_front();
    ++piece_messages_;
    if (paused_) --before_pause_;
  }
}

void SocketcandConnection::flush() {
  if (paused_ && std::chrono::steady_clock::now() >= pause_end_) paused_ = false;
  while (wants_to_write()) {
    if (piece_.empty()) next_piece();
    if (!writable()) return;
    const ssize_t count = ::send(fd_, piece_.data() + piece_sent_, piece_.size() - piece_sent_,
                                 MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0) {
      if (errno != EAGAIN && errno != EINTR) output_open_ = false;
      return;
    }
    piece_sent_ += static_cast<std::size_t>(count);
    queued_ -= static_cast<std::size_t>(count);
    if (piece_sent_ < piece_.size()) return;
    piece_.clear();
    piece_messages_ = 0;
  }
}

void SocketcandConnection::shut_down() { ::shutdown(fd_, SHUT_WR); }

}  // namespace vericansim
