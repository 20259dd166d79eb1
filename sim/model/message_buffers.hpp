// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MessageBuffers: what is in the buffers, in one of the states that a model holds to be possible.
// Most of its copies are never changed, so copies share what they hold.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/buffer_match.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// Words as they should read. `known` marks the bits that the specification promises.
struct KnownWords {
  std::array<std::uint32_t, 4> word{};
  std::array<std::uint32_t, 4> known{~0u, ~0u, ~0u, ~0u};
  bool stamped = false;  ///< the stamp is a reference count, not what the CPU wrote
  friend bool operator==(const KnownWords &, const KnownWords &) = default;
};

/// Whether a buffer has been serviced since its last frame; kOpen: the specification does not say.
enum class Serviced : std::uint8_t { kNo, kYes, kOpen };

/// A request to send: the buffer as it was when its C/S word was written.
struct SendRequest {
  Frame frame;
  std::uint64_t value = 0;                  ///< arbitration_value()
  std::uint64_t since = 0;                  ///< clock of the activation
  std::uint64_t until = ~std::uint64_t{0};  ///< clock of the deactivation
  bool one_shot = false;
  friend bool operator==(const SendRequest &, const SendRequest &) = default;
};

/// One buffer.
struct BufferContent {
  KnownWords words;
  Serviced serviced = Serviced::kNo;
  bool guarded = false;   ///< its flag tells the end of a transmission and stands (AEN=1)
  bool one_shot = false;  ///< bit 28 of the C/S word, which XCTRL.OSMB let be written (code 1100)
  std::optional<SendRequest> request;
  friend bool operator==(const BufferContent &, const BufferContent &) = default;
  [[nodiscard]] unsigned code() const { return cs_code(words.word[0]); }
};

/// The buffers, copied when one of several owners changes them.
class MessageBuffers {
 public:
  explicit MessageBuffers(unsigned number);
  [[nodiscard]] unsigned size() const { return static_cast<unsigned>(block_->buffers.size()); }
  [[nodiscard]] const BufferContent &operator[](unsigned n) const { return block_->buffers[n]; }
  /// To be changed before the next copy or comparison.
  [[nodiscard]] BufferContent &change(unsigned n);

  /// Depends on everything that is in them.
  [[nodiscard]] std::uint64_t digest() const;
  /// By digest: one time in 2^64 different buffers are taken for the same, and a state that is
  /// possible is forgotten.
  friend bool operator==(const MessageBuffers &a, const MessageBuffers &b) {
    return a.block_ == b.block_ || a.digest() == b.digest();
  }

 private:
  struct Block {
    std::vector<BufferContent> buffers;
    std::optional<std::uint64_t> digest;  ///< none: not computed since the last change
  };
  std::shared_ptr<Block> block_;
};

}  // namespace vericansim
