// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RunningTool: `verican` while it runs, to send signals to.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

#include "firmware/tool_run.hpp"

namespace tb {

/// Starts the tool; its end is waited for by wait(), or made by the destructor.
class RunningTool {
 public:
  explicit RunningTool(std::vector<std::string> arguments);
  ~RunningTool();
  RunningTool(const RunningTool &) = delete;
  RunningTool &operator=(const RunningTool &) = delete;

  /// Waits until `ready()`; false if the tool ends before.
  [[nodiscard]] bool wait_until(const std::function<bool()> &ready);
  void signal(int number) const;
  /// Waits for the end. The code is -1 if a signal has ended it.
  [[nodiscard]] ToolResult wait();

 private:
  std::string out_, error_;
  pid_t process_ = -1;
};

}  // namespace tb
