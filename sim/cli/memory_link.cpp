// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_link.hpp. The protocol of socketcand: its doc/protocol.md, rawmode.
#include "cli/memory_link.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>

#include "bridge/raw_port.hpp"
#include "bridge/socketcand_listener.hpp"
#include "bridge/socketcand_splitter.hpp"
#include "trace/input_error.hpp"
#include "trace/text.hpp"
#include "verican_remote_socketcan.h"

namespace vericansim::cli {
namespace {

class InterfaceLink : public MemoryLink {
 public:
  explicit InterfaceLink(const std::string &name) {
    const int error = verican_remote_socketcan_open(&socket_, name.c_str());
    if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT)
      throw InputError("--if", 0, can_socket_problem(error));
    if (error != 0)
      throw InputError("--if", 0,
                       fmt::format("{}: {}; allowed: a CAN interface that is up", in_quotes(name),
                                   std::strerror(error)));
  }
  ~InterfaceLink() override { verican_remote_socketcan_close(&socket_); }
  InterfaceLink(const InterfaceLink &) = delete;
  InterfaceLink &operator=(const InterfaceLink &) = delete;

  verican_remote_port_t port() override { return verican_remote_socketcan_port(&socket_); }
  [[nodiscard]] bool remote_frames() const override { return true; }

 private:
  verican_remote_socketcan_t socket_{};
};

std::uint32_t now_us() {
  using std::chrono::microseconds;
  return static_cast<std::uint32_t>(
      std::chrono::duration_cast<microseconds>(std::chrono::steady_clock::now().time_since_epoch())
          .count());
}

/// A connected socket; -1: nobody is there.
int connect_to(const SocketcandAddress &address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo *found = nullptr;
  if (::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found) !=
      0)
    return -1;
  int fd = -1;
  for (const addrinfo *one = found; one != nullptr && fd < 0; one = one->ai_next) {
    fd = ::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
    if (fd >= 0 && ::connect(fd, one->ai_addr, one->ai_addrlen) != 0) {
      ::close(fd);
      fd = -1;
    }
  }
  ::freeaddrinfo(found);
  return fd;
}

using Words = std::vector<std::string_view>;

/// The DLC of "rtr ID TIME DLC"; not all servers tell it.
bool read_length(const Words &words, verican_remote_frame_t &frame) {
  constexpr unsigned kMost = 8;
  if (words.size() < 4) return true;
  const auto dlc = text::parse_unsigned(words[3], 10);
  if (!dlc || *dlc > 15) return false;
  frame.dlc = static_cast<std::uint8_t>(std::min<std::uint64_t>(*dlc, kMost));
  return true;
}

/// The bytes of "frame ID TIME BYTES".
bool read_bytes(const Words &words, verican_remote_frame_t &frame) {
  std::string digits;
  for (std::size_t i = 3; i < words.size(); ++i) digits += words[i];
  if (digits.size() > 16 || digits.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < digits.size(); i += 2) {
    const auto byte = text::parse_unsigned(std::string_view{digits}.substr(i, 2), 16);
    if (!byte) return false;
    frame.data[frame.dlc++] = static_cast<std::uint8_t>(*byte);
  }
  return true;
}

/// A "frame" or "rtr" message as a frame; false: nothing of a bus of remote nodes.
bool read_frame(const std::string &text, verican_remote_frame_t &frame) {
  const Words words = text::split_blanks(text);
  if (words.size() < 3 || (words[0] != "frame" && words[0] != "rtr") || words[1].size() > 3)
    return false;
  const auto id = text::parse_unsigned(words[1], 16);
  if (!id || *id > 0x7FF) return false;
  frame = {};
  frame.id = static_cast<std::uint16_t>(*id);
  frame.remote = words[0] == "rtr";
  return frame.remote ? read_length(words, frame) : read_bytes(words, frame);
}

/// "error CLASS TIME BYTES", CLASS of eight digits: what the bus shows, while "error" and a text is
/// a complaint of the server.
bool is_error_frame(std::string_view message) {
  const auto words = text::split_blanks(message);
  const bool time = words.size() >= 3 && words[2].find_first_not_of("0123456789.") == words[2].npos;
  return time && words[0] == "error" && words[1].size() == 8 && text::parse_unsigned(words[1], 16);
}

class SocketcandLink : public MemoryLink {
 public:
  SocketcandLink(const std::string &address, const std::string &bus)
      : fd_{connect_to(SocketcandAddress::parse("--socketcand", address))} {
    if (fd_ < 0)
      throw InputError(
          "--socketcand", 0,
          "nobody answers at " + in_quotes(address) + "; allowed: a socketcand server");
    expect("hi", address);
    say("< open " + bus + " >");
    expect("ok", address);
    say("< rawmode >");
    expect("ok", address);
  }
  ~SocketcandLink() override { ::close(fd_); }
  SocketcandLink(const SocketcandLink &) = delete;
  SocketcandLink &operator=(const SocketcandLink &) = delete;

