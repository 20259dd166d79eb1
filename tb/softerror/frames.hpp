// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of the soft-error runs: each is a function of who sends it and its number, so that any
// frame received anywhere can be told to be the one that was meant, or wrong.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// Senders, and receivers: 0 is the node under test, 1 and 2 are its healthy neighbours.
inline constexpr unsigned kParties = 3;

/// Mixes 64 bits (splitmix64): the source of all that is random here.
[[nodiscard]] std::uint64_t mix(std::uint64_t value);

/// Who sends a frame, and which one.
struct FrameTag {
  unsigned source = 0;  ///< 0..2
  unsigned number = 0;  ///< 0..65535
  friend bool operator==(const FrameTag &, const FrameTag &) = default;
};

/// The frame of that number: base or extended, data or remote, any DLC; base frames have at least
/// three bytes, for the number and a check.
[[nodiscard]] Frame make_frame(const FrameTag &tag);

/// Whose frame it is; nothing if it is not bit by bit what any of the senders sends.
[[nodiscard]] std::optional<FrameTag> identify(const Frame &frame);

/// What is known of one frame that was to be sent.
struct Fate {
  std::array<std::uint8_t, kParties> received{};  ///< how often, by whom
  bool sent = false;                              ///< its sender says so
  bool aborted = false;                           ///< its sender says that it was given up
  bool excused = false;  ///< the node under test was off the bus on purpose meanwhile
};

/// Book of all frames of a run.
class Ledger {
 public:
  /// Numbers begin at `first`, 0 to 32767, so that no two runs have the same frames.
  explicit Ledger(unsigned first) : first_{first} {}
  /// The next frame of `source`, which is to be sent from now on.
  FrameTag next(unsigned source);
  void sent(const FrameTag &tag, bool excused) {
    fate(tag).sent = true;
    fate(tag).excused |= excused;
  }
  /// The node under test is about to leave the bus on purpose: what it has not yet got of its
  /// neighbours' frames it need not get.
  void excuse();
  void aborted(const FrameTag &tag) { fate(tag).aborted = true; }
  /// `by` has accepted this frame as valid; one that nobody was to send counts as wrong.
  void received(unsigned by, const Frame &frame, bool excused = false);

  [[nodiscard]] const std::vector<Fate> &fates(unsigned source) const { return fates_[source]; }
  [[nodiscard]] unsigned wrong(unsigned by) const { return wrong_[by]; }

 private:
  [[nodiscard]] Fate &fate(const FrameTag &tag) { return fates_[tag.source][tag.number - first_]; }

  unsigned first_;
  std::array<std::vector<Fate>, kParties> fates_;
  std::array<unsigned, kParties> wrong_{};
};

}  // namespace vericansim
