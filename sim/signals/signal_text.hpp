// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Signals for people.
#pragma once

#include <string>
#include <vector>

#include "signals/signal_codec.hpp"

namespace vericansim {

/// A physical value of the signal, with as many decimals as it has and no more.
[[nodiscard]] std::string number_text(const Signal &signal, double value);
/// The same for a value that was decoded: all digits of integers of 64 bits.
[[nodiscard]] std::string number_text(const SignalValue &value);
/// "2400 rpm", or the choice "Sport".
[[nodiscard]] std::string to_text(const SignalValue &value);
/// "EngineData(EngineSpeed: 2400 rpm, Mode: Sport)".
[[nodiscard]] std::string to_text(const SignalMessage &message,
                                  const std::vector<SignalValue> &values);
/// "0 to 16383.75 rpm in steps of 0.25, Off, Sport".
[[nodiscard]] std::string allowed_values(const Signal &signal);
/// Names with commas between.
[[nodiscard]] std::string signal_names(const SignalMessage &message);

}  // namespace vericansim
