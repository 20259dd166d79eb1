// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The experiments of the paper that this core follows (Son, Park, Kang 2016), repeated and compared
// with it.
#pragma once

#include <string>
#include <vector>

namespace vericansim {

/// One statement of the paper beside what the simulation has shown.
struct PaperCheck {
  std::string figure;    ///< "11" to "18"
  std::string reported;  ///< by the paper, in our words
  std::string seen;
  bool ok = false;
};

/// One experiment: its statements and its waveform.
struct PaperExperiment {
  std::string name;
  std::string wave;  ///< file, empty if none was asked for
  std::vector<PaperCheck> checks;
};

/// Runs all experiments at 50 kbit/s, 10 quanta of 2 us a bit (PROP 5, PS1 2, PS2 2, sample point
/// 80 %) and writes a waveform of each below `folder` ("" for none). `suffix` is ".vcd" or ".fst".
/// Throws InputError if a file cannot be written.
[[nodiscard]] std::vector<PaperExperiment> run_paper(const std::string &folder,
                                                     const std::string &suffix);

}  // namespace vericansim
