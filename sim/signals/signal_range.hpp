// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Order of a signal's values, and limits for them: exact also where doubles are not.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "signals/signal_codec.hpp"

namespace vericansim {

/// True if `a` is the smaller one of two values of one signal; false with one that is no number.
[[nodiscard]] bool is_below(const SignalValue &a, const SignalValue &b);

/// A limit for a signal's values. Doubles hold 53 bits, so that integers have their bits too.
struct SignalLimit {
  double value = 0;                  ///< physical
  std::optional<std::uint64_t> raw;  ///< exact, as in SignalValue; none: `value` is all there is
};

/// The limit that `text` stands for: a choice or a number. Throws SignalError: neither, or a number
/// with which a long integer cannot be compared exactly.
[[nodiscard]] SignalLimit limit_of(const Signal &signal, const std::string &text);

/// Inclusive limits of a signal's values.
struct SignalRange {
  std::optional<SignalLimit> least, most;
  [[nodiscard]] bool is_limited() const { return least || most; }
  [[nodiscard]] bool contains(const SignalValue &value) const;
};

/// True if no value can be in the range, for its limits are the wrong way round.
[[nodiscard]] bool is_empty(const Signal &signal, const SignalRange &range);
/// "5", "at least 5", "at most 7", "5 to 7".
[[nodiscard]] std::string to_text(const Signal &signal, const SignalRange &range);

}  // namespace vericansim
