// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// From a frame's data to the values of its signals, and back.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "signals/database.hpp"

namespace vericansim {

/// A signal in a frame.
struct SignalValue {
  const Signal *signal = nullptr;
  std::uint64_t raw = 0;  ///< its bits; those of a signed signal are extended to 64
  double value = 0;       ///< physical, rounded to the signal's decimals
};

/// Values as a user writes them: a number in the signal's unit, or the text of a choice.
using SignalTexts = std::map<std::string, std::string>;

/// A value that a signal cannot have; what() says which is allowed.
class SignalError : public std::runtime_error {
 public:
  SignalError(std::string signal, const std::string &message)
      : std::runtime_error(message), signal_{std::move(signal)} {}
  /// Name of the signal.
  [[nodiscard]] const std::string &signal() const { return signal_; }

 private:
  std::string signal_;
};

using FrameData = std::array<std::uint8_t, 8>;

/// True if the signal is there: it is not multiplexed, or its multiplexer, which is there itself,
/// has a value that selects it.
[[nodiscard]] bool is_selected(const SignalMessage &message, const Signal &signal,
                               const FrameData &data);

/// The signals that `frame` holds: those within its bytes and, of multiplexed ones, those that are
/// selected. None of a remote frame.
[[nodiscard]] std::vector<SignalValue> decode(const SignalMessage &message, const Frame &frame);

/// A signal's value with these raw bits (sign-extended as in SignalValue).
[[nodiscard]] SignalValue value_of(const Signal &signal, std::uint64_t raw);

/// The choice of a value, if it has one.
[[nodiscard]] std::optional<std::string_view> choice_of(const SignalValue &value);

/// The raw bits that `text` stands for: a choice, or the nearest that a number in the signal's unit
/// has. Throws SignalError: no number and no choice, out of range, not the only one of that text.
[[nodiscard]] std::uint64_t raw_of(const Signal &signal, const std::string &text);

/// The raw value of an integer signal with factor 1 and offset 0 that `text`, a whole number, is,
/// also one that its bits do not hold; nothing for other signals and texts.
[[nodiscard]] std::optional<std::uint64_t> exact_integer(const Signal &signal,
                                                         const std::string &text);

/// Data with the signals of `texts`; others have their start values. Throws SignalError: a value
/// that is not possible, an unknown signal, one that is not selected, two that share bits, a signal
/// behind byte 8.
[[nodiscard]] FrameData encode(const SignalMessage &message, const SignalTexts &texts);

}  // namespace vericansim
