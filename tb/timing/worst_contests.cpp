// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Which frames keep two neighbours apart: see far_winner.hpp.
#include <algorithm>
#include <cmath>
#include <optional>

#include "model/frame_codec.hpp"
#include "timing/far_winner.hpp"

namespace vericansim {
namespace {

/// Bits in runs, most of them of four: a stuff bit and four others are five.
std::uint64_t runs(std::mt19937_64 &random, unsigned bits) {
  std::uint64_t value = 0;
  bool level = (random() & 1) != 0;
  auto length = static_cast<unsigned>(1 + random() % 5);
  while (bits > 0) {
    for (; length > 0 && bits > 0; --length, --bits) value = value << 1 | level;
    level = !level;
    length = random() % 10 != 0 ? 4 : static_cast<unsigned>(1 + random() % 5);
  }
  return value;
}

Frame random_frame(std::mt19937_64 &random) {
  Frame frame;
  frame.extended = (random() & 1) != 0;
  frame.remote = random() % 8 == 0;
  frame.dlc = static_cast<std::uint8_t>(random() % 9);
  frame.id = static_cast<std::uint32_t>(runs(random, frame.extended ? 29 : 11));
  const std::uint64_t data = runs(random, 64);
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(data >> (56 - 8 * i));
  return frame;
}

/// The same frame with a recessive bit among the first eleven of the identifier, if one is
/// dominant; `lost` counts the bits from SOF to it.
std::optional<Frame> loser_to(const Frame &winner, std::mt19937_64 &random, unsigned &lost) {
  const unsigned first = winner.extended ? 28 : 10;
  const auto before = static_cast<unsigned>(random() % 11);
  if ((winner.id >> (first - before) & 1) != 0) return {};
  Frame loser = winner;
  loser.id |= 1U << (first - before);
  lost = before + 1;
  return loser;
}

/// The neighbours' phase errors to the winner's edges, followed bit by bit: the fast loser's grows
/// by the drift, the slow listener's does not, and each edge sets both back by SJW at most.
double apart_at_ack(const Frame &winner, unsigned lost, const RowPromise &promise) {
  const BitTiming &t = promise.timing;
  const double quantum_ns = 1e9 * t.prescaler / promise.clock_hz;
  const double loop = 2 * (promise.cable_m * 5 + promise.node_delay_ns) + 4e9 / promise.clock_hz;
  const double drift = 2 * promise.tolerance * t.quanta();  // a bit
  const auto follow = [&](double &late) {
    late -= std::clamp(std::floor(late), 0.0, static_cast<double>(t.sjw));
  };
  const EncodedFrame wire = encode_frame(winner);
  double fast = std::floor(loop / quantum_ns), slow = fast;
  unsigned plain = 0;
  for (std::size_t i = 1; i <= wire.stuffed_length; ++i) {
    plain += !wire.bits[i].is_stuff;
    const bool edge =
        wire.bits[i - 1].level == Level::kRecessive && wire.bits[i].level == Level::kDominant;
    fast += drift;
    if (plain < lost) {
      if (edge) fast = slow;  // both follow the loser
    } else if (edge) {
      follow(fast);
      follow(slow);
    }
  }
  return fast - slow;
}

}  // namespace

std::vector<Contest> worst_contests(const RowPromise &promise, unsigned count, std::uint64_t seed) {
  constexpr unsigned kTried = 20'000;
  std::mt19937_64 random{seed};
  std::vector<Contest> contests;
  for (unsigned i = 0; i < kTried; ++i) {
    const Frame winner = random_frame(random);
    unsigned lost = 0;
    if (const auto loser = loser_to(winner, random, lost))
      contests.push_back({winner, *loser, apart_at_ack(winner, lost, promise)});
  }
  std::stable_sort(contests.begin(), contests.end(),
                   [](const Contest &a, const Contest &b) { return a.apart > b.apart; });
  contests.resize(std::min<std::size_t>(count, contests.size()));
  return contests;
}

}  // namespace vericansim
