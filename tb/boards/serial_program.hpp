// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SerialProgram: a program at a pseudo-terminal, with its standard input and output.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

namespace vericansim {

/// The program is started with the terminal's name as its last argument, and ended with this.
/// std::runtime_error if the system refuses something.
class SerialProgram {
 public:
  explicit SerialProgram(std::vector<std::string> command);
  ~SerialProgram();
  SerialProgram(const SerialProgram &) = delete;
  SerialProgram &operator=(const SerialProgram &) = delete;

  /// What it has written to the terminal since the last call.
  std::string from_terminal();
  void to_terminal(const std::string &bytes);
  /// What somebody types at its standard input.
  void type(const std::string &text);
  void line(const std::string &text) { type(text + "\n"); }
  /// The end of its standard input.
  void end_of_input();
  /// Whole lines of its standard output and error since the last call.
  std::vector<std::string> lines();
  /// Waits until it has something to say, 5 ms at most.
  void wait() const;
  /// Its exit code, or -1 while it runs.
  int exit_code();

 private:
  [[noreturn]] void become(const std::vector<std::string> &command, const std::string &terminal,
                           const int (&input)[2], const int (&output)[2]) const;

  int terminal_ = -1, held_ = -1, input_ = -1, output_ = -1;
  pid_t child_ = -1;
  int code_ = -1;
  std::string text_;
};

}  // namespace vericansim
