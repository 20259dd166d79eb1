// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ScopedEnv: a variable of the environment that is another for a while.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace vericansim {

/// A variable of the environment, set until this goes; then it is what it was before.
class ScopedEnv {
 public:
  ScopedEnv(std::string name, const std::string &value) : name_{std::move(name)} {
    const char *before = std::getenv(name_.c_str());
    if (before != nullptr) before_ = before;
    ::setenv(name_.c_str(), value.c_str(), 1);
  }
  ~ScopedEnv() {
    before_ ? ::setenv(name_.c_str(), before_->c_str(), 1) : ::unsetenv(name_.c_str());
  }
  ScopedEnv(const ScopedEnv &) = delete;
  ScopedEnv &operator=(const ScopedEnv &) = delete;

 private:
  std::string name_;
  std::optional<std::string> before_;
};

}  // namespace vericansim
