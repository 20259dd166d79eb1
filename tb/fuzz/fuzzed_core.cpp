// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The Verilated cores of FuzzedCore.
#include "fuzz/fuzzed_core.hpp"

#include "Vcan_ahb64.h"
#include "Vcan_ahb64___024root.h"
#include "Vcan_ahb_user.h"
#include "Vcan_ahb_user___024root.h"

namespace vericansim::fuzz {

std::unique_ptr<FuzzedCore> FuzzedCore::create(Kind kind) {
  if (kind == Kind::kFull) return std::make_unique<FuzzedCoreOf<Vcan_ahb64>>(64, false);
  return std::make_unique<FuzzedCoreOf<Vcan_ahb_user>>(16, true);
}

}  // namespace vericansim::fuzz
