// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputError: what was to be written could not be written; which file, and why.
#pragma once

#include <cstring>
#include <string>

#include "trace/input_error.hpp"

namespace vericansim {

/// An output cannot be opened, written to its end or put in its place. what() is "file: what
/// failed: reason", one line. An InputError, since who named the file can name another one.
class OutputError : public InputError {
 public:
  /// `code` is the errno of the call that failed.
  OutputError(const std::string &path, const std::string &what, int code)
      : InputError(path == "-" ? "standard output" : path, 0, what + ": " + std::strerror(code)),
        code_{code} {}
  /// The errno.
  [[nodiscard]] int code() const { return code_; }

 private:
  int code_;
};

}  // namespace vericansim
