// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican linux without a kernel: what it says when there is nothing it can run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using ::testing::HasSubstr;

struct Result {
  int code = -1;
  std::string error;
};

class LinuxCommand : public ::testing::Test {
 protected:
  LinuxCommand() {
    std::string path = (std::filesystem::temp_directory_path() / "cli-XXXXXX").string();
    directory = ::mkdtemp(path.data());
  }
  ~LinuxCommand() override { std::filesystem::remove_all(directory); }

  Result tool(const std::string &arguments) const {
    const std::string log = directory + "/error";
    const int status = std::system(
        (std::string(VERICAN_BINARY) + " linux " + arguments + " >/dev/null 2>" + log).c_str());
    std::ifstream file(log);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            {std::istreambuf_iterator<char>(file), {}}};
  }
  // Runs a shell script in the place of a kernel.
  Result kernel(const std::string &script, const std::string &more = "") const {
    const std::string path = directory + "/kernel";
    std::ofstream(path) << "#!/bin/sh\n" << script << '\n';
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return tool("--kernel " + path + " --dtb /dev/null --init /bin/true " + more);
  }

  std::string directory;
};

TEST_F(LinuxCommand, NamesTheFileThatIsMissing) {
  Result result = tool("--kernel /no/kernel --dtb /dev/null --init /bin/true");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.error, "verican: --kernel: cannot read /no/kernel\n");
  result = tool("--kernel /bin/true --dtb /no/tree --init /bin/true");
  EXPECT_EQ(result.error, "verican: --dtb: cannot read /no/tree\n");
  result = tool("--kernel /bin/true --dtb /dev/null --init /bin/true --preload /no/library");
  EXPECT_EQ(result.error, "verican: --preload: cannot read /no/library\n");
  EXPECT_EQ(tool("--dtb /dev/null --init /bin/true").code, 2);
  EXPECT_EQ(kernel("exit 0", "--controllers 9").code, 2);
}

TEST_F(LinuxCommand, AProgramThatIsNoKernelIsFoundOut) {
  const Result result = kernel("exit 0");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("is no user-mode Linux with time-travel support"));
}

TEST_F(LinuxCommand, AKernelThatFailsFailsTheRun) {
  const Result result = kernel("exit 3");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("the guest kernel ended with code 3"));
}

TEST_F(LinuxCommand, AKernelThatNeverEndsIsEnded) {
  const Result result = kernel("sleep 1000", "--timeout 1");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("the guest did not end within 1 s"));
}

TEST_F(LinuxCommand, TheKernelIsToldWhatItNeeds) {
  const Result result =
      kernel("echo $* >" + directory + "/words; exit 1", "--memory 32M --dir /tmp -- VERICAN_X=1");
  EXPECT_EQ(result.code, 1);
  std::ifstream file(directory + "/words");
  const std::string words{std::istreambuf_iterator<char>(file), {}};
  for (const char *word :
       {"mem=32M", "rootfstype=hostfs", "init=/bin/true", "dtb=/dev/null",
        "time-travel=ext:", "VERICAN_SOCKETS=", "VERICAN_DIR=/tmp", "VERICAN_X=1"})
    EXPECT_THAT(words, HasSubstr(word));
}

}  // namespace
