// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The commands of the socketcand protocol and the modes in which each is allowed.
#include <fmt/format.h>

#include <algorithm>

#include "socketcand_client.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// Tuples of a muxfilter, the multiplex mask among them.
constexpr std::uint64_t kMostTuples = 257;
/// A day, in milliseconds.
constexpr std::uint64_t kLongestStatistics = 86'400'000;

std::string mode_list(unsigned modes) {
  constexpr std::pair<unsigned, const char *> kNames[] = {
      {1, "before a bus is open"}, {2, "in bcmmode"}, {4, "in rawmode"}, {8, "in controlmode"}};
  std::string list;
  for (const auto &[mode, name] : kNames)
    if ((modes & mode) != 0) list += std::string(list.empty() ? "" : " or ") + name;
  return list;
}

}  // namespace

const SocketcandClient::Command SocketcandClient::kCommands[] = {
    {"open", kNoBus, &SocketcandClient::open},
    {"echo", kNoBus | kOpen, &SocketcandClient::echo},
    {"rawmode", kOpen, &SocketcandClient::raw_mode},
    {"bcmmode", kOpen, &SocketcandClient::broadcast_mode},
    {"controlmode", kOpen, &SocketcandClient::control_mode},
    {"isotpmode", kOpen, &SocketcandClient::isotp_mode},
    {"ownmessages", kOpen, &SocketcandClient::own_messages},
    {"send", kBroadcast | kRaw, &SocketcandClient::send},
    {"sendrtr", kBroadcast | kRaw, &SocketcandClient::send_remote},
    {"add", kBroadcast, &SocketcandClient::add},
    {"update", kBroadcast, &SocketcandClient::update},
    {"delete", kBroadcast, &SocketcandClient::remove},
    {"subscribe", kBroadcast, &SocketcandClient::subscribe},
    {"filter", kBroadcast, &SocketcandClient::filter},
    {"muxfilter", kBroadcast, &SocketcandClient::mux_filter},
    {"unsubscribe", kBroadcast, &SocketcandClient::unsubscribe},
    {"statistics", kControl, &SocketcandClient::statistics},
};

void SocketcandClient::execute(const std::string &text) {
  CommandWords words(text);
  try {
    const auto *command =
        std::find_if(std::begin(kCommands), std::end(kCommands),
                     [&](const Command &entry) { return entry.name == words.name(); });
    if (command == std::end(kCommands)) throw CommandError(unknown(words.name()));
    if ((command->modes & mode_) == 0)
      throw words.error("only allowed " + mode_list(command->modes));
    (this->*command->run)(words);
  } catch (const CommandError &error) {
    fail(error.what());
  }
}

std::string SocketcandClient::unknown(std::string_view name) const {
  if (name.empty()) return "a command is empty";
  const auto &buses = shared_.buses;
  if (std::find(buses.begin(), buses.end(), name) != buses.end())
    return std::string(name) +
           ": bit timing and control mode belong to the simulated bus, not to "
           "its clients";
  return "there is no command " + in_quotes(std::string(name));
}

void SocketcandClient::open(CommandWords &words) {
  const std::string name(words.next("name of a bus"));
  words.end();
  const auto &buses = shared_.buses;
  const auto found = std::find(buses.begin(), buses.end(), name);
  if (found == buses.end()) {
    leave();  // the protocol wants the connection to end here
    throw words.error(
        fmt::format("there is no bus {}; there is: {}", in_quotes(name), fmt::join(buses, " ")));
  }
  bus_ = static_cast<std::size_t>(found - buses.begin());
  enter(kBroadcast);
  answer_ok();
}

void SocketcandClient::echo(CommandWords &words) {
  words.end();
  put("< echo >");
}

void SocketcandClient::enter(Mode mode) {
  mode_ = mode;
  // Jobs, filters and statistics live as long as their mode.
  broadcast_.clear();
  statistics_interval_ = 0;
  receiving_ = mode == kRaw;
}

void SocketcandClient::raw_mode(CommandWords &words) {
  words.end();
  enter(kRaw);
  answer_ok();
  connection_.pause(shared_.limits.raw_pause);
}

void SocketcandClient::broadcast_mode(CommandWords &words) {
  words.end();
  enter(kBroadcast);
  answer_ok();
}

void SocketcandClient::control_mode(CommandWords &words) {
  words.end();
  enter(kControl);
  answer_ok();
}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): an entry of the command table
void SocketcandClient::isotp_mode(CommandWords &words) {
  throw words.error("not offered; ISO-TP can be built on rawmode");
}

void SocketcandClient::own_messages(CommandWords &words) {
  own_messages_ = words.decimal("switch", 1) == 1;
  words.end();
  answer_ok();
}

void SocketcandClient::send(CommandWords &words) { pending_ = send_frame(words); }

void SocketcandClient::send_remote(CommandWords &words) { pending_ = remote_frame(words); }

void SocketcandClient::add(CommandWords &words) {
  const Time interval = words.interval();
  can_frame frame{};
  frame.can_id = words.id();
  words.data(frame);
  broadcast_.add_job(frame, interval, shared_.now);
}

void SocketcandClient::update(CommandWords &words) {
  can_frame frame{};
  frame.can_id = words.id();
  words.data(frame);
  broadcast_.update_job(frame);
}

void SocketcandClient::remove(CommandWords &words) {
  const canid_t id = words.id();
  words.end();
  broadcast_.delete_job(id);
}

void SocketcandClient::subscribe(CommandWords &words) {
  const Time throttle = words.interval();
  const canid_t id = words.id();
  words.end();
  broadcast_.subscribe(id, throttle);
  receiving_ = true;
}

void SocketcandClient::filter(CommandWords &words) {
  const Time throttle = words.interval();
  can_frame mask{};
  mask.can_id = words.id();
  words.data(mask);
  broadcast_.filter(mask.can_id, throttle, content_of(mask));
  receiving_ = true;
}

void SocketcandClient::mux_filter(CommandWords &words) {
  const Time throttle = words.interval();
  const canid_t id = words.id();
  const auto count = words.decimal("number of tuples", kMostTuples);
  if (count < 2) throw words.error("2 to 257 tuples are needed, the multiplex mask first");
  std::vector<std::uint64_t> tuples(count);
  for (std::uint64_t &tuple : tuples)
    for (unsigned i = 0; i < CAN_MAX_DLEN; ++i)
      tuple = tuple << 8U | words.hex("byte of a tuple", 0xFF);
  words.end();
  broadcast_.mux_filter(id, throttle, tuples);
  receiving_ = true;
}

void SocketcandClient::unsubscribe(CommandWords &words) {
  const canid_t id = words.id();
  words.end();
  broadcast_.unsubscribe(id);
}

void SocketcandClient::statistics(CommandWords &words) {
  const auto milliseconds = words.decimal("interval", kLongestStatistics);
  words.end();
  statistics_interval_ = static_cast<Time>(milliseconds) * kMillisecond;
  statistics_due_ = shared_.now + statistics_interval_;
}

}  // namespace vericansim
