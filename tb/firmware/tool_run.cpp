// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See tool_run.hpp.
#include "firmware/tool_run.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace tb {

std::string slurp(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string temporary(const std::string &suffix) {
  const auto *const info = ::testing::UnitTest::GetInstance()->current_test_info();
  return ::testing::TempDir() + info->test_suite_name() + "." + info->name() + suffix;
}

ToolResult run_tool(const std::string &arguments) {
  const std::string out = temporary(".out"), error = temporary(".err");
  const std::string command =
      std::string(VERICAN_BINARY) + " " + arguments + " > " + out + " 2> " + error;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(error)};
}

std::string example_elf(const std::string &name) {
  return std::string(VERICAN_FIRMWARE_DIR) + "/" + name + ".elf";
}

std::string test_elf(const std::string &name) {
  return std::string(VERICAN_FIRMWARE_DIR) + "/test/" + name + ".elf";
}

}  // namespace tb
