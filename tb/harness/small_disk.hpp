// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SmallDisk: a file system that is soon full.
#pragma once

#include <string>

namespace vericansim::test {

/// A memory file system on an empty folder, seen by this process and its children alone.
class SmallDisk {
 public:
  /// `kilobytes`: its size, a multiple of a page. `folder` is created.
  SmallDisk(const std::string &folder, unsigned kilobytes);
  ~SmallDisk();
  SmallDisk(const SmallDisk &) = delete;
  SmallDisk &operator=(const SmallDisk &) = delete;

  /// False where this process may not mount; why() says so then.
  [[nodiscard]] bool mounted() const { return why_.empty(); }
  [[nodiscard]] const std::string &why() const { return why_; }
  /// Path of a file on it.
  [[nodiscard]] std::string file(const std::string &name) const { return folder_ + "/" + name; }
  /// Number of files on it, hidden ones too.
  [[nodiscard]] std::size_t files() const;

 private:
  std::string folder_;
  std::string why_;
};

}  // namespace vericansim::test
