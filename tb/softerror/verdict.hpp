// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a flip has done, in one word: the classes of docs/soft-errors.md, mildest first.
#pragma once

#include <cstdint>
#include <string>

#include "softerror/experiment.hpp"

namespace vericansim {

/// The classes. An outcome belongs to the last one that fits.
enum class Verdict : std::uint8_t {
  kGone,           ///< nothing seen, and the state is again what it would have been
  kLatent,         ///< nothing seen, but something in the core is still different
  kStatus,         ///< the CPU saw another value or interrupt; every frame right
  kTiming,         ///< the bus was used differently, without an error; every frame right
  kRetried,        ///< error frames; every frame right, by itself
  kTwice,          ///< a frame received twice, as CAN allows after errors
  kBusOff,         ///< bus-off, and back by itself
  kLostTold,       ///< frames lost, and the controller said so (overrun)
  kLost,           ///< frames lost without a word
  kWrongReceived,  ///< a wrong frame reached the CPU
  kWrongSent,      ///< a wrong frame was sent with a right CRC
  kConfig,         ///< a configuration register changed, all frames still right
  kConfigBad,      ///< a configuration register changed, and it matters until it is rewritten
  kStuckRenew,     ///< something stood still until the driver renewed buffers and flags
  kStuckFreeze,    ///< ... until it went through freeze mode and configured anew
  kStuckReset,     ///< ... until a soft reset
  kBlocked,        ///< the neighbours could not use the bus until the software acted
  kHang,           ///< only a hard reset helps, or the CPU's access never ends
  kBabble,         ///< dominant for longer than the longest legal run
};
inline constexpr unsigned kVerdicts = 19;

/// Short name for tables.
[[nodiscard]] const char *to_string(Verdict verdict);

/// `reference` is the same run without the flip.
[[nodiscard]] Verdict judge(const Outcome &out, const Outcome &reference);

/// Empty if a run without a flip is what it should be; else what is wrong with it.
[[nodiscard]] std::string complaint(const Outcome &reference);

}  // namespace vericansim
