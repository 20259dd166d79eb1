// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican linux without a kernel: what it says when there is nothing it can run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"

namespace {

using ::testing::HasSubstr;

class LinuxCommand : public vericansim::ScratchTest {
 protected:
  static tb::ToolResult tool(const std::string &arguments) {
    return tb::run_tool("linux " + arguments);
  }
  // Runs a shell script in the place of a kernel.
  tb::ToolResult kernel(const std::string &script, const std::string &more = "") const {
    const std::string path = file_with("kernel", std::string{"#!/bin/sh\n"} + script + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return tool("--kernel " + path + " --dtb /dev/null --init /bin/true " + more);
  }
};

TEST_F(LinuxCommand, NamesTheFileThatIsMissing) {
  tb::ToolResult result = tool("--kernel /no/kernel --dtb /dev/null --init /bin/true");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.error, "verican: --kernel: cannot read /no/kernel\n");
  result = tool("--kernel /bin/true --dtb /no/tree --init /bin/true");
  EXPECT_EQ(result.error, "verican: --dtb: cannot read /no/tree\n");
  result = tool("--kernel /bin/true --dtb /dev/null --init /bin/true --preload /no/library");
  EXPECT_EQ(result.error, "verican: --preload: cannot read /no/library\n");
  EXPECT_EQ(tool("--dtb /dev/null --init /bin/true").code, 2);
  EXPECT_EQ(kernel("exit 0", "--controllers 9").code, 2);
  EXPECT_EQ(kernel("exit 0", "--lean --time-unit").code, 2);
}

TEST_F(LinuxCommand, AProgramThatIsNoKernelIsFoundOut) {
  const tb::ToolResult result = kernel("exit 0");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("is no user-mode Linux with time-travel support"));
}

TEST_F(LinuxCommand, AKernelThatFailsFailsTheRun) {
  const tb::ToolResult result = kernel("exit 3");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("the guest kernel ended with code 3"));
}

TEST_F(LinuxCommand, AKernelThatNeverEndsIsEnded) {
  const tb::ToolResult result = kernel("sleep 1000", "--timeout 1");
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.error, HasSubstr("the guest did not end within 1 s"));
}

TEST_F(LinuxCommand, TheKernelIsToldWhatItNeeds) {
  const tb::ToolResult result =
      kernel("echo $* >" + in("words") + "; exit 1", "--memory 32M --dir /tmp -- VERICAN_X=1");
  EXPECT_EQ(result.code, 1);
  std::ifstream file(in("words"));
  const std::string words{std::istreambuf_iterator<char>(file), {}};
  for (const char *word :
       {"mem=32M", "rootfstype=hostfs", "init=/bin/true", "dtb=/dev/null",
        "time-travel=ext:", "VERICAN_SOCKETS=", "VERICAN_DIR=/tmp", "VERICAN_X=1"})
    EXPECT_THAT(words, HasSubstr(word));
}

}  // namespace
