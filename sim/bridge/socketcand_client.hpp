// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SocketcandClient: the protocol with one client. Source: doc/protocol.md of socketcand.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "can_port.hpp"
#include "socketcand_broadcast.hpp"
#include "socketcand_connection.hpp"
#include "socketcand_limits.hpp"
#include "socketcand_splitter.hpp"
#include "socketcand_words.hpp"

namespace vericansim {

/// What the clients of one server share.
struct SocketcandShared {
  std::vector<std::string> buses;
  std::vector<SocketcandTraffic> traffic;  ///< one each bus
  SocketcandLimits limits;
  SocketcandCounts counts;
  Time now = 0;  ///< simulated
};

/// Commands are carried out in their order; one that sends a frame holds up those behind it until
/// the bus has room, and what is not read fills TCP's window, so a client cannot outrun the bus.
class SocketcandClient {
 public:
  /// Greets. `id`: never 0, never given to another client.
  SocketcandClient(std::uint64_t id, int fd, SocketcandShared &shared);

  [[nodiscard]] std::uint64_t id() const { return id_; }
  /// Index of the bus that it has opened.
  [[nodiscard]] std::optional<std::size_t> bus() const { return bus_; }
  /// True once it gets frames: in raw mode, or with a filter.
  [[nodiscard]] bool receiving() const { return receiving_; }
  [[nodiscard]] int fd() const { return connection_.fd(); }
  /// What to poll for; 0: nothing, leave it out.
  [[nodiscard]] short events() const;
  /// Host time at which work() is to be called even if nothing arrives.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> alarm() const;
  /// True: something happens at a later simulated time.
  [[nodiscard]] bool awaits_time() const;
  /// Reads what has arrived, as far as there is room.
  void read();
  /// Carries out commands up to one that sends a frame, and sends answers.
  void work();
  /// The next frame for its bus.
  [[nodiscard]] std::optional<can_frame> take();
  /// At the end: reads what the client has sent, counts the frames that will not be sent, and tells
  /// the client.
  [[nodiscard]] std::size_t remaining();
  /// Throws away the frames that it has sent and the bus has not taken; their number.
  std::size_t drop_frames();
  /// False when it has ended its side, or was told to go: it may only have frames left to be sent.
  [[nodiscard]] bool connected() const;
  /// A message of its bus.
  void deliver(const PortMessage &message);
  /// True when it has left, or was told to go, and nothing is left to be done.
  [[nodiscard]] bool done() const;
  /// Sends what can be sent; true when nothing waits, or the client is gone.
  [[nodiscard]] bool flushed();
  /// Half-closes and throws away what the client still sends, so that what it was told is not lost
  /// by a reset of the connection.
  void say_goodbye();
  /// Adds to the counts what was not delivered; before its end.
  void account();

 private:
  enum Mode : unsigned { kNoBus = 1, kBroadcast = 2, kRaw = 4, kControl = 8 };
  static constexpr unsigned kOpen = kBroadcast | kRaw | kControl;
  struct Command {
    std::string_view name;
    unsigned modes;
    void (SocketcandClient::*run)(CommandWords &);
  };
  static const Command kCommands[];

  void next_command();
  void execute(const std::string &text);
  [[nodiscard]] std::string unknown(std::string_view name) const;
  void fail(const std::string &text);
  void answer_ok() { put("< ok >"); }
  void enter(Mode mode);
  void leave();
  bool put(const std::string &text);
  void show(const PortMessage &message);
  void tick();

  void open(CommandWords &words);
  void echo(CommandWords &words);
  void raw_mode(CommandWords &words);
  void broadcast_mode(CommandWords &words);
  void control_mode(CommandWords &words);
  void isotp_mode(CommandWords &words);
  void own_messages(CommandWords &words);
  void send(CommandWords &words);
  void send_remote(CommandWords &words);
  void add(CommandWords &words);
  void update(CommandWords &words);
  void remove(CommandWords &words);
  void subscribe(CommandWords &words);
  void filter(CommandWords &words);
  void mux_filter(CommandWords &words);
  void unsubscribe(CommandWords &words);
  void statistics(CommandWords &words);

  std::uint64_t id_;
  SocketcandShared &shared_;
  SocketcandConnection connection_;
  CommandSplitter splitter_;
  BroadcastManager broadcast_;
  Mode mode_ = kNoBus;
  std::optional<std::size_t> bus_;
  std::optional<can_frame> pending_;  ///< from a command, not taken yet
  bool own_messages_ = false;
  bool receiving_ = false;
  bool jobs_turn_ = false;  ///< jobs and commands take turns
  bool leaving_ = false;    ///< told to go: no more input, no more frames
  std::chrono::steady_clock::time_point told_{};
  Time statistics_interval_ = 0;  ///< 0: off
  Time statistics_due_ = 0;
};

}  // namespace vericansim
