// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandConnection: one TCP connection; bytes in, whole messages out, nothing blocks.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>

namespace vericansim {

/// Owns the descriptor. The peer may vanish at any time: nothing here throws or signals for that.
class SocketcandConnection {
 public:
  /// `fd`: a connected socket, non-blocking.
  explicit SocketcandConnection(int fd);
  ~SocketcandConnection();
  SocketcandConnection(const SocketcandConnection &) = delete;
  SocketcandConnection &operator=(const SocketcandConnection &) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  /// Reads at most `most` bytes of what has arrived.
  [[nodiscard]] std::string read(std::size_t most);
  /// False when the peer has ended its side or is gone.
  [[nodiscard]] bool input_open() const { return input_open_; }
  /// False when the peer is gone: what is put then is thrown away.
  [[nodiscard]] bool output_open() const { return output_open_; }

  /// Appends a message; flush() sends it.
  void put(std::string message);
  /// Sends what the peer's window allows, in pieces that end with a whole message.
  void flush();
  /// What comes after the messages so far is kept back for `time` (host time).
  void pause(std::chrono::milliseconds time);
  /// When the pause ends, if something waits for that.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> pause_end() const;
  /// Bytes that are not sent.
  [[nodiscard]] std::size_t queued() const { return queued_; }
  /// Messages that are not, or not wholly, sent.
  [[nodiscard]] std::size_t messages_queued() const;
  /// Something could be sent if the peer's window were open.
  [[nodiscard]] bool wants_to_write() const;
  /// No more output after what is queued has gone.
  void shut_down();

 private:
  /// A piece. Small, so that a socket that polls writable takes it whole: python-can up to 4.3
  /// loses bytes where a message arrives in three parts.
  static constexpr std::size_t kPiece = 4096;

  [[nodiscard]] bool writable() const;
  void next_piece();

  int fd_;
  bool input_open_ = true;
  bool output_open_ = true;
  std::deque<std::string> messages_;
  std::string piece_;
  std::size_t piece_messages_ = 0;
  std::size_t piece_sent_ = 0;
  std::size_t queued_ = 0;
  std::size_t before_pause_ = 0;  ///< messages of the queue that may go although paused_
  bool paused_ = false;
  std::chrono::steady_clock::time_point pause_end_{};
};

}  // namespace vericansim
