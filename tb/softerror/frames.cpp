// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The frames of the soft-error runs: see frames.hpp.
#include "softerror/frames.hpp"

namespace vericansim {
namespace {

// Identifiers end with the source: two nodes never send the same one at the same time.
constexpr std::uint32_t kSourceMask = 3;

// The node under test has eight buffers full and would win most arbitrations: nine frames in ten
// that it sends have ID28 = 1.
std::uint32_t low_priority(const FrameTag &tag) {
  return tag.source == 0 && tag.number % 10 != 0 ? 0x400 : 0;
}

}  // namespace

std::uint64_t mix(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

Frame make_frame(const FrameTag &tag) {
  std::uint64_t random = mix((std::uint64_t{tag.source} << 32) | tag.number);
  const auto take = [&random](unsigned bits) {
    const auto value = static_cast<std::uint32_t>(random & ((1ULL << bits) - 1));
    random >>= bits;
    return value;
  };
  Frame frame;
  frame.extended = take(1) != 0;
  if (frame.extended) {
    frame.remote = take(3) == 0;
    frame.id = (low_priority(tag) | take(11)) << 18 | (tag.number << 2) | tag.source;
    frame.dlc = static_cast<std::uint8_t>(take(4));
  } else {
    frame.id = low_priority(tag) | (take(9) << 2) | tag.source;
    frame.dlc = static_cast<std::uint8_t>(3 + take(16) % 6);
  }
  const std::uint64_t payload = mix(~std::uint64_t{tag.number} << 8 | tag.source);
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    frame.data[i] = static_cast<std::uint8_t>(payload >> (8 * i));
  }
  // Long runs of one level now and then, for the stuff bits.
  if (tag.number % 5 == 0) {
    for (unsigned i = 3; i < frame.payload_size(); ++i) frame.data[i] = (i & 1) ? 0x00 : 0xFF;
  }
  if (!frame.extended) {
    frame.data[0] = static_cast<std::uint8_t>(tag.number);
    frame.data[1] = static_cast<std::uint8_t>(tag.number >> 8);
  }
  return frame;
}

std::optional<FrameTag> identify(const Frame &frame) {
  FrameTag tag;
  tag.source = frame.id & kSourceMask;
  if (tag.source >= kParties) return std::nullopt;
  tag.number = frame.extended ? (frame.id >> 2) & 0xFFFF : frame.data[0] | (frame.data[1] << 8);
  if (make_frame(tag) != frame) return std::nullopt;
  return tag;
}

FrameTag Ledger::next(unsigned source) {
  fates_[source].emplace_back();
  return {source, first_ + static_cast<unsigned>(fates_[source].size() - 1)};
}

void Ledger::excuse() {
  for (unsigned source = 1; source < kParties; ++source) {
    for (Fate &known : fates_[source]) known.excused |= known.received[0] == 0;
  }
}

void Ledger::received(unsigned by, const Frame &frame, bool excused) {
  const auto tag = identify(frame);
  if (!tag || tag->source == by || tag->number < first_ ||
      tag->number - first_ >= fates_[tag->source].size()) {
    ++wrong_[by];
    return;
  }
  Fate &known = fate(*tag);
  if (known.received[by] < 255) ++known.received[by];
  known.excused |= excused;
}

}  // namespace vericansim
