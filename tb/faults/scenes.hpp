// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes: the stretches of bus life whose bits the matrix disturbs, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "faults/injection_axes.hpp"

namespace vericansim {

/// The frame of the DUT (GV-1).
inline constexpr Frame kOwnFrame{.id = 0x123, .dlc = 1, .data = {0x55}};

/// How the DUT comes to the bits that are disturbed, and which these are. Scripts are those of
/// InjectionRig::play(), from the SOF of the frame on.
struct Scene {
  /// What happens to the DUT's requests after `before`.
  enum class Extra : std::uint8_t { kNone, kRequest, kCancel };

  std::string name = {};
  bool transmitter = false;  ///< the DUT sends `frame`, else LT does
  Frame frame = {};
  std::string before = {};  ///< goes ahead of the disturbed stretch
  std::string wire = {};    ///< the stretch; one position a character
  Extra extra = Extra::kNone;
  std::size_t positions = 0;          ///< only so many of the stretch; 0: all
  bool acknowledge = true;            ///< LT acknowledges what the DUT sends, from the start on
  std::vector<Frame> delivered = {};  ///< frames besides `frame` that the DUT may deliver
};

/// The frame that Extra::kRequest asks for.
inline const Frame kQueuedFrame{.id = 0x0F3, .dlc = 2, .data = {0x00, 0xFF}};

/// The DUT sends or receives each of `streams`: SOF to the second bit of idle.
[[nodiscard]] std::vector<Scene> frame_scenes(const std::vector<Stream> &streams, bool transmitter);
/// Flags, delimiter wait and delimiters of error and overload frames, and what follows them.
[[nodiscard]] std::vector<Scene> handling_scenes();
/// Delimiter to idle behind every story of TH-05, each with and without a frame that waits.
[[nodiscard]] std::vector<Scene> gap_scenes();
/// The first disturbance of each mandatory pair (MX-31) lies in `before`.
[[nodiscard]] std::vector<Scene> pair_scenes();
/// Arbitration: one scene for each bin of lost arbitration; its only position is the lost bit, and
/// LT goes on with the winner.
[[nodiscard]] std::vector<Scene> loss_scenes();

}  // namespace vericansim
