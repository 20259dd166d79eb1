// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The experiments of the paper that this core follows (Son, Park, Kang 2016), repeated and compared
// with it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// One statement of the paper beside what the simulation has shown.
struct PaperCheck {
  std::string figure;    ///< "11" to "18"
  std::string reported;  ///< by the paper, in our words
  std::string seen;
  bool ok = false;
  std::optional<Time> time = {};  ///< of the bus, ps: the moment that shows it
};

/// Files of an experiment, empty: none.
struct PaperFiles {
  std::string wave;  ///< .vcd or .fst
  std::string page;  ///< HTML (docs/report.md)
};

/// One experiment: its statements and its files.
struct PaperExperiment {
  std::string name;
  PaperFiles files;
  std::vector<PaperCheck> checks = {};
};

/// Where the experiments write, and what.
struct PaperOutputs {
  std::string wave_folder = {};  ///< empty: no waveforms
  std::string suffix = ".vcd";   ///< of the waveforms, or ".fst"
  std::string page_folder = {};  ///< empty: no pages
};

/// Runs all experiments at 50 kbit/s, 10 quanta of 2 us a bit (PROP 5, PS1 2, PS2 2, sample point
/// 80 %) and writes a waveform and a page of each; folders are created. When
/// the user wants the end (stop_request.hpp), those that are done are all. Throws InputError if a
/// file cannot be written.
[[nodiscard]] std::vector<PaperExperiment> run_paper(const PaperOutputs &outputs);

}  // namespace vericansim
