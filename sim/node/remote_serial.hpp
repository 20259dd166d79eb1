// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The serial number of a Verilated can_remote, with or without an engine.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "model/remote_config.hpp"

namespace vericansim {

/// Sets the number, so that one model serves all. A netlist has the one that it was synthesised
/// with, that of RemoteConfig: std::logic_error for another.
template <typename Root>
void set_serial(Root &root, std::uint32_t serial) {
  if constexpr (requires { root.can_remote__DOT__serial; })
    root.can_remote__DOT__serial = serial;
  else if (serial != RemoteConfig{}.serial)
    throw std::logic_error("the serial number of a netlist cannot be set");
}

}  // namespace vericansim
