// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Trail: what happened on a bus, line by line, to be compared with that of another run.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bus/observer.hpp"

namespace vericansim {

using Trail = std::vector<std::string>;

/// Notes everything that a bus tells its observers, but for single clocks: with a watcher of those
/// no node rests.
class TrailRecorder : public BusObserver {
 public:
  explicit TrailRecorder(Trail &trail) : trail_{trail} {}
  [[nodiscard]] unsigned interests() const override { return kLevels | kNodeLevels | kBits; }
  void on_level(Time t, Level level) override { note("level", kBus, t, level); }
  void on_node_tx(NodeId id, Time t, Level level) override { note("tx", id, t, level); }
  void on_node_rx(NodeId id, Time t, Level level) override { note("rx", id, t, level); }
  void on_bit(NodeId id, const BitRecord &bit) override {
    const Trace &at = bit.at, &after = bit.after;
    trail_.push_back(fmt::format("bit {} {} {} {} {} {} {} {} {} {} {}", id, bit.time,
                                 static_cast<int>(at.rx), static_cast<int>(at.tx), at.transmitter,
                                 at.stuff, static_cast<int>(at.field), at.left, after.errors,
                                 after.tec, after.rec));
  }

 private:
  static constexpr NodeId kBus = 99;
  void note(const char *what, NodeId id, Time t, Level level) {
    trail_.push_back(fmt::format("{} {} {} {}", what, id, t, static_cast<int>(level)));
  }
  Trail &trail_;
};

/// Where `got` leaves `due`, with the entries before; empty if they are the same.
inline std::string first_difference(const Trail &got, const Trail &due) {
  const auto [at, expected] = std::mismatch(got.begin(), got.end(), due.begin(), due.end());
  if (at == got.end() && expected == due.end()) return "";
  constexpr std::ptrdiff_t kShown = 30;
  std::string text =
      fmt::format("entry {} of {}: {}, not {}, after\n", expected - due.begin(), due.size(),
                  at == got.end() ? "the end" : *at, expected == due.end() ? "the end" : *expected);
  for (auto i = expected - std::min(kShown, expected - due.begin()); i != expected; ++i)
    text += *i + "\n";
  return text;
}

}  // namespace vericansim
