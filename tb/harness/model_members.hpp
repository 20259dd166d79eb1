// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ModelMembers: whether two Verilated models of one kind have the same bits in every member.
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

namespace vericansim {

template <typename Root>
class ModelMembers {
 public:
  /// Of two models that are known to be in the same state: the bytes in which they differ are
  /// pointers, or lie between the members.
  ModelMembers(const Root &one, const Root &other) {
    const auto a = bytes(one), b = bytes(other);
    for (std::size_t i = 0; i < a.size(); ++i) shared_.push_back(a[i] == b[i]);
  }

  [[nodiscard]] bool same(const Root &one, const Root &other) const {
    const auto a = bytes(one), b = bytes(other);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (shared_[i] && a[i] != b[i]) return false;
    return true;
  }

 private:
  // Without those that only say how the model was evaluated last.
  static std::vector<unsigned char> bytes(const Root &root) {
    std::vector<unsigned char> result(sizeof(Root));
    std::memcpy(result.data(), static_cast<const void *>(&root), sizeof(Root));
    const auto clear = [&](const auto &member) {
      const auto *begin = reinterpret_cast<const unsigned char *>(&root);
      const auto at = reinterpret_cast<const unsigned char *>(&member) - begin;
      std::memset(result.data() + at, 0, sizeof(member));
    };
    clear(root.__VnbaTriggered);
    clear(root.__VactTriggered);
    clear(root.__VicoTriggered);
    clear(root.__VicoIterCount);
    clear(root.__VactIterCount);
    return result;
  }

  std::vector<bool> shared_;
};

}  // namespace vericansim
