// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets: what TCP clients of the bridge send, and frames in SocketCAN's form.
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "bridge/frame_form.hpp"
#include "bridge/socketcand_client.hpp"
#include "bridge/socketcand_splitter.hpp"
#include "bridge/socketcand_words.hpp"
#include "fuzz/target.hpp"
#include "trace/input_error.hpp"

namespace vericansim::fuzz {
namespace {

struct Split {
  std::vector<std::pair<bool, std::string>> items;
  void drain(CommandSplitter &splitter) {
    while (const auto item = splitter.next()) items.emplace_back(item->good, item->text);
  }
};

/// A frame as the kernel hands it to a raw socket.
bool canonical(const can_frame &frame) {
  return (frame.can_id & CAN_ERR_FLAG) == 0 && frame.len <= CAN_MAX_DLEN &&
         ((frame.can_id & CAN_EFF_FLAG) != 0 || (frame.can_id & CAN_EFF_MASK) <= CAN_SFF_MASK);
}

/// The command that sends a frame, for frames that one can.
void require_same_by_command(const can_frame &frame) {
  const bool extended = (frame.can_id & CAN_EFF_FLAG) != 0;
  std::string command =
      extended ? fmt::format("send {:08X} {:x}", frame.can_id & CAN_EFF_MASK, frame.len)
               : fmt::format("send {:03x} {:x}", frame.can_id, frame.len);
  for (unsigned i = 0; i < frame.len; ++i) command += fmt::format(" {:x}", frame.data[i]);
  CommandWords words{command};
  const can_frame again = send_frame(words);
  require(again.can_id == frame.can_id && again.len == frame.len &&
              std::memcmp(again.data, frame.data, frame.len) == 0,
          "the frame of the command");
}

/// What a client has been sent: messages in brackets, nothing between them but blanks.
void require_messages(const std::string &text) {
  bool inside = false;
  for (const char c : text) {
    require(inside || c == '<' || c == '\n' || c == ' ', "nothing between messages");
    require(c != '<' || !inside, "messages end before others begin");
    if (c == '<') inside = true;
    if (c == '>') inside = false;
  }
  require(!inside, "messages are complete");
}

/// A client on one end of a socket pair; the other end is that of its program.
class Session {
 public:
  Session() {
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends_.data()) == 0, "a socket");
    shared_.buses = {"can0", "can1"};
    shared_.traffic.resize(shared_.buses.size());
    shared_.limits.raw_pause = std::chrono::milliseconds{0};
    client_.emplace(1, ends_[0], shared_);
  }
  ~Session() {
    client_.reset();
    ::close(ends_[1]);
  }
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  void send(std::string_view bytes) {
    if (!bytes.empty()) ::send(ends_[1], bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  void work() {
    if (client_->events() != 0) client_->read();
    client_->work();
    receive();
  }
  void take() {
    if (const auto frame = client_->take()) require(canonical(*frame), "a frame of the bus");
    receive();
  }
  void pass(Time time) {
    shared_.now += time;
    client_->work();
    receive();
  }
  void deliver(const PortMessage &message) {
    if (client_->bus() && client_->receiving()) client_->deliver(message);
  }
  [[nodiscard]] Time now() const { return shared_.now; }
  void end() {
    ::shutdown(ends_[1], SHUT_WR);
    work();
    static_cast<void>(client_->remaining());
    for (int i = 0; i < 4 && !client_->done(); ++i) {
      take();
      work();
    }
    receive();
    require_messages(received_);
    client_->account();
  }

 private:
  void receive() {
    std::array<char, 4096> buffer;
    for (ssize_t got = 0; (got = ::recv(ends_[1], buffer.data(), buffer.size(), 0)) > 0;)
      received_.append(buffer.data(), static_cast<std::size_t>(got));
  }

  std::array<int, 2> ends_{};
  SocketcandShared shared_;
  std::optional<SocketcandClient> client_;
  std::string received_;
};

PortMessage take_message(Reader &input, Time now) {
  PortMessage message;
  message.frame.can_id = static_cast<canid_t>(input.number(4));
  message.frame.len = input.byte() % 9;
  for (unsigned i = 0; i < message.frame.len; ++i) message.frame.data[i] = input.byte();
  message.time = now;
  message.client = input.byte() % 3;
  message.echo = message.client != PortMessage::kNobody;
  return message;
}

}  // namespace

// What comes out does not depend on how the bytes were cut: the first byte is the size of a piece.
void fuzz_splitter(Bytes bytes) {
  Reader input{bytes};
  const std::size_t piece = std::size_t{1} + input.byte() % 32;
  const std::string_view text = text_of(input.take(bytes.size()));
  CommandSplitter whole, pieces;
  Split one, many;
  whole.feed(text);
  whole.finish();
  one.drain(whole);
  for (std::size_t at = 0; at < text.size(); at += piece) {
    pieces.feed(text.substr(at, piece));
    many.drain(pieces);
    require(pieces.waiting() == 0, "all that has come is looked at");
  }
  pieces.finish();
  many.drain(pieces);
  require(one.items == many.items, "the same commands however they were cut");
  for (const auto &[good, command] : one.items)
    require(!good || (command.size() <= CommandSplitter::kLongest &&
                      command.find_first_of("<>\n") == std::string::npos),
            "a command without brackets");
}

void fuzz_words(Bytes input) {
  const std::string command{text_of(input)};
  CommandWords words{command};
  try {
    if (words.name() == "send") {
      const can_frame frame = send_frame(words);
      require(canonical(frame), "a frame of the bus");
      if ((frame.can_id & CAN_RTR_FLAG) == 0) require_same_by_command(frame);
      for (const char *const separator : {"", " "})
        require(message_text({.frame = frame}, separator).ends_with(" >"), "a message in brackets");
    } else if (words.name() == "sendrtr") {
      require(canonical(remote_frame(words)), "a frame of the bus");
    } else if (words.name() == "interval") {
      require(words.interval() >= 0, "an interval");
      words.end();
    } else {
      static_cast<void>(words.decimal("number", 1000));
      static_cast<void>(words.hex("number", 0xFFFF));
      static_cast<void>(words.id());
      words.end();
    }
  } catch (const CommandError &error) {
    const std::string told = error_text(error.what());
    require(std::count(told.begin(), told.end(), '<') == 1, "one message");
  }
}

// Text is sent; bytes below 8 are what happens meanwhile.
void fuzz_client(Bytes bytes) {
  Session session;
  std::string text;
  Reader input{bytes};
  while (!input.empty()) {
    const std::uint8_t byte = input.byte();
    if (byte >= 8) {
      text += static_cast<char>(byte);
      continue;
    }
    session.send(text);
    text.clear();
    switch (byte) {
      case 0: session.work(); break;
      case 1: session.take(); break;
      case 2: session.deliver(take_message(input, session.now())); break;
      case 3: session.pass(kMillisecond); break;
      case 4: session.pass(20 * kSecond); break;
      default:
        session.work();
        session.take();
        break;
    }
  }
  session.send(text);
  session.end();
}

void fuzz_can_frame(Bytes bytes) {
  can_frame frame{};
  std::memcpy(&frame, bytes.data(), std::min(bytes.size(), sizeof frame));
  const auto on_bus = from_can_frame(frame);
  require(on_bus.has_value() == canonical(frame), "frames of classical CAN and no others");
  if (!on_bus) return;
  require_valid(*on_bus);
  const can_frame back = to_can_frame(*on_bus);
  require(back.can_id == frame.can_id && back.len == frame.len, "the same frame back");
  require((frame.can_id & CAN_RTR_FLAG) != 0 || std::memcmp(back.data, frame.data, back.len) == 0,
          "the same data back");
  require(from_can_frame(back) == on_bus, "the same frame again");
}

}  // namespace vericansim::fuzz
