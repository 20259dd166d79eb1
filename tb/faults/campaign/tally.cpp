// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Tally: see tally.hpp.
#include "faults/campaign/tally.hpp"

#include <utility>

namespace vericansim {

void Tally::add(const Grid &grid, std::size_t index, Outcome outcome) {
  const bool failed = !outcome.report.empty();
  const Key key{grid.name(), std::move(outcome.role), std::move(outcome.state),
                std::move(outcome.position), std::move(outcome.reaction)};
  counts_[key].add({1, failed ? 1u : 0u});
  if (failed && failures_.size() < kKeptFailures) {
    failures_.push_back({grid.id(index), std::move(outcome.report)});
  }
}

void Tally::merge(const Tally &other) {
  for (const auto &[key, count] : other.counts_) counts_[key].add(count);
  for (const Failure &failure : other.failures_) add(failure);
}

void Tally::add(Failure failure) {
  if (failures_.size() < kKeptFailures) failures_.push_back(std::move(failure));
}

Count Tally::total() const {
  Count sum;
  for (const auto &[key, count] : counts_) sum.add(count);
  return sum;
}

std::map<std::pair<std::string, std::string>, Count> Tally::by(std::size_t row,
                                                               std::size_t column) const {
  std::map<std::pair<std::string, std::string>, Count> sums;
  for (const auto &[key, count] : counts_) sums[{key[row], key[column]}].add(count);
  return sums;
}

}  // namespace vericansim
