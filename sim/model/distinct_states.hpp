// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DistinctStates: buffer states, each once. A CPU that leaves much open has hundreds of them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "model/buffer_state.hpp"

namespace vericansim {

/// States in the order in which they came, each once.
class DistinctStates {
 public:
  void add(BufferState state) {
    if (!states_.empty() && known(state)) return;
    states_.push_back(std::move(state));
  }
  [[nodiscard]] std::size_t size() const { return states_.size(); }
  [[nodiscard]] const BufferState &operator[](std::size_t i) const { return states_[i]; }
  /// The states; none are left here.
  [[nodiscard]] std::vector<BufferState> take() {
    digests_.clear();
    return std::exchange(states_, {});
  }

 private:
  // Leaves the digest of a state that is new. The first one's waits until there is a second.
  bool known(const BufferState &state) {
    if (digests_.empty()) digests_.push_back(states_.front().digest());
    const std::uint64_t digest = state.digest();
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (digests_[i] == digest && states_[i] == state) return true;
    digests_.push_back(digest);
    return false;
  }

  std::vector<BufferState> states_;
  std::vector<std::uint64_t> digests_;
};

}  // namespace vericansim
