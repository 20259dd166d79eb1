// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TimeZone: this computer in another time zone for a while.
#pragma once

#include <ctime>
#include <optional>
#include <string>

#include "harness/scoped_env.hpp"

namespace vericansim {

/// The time zone of this process, as TZ names it, until this goes.
class TimeZone {
 public:
  explicit TimeZone(const std::string &name) {
    variable_.emplace("TZ", name);
    ::tzset();
  }
  ~TimeZone() {
    variable_.reset();
    ::tzset();
  }
  TimeZone(const TimeZone &) = delete;
  TimeZone &operator=(const TimeZone &) = delete;

 private:
  std::optional<ScopedEnv> variable_;
};

}  // namespace vericansim
