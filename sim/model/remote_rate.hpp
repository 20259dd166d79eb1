// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteRate: the search for the bit rate of a bus that one only listens to (RN-73).
#pragma once

namespace vericansim {

/// Which row of the rate table is tried.
class RemoteRate {
 public:
  /// `rows`: of the table, 1 or more; the first is tried first.
  explicit RemoteRate(unsigned rows) : rows_{rows} {}

  [[nodiscard]] unsigned row() const { return row_; }
  void restart() { *this = RemoteRate{rows_}; }
  /// An error was seen: the second without a valid frame leads to the next row.
  void error() {
    if (++errors_ < 2) return;
    row_ = (row_ + 1) % rows_;
    errors_ = valid_ = 0;
  }
  /// A valid frame was seen. True: it was the second, the row is right.
  [[nodiscard]] bool frame() {
    errors_ = 0;
    return ++valid_ >= 2;
  }

 private:
  unsigned rows_;
  unsigned row_ = 0;
  unsigned errors_ = 0;
  unsigned valid_ = 0;
};

}  // namespace vericansim
