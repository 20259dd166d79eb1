// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ScratchTest: a test with a folder of its own.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "harness/scratch_folder.hpp"

namespace vericansim {

/// The fixture of tests that read and write files.
class ScratchTest : public ::testing::Test {
 protected:
  /// The path of `name` in the test's folder.
  [[nodiscard]] std::string in(const std::string &name) const { return folder / name; }
  /// Writes a file there; returns its path.
  std::string file_with(const std::string &name, const std::string &text) const {
    return folder.file(name, text);
  }
  /// Number of files there, hidden ones too.
  [[nodiscard]] std::size_t files() const { return folder.files(); }

  ScratchFolder folder;
};

}  // namespace vericansim
