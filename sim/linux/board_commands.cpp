// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: the commands of test scripts. Each answer is made for a shell: key=value, one node a line.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "linux/board.hpp"
#include "linux/command_words.hpp"
#include "timing/bittime.hpp"
#include "trace/output_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim {

void refuse(const std::string &message) { throw InputError("command", 0, message); }

std::string_view word(const std::vector<std::string_view> &words, std::size_t n, const char *what) {
  if (n >= words.size()) refuse(fmt::format("'{}' needs {}", words.front(), what));
  return words[n];
}

std::uint64_t number(std::string_view text, std::uint64_t low, std::uint64_t high,
                     const char *what) {
  const auto value = parse_integer(text);
  if (!value || *value < low || *value > high)
    refuse(
        fmt::format("{} must be {} to {}, got {}", what, low, high, in_quotes(std::string{text})));
  return *value;
}

namespace {

bool on_or_off(std::string_view text) {
  if (text != "on" && text != "off")
    refuse(fmt::format("expected on or off, got {}", in_quotes(std::string{text})));
  return text == "on";
}

Field field_named(std::string_view name) {
  for (unsigned code = 0; code < 32; ++code) {
    const auto field = static_cast<Field>(code);
    if (field_name(field) == name && name != "?") return field;
  }
  refuse(fmt::format("no field of a frame is called {}", in_quotes(std::string{name})));
}

Effect effect_named(std::string_view name) {
  if (name == "flip") return Effect::kFlip;
  if (name == "dominant") return Effect::kDominant;
  if (name == "recessive") return Effect::kRecessive;
  refuse(fmt::format("expected flip, dominant or recessive, got {}", in_quotes(std::string{name})));
}

std::string counts_text(const std::string &name, const NodeCounts &counts) {
  const auto kind = [&](TraceError bit) {
    return counts.by_kind[static_cast<unsigned>(std::countr_zero(static_cast<unsigned>(bit)))];
  };
  const char *state = counts.off ? "bus-off" : counts.passive ? "passive" : "active";
  return fmt::format(
      "{} attempts={} sent={} delivered={} lost={} errors={} stuff={} form={} crc={} ack={} "
      "bit0={} "
      "bit1={} busoff={} tec={} rec={} maxtec={} maxrec={} state={}\n",
      name, counts.attempts, counts.sent, counts.delivered, counts.lost_arbitration, counts.errors,
      kind(kErrStuff), kind(kErrForm), kind(kErrCrc), kind(kErrAck), kind(kErrBit0), kind(kErrBit1),
      counts.bus_off, counts.tec, counts.rec, counts.max_tec, counts.max_rec, state);
}

}  // namespace

std::string Board::command(const std::string &text) {
  std::string line = text;
  std::replace(line.begin(), line.end(), '\n', ' ');
  struct Entry {
    const char *name;
    std::string (Board::*run)(const Words &);
  };
  static constexpr std::array kCommands = {
      Entry{"bitrate", &Board::observe},   Entry{"log", &Board::log},
      Entry{"hold", &Board::hold},         Entry{"cut", &Board::cut},
      Entry{"strike", &Board::strike},     Entry{"peer", &Board::peer},
      Entry{"sabotage", &Board::sabotage}, Entry{"pulse", &Board::pulse},
      Entry{"edges", &Board::edges}};
  Words words = text::split_blanks(text::trimmed(line));
  if (words.empty()) refuse("empty");
  touched_ = now_;
  if (words[0] == "report") return report();
  if (words[0] == "now") return fmt::format("{}\n", now());
  for (const Entry &entry : kCommands)
    if (words[0] == entry.name) return (this->*entry.run)(words);
  refuse(
      fmt::format("{} is none of bitrate, log, report, now, hold, cut, strike, peer, sabotage, "
                  "pulse, edges",
                  in_quotes(std::string{words[0]})));
}

// ---- Judges

void Board::watch_bus() {
  if (monitor_) {
    monitor_->settle_all(now_);
    bus_.remove(*monitor_);
  }
  const Time bit_time = kSecond / bitrate_;
  monitor_ = std::make_unique<BusMonitor>(bus_, bit_time, recommended_sample_point(bitrate_));
  monitor_->on_frame = [this](const BusFrame &frame) {
    if (log_) log_->write({frame.start + skipped_, "bus", frame.frame});
  };
  bus_.add(*monitor_);
  observed_since_ = now_ + skipped_;
}

