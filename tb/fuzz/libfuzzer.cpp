// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The entry of libFuzzer: VERICAN_FUZZ_TARGET is the target of this program.
#include "fuzz/target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  vericansim::fuzz::VERICAN_FUZZ_TARGET({data, size});
  return 0;
}
