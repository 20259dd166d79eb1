// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandListener: the address of a socketcand server, and the socket that listens there.
#pragma once

#include <cstdint>
#include <string>

namespace vericansim {

/// Where to listen.
struct SocketcandAddress {
  std::string host = "127.0.0.1";  ///< address or name; IPv6 without brackets
  std::uint16_t port = 29536;      ///< 0: any free one
  /// Where it was given, for messages: an option, or the place of a key in a file.
  std::string option = "--socketcand";

  /// "[ADDRESS:]PORT": "29536", "127.0.0.1:0", "[::1]:29536", "localhost:29536". InputError that
  /// names `option` if it is anything else.
  [[nodiscard]] static SocketcandAddress parse(const std::string &option, const std::string &text);
  /// As parse() reads it.
  [[nodiscard]] std::string text() const;
};

/// A listening TCP socket, non-blocking.
class SocketcandListener {
 public:
  /// InputError that names `option` if the address is not known, in use or not permitted.
  SocketcandListener(const std::string &option, const SocketcandAddress &address);
  ~SocketcandListener();
  SocketcandListener(const SocketcandListener &) = delete;
  SocketcandListener &operator=(const SocketcandListener &) = delete;

  [[nodiscard]] int fd() const { return fd_; }
  /// Address and port that clients connect to.
  [[nodiscard]] const SocketcandAddress &address() const { return address_; }
  /// A client's socket, non-blocking; -1 if there is none now.
  [[nodiscard]] int accept() const;

 private:
  SocketcandAddress address_;
  int fd_ = -1;
};

}  // namespace vericansim