std::string Board::observe(const Words &words) {
  bitrate_ = static_cast<std::uint32_t>(
      number(word(words, 1, "a bit rate"), 10'000, 1'000'000, "the bit rate"));
  watch_bus();
  return "ok\n";
}

void Board::close_frame_log() {
  monitor_->settle_all(now_);
  if (!log_) return;
  log_.reset();
  log_file_->commit();
  log_file_.reset();
}

std::unique_ptr<OutputFile> Board::open_log(const std::string &name) const {
  if (name.find('/') != std::string::npos || config_.directory.empty())
    refuse("a log is a file in the directory of logs, of which there must be one");
  try {
    return std::make_unique<OutputFile>(config_.directory + "/" + name);
  } catch (const OutputError &error) {
    refuse(error.what());
  }
}

std::string Board::log(const Words &words) {
  const std::string name{word(words, 1, "a name, or off")};
  close_frame_log();
  if (name == "off") return "ok\n";
  log_file_ = open_log(name);
  log_ = std::make_unique<CandumpWriter>(log_file_->stream());
  return "ok\n";
}

std::string Board::report() {
  monitor_->settle_all(now_);
  const Time span = std::max<Time>(now_ + skipped_ - observed_since_, 1);
  std::string text =
      fmt::format("bus frames={} unacked={} errors={} overloads={} load={:.4f} access_errors={}\n",
                  monitor_->frames(), monitor_->unacknowledged(), monitor_->error_frames(),
                  monitor_->overload_frames(),
                  static_cast<double>(monitor_->busy()) / static_cast<double>(span), bus_errors_);
  for (NodeId id = 0; id < bus_.size(); ++id)
    text += counts_text(node_name(id), monitor_->node(id));
  return text;
}

std::string Board::node_name(NodeId id) const {
  return id < cores_.size() ? cores_[id]->name() : "peer";
}

NodeId Board::node_named(std::string_view name) const {
  for (NodeId id = 0; id < bus_.size(); ++id)
    if (node_name(id) == name) return id;
  refuse(fmt::format("no node is called {}", in_quotes(std::string{name})));
}

// ---- Faults

// The bus is faster without faults, so there is none before the first is wanted.
SwitchFault &Board::faults() {
  if (!faulty_) bus_.add(fault_);
  faulty_ = true;
  return fault_;
}

std::string Board::hold(const Words &words) {
  const std::string_view level = word(words, 1, "dominant, recessive or off");
  if (level == "off") {
    faults().hold({});
    return "ok\n";
  }
  const Effect effect = effect_named(level);
  if (effect == Effect::kFlip) refuse("a bus is held dominant, recessive or off");
  faults().hold(apply_effect(effect, Level::kRecessive));
  return "ok\n";
}

std::string Board::cut(const Words &words) {
  const NodeId node = node_named(word(words, 1, "a node"));
  faults().cut(node, on_or_off(word(words, 2, "on or off")));
  return "ok\n";
}

std::string Board::strike(const Words &words) {
  const NodeId node = node_named(word(words, 1, "a node, a field, a bit, an effect and a count"));
  const Field field = field_named(word(words, 2, "a field"));
  const auto index = static_cast<unsigned>(number(word(words, 3, "a bit"), 0, 63, "the bit"));
  const Effect effect = effect_named(word(words, 4, "flip, dominant or recessive"));
  const auto times =
      static_cast<unsigned>(number(word(words, 5, "a count"), 0, 1'000'000, "the count"));
  faults().strike(node, field, index, effect, times);
  return "ok\n";
}

// ---- Peer

// An engine of the bus's rate with the clock of the others.
void Board::start_peer() {
  const auto timings = find_bit_timings(
      {.clock_hz = static_cast<std::uint32_t>(config_.clock_hz), .bitrate = bitrate_});
  if (timings.empty()) refuse(fmt::format("no bit timing for {} bit/s", bitrate_));
  CoreConfig config;
  config.timing = timings.front().timing;
  if (peer_) {
    peer_->stop();
    while (peer_->running()) bus_.step();
    peer_->configure(config);
  } else {
    ClockConfig clock = cores_.front()->oscillator().config();
    clock.phase = cores_.front()->oscillator().next();
    peer_ = std::make_unique<CoreNode>("peer", config, clock);
    bus_.add(*peer_);
  }
  peer_->start();
  watch_bus();
}

std::string Board::peer(const Words &words) {
  const std::string_view what = word(words, 1, "start, send, pending or stop");
  if (what == "start") {
    start_peer();
    return "ok\n";
  }
  if (!peer_) refuse("the peer has not been started");
  if (what == "pending") return fmt::format("{:d}\n", peer_->pending());
  if (what == "stop") {
    peer_->cancel();
    return "ok\n";
  }
  if (what != "send") refuse("a peer can start, send, pending or stop");
  const std::uint64_t count = number(word(words, 2, "a count"), 1, 100'000, "the count");
  Frame frame;
  if (!parse_candump_frame(word(words, 3, "a frame"), frame, {"command", 0}))
    refuse("a peer sends classical frames");
  for (std::uint64_t n = 0; n < count; ++n) {
    peer_->request(frame);
    // The number of the frame, so that each can be told from the others.
    if (frame.payload_size() >= 2) {
      const auto next = static_cast<unsigned>((frame.data[0] << 8) + frame.data[1] + 1);
      frame.data[0] = static_cast<std::uint8_t>(next >> 8);
      frame.data[1] = static_cast<std::uint8_t>(next);
    }
  }
  return "ok\n";
}

// ---- Seeing tests fail

std::string Board::sabotage(const Words &words) {
  const std::string_view what = word(words, 1, "what to spoil");
  if (what == "lose-frame")
    sabotage_.lose_frame = true;
  else if (what == "corrupt-data")
    sabotage_.corrupt_data = true;
  else if (what == "frozen-errors")
    sabotage_.frozen_errors = true;
  else if (what == "deaf")
    sabotage_.deaf = true;
  else if (what == "off")
    sabotage_ = {};
  else
    refuse("sabotage is lose-frame, corrupt-data, frozen-errors, deaf or off");
  return "ok\n";
}

}  // namespace vericansim
