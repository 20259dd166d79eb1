// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GoldenCaller: the calls of vectors.yaml through the C client, whatever it talks to (RN-93).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "remote/golden_vectors.hpp"
#include "verican_remote.h"

namespace vericansim {

/// Carries out calls and expects, with GoogleTest, what the vectors say of them.
class GoldenCaller {
 public:
  GoldenCaller(verican_remote_t &client, std::string profile)
      : client_{client}, profile_{std::move(profile)} {}

  /// Every call but "frame".
  void carry_out(const golden::Call &call);

 private:
  using Bytes = std::vector<std::uint8_t>;

  void others(const golden::Call &call);
  void select(const golden::Call &call);
  void status(std::uint8_t node, const Bytes &row);
  void identity(std::uint8_t node, const Bytes &row);
  void poll(const golden::Call &call);

  verican_remote_t &client_;
  std::string profile_;
};

/// The host's frames of a vector, as candump writes them.
[[nodiscard]] std::vector<std::string> frames_of(const golden::Vector &vector);

}  // namespace vericansim
