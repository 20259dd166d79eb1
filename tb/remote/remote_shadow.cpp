// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteShadow: see remote_shadow.hpp.
#include "remote/remote_shadow.hpp"

#include <fmt/format.h>

#include <utility>

#include "bus/bus.hpp"
#include "remote/remote_text.hpp"

namespace vericansim {
namespace {

std::string text_of(RemoteState state) { return std::to_string(static_cast<int>(state)); }

}  // namespace

RemoteShadow::RemoteShadow(RemoteNode &node, NodeId id, const RemoteConfig &config, unsigned number)
    : node_{node}, id_{id}, model_{config, number} {
  node_.on_pulse = [this](const RemotePulse &shown) { pulse(shown); };
  node_.on_access = [this](const UserAccess &access) {
    if (access.write) model_.user_write(access.word, access.data, access.lanes);
  };
  node_.on_ms = [this] { ++ms_; };
}

void RemoteShadow::start() {
  node_.start();
  model_.start();
}

void RemoteShadow::hold(bool on) {
  holds_ = on;
  if (!on) released_ = node_.bus()->now();
  node_.hold(on);
  model_.hold(on);
}

void RemoteShadow::on_bit(NodeId node, const BitRecord &bit) {
  if (node != id_) return;
  // The node was off the bus for some clocks and integrates.
  if (model_.restarting() && bit.at.field == Field::kInteg) model_.stopped();
  for (; ms_ != 0; --ms_) model_.tick();
  follow_header(bit);
  follow_sending(bit);
  follow_errors(bit.after);
  if (to_int2_ != 0 && --to_int2_ == 0) model_.intermission();
  if (bit.after.rx_valid && !bit.at.transmitter) {
    to_int2_ = 3;
    valid_ = bit.time;
    model_.receive(node_.frame());
  }
  may_write_ = bit.at.field != Field::kEof && to_int2_ == 0;
  in_frame_ = bit.at.field != Field::kIdle && bit.at.field != Field::kInt;
}

// What falls due within a request comes behind its answer (docs/remote.md).
void RemoteShadow::follow_header(const BitRecord &bit) {
  if (bit.at.field == Field::kDlc && !bit.at.transmitter)
    model_.announce(node_.frame());
  else if (bit.at.field <= Field::kSuspend)
    model_.released();
}

bool RemoteShadow::may_write(unsigned word) const {
  using namespace remote_map;
  const auto within = [word](unsigned from, unsigned end) {
    return word >= from / 4 && word < end / 4;
  };
  const bool early = within(kMaps, kTablesEnd) || within(kWriteProtect, kReadProtect);
  return may_write_ && !(early && in_frame_ && model_.config().num_map != 0);
}

void RemoteShadow::follow_sending(const BitRecord &bit) {
  const Trace &after = bit.after;
  if (after.start && after.transmitter) {
    under_way_ = model_.wants();
    if (!under_way_) differ("begins to send", "a frame", "nothing");
    model_.attempt();
  }
  if (!under_way_ || !(after.tx_ok || after.tx_fail)) return;
  const std::optional<Frame> expected = std::exchange(under_way_, std::nullopt);
  if (after.tx_ok) {
    if (node_.frame() != *expected) differ("sends", text_of(node_.frame()), text_of(expected));
    ++sent_;
    model_.sent();
  } else if (after.errors != 0) {
    model_.failed();
  } else {
    model_.lost_arbitration();
  }
}

void RemoteShadow::follow_errors(const Trace &trace) {
  if (!trace.bus_off) model_.set_errors(trace.tec, trace.rec);
  if (trace.bus_off == off_bus_) return;
  off_bus_ = trace.bus_off;
  if (off_bus_)
    model_.went_bus_off();
  else
    model_.recovered();
}

// RN-45: in the clock after the sample point of INT2, unless user logic holds. Where an overload
// flag takes its place, INT2 is still the third sample point after that of EOF6.
void RemoteShadow::pulse(const RemotePulse &shown) {
  pulses_.push_back(shown);
  if (holds_ || released_ >= valid_) return;
  if (to_int2_ != 1) differ("pulse", fmt::format("{} bits before INT2", to_int2_), "after INT2");
}

const std::string &RemoteShadow::compare(bool all) {
  if (node_.state() != model_.state())
    differ("state", text_of(node_.state()), text_of(model_.state()));
  if (model_.wants()) differ("offers nothing", "", text_of(model_.wants()));
  const std::string shown = text_of(std::exchange(pulses_, {}));
  const std::string expected = text_of(model_.take_pulses());
  if (shown != expected) differ("pulses", shown, expected);
  compare_words(0, all ? remote_map::kHidden / 4 : 0x20);
  compare_words(remote_map::kNode / 4, (remote_map::kConfigEnd - remote_map::kNode) / 4);
  for (unsigned i = 0; i < 3; ++i)
    compare_byte(remote_map::kStatus + i, node_.peek(remote_map::kStatus + i));
  if (model_.config().counters) compare_words(remote_map::kCounters / 4, 2);
  const std::vector<std::uint32_t> rows = node_.peek_words(remote_map::kStatus / 4, 4);
  for (unsigned i = 3; i < 16; ++i)
    compare_byte(remote_map::kStatus + i, rows[i / 4] >> 8 * (i % 4) & 0xFF);
  return difference_;
}

void RemoteShadow::compare_words(unsigned first, unsigned n) {
  const std::vector<std::uint32_t> words = node_.peek_words(first, n);
  for (unsigned i = 0; i < 4 * n; ++i)
    compare_byte(4 * first + i, words[i / 4] >> 8 * (i % 4) & 0xFF);
}

void RemoteShadow::compare_byte(unsigned address, unsigned rtl) {
  const unsigned model = model_.memory()[address];
  if (rtl != model)
    differ(fmt::format("byte {:03X}", address), fmt::format("{:02X}", rtl),
           fmt::format("{:02X}", model));
}

void RemoteShadow::differ(const std::string &what, const std::string &rtl,
                          const std::string &model) {
  if (difference_.empty())
    difference_ = fmt::format("{}: {}: {}, model: {}", node_.name(), what, rtl, model);
}

}  // namespace vericansim
