// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs packed by gzip itself, damaged ones, and those that are no files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/input_file.hpp"
#include "trace/log.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

std::string error_of(const std::string &path) {
  return input_error_of([&] { return read_text_file(path); });
}

TEST(InputFile, GzipIsUnpackedWhateverTheName) {
  const ScratchFolder folder;
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += "(1.0) can0 123#" + std::to_string(10 + i % 90) + "\n";
  const std::string path = folder.file("log", text);
  ASSERT_EQ(shell("gzip -9 < " + path + " > " + path + ".packed").code, 0);
  EXPECT_EQ(read_text_file(path + ".packed"), text);
  EXPECT_EQ(read_log(path + ".packed").entries.size(), 50'000U);
  // Two packed files one behind the other are their texts one behind the other.
  ASSERT_EQ(shell("cat " + path + ".packed " + path + ".packed > " + path + ".two").code, 0);
  EXPECT_EQ(read_text_file(path + ".two"), text + text);
}

TEST(InputFile, DamagedGzipIsOneLine) {
  const ScratchFolder folder;
  const std::string path = folder.file("log", std::string(1000, 'x') + "end\n");
  ASSERT_EQ(shell("gzip < " + path + " > " + path + ".gz").code, 0);
  const std::string packed = shell("cat " + path + ".gz").text;
  for (std::size_t cut = 2; cut < packed.size(); ++cut)
    EXPECT_THAT(error_of(folder.file("cut.gz", packed.substr(0, cut))), HasSubstr("(gzip)")) << cut;
  std::string wrong = packed;
  wrong[packed.size() - 8] ^= 1;  // the sum of the bytes
  EXPECT_EQ(error_of(folder.file("wrong.gz", wrong)), folder / "wrong.gz: damaged (gzip)");
}

TEST(InputFile, WhatIsNoFileIsRefused) {
  const ScratchFolder folder;
  EXPECT_THAT(error_of(folder / "none"), HasSubstr("none: no such file"));
  EXPECT_THAT(error_of(folder / "."), HasSubstr("is a directory"));
  EXPECT_EQ(without_gz("a.log.gz"), "a.log");
  EXPECT_EQ(without_gz("a.log"), "a.log");
}

}  // namespace
}  // namespace vericansim
