// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Commands of the shell: other programs as judges, and the tool as a user calls it.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace vericansim {

/// What a command prints on stdout, and its exit code.
struct Said {
  std::string text;
  int code = -1;  ///< -1: a signal has ended it
};

/// Runs `command` by sh. Throws std::runtime_error if no process can be made.
inline Said shell(const std::string &command) {
  Said said;
  std::FILE *pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("popen");
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) said.text += static_cast<char>(c);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) said.code = WEXITSTATUS(status);
  return said;
}

/// Whether `command` ends with 0; what it says is dropped.
inline bool succeeds(const std::string &command) {
  return shell("{ " + command + "; } 2> /dev/null").code == 0;
}

/// Whether `program` is installed.
inline bool has_program(const std::string &program) { return succeeds("command -v " + program); }

/// Whether the Python that the tool calls has python-can.
inline bool has_python_can() { return succeeds("/usr/bin/python3 -c 'import can'"); }

}  // namespace vericansim
