// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WaveSink: where waveforms go; VCD and FST files are two kinds of it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "bus/types.hpp"

namespace vericansim {

/// Receives declarations first, then changes in the order of time.
class WaveSink {
 public:
  using Signal = unsigned;

  virtual ~WaveSink() = default;

  /// Declares a vector of `width` bits (1..64) below the module `scope`; only before start().
  virtual Signal add_wire(const std::string &scope, const std::string &name, unsigned width) = 0;
  /// Declares a text that waveform viewers show beside the wires; only before start().
  virtual Signal add_text(const std::string &scope, const std::string &name) = 0;
  /// Ends the declarations.
  virtual void start() = 0;
  /// A signal has a new value from `time` on; `time` may not go back.
  virtual void set(Time time, Signal signal, std::uint64_t value) = 0;
  virtual void set(Time time, Signal signal, std::string_view text) = 0;
  /// Marks the end of time and puts the file in its place, where it is not before; nothing may
  /// follow.
  virtual void finish(Time time) = 0;
};

/// A VCD file. Texts are `$var string` (GTKWave), blanks in them become '_'. `unit` is the
/// timescale in picoseconds: 1, 10, 100, ... Throws OutputError, its methods too.
[[nodiscard]] std::unique_ptr<WaveSink> open_vcd(const std::string &path, Time unit = kNanosecond);

/// An FST file, compressed, with a resolution of 1 ps. Throws OutputError, its methods too.
[[nodiscard]] std::unique_ptr<WaveSink> open_fst(const std::string &path);

}  // namespace vericansim
