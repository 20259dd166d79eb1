// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Inputs packed by gzip itself, damaged ones, and those that are no files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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
  // As gzip does it: what fills the last block of a tape is no third one.
  ASSERT_EQ(shell("head -c 512 /dev/zero >> " + path + ".two").code, 0);
  EXPECT_EQ(read_text_file(path + ".two"), text + text);
}

// Editors of Windows put one in front of a text.
TEST(InputFile, AByteOrderMarkIsLeftOut) {
  const ScratchFolder folder;
  const std::string path = folder.file("bom.log", "\xEF\xBB\xBF(1.0) can0 123#11\n");
  EXPECT_EQ(read_text_file(path), "(1.0) can0 123#11\n");
  EXPECT_EQ(read_log(path).entries.size(), 1U);
  EXPECT_EQ(read_bytes(path).size(), 21U);
}

TEST(InputFile, DamagedGzipIsOneLine) {
  const ScratchFolder folder;
  const std::string path = folder.file("log", std::string(1000, 'x') + "end\n");
  ASSERT_EQ(shell("gzip < " + path + " > " + path + ".gz").code, 0);
  const std::string packed = shell("cat " + path + ".gz").text;
  for (std::size_t cut = 2; cut < packed.size(); ++cut)
    EXPECT_EQ(error_of(folder.file("cut.gz", packed.substr(0, cut))),
              folder / "cut.gz: cut short (gzip)")
        << cut;
  std::string wrong = packed;
  wrong[packed.size() - 8] ^= 1;  // the sum of the bytes
  EXPECT_EQ(error_of(folder.file("wrong.gz", wrong)), folder / "wrong.gz: damaged (gzip)");
  // What was appended without packing it, also behind what fills a block.
  for (const std::string &more : {std::string("(2.0) can0 123#22\n"), std::string(9, '\0') + "x"})
    EXPECT_EQ(error_of(folder.file("more.gz", packed + more)),
              folder / "more.gz: what follows the packed bytes is not packed (gzip)");
}

TEST(InputFile, UnpacksUpToALimit) {
  const ScratchFolder folder;
  const std::string path = folder.file("log", std::string(3 << 20, 'x'));
  ASSERT_EQ(shell("gzip " + path).code, 0);
  const std::string packed = shell("cat " + path + ".gz").text;
  EXPECT_EQ(unpacked(packed, "a.gz", 3 << 20).size(), 3U << 20);
  EXPECT_EQ(input_error_of([&] { return unpacked(packed, "a.gz", 2 << 20); }),
            "a.gz: unpacks to more than 2 MiB (gzip)");
}

// A device may never end: what is read is bounded, to the byte.
TEST(InputFile, WhatNeverEndsIsRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("log", std::string(1 << 20, 'x'));
  EXPECT_EQ(read_text_file(path, 1 << 20).size(), 1U << 20);
  EXPECT_EQ(input_error_of([&] { return read_text_file(path, (1 << 20) - 1); }),
            path + ": has more than 1048575 bytes");
  EXPECT_EQ(input_error_of([] { return read_text_file("/dev/zero", 3 << 20); }),
            "/dev/zero: has more than 3145728 bytes");
}

TEST(InputFile, WhatIsPackedHasTheSameLimit) {
  const ScratchFolder folder;
  const std::string path = folder.file("log", std::string(3 << 20, 'x'));
  ASSERT_EQ(shell("gzip " + path).code, 0);
  EXPECT_EQ(input_error_of([&] { return read_text_file(path + ".gz", 2 << 20); }),
            path + ".gz: unpacks to more than 2 MiB (gzip)");
}

TEST(InputFile, AReadThatFailsIsNoEnd) {
  EXPECT_EQ(error_of("/proc/self/mem"), "/proc/self/mem: cannot be read to its end");
}

TEST(InputFile, BytesAreNotUnpacked) {
  const ScratchFolder folder;
  const std::string image = "\x1f\x8b rows of a memory";
  EXPECT_EQ(read_bytes(folder.file("image", image)), image);
}

TEST(InputFile, AFileThatMayNotBeReadIsRefused) {
  const ScratchFolder folder;
  const std::string path = folder.file("secret", "x");
  ASSERT_EQ(::chmod(path.c_str(), 0), 0);
  for (const std::string &way : {::testing::TempDir(), folder.path()})
    ASSERT_EQ(::chmod(way.c_str(), 0755), 0);
  constexpr uid_t kNobody = 65534;
  const uid_t before = ::geteuid();
  if (before == 0) {  // root may read everything
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  EXPECT_EQ(error_of(path), path + ": cannot be opened for reading: Permission denied");
  ASSERT_EQ(::seteuid(before), 0);
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
