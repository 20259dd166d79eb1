// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Many flips: jobs, each a world run up to a random moment and then, in a process of its own for
// each flip, from there on.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "softerror/experiment.hpp"
#include "softerror/verdict.hpp"

namespace vericansim {

/// A flip's outcome and its class.
struct Record {
  Outcome outcome;
  Verdict verdict = Verdict::kGone;
};

/// One moment of one world, and what is flipped there.
struct Job {
  std::uint64_t seed = 0;
  std::optional<std::uint64_t> time;  ///< clocks; empty: chosen by the seed
  std::vector<Flip> flips;
  std::string wave;  ///< VCD file of the (last) flip; empty: none
};

/// Jobs in which every flip-flop is flipped `rounds` times, each time in another job, and so many
/// RAM bits in each; `share` (0 to 1] keeps only a part of the jobs.
[[nodiscard]] std::vector<Job> plan_jobs(std::uint64_t seed, double share);

/// Runs one job. Throws std::runtime_error if a run without a flip is not clean or a process dies.
[[nodiscard]] std::vector<Record> run_job(const Job &job);

/// Runs them all in `processes` processes that keep their results in `scratch`; prints how far it
/// is. The records are in the order of the jobs' seeds.
[[nodiscard]] std::vector<Record> run_jobs(const std::vector<Job> &jobs, unsigned processes,
                                           const std::string &scratch);

/// A file with records, for a run of the same program. Both throw std::runtime_error if it cannot
/// be written or read.
void write_records(const std::vector<Record> &records, const std::string &path);
/// Records of several such files, in the order of the jobs' seeds.
[[nodiscard]] std::vector<Record> read_records(const std::vector<std::string> &paths);

}  // namespace vericansim
