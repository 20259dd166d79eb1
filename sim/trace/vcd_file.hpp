// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VcdFile: reads one-bit signals of a VCD waveform, whoever wrote it.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// A declared variable.
struct VcdSignal {
  std::string name;    ///< with its modules and index, "top.node.rx", "top.pins[3]"
  std::string type;    ///< "wire", "reg", "string", ...
  unsigned width = 1;  ///< bits
  std::string code;    ///< identifier code of the value changes
};

/// A VCD file, read into memory; the header is parsed by the constructor.
class VcdFile {
 public:
  using OnChange = std::function<void(Time, Level)>;

  /// Throws InputError if the file cannot be read or its header is broken.
  explicit VcdFile(std::string path);
  /// Parses `text` as if it stood in the file `path`.
  VcdFile(std::string path, std::string text);

  [[nodiscard]] const std::vector<VcdSignal> &signals() const { return signals_; }

  /// The signal called `name`: the full name, or the end of exactly one ("rx", "node.rx"), with its
  /// index or without. Throws InputError that lists the signals if there is none or more than one,
  /// or if it is no single bit.
  [[nodiscard]] const VcdSignal &find(const std::string &name) const;
  /// The signal that is most likely the bus: the only one-bit signal, or one called can, can_bus,
  /// can_rx, rx... Throws InputError if there is no such signal.
  [[nodiscard]] const VcdSignal &guess_bus() const;

  /// Calls `change` for each change of the signal in the order of time; returns the time of the
  /// end, ps. 'x' and 'z' count as recessive: nobody drives; so does a signal without a value from
  /// the first time of the file on; 'L' as dominant. Throws InputError on what is no value change
  /// of a declared variable, also of one that is not asked for.
  Time read(const VcdSignal &signal, const OnChange &change) const;

 private:
  [[nodiscard]] Time stamp(std::string_view word, Time now, std::size_t line) const;
  void parse_header();
  void parse_var(const std::vector<std::string_view> &words, std::size_t line);
  [[noreturn]] void fail_with_list(const std::string &message) const;

  std::string path_;
  std::string text_;
  std::size_t body_ = 0;       // offset behind $enddefinitions $end
  std::size_t body_line_ = 1;  // its line
  Time unit_ = 0;              // ps; 0 until $timescale is seen
  Time fraction_ = 1;          // for femtosecond scales: ticks per ps
  std::vector<std::string> scopes_;
  std::vector<VcdSignal> signals_;
};

}  // namespace vericansim
