// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican linux without a kernel: what it says when there is nothing it can run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/tool_run.hpp"
#include "harness/scoped_env.hpp"
#include "harness/scratch_test.hpp"
#include "harness/shell.hpp"
#include "system/running_tool.hpp"

namespace {

using ::testing::AllOf;
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
  result = kernel("exit 0", "--dir /no/directory");
  EXPECT_EQ(result.error, "verican: --dir: /no/directory is no directory\n");
  EXPECT_EQ(kernel("exit 0", "--controllers 9").code, 2);
  EXPECT_EQ(kernel("exit 0", "--lean --time-unit").code, 2);
}

TEST_F(LinuxCommand, WhatCannotBeRunIsRefused) {
  const auto refusal = [&](const std::string &arguments) {
    const tb::ToolResult result = tool("--dtb /dev/null --init /bin/true " + arguments);
    EXPECT_EQ(result.code, 2) << arguments;
    return result.error;
  };
  const std::string text = file_with("text", "hello");
  EXPECT_EQ(refusal("--kernel " + text),
            "verican: --kernel: " + text + " is no program: it may not be executed\n");
  std::filesystem::permissions(text, std::filesystem::perms::owner_all);
  EXPECT_EQ(refusal("--kernel " + text),
            "verican: --kernel: cannot run " + text + ": Exec format error\n");
  EXPECT_EQ(refusal("--kernel /tmp"), "verican: --kernel: /tmp is a directory; allowed: a file\n");
  EXPECT_EQ(refusal("--kernel /bin/true --preload /tmp"),
            "verican: --preload: /tmp is a directory; allowed: a file\n");
  EXPECT_THAT(refusal("--kernel /bin/true --access-logs"),
              AllOf(HasSubstr("--access-logs"), HasSubstr("--dir")));
  EXPECT_EQ(refusal("--kernel /bin/true --clock-ppm 1,2,3"),
            "verican: --clock-ppm: 3 errors of 2 clocks; allowed: as many as --controllers, or "
            "fewer\n");
}

TEST_F(LinuxCommand, ASignalEndsTheGuestAndLeavesNothing) {
  const std::filesystem::path before = std::filesystem::temp_directory_path();
  for (const int signal : {SIGINT, SIGTERM}) {
    const std::string path =
        file_with("kernel", "#!/bin/sh\nsleep 1000 &\necho $! $$ >" + in("started") +
                                "\nls -d $TMPDIR/verican-*/time >" + in("sockets") + "\nwait\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    std::filesystem::create_directory(in("tmp"));
    std::filesystem::remove(in("sockets"));
    const vericansim::ScopedEnv variable{"TMPDIR", in("tmp")};
    tb::RunningTool running{
        {"linux", "--kernel", path, "--dtb", "/dev/null", "--init", "/bin/true"}};
    ASSERT_TRUE(running.wait_until([&] { return !tb::slurp(in("sockets")).empty(); }));
    running.signal(signal);
    const tb::ToolResult result = running.wait();
    EXPECT_EQ(result.code, 128 + signal);
    EXPECT_THAT(result.error, HasSubstr("verican linux: interrupted; the guest is ended\n"));
    EXPECT_EQ(vericansim::shell("ls " + in("tmp") + " | grep verican- ; true").text, "");
    // A process that nobody has taken note of yet is a zombie (Z).
    EXPECT_EQ(vericansim::shell("for p in $(cat " + in("started") +
                                "); do grep -s '^State:.[^Z]' /proc/$p/status; done; true")
                  .text,
              "");
  }
  // The tests behind this one have the folder of this process, which goes with it.
  EXPECT_EQ(std::filesystem::temp_directory_path(), before);
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
