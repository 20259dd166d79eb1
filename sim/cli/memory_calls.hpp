// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The calls of `verican memory`, over the C client.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "cli/memory_link.hpp"
#include "verican_remote.h"

namespace vericansim::cli {

/// A call had no success; what() says so in one line.
class MemoryFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The client with exceptions in place of results.
class MemoryCalls {
 public:
  /// `timeout_ms`: for an answer. `link` must outlive it.
  MemoryCalls(MemoryLink &link, unsigned name_bits, unsigned timeout_ms);

  [[nodiscard]] std::vector<verican_remote_identity_t> scan();
  /// The nodes that have a number.
  [[nodiscard]] std::vector<verican_remote_identity_t> numbered();
  [[nodiscard]] std::vector<std::uint8_t> read(unsigned node, unsigned address, unsigned length);
  /// Confirmed, but to all nodes (VERICAN_REMOTE_ALL).
  void write(unsigned node, unsigned address, const std::vector<std::uint8_t> &bytes);
  [[nodiscard]] verican_remote_answers_t poll(unsigned address, unsigned length);
  [[nodiscard]] verican_remote_status_t status(unsigned node);
  void trigger(unsigned count);
  void state(unsigned node, unsigned command);
  void assign(std::uint32_t serial, unsigned number);

  [[nodiscard]] unsigned name_bits() const { return client_.name_bits; }
  [[nodiscard]] unsigned highest_number() const { return (1U << client_.name_bits) - 1; }

 private:
  void check(verican_remote_result_t result, const std::string &who) const;

  verican_remote_t client_{};
};

}  // namespace vericansim::cli