  verican_remote_port_t port() override {
    return {.send =
                [](void *self, const verican_remote_frame_t *frame) {
                  return static_cast<SocketcandLink *>(self)->send(*frame);
                },
            .receive =
                [](void *self, verican_remote_frame_t *frame, std::uint32_t timeout_us) {
                  return static_cast<SocketcandLink *>(self)->receive(*frame, timeout_us);
                },
            .now_us = [](void *) { return now_us(); },
            .context = this};
  }
  // Servers write them as data frames, or not at all.
  [[nodiscard]] bool remote_frames() const override { return false; }
  [[nodiscard]] std::string remarks() const override {
    std::string text = complaint_.empty() ? "" : "; the server says: " + complaint_;
    if (error_frames_ != 0)
      text += fmt::format("; {} error frame{} on the bus", error_frames_,
                          error_frames_ == 1 ? "" : "s");
    return text;
  }

 private:
  verican_remote_result_t send(const verican_remote_frame_t &frame) {
    std::string text = fmt::format("< send {:03X} {} ", frame.id, frame.dlc);
    for (unsigned i = 0; i < frame.dlc; ++i) text += fmt::format("{:02X} ", frame.data[i]);
    return say(text + ">") ? VERICAN_REMOTE_OK : VERICAN_REMOTE_BUS_OFF;
  }

  verican_remote_result_t receive(verican_remote_frame_t &frame, std::uint32_t timeout_us) {
    const std::uint32_t begin = now_us();
    for (;;) {
      const std::uint32_t passed = now_us() - begin;
      const auto text = next(passed < timeout_us ? timeout_us - passed : 0);
      if (gone_) return VERICAN_REMOTE_BUS_OFF;
      if (!text) return VERICAN_REMOTE_TIMEOUT;
      if (read_frame(*text, frame)) return VERICAN_REMOTE_OK;
      note_error(text::trimmed(*text));
      if (now_us() - begin >= verican_remote_skip_us(timeout_us)) return VERICAN_REMOTE_TIMEOUT;
    }
  }

  void note_error(std::string_view message) {
    constexpr std::string_view kError = "error ";
    if (is_error_frame(message))
      ++error_frames_;
    else if (message.starts_with(kError))
      complaint_ = text::trimmed(message.substr(kError.size()));
  }

  bool say(const std::string &text) {
    std::string_view rest = text;
    while (!rest.empty()) {
      const ssize_t n = ::send(fd_, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      rest.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }

  // The next message; nothing: none in time, whatever else comes meanwhile. What is there already
  // is looked at in any case.
  std::optional<std::string> next(std::uint32_t timeout_us) {
    const std::uint32_t begin = now_us();
    for (std::uint32_t passed = 0, looks = 0;; passed = now_us() - begin, ++looks) {
      while (const auto item = splitter_.next())
        if (item->good) return item->text;
      if (looks != 0 && passed >= timeout_us) return std::nullopt;
      pollfd one{fd_, POLLIN, 0};
      const std::uint32_t left = timeout_us - std::min(passed, timeout_us);
      if (::poll(&one, 1, static_cast<int>((left + 999) / 1000)) <= 0) return std::nullopt;
      std::array<char, 4096> buffer{};
      const ssize_t n = ::recv(fd_, buffer.data(), buffer.size(), 0);
      gone_ = n <= 0;
      if (gone_) return std::nullopt;
      splitter_.feed({buffer.data(), static_cast<std::size_t>(n)});
    }
  }

  void expect(const std::string &answer, const std::string &address) {
    constexpr std::uint32_t kPatience = 5'000'000;  // us
    const auto seen = next(kPatience);
    const std::string said{text::trimmed(seen.value_or(""))};
    if (said != answer)
      throw InputError("--socketcand", 0,
                       fmt::format("the server at {} says {}; allowed: socketcand with this bus",
                                   in_quotes(address), seen ? "'" + said + "'" : "nothing"));
  }

  int fd_;
  CommandSplitter splitter_;
  bool gone_ = false;
  std::string complaint_;  // the server's last one
  std::uint64_t error_frames_ = 0;
};

}  // namespace

std::unique_ptr<MemoryLink> open_interface(const std::string &name) {
  return std::make_unique<InterfaceLink>(name);
}

std::unique_ptr<MemoryLink> open_socketcand(const std::string &address, const std::string &bus) {
  return std::make_unique<SocketcandLink>(address, bus);
}

}  // namespace vericansim::cli
