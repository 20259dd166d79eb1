// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// depth(): how far a test goes that could go on for long.
#pragma once

#include <cstdlib>

namespace vericansim {

/// The environment asks for all that the tests have (VERICAN_WHOLE_TESTS=1), as the campaign's
/// stages with mutants do.
[[nodiscard]] inline bool whole_tests() {
  const char *variable = std::getenv("VERICAN_WHOLE_TESTS");  // NOLINT(concurrency-mt-unsafe)
  return variable != nullptr && *variable == '1';
}

/// `sample` in `make test`, else `whole`.
template <typename T>
[[nodiscard]] T depth(T sample, T whole) {
  return whole_tests() ? whole : sample;
}

}  // namespace vericansim
