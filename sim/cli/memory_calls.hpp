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
  [[nodiscard]] std::vector<std::uint8_t> read(unsigned node, unsigned address, unsigned length);
  /// Confirmed, but to all nodes (VERICAN_REMOTE_ALL).
  void write(unsigned node, unsigned address, const std::vector<std::uint8_t> &bytes);
  [[nodiscard]] verican_remote_answers_t poll(unsigned address, unsigned length);
  [[nodiscard]] verican_remote_status_t status(unsigned node);
  void trigger(unsigned count);
  void state(unsigned node, unsigned command);
  void clear(unsigned node);
  /// Bytes of the node's memory and registers together (RN-25).
  [[nodiscard]] unsigned memory_size(unsigned node);
  void assign(std::uint32_t serial, unsigned number);

  [[nodiscard]] unsigned name_bits() const { return client_.name_bits; }
  [[nodiscard]] unsigned highest_number() const { return (1U << client_.name_bits) - 1; }

 private:
  /// `at`: behind "refuses" or what else went wrong.
  void check(verican_remote_result_t result, const std::string &who,
             const std::string &at = {}) const;
  /// The same of a transfer from `first` on; tells where it has ended.
  void check_transfer(verican_remote_result_t result, unsigned node, unsigned first) const;

  verican_remote_t client_{};
};

}  // namespace vericansim::cli
