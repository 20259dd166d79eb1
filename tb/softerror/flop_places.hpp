// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FlopPlaces: where the flip-flops of a Verilated model lie in its root. Who has the model fills it
// with the lines of its flops.inc (tools/softerror/flops.py).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace vericansim {

/// One flip, or a flip-flop that is stuck.
struct FlopFlip {
  unsigned flop = 0;          ///< of the model's FlopPlaces
  std::uint64_t clock = 0;    ///< since the node's first
  std::optional<bool> stuck;  ///< at this level from then on
};

class FlopPlaces {
 public:
  /// The bits of a variable at `offset` of the root that `mask` has.
  void add(const char *name, std::size_t offset, std::uint64_t mask) {
    for (unsigned bit = 0; bit < 64; ++bit) {
      if ((mask >> bit & 1) == 0) continue;
      places_.push_back({offset + bit / 8, static_cast<unsigned char>(1U << bit % 8)});
      names_.push_back(std::string{name} + "[" + std::to_string(bit) + "]");
    }
  }

  /// Names of all flip-flops, each with its bit, in the order of flops.py.
  [[nodiscard]] const std::vector<std::string> &names() const { return names_; }
  /// The number of the flip-flop of that name; std::invalid_argument if there is none.
  [[nodiscard]] unsigned number_of(const std::string &name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end())
      throw std::invalid_argument("--flop " + name + ": there is no such flip-flop; for example " +
                                  names_.front());
    return static_cast<unsigned>(found - names_.begin());
  }
  /// Of the model whose root this is.
  [[nodiscard]] bool value(const void *root, unsigned flop) const {
    return (*byte_of(const_cast<void *>(root), flop) & places_.at(flop).bit) != 0;
  }
  /// What depends on it is to be settled behind it.
  void flip(void *root, unsigned flop) const { *byte_of(root, flop) ^= places_.at(flop).bit; }

 private:
  struct Place {
    std::size_t offset;
    unsigned char bit;
  };
  [[nodiscard]] unsigned char *byte_of(void *root, unsigned flop) const {
    return static_cast<unsigned char *>(root) + places_.at(flop).offset;
  }

  std::vector<Place> places_;
  std::vector<std::string> names_;
};

}  // namespace vericansim
