// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// same_identifier(): frames that no arbitration tells apart.
#pragma once

#include "model/frame.hpp"

namespace vericansim {

/// True if identifier, format and RTR of two frames are the same.
[[nodiscard]] inline bool same_identifier(const Frame &a, const Frame &b) {
  return a.id == b.id && a.extended == b.extended && a.remote == b.remote;
}

}  // namespace vericansim
