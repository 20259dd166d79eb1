// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Semihosting: the calls by BKPT 0xAB with which firmware prints, asks for the time and ends
// ("Semihosting for AArch32 and AArch64", Arm).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/engine.hpp"

namespace vericansim::firmware {

/// What firmware finds on the other side. Output goes to one place, whatever the file handle; input
/// is always at its end. The one file is that of the features.
class Semihosting {
 public:
  /// Gets what the firmware prints.
  std::function<void(std::string_view)> on_output;
  /// Simulated microseconds since the start of the firmware.
  std::function<std::uint64_t()> microseconds;

  /// Serves the call in R0 with its parameter in R1; the result goes to R0. Nothing, or what is
  /// wrong: a pointer to where there is no memory.
  [[nodiscard]] std::optional<std::string> serve(Engine &engine);

  /// Set once the firmware has ended itself: 0 is success.
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }

 private:
  [[nodiscard]] std::uint32_t word(std::uint32_t address, unsigned index) const;
  [[nodiscard]] std::string text_at(std::uint32_t address,
                                    std::optional<std::uint32_t> length) const;
  [[nodiscard]] std::uint32_t call(std::uint32_t operation, std::uint32_t parameter);
  [[nodiscard]] std::uint32_t open(std::uint32_t block);
  [[nodiscard]] std::uint32_t read(std::uint32_t block);
  [[nodiscard]] std::uint32_t seek(std::uint32_t block);
  [[nodiscard]] std::uint32_t length(std::uint32_t block) const;
  [[nodiscard]] std::uint32_t write(std::uint32_t block);
  [[nodiscard]] std::uint32_t elapsed(std::uint32_t block);
  void exit(std::uint32_t reason, std::uint32_t code);

  Engine *engine_ = nullptr;    // while a call is served
  std::uint32_t position_ = 0;  // in the file of features
  std::optional<int> exit_code_;
};

}  // namespace vericansim::firmware
