// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SYNC and FUP of an ideal master (docs/time-spec.md, 7.1), identifier 1, domain 3, for tests that
// put them on a bus bit by bit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "model/frame_codec.hpp"
#include "time/stamp_rule.hpp"
#include "time/tsyn_data.hpp"

namespace vericansim {

inline constexpr std::uint32_t kTsynId = 1;
inline constexpr unsigned kTsynDomain = 3;

/// A message: type, sequence counter, byte 3, seconds or nanoseconds.
inline Frame tsyn_message(unsigned type, unsigned sc, unsigned byte3, std::uint32_t word) {
  Frame frame{.id = kTsynId, .dlc = 8};
  frame.data =
      TsynData{.type = type, .domain = kTsynDomain, .sc = sc, .byte3 = byte3, .word = word}.bytes();
  return frame;
}

/// Bits of a frame as its sender drives them: nobody acknowledges it for itself.
inline EncodedFrame encode_unacknowledged(const Frame &frame) {
  return encode_frame(frame, {.ack_slot = Level::kRecessive});
}

/// The master's side of pairs, one behind the other.
class TsynPairs {
 public:
  /// SYNC, queued at `t0`, ns of the master's time.
  Frame sync(std::uint64_t t0) {
    seconds_ = t0 / kSecondNs;
    return tsyn_message(0x10, sc_, 0, static_cast<std::uint32_t>(seconds_));
  }
  /// FUP of the SYNC before, whose reference edge came at `t1`.
  Frame follow_up(std::uint64_t t1) {
    const std::uint64_t t4 = t1 - seconds_ * kSecondNs;
    return tsyn_message(0x18, sc_++, static_cast<unsigned>(t4 / kSecondNs),
                        static_cast<std::uint32_t>(t4 % kSecondNs));
  }

 private:
  static constexpr std::uint64_t kSecondNs = 1'000'000'000;
  unsigned sc_ = 0;
  std::uint64_t seconds_ = 0;
};

}  // namespace vericansim
