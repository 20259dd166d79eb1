// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Grid: all combinations of the values of some axes, numbered and named; and an even sample of
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vericansim {

/// One axis: what varies and the names of its values. A name holds no '/'.
struct Axis {
  std::string name;
  std::vector<std::string> values;
};

/// The product of its axes. Case 0 has the first value of every axis; the last axis varies fastest.
class Grid {
 public:
  using Digits = std::vector<std::size_t>;

  Grid(std::string name, std::vector<Axis> axes);

  [[nodiscard]] const std::string &name() const { return name_; }
  [[nodiscard]] const std::vector<Axis> &axes() const { return axes_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Position of each axis' value in case `index`.
  [[nodiscard]] Digits digits(std::size_t index) const;
  /// Name of a case: <grid>/<value>/<value>...
  [[nodiscard]] std::string id(std::size_t index) const;
  /// The case of that name; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view id) const;

 private:
  std::string name_;
  std::vector<Axis> axes_;
  std::size_t size_ = 1;
};

/// `count` different numbers below `size`, spread evenly over it and in no step with any axis:
/// multiples of a number near the golden section of `size` that has no factor in common with it.
/// All of them if `count` is `size` or more.
class Spread {
 public:
  Spread(std::size_t size, std::size_t count);
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t at(std::size_t i) const;

 private:
  std::uint64_t size_;
  std::uint64_t step_;
  std::size_t count_;
};

}  // namespace vericansim
