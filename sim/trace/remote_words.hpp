// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What frames mean on a bus of nodes without a processor (docs/remote.md), in words.
#pragma once

#include <string>

#include "model/frame.hpp"

namespace vericansim {

/// "3: write 020 <- 5A", "3 says 020 = 5A", "TRIGGER 7". Empty: nothing to such nodes (extended
/// frames). `name_bits`: 3 or 5, as all nodes of the bus have it.
[[nodiscard]] std::string remote_words(const Frame &frame, unsigned name_bits);

/// "locked" for 0x11 (RN-31).
[[nodiscard]] std::string remote_code_name(unsigned code);

/// "SAFE", from the two lowest bits of STATUS (RN-24).
[[nodiscard]] std::string remote_state_name(unsigned state);

}  // namespace vericansim
