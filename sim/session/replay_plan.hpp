// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayPlan: which frames of a recording a node sends, and when.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenario/node_role.hpp"
#include "trace/log.hpp"

namespace vericansim {

/// One frame to send.
struct PlannedFrame {
  Time due = 0;  ///< since the start of the scenario; in a loop, of the first pass
  Frame frame;
};

/// What a ReplayRole takes from its log.
struct ReplayPlan {
  std::vector<PlannedFrame> frames;
  Time recorded = 0;                  ///< between the first and the latest of them in the recording
  Time pass = 0;                      ///< in a loop: from the begin of one pass to that of the next
  Time longest_gap = 0;               ///< in the recording, without a frame for this node
  std::size_t after_gap = 0;          ///< number of the frame that ends it, from 1
  std::size_t skipped = 0;            ///< entries of the log that are no classical frames
  std::vector<std::string> warnings;  ///< of the file that was read, as in CanLog
  std::string nothing;                ///< why there is no frame to send; empty if there are some
};

/// Throws InputError if the log cannot be read, or a time leaves what can be simulated.
[[nodiscard]] ReplayPlan make_plan(const ReplayRole &role);

/// The share of the identifiers, 0 to `of` - 1, to which `frame` belongs: always the same for one
/// identifier, as on a real bus.
[[nodiscard]] unsigned share_of(const Frame &frame, unsigned of);

}  // namespace vericansim
