// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Seeds of random tests that can also run with others than `make test` has (docs/testing.md).
#pragma once

#include <gtest/gtest.h>

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace vericansim {

/// The seeds of a suite: those of VERICAN_RANDOM_SEEDS, "FIRST+COUNT",
/// else 1 to `count`. Throws std::runtime_error if the variable is anything else.
inline auto random_seeds(unsigned count) {
  const char *text = std::getenv("VERICAN_RANDOM_SEEDS");  // NOLINT(concurrency-mt-unsafe)
  if (text == nullptr || *text == 0) return ::testing::Range(1u, count + 1);
  const std::string_view given{text};
  unsigned first = 0;
  const auto [plus, wrong] = std::from_chars(given.begin(), given.end(), first);
  const bool more = wrong == std::errc{} && plus != given.end() && *plus == '+';
  const auto [end, bad] = std::from_chars(more ? plus + 1 : given.end(), given.end(), count);
  if (!more || bad != std::errc{} || end != given.end() || count == 0 || first + count < first)
    throw std::runtime_error("VERICAN_RANDOM_SEEDS is '" + std::string{given} +
                             "'; allowed: FIRST+COUNT, such as 100000+60, up to 4294967295");
  return ::testing::Range(first, first + count);
}

}  // namespace vericansim
