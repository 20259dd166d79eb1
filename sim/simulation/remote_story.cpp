// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteStory: see remote_story.hpp.
#include "simulation/remote_story.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/remote_words.hpp"

namespace vericansim {
RemoteStory::RemoteStory(Bus &bus, const std::vector<WatchedUnit> &units, bool page)
    : bus_{bus}, page_{page} {
  for (const WatchedUnit &unit : units)
    units_.push_back({unit, -1, std::vector<std::uint8_t>(unit.config.first_port())});
}

void RemoteStory::begin() {
  start_ = bus_.now();
  starts_.clear();
  told_.clear();
  known_.clear();
  frames_ = 0;
  columns_ = {};
  for (Unit &unit : units_) {
    unit.state = -1;
    std::fill(unit.window.begin(), unit.window.end(), std::uint8_t{0});
    columns_.units.push_back(
        {unit.watched.node, unit.watched.number, unit.watched.config.first_port()});
    if (!page_) continue;
    look_at_state(unit, start_);
    look_at_window(unit, start_);
  }
}

void RemoteStory::on_bit(NodeId node, const BitRecord &bit) {
  for (Unit &unit : units_)
    if (unit.watched.node == node) look_at_state(unit, bit.time);
}

void RemoteStory::look_at_state(Unit &unit, Time time) {
  const int state = static_cast<int>(unit.watched.unit->state());
  if (state == unit.state) return;
  unit.state = state;
  columns_.state_time.push_back(ns(time));
  columns_.state_node.push_back(static_cast<std::uint8_t>(unit.watched.node));
  columns_.state.push_back(static_cast<std::uint8_t>(state));
}

void RemoteStory::look_at_window(Unit &unit, Time time) {
  for (unsigned i = 0; i < unit.window.size(); ++i) {
    const std::uint8_t byte = unit.watched.unit->peek(i);
    if (byte == unit.window[i]) continue;
    unit.window[i] = byte;
    columns_.byte_time.push_back(ns(time));
    columns_.byte_node.push_back(static_cast<std::uint8_t>(unit.watched.node));
    columns_.byte_address.push_back(static_cast<std::uint8_t>(i));
    columns_.byte.push_back(byte);
  }
}

// In a clock edge of the node nothing may be asked of it.
void RemoteStory::written(std::size_t index) {
  if (!page_) return;
  bus_.at(bus_.now() + 1, [this, index] { look_at_window(units_[index], bus_.now()); });
}

std::uint32_t RemoteStory::index_of(const std::string &words) {
  const auto [place, is_new] = known_.try_emplace(words, columns_.texts);
  if (is_new) {
    columns_.text.insert(columns_.text.end(), words.begin(), words.end());
    columns_.text.push_back('\n');
    ++columns_.texts;
  }
  return place->second;
}

void RemoteStory::on_frame(const BusFrame &frame) {
  ++frames_;
  const bool tell = told_.size() < kTold;
  if (!tell && !page_) return;
  const std::string words = remote_words(frame.frame, units_.front().watched.config.name_bits);
  if (tell) told_.push_back({frame.start - start_, words});
  starts_.push_back(frame.start);
  if (!page_) return;
  columns_.words.push_back(index_of(words));
}

void RemoteStory::on_cycle(const BusFrame &trigger, std::size_t nodes, Time skew) {
  const auto place = std::lower_bound(starts_.begin(), starts_.end(), trigger.start);
  if (place == starts_.end() || *place != trigger.start) return;
  std::string more = fmt::format(", {} node{}", nodes, nodes == 1 ? "" : "s");
  if (nodes > 1) more += fmt::format(", skew {:.0f} ns", static_cast<double>(skew) / 1e3);
  const auto index = static_cast<std::size_t>(place - starts_.begin());
  if (index < told_.size()) told_[index].words += more;
  if (!page_) return;
  const std::string words = remote_words(trigger.frame, units_.front().watched.config.name_bits);
  columns_.words[index] = index_of(words + more);
}

void RemoteStory::finish() {
  if (!page_) return;
  for (Unit &unit : units_) look_at_window(unit, bus_.now());
}

void RemoteStory::describe(RemoteReport &report) const {
  report.frames = told_;
  report.more_frames = frames_ - told_.size();
}

}  // namespace vericansim
