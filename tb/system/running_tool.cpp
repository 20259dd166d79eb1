// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RunningTool: see running_tool.hpp.
#include "system/running_tool.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace tb {

RunningTool::RunningTool(std::vector<std::string> arguments)
    : out_{temporary(".out")}, error_{temporary(".err")} {
  std::vector<char *> words{const_cast<char *>(VERICAN_BINARY)};
  for (std::string &argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  // What an earlier run has left must not be taken for words of this one.
  ::unlink(out_.c_str());
  ::unlink(error_.c_str());
  process_ = ::fork();
  if (process_ != 0) return;
  ::dup2(::open(out_.c_str(), kNew, 0600), STDOUT_FILENO);
  ::dup2(::open(error_.c_str(), kNew, 0600), STDERR_FILENO);
  ::execv(words[0], words.data());
  ::_exit(127);
}

RunningTool::~RunningTool() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool RunningTool::wait_until(const std::function<bool()> &ready) {
  siginfo_t ended{};
  while (!ready()) {
    ended.si_pid = 0;
    ::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid != 0) return ready();
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  return true;
}

void RunningTool::signal(int number) const { ::kill(process_, number); }

ToolResult RunningTool::wait() {
  int status = 0;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out_), slurp(error_)};
}

}  // namespace tb
