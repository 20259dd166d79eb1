// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes of lost arbitration: each of the 12 + 32 positions with a stuff bit before it, in its
// place, behind it, or none near (TH-05).
#include <algorithm>
#include <optional>
#include <utility>

#include "faults/scenes.hpp"
#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

/// Places of the arbitration field in order of the wire: 0 = ID28 .. 31 = extended RTR (AR-12).
struct Arbitration {
  bool extended;
  [[nodiscard]] unsigned positions() const { return extended ? 32 : 12; }
  /// Number of the identifier's bit at `position`; nothing for SRR, IDE, RTR.
  [[nodiscard]] std::optional<unsigned> id_bit(unsigned position) const {
    if (position < 11) return (extended ? 28 : 10) - position;
    if (extended && position >= 13 && position < 31) return 30 - position;
    return std::nullopt;
  }
  [[nodiscard]] bool fixed(unsigned position) const {
    return extended && (position == 11 || position == 12);
  }
};

using Bits = std::vector<bool>;  // true: recessive

Frame frame_of(const Arbitration &arbitration, const Bits &bits) {
  Frame frame{.extended = arbitration.extended};
  for (unsigned p = 0; p < arbitration.positions(); ++p) {
    const std::optional<unsigned> id_bit = arbitration.id_bit(p);
    if (id_bit && bits[p]) frame.id |= 1u << *id_bit;
  }
  frame.remote = bits.back();
  frame.dlc = 1;
  if (!frame.remote) frame.data = {0x5A};
  return frame;
}

/// Two runs of equal own bits that end before a position: the last one, and the one before it, of
/// the other level.
struct RunsBefore {
  unsigned last;
  bool recessive;
  unsigned before;
};

/// Own bits with these runs before `position`, and which alternate else; the bit at `position` is
/// recessive.
Bits own_bits(const Arbitration &arbitration, unsigned position, const RunsBefore &runs) {
  Bits bits(arbitration.positions());
  bool level = runs.recessive;
  for (unsigned n = position; n-- > 0;) {
    if (position - n <= runs.last) {
      bits[n] = runs.recessive;
    } else if (position - n <= runs.last + runs.before) {
      bits[n] = !runs.recessive;
    } else {
      bits[n] = level;
      level = !level;
    }
  }
  for (unsigned n = position; n < bits.size(); ++n) bits[n] = (n - position) % 2 == 0;
  for (unsigned n = 0; n < bits.size(); ++n) {
    if (arbitration.fixed(n)) bits[n] = true;
  }
  return bits;
}

/// The frame that wins with a dominant bit at `position` (AR-06).
Frame winner_of(const Arbitration &arbitration, Bits bits, unsigned position) {
  if (arbitration.fixed(position)) {  // a base frame: data wins at SRR, remote at IDE
    Bits base(bits.begin(), bits.begin() + 12);
    base[11] = position == 12;
    return frame_of({.extended = false}, base);
  }
  bits[position] = false;
  return frame_of(arbitration, bits);
}

/// Index on the wire of an arbitration bit, or of the stuff bit right before it.
std::optional<std::size_t> wire_index(const EncodedFrame &frame, unsigned position, bool stuff) {
  unsigned seen = 0;
  for (std::size_t i = 1; i < frame.bits.size(); ++i) {
    const WireBit &bit = frame.bits[i];
    if (seen == position && bit.is_stuff == stuff) return i;
    if (!bit.is_stuff && seen == position) return std::nullopt;
    if (!bit.is_stuff) ++seen;
  }
  return std::nullopt;
}

unsigned relation_of(const EncodedFrame &own, const std::string &won, std::size_t index) {
  if (own.bits[index].is_stuff) return kLossAtStuff;
  if (own.bits[index - 1].is_stuff) return kLossAfterStuff;
  const bool five = index >= 4 && won.substr(index - 4, 5) == "00000";
  return five ? kLossBeforeStuff : kLossPlain;
}

std::optional<Scene> scene_with(const Arbitration &arbitration, unsigned position,
                                unsigned relation, const Bits &bits) {
  const Frame own = frame_of(arbitration, bits);
  const EncodedFrame encoded = encode_frame(own);
  const auto index = wire_index(encoded, position, relation == kLossAtStuff);
  if (!index || encoded.bits[*index].level == Level::kDominant) return std::nullopt;
  const Frame winner = winner_of(arbitration, bits, position);
  const std::string won = model_bench::whole(winner);
  if (relation_of(encoded, won, *index) != relation) return std::nullopt;
  constexpr const char *kNames[] = {"plain", "after-stuff", "at-stuff", "before-stuff"};
  const bool stuff_error = relation == kLossAtStuff;
  return Scene{.name = std::string{arbitration.extended ? "ext" : "base"} +
                       std::to_string(position) + "-" + kNames[relation],
               .transmitter = true,
               .frame = own,
               .before = model_bench::rep(static_cast<int>(*index), "."),
               .wire = "1" + (stuff_error ? "" : won.substr(*index + 1)) + "111",
               .positions = 1,
               .delivered = {winner}};
}

/// The first frame whose bits lead to that relation; nothing if none does.
std::optional<Scene> find_scene(const Arbitration &arbitration, unsigned position,
                                unsigned relation) {
  for (unsigned last = 0; last <= std::min(position, 5u); ++last) {
    for (unsigned before = 1; before <= 5; ++before) {
      for (const bool recessive : {false, true}) {
        const Bits bits = own_bits(arbitration, position, {last, recessive, before});
        std::optional<Scene> scene = scene_with(arbitration, position, relation, bits);
        if (scene) return scene;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Scene> loss_scenes() {
  std::vector<Scene> all;
  for (const Arbitration arbitration : {Arbitration{false}, Arbitration{true}}) {
    for (unsigned position = 0; position < arbitration.positions(); ++position) {
      for (unsigned relation = 0; relation < 4; ++relation) {
        std::optional<Scene> scene = find_scene(arbitration, position, relation);
        if (scene) all.push_back(std::move(*scene));
      }
    }
  }
  return all;
}

}  // namespace vericansim
