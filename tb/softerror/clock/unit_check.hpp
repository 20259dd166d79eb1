// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Does the time unit work? Every part of it is used once, by the driver where it can (TM-141).
#pragma once

#include <string>

#include "softerror/clock/clock_world.hpp"

namespace vericansim {

/// Empty: all of it does; else what does not. The scene must be over; TIME need not be right.
[[nodiscard]] std::string what_fails(ClockWorld &world);

}  // namespace vericansim
