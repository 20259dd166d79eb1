// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputFile: whole or not at all, and every failed write is told.
#include "trace/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"
#include "harness/small_disk.hpp"
#include "trace/output_place.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vericansim;
using ::testing::HasSubstr;

/// The message and errno of the failure that `act` must end in.
void expect_failure(const std::function<void()> &act, const std::string &message, int code) {
  try {
    act();
    ADD_FAILURE() << "no failure; expected: " << message;
  } catch (const OutputError &error) {
    EXPECT_EQ(error.what(), message);
    EXPECT_EQ(error.code(), code);
  }
}

class OutputFileTest : public ScratchTest {
 protected:
  void write(const std::string &name, const std::string &text) const {
    OutputFile file{in(name)};
    file.stream() << text;
    file.commit();
  }
};

TEST_F(OutputFileTest, IsThereOnlyAfterCommit) {
  {
    OutputFile file{in("a")};
    file.stream() << "half" << std::flush;
    EXPECT_FALSE(fs::exists(in("a")));
    file.stream() << " and half\n";
    file.commit();
    EXPECT_EQ(tb::slurp(in("a")), "half and half\n");
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFileTest, WithoutCommitTheOldFileStays) {
  std::ofstream(in("a")) << "old";
  {
    OutputFile file{in("a")};
    file.stream() << "new";
    EXPECT_EQ(tb::slurp(in("a")), "old");
  }
  EXPECT_EQ(tb::slurp(in("a")), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(OutputFileTest, KeepsTheModeOfTheFileThatItReplaces) {
  std::ofstream(in("a")) << "old";
  ASSERT_EQ(::chmod(in("a").c_str(), 0640), 0);
  write("a", "new");
  struct stat status {};
  ASSERT_EQ(::stat(in("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST_F(OutputFileTest, NewFilesHaveTheUsersMask) {
  const mode_t before = ::umask(027);
  write("a", "new");
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(in("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0640U);
}

TEST_F(OutputFileTest, WritesThroughLinks) {
  fs::create_directories(in("other"));
  fs::create_symlink("other/new", in("dangling"));
  fs::create_symlink("dangling", in("twice"));
  write("twice", "text");
  EXPECT_TRUE(fs::is_symlink(in("twice")));
  EXPECT_TRUE(fs::is_symlink(in("dangling")));
  EXPECT_EQ(tb::slurp(in("other/new")), "text");
}

// As the kernel says of them; the links stay.
TEST_F(OutputFileTest, LinksThatLeadInACircleAreRefused) {
  fs::create_symlink("there", in("back"));
  fs::create_symlink("back", in("there"));
  for (const char *name : {"back", "there"}) {
    expect_failure([&] { OutputFile file{in(name)}; },
                   in(name) + ": cannot be opened for writing: Too many levels of symbolic links",
                   ELOOP);
    EXPECT_TRUE(fs::is_symlink(in(name)));
  }
  EXPECT_EQ(files(), 2U);
}

// What gunzip makes of it, and no name inside.
TEST_F(OutputFileTest, GzAtTheEndCompresses) {
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "line " + std::to_string(i) + "\n";
  write("a.log.gz", text);
  EXPECT_LT(fs::file_size(in("a.log.gz")), text.size() / 3);
  ASSERT_EQ(std::system(("gunzip -c " + in("a.log.gz") + " > " + in("a.log")).c_str()), 0);
  EXPECT_EQ(tb::slurp(in("a.log")), text);
}

TEST_F(OutputFileTest, AFinishedFileTakesItsPlace) {
  for (const char *name : {"plain", "packed.gz"}) {
    OutputFile file{in(name)};
    const std::string scratch = file.make_scratch();
    EXPECT_EQ(fs::path{scratch}.parent_path(), folder.path());
    EXPECT_TRUE(fs::exists(scratch)) << "somebody else could make it";
    std::ofstream(scratch) << "made by a library";
    file.commit(scratch);
  }
  EXPECT_EQ(tb::slurp(in("plain")), "made by a library");
  ASSERT_EQ(std::system(("gunzip -c " + in("packed.gz") + " > " + in("unpacked")).c_str()), 0);
  EXPECT_EQ(tb::slurp(in("unpacked")), "made by a library");
  EXPECT_EQ(files(), 3U);
}

// A process of another container may have this one's number, and write to the same folder.
TEST_F(OutputFileTest, FilesOfOthersStay) {
  constexpr unsigned kMost = 100;
  const auto foreign = [&](unsigned i) {
    return in(".verican-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".part");
  };
  for (unsigned i = 0; i < kMost; ++i) std::ofstream(foreign(i)) << "of somebody else";
  write("a", "text");
  EXPECT_EQ(files(), kMost + 1);
  for (unsigned i = 0; i < kMost; ++i) EXPECT_EQ(tb::slurp(foreign(i)), "of somebody else");
}

// Neither has two files of one name, and neither takes a name that is there.
TEST_F(OutputFileTest, FilesAsideHaveNamesOfTheirOwn) {
  OutputFile first{in("a")}, second{in("a")};
  const std::string one = first.make_scratch(), other = second.make_scratch();
  EXPECT_NE(one, other);
  EXPECT_EQ(files(), 4U);
  first.stream() << "first";
  second.stream() << "second";
  first.commit();
  EXPECT_EQ(tb::slurp(in("a")), "first");
  second.commit();
  EXPECT_EQ(tb::slurp(in("a")), "second");
}

// The next one that writes the same file removes what is left of a writer that was killed, and
// nothing else.
TEST_F(OutputFileTest, WhatAKilledWriterLeavesIsRemovedByTheNext) {
  for (const char *name : {"a", "b"}) {
    const pid_t writer = ::fork();
    if (writer == 0) {
      OutputFile file{in(name)};
      const std::string scratch = file.make_scratch();
      file.stream() << "half" << std::flush;
      ::raise(SIGKILL);
    }
    ASSERT_EQ(::waitpid(writer, nullptr, 0), writer);
  }
  EXPECT_EQ(files(), 4U);
  OutputFile other{in("a")};
  const std::string scratch = other.make_scratch();
  EXPECT_EQ(files(), 4U) << "two of b, two of the writer that lives";
  write("a", "whole");
  EXPECT_EQ(files(), 5U);
  EXPECT_TRUE(fs::exists(scratch));
  other.commit();
  fs::remove(scratch);
  write("b", "whole");
  EXPECT_EQ(files(), 2U);
}

// Also between the last byte and the name.
TEST_F(OutputFileTest, AFinishedFileThatIsNotInItsPlaceYetIsNotRemoved) {
  OutputPlace place{in("a")};
  ::close(place.descriptor());
  write("a", "other");
  place.rename();
  EXPECT_EQ(tb::slurp(in("a")), "");
}

TEST_F(OutputFileTest, PathsThatCannotBeWrittenAreRefusedAtOnce) {
  const auto open = [](const std::string &path) { return [path] { OutputFile file{path}; }; };
  expect_failure(open("/no/such/a"),
                 "/no/such/a: cannot be opened for writing: No such file or directory", ENOENT);
  expect_failure(open(folder.path()),
                 folder.path() + ": cannot be opened for writing: Is a directory", EISDIR);
  expect_failure(open(in("new/")), in("new/") + ": cannot be opened for writing: Is a directory",
                 EISDIR);
  std::ofstream(in("file")) << "";
  expect_failure(open(in("file/a")),
                 in("file/a") + ": cannot be opened for writing: Not a directory", ENOTDIR);
}

TEST_F(OutputFileTest, AReadOnlyFileIsNotReplaced) {
  std::ofstream(in("a")) << "old";
  ASSERT_EQ(::chmod(in("a").c_str(), 0444), 0);
  for (const std::string &way : {::testing::TempDir(), folder.path()})
    ASSERT_EQ(::chmod(way.c_str(), 0777), 0);
  constexpr uid_t kNobody = 65534;
  const uid_t before = ::geteuid();
  if (before == 0) {  // root may write everything
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  expect_failure([&] { OutputFile file{in("a")}; },
                 in("a") + ": cannot be opened for writing: Permission denied", EACCES);
  ASSERT_EQ(::seteuid(before), 0);
}

TEST_F(OutputFileTest, APlaceThatIsTakenMeanwhileIsNoticed) {
  OutputFile file{in("a")};
  fs::create_directories(in("a"));
  expect_failure([&] { file.commit(); }, in("a") + ": cannot be put in its place: Is a directory",
                 EISDIR);
}

TEST_F(OutputFileTest, AFullDeviceIsNoticed) {
  const std::string message = "/dev/full: cannot be written to its end: No space left on device";
  expect_failure(
      [] {
        OutputFile file{"/dev/full"};
        file.stream() << "short";
        file.commit();
      },
      message, ENOSPC);
  expect_failure(
      [] {
        OutputFile file{"/dev/full"};
        file.stream() << "a whole line\n";  // goes out at once
      },
      message, ENOSPC);
}

// Who caught the first failure learns of it again: at the next write, and at the end.
TEST_F(OutputFileTest, AFailureIsNotForgotten) {
  const std::string message = "/dev/full: cannot be written to its end: No space left on device";
  OutputFile file{"/dev/full"};
  expect_failure([&] { file.stream() << "a whole line\n"; }, message, ENOSPC);
  expect_failure([&] { file.stream() << "another\n"; }, message, ENOSPC);
  expect_failure([&] { file.commit(); }, message, ENOSPC);
}

// Bytes are missing although the disk has room again at the end.
TEST_F(OutputFileTest, AFailureIsNotForgottenWhenRoomComes) {
  const test::SmallDisk disk{in("disk"), 1024};
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const std::string message = disk.file("b") +
                              ": cannot be written to its end: "
                              "No space left on device";
  std::ofstream{disk.file("filler")} << std::string(900 * 1024, '-');
  OutputFile file{disk.file("b")};
  const std::string part(300 * 1024, '+');
  expect_failure([&] { file.stream() << part; }, message, ENOSPC);
  std::filesystem::remove(disk.file("filler"));
  expect_failure([&] { file.commit(); }, message, ENOSPC);
}

TEST_F(OutputFileTest, AFullDiskIsNoticedAndNothingIsLeft) {
  const test::SmallDisk disk{in("disk"), 64};
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  for (const char *name : {"a", "a.gz"}) {
    const std::string path = disk.file(name);
    expect_failure(
        [&] {
          OutputFile file{path};
          std::uint32_t noise = 1;  // does not get smaller
          for (int i = 0; i < 1'000'000; ++i)
            file.stream() << (noise = noise * 1664525 + 1013904223);
          file.commit();
        },
        path + ": cannot be written to its end: No space left on device", ENOSPC);
    EXPECT_EQ(disk.files(), 0U) << name;
  }
}

// The last bytes are written by commit() alone.
TEST_F(OutputFileTest, ADiskThatIsFullAtTheEndIsNoticed) {
  const test::SmallDisk disk{in("disk"), 64};
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  std::ofstream(disk.file("filler")) << std::string(64 << 10, 'x');
  expect_failure(
      [&] {
        OutputFile file{disk.file("a")};
        file.stream() << "text";
        file.commit();
      },
      disk.file("a") + ": cannot be written to its end: No space left on device", ENOSPC);
  EXPECT_EQ(disk.files(), 1U);
}

TEST_F(OutputFileTest, APipeIsWrittenToDirectly) {
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  std::string seen;
  std::thread reader{[&] { seen = tb::slurp(in("pipe")); }};
  write("pipe", "through the pipe\n");
  reader.join();
  EXPECT_EQ(seen, "through the pipe\n");
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
}

TEST_F(OutputFileTest, MinusIsTheStandardOutput) {
  for (const char *name : {"-", "/dev/stdout"}) {
    ::testing::internal::CaptureStdout();
    {
      OutputFile file{name};
      file.stream() << "text\n";
      file.commit();
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "text\n");
  }
}

}  // namespace
