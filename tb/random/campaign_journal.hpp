// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CampaignJournal: what a random campaign has done so far, so that it can be interrupted.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "random/judged_run.hpp"

namespace vericansim {

/// One line of JSON for every seed that passed. A seed that failed is not in it: it runs again.
class CampaignJournal {
 public:
  /// Begins the file `path` anew; with `resume` takes over what it holds if it was written under
  /// the same `key`. A last line that was cut off is dropped. Throws std::runtime_error if the file
  /// cannot be written.
  CampaignJournal(const std::string &path, const std::string &key, bool resume);
  /// The same with what the files `sources` hold, journals of the campaign's shards.
  CampaignJournal(const std::string &path, const std::string &key,
                  const std::vector<std::string> &sources);

  /// Seeds that passed before.
  [[nodiscard]] const std::map<std::uint64_t, JudgedRun> &before() const { return before_; }
  /// Wall time that the campaign had taken before.
  [[nodiscard]] double seconds_before() const { return seconds_before_; }

  /// Seed `seed` has passed; `seconds`: wall time of the campaign in all.
  void add(std::uint64_t seed, const JudgedRun &run, double seconds);

 private:
  void take_over(const std::string &path, const std::string &key);
  void write(std::uint64_t seed, const JudgedRun &run, double seconds);

  std::map<std::uint64_t, JudgedRun> before_;
  double seconds_before_ = 0;
  std::ofstream file_;
};

/// A key of the program that runs: results of another build do not count.
/// Throws std::runtime_error if it cannot be read.
[[nodiscard]] std::string program_key();

}  // namespace vericansim
