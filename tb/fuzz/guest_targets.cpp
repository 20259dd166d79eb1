// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets: what a guest kernel says: its test scripts' commands, and messages on its sockets.
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "fuzz/target.hpp"
#include "linux/board.hpp"
#include "linux/guest_server.hpp"
#include "trace/input_error.hpp"
#include "trace/text.hpp"

namespace vericansim::fuzz {
namespace {

/// A directory for sockets, removed when the program ends.
class Directory {
 public:
  Directory() {
    std::string name = std::filesystem::temp_directory_path() / "verican-fuzz-XXXXXX";
    require(::mkdtemp(name.data()) != nullptr, "a directory for sockets");
    path_ = name;
  }
  ~Directory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Directory(const Directory &) = delete;
  Directory &operator=(const Directory &) = delete;
  [[nodiscard]] const std::string &path() const { return path_; }

 private:
  std::string path_;
};

/// The guest's end of a socket, with what it says.
class Speaker {
 public:
  void say(const void *data, std::size_t size) {
    const auto *bytes = static_cast<const char *>(data);
    words_.append(bytes, size);
  }
  /// Connects, says everything and says that nothing more will come.
  void speak(const std::string &path) {
    fd_ = Descriptor{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    require(::connect(fd_.get(), reinterpret_cast<sockaddr *>(&address), sizeof address) == 0,
            "the server listens");
    if (!words_.empty()) ::send(fd_.get(), words_.data(), words_.size(), MSG_NOSIGNAL);
    ::shutdown(fd_.get(), SHUT_WR);
  }

 private:
  std::string words_;
  Descriptor fd_;
};

}  // namespace

void fuzz_board(Bytes input) {
  Board board{{}};
  text::for_each_line(text_of(input), "input", [&](std::string_view line, const text::Place &) {
    try {
      require(!board.command(std::string{line}).empty(), "an answer");
    } catch (const InputError &) {
    }
  });
}

// 't': a time message; 'r': a request; 'c': a command, its length before it; 'i': an answer to an
// interrupt; other bytes go to the socket of the registers as they are. The guest asks for the time
// between requests, as guests do.
void fuzz_guest(Bytes bytes) {
  static const Directory directory;
  Speaker time, registers, interrupts;
  Reader input{bytes};
  const TimeMessage get{static_cast<std::uint32_t>(TimeOp::kGet), 0, 0};
  time.say(&get, sizeof get);
  while (!input.empty()) {
    const std::uint8_t kind = input.byte();
    if (kind == 't') {
      const TimeMessage message{input.byte(), 0, input.number(8)};
      time.say(&message, sizeof message);
      continue;
    }
    time.say(&get, sizeof get);
    if (kind == 'r') {
      const GuestRequest request{input.byte(), static_cast<std::uint32_t>(input.number(4)),
                                 static_cast<std::uint32_t>(input.number(4)), input.byte()};
      registers.say(&request, sizeof request);
    } else if (kind == 'c') {
      const auto size = static_cast<std::uint32_t>(input.number(2));
      const Bytes text = input.take(size);
      const GuestRequest request{2, 0, 0, size};
      registers.say(&request, sizeof request);
      registers.say(text.data(), text.size());
    } else if (kind == 'i') {
      const Bytes text = input.take(4);
      interrupts.say(text.data(), text.size());
    } else {
      registers.say(&kind, 1);
    }
  }
  Board board{{}};
  GuestServer server{board, directory.path()};
  time.speak(directory.path() + "/time");
  registers.speak(directory.path() + "/registers");
  interrupts.speak(directory.path() + "/interrupts");
  try {
    server.serve([] { return true; });
  } catch (const InputError &) {
  }
}

}  // namespace vericansim::fuzz
