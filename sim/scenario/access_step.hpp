// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AccessStep as text, as scenario files have it.
#pragma once

#include <string>

#include "scenario/register_name.hpp"
#include "scenario/scenario.hpp"

namespace vericansim {

/// As in "write MB5.CS 0x8000000".
[[nodiscard]] std::string to_text(const AccessStep &step, unsigned buffers = kMostBuffers);

}  // namespace vericansim
