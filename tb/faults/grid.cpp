// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Grid: see grid.hpp.
#include "faults/grid.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace vericansim {

Grid::Grid(std::string name, std::vector<Axis> axes)
    : name_{std::move(name)}, axes_{std::move(axes)} {
  for (const Axis &axis : axes_) size_ *= axis.values.size();
}

Grid::Digits Grid::digits(std::size_t index) const {
  if (index >= size_) throw std::out_of_range(name_ + " has no case " + std::to_string(index));
  Digits digits(axes_.size());
  for (std::size_t i = axes_.size(); i-- > 0;) {
    digits[i] = index % axes_[i].values.size();
    index /= axes_[i].values.size();
  }
  return digits;
}

std::string Grid::id(std::size_t index) const {
  const Digits at = digits(index);
  std::string text = name_;
  for (std::size_t i = 0; i < at.size(); ++i) text += "/" + axes_[i].values[at[i]];
  return text;
}

std::optional<std::size_t> Grid::find(std::string_view id) const {
  const auto next = [&id] {
    const std::size_t end = std::min(id.find('/'), id.size());
    const std::string_view part = id.substr(0, end);
    id.remove_prefix(std::min(end + 1, id.size()));
    return part;
  };
  if (next() != name_) return std::nullopt;
  std::size_t index = 0;
  for (const Axis &axis : axes_) {
    const auto value = std::find(axis.values.begin(), axis.values.end(), next());
    if (value == axis.values.end()) return std::nullopt;
    index = index * axis.values.size() + static_cast<std::size_t>(value - axis.values.begin());
  }
  if (!id.empty()) return std::nullopt;
  return index;
}

Spread::Spread(std::size_t size, std::size_t count)
    : size_{size}, step_{size * 618 / 1000}, count_{std::min(size, count)} {
  while (size_ > 1 && std::gcd(size_, std::max<std::uint64_t>(step_, 1)) != 1) ++step_;
}

std::size_t Spread::at(std::size_t i) const {
  return count_ == size_ ? i : static_cast<std::size_t>((i + 1) * step_ % size_);
}

}  // namespace vericansim
