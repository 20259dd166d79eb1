// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HardFrames: see hard_frames.hpp.
#include "timing/hard_frames.hpp"

namespace vericansim {

/// 64 bits in runs of equal ones, three in four of a length that this word prefers: mostly four,
/// which stuff bits make five, again and again.
std::uint64_t HardFrames::runs() {
  constexpr unsigned kPreferred[] = {4, 4, 4, 5, 5, 3, 2, 1};
  const unsigned preferred = kPreferred[random_() % 8];
  std::uint64_t bits = 0;
  bool level = (random_() & 1) != 0;
  for (unsigned left = 64; left > 0; level = !level) {
    const auto length = random_() % 4 != 0 ? preferred : static_cast<unsigned>(1 + random_() % 5);
    for (unsigned n = 0; n < length && left > 0; ++n, --left) bits = bits << 1 | level;
  }
  return bits;
}

Frame HardFrames::next(unsigned sender, unsigned sent) {
  constexpr unsigned kTogether = 16;  // frames with one common identifier
  if (sent / kTogether != epoch_) {
    epoch_ = sent / kTogether;
    common_ = runs() & 0x1FFFFFFF;
    extended_ = random_() % 3 == 0;
  }
  Frame frame;
  // In the last bits at the latest the senders differ.
  const std::uint64_t flipped = common_ ^ (1ULL << random_() % 29);
  frame.extended = extended_;
  frame.id = static_cast<std::uint32_t>(extended_ ? (flipped & ~3ULL) | sender
                                                  : ((flipped >> 18) & 0x7FC) | sender);
  frame.remote = random_() % 16 == 0;
  frame.dlc = static_cast<std::uint8_t>(random_() % 4 == 0 ? random_() % 9 : 8);
  const std::uint64_t data = runs();
  for (unsigned i = 0; i < frame.payload_size(); ++i)
    frame.data[i] = static_cast<std::uint8_t>(data >> 8 * i);
  return frame;
}

}  // namespace vericansim
