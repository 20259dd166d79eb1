// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// input_error_of(): what bad input is answered.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "trace/input_error.hpp"

namespace vericansim {

/// The message of the InputError that `act()` throws, which must be one line; "no error" if it
/// throws none.
template <typename Act>
std::string input_error_of(Act act) {
  try {
    static_cast<void>(act());
  } catch (const InputError &error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "no error";
}

}  // namespace vericansim
