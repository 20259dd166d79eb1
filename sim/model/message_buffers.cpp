// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MessageBuffers: see message_buffers.hpp.
#include "model/message_buffers.hpp"

#include <bit>

namespace vericansim {
namespace {

/// Finaliser of SplitMix64: every bit of the result depends on every bit of the value.
std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ value >> 30) * 0xBF58476D1CE4E5B9;
  value = (value ^ value >> 27) * 0x94D049BB133111EB;
  return value ^ value >> 31;
}

class Digest {
 public:
  explicit Digest(std::uint64_t start) : sum_{mixed(start)} {}
  void add(std::uint64_t value) { sum_ = mixed(sum_ + value + 0x9E3779B97F4A7C15); }
  void add(const std::array<std::uint32_t, 4> &words) {
    add(std::uint64_t{words[0]} << 32 | words[1]);
    add(std::uint64_t{words[2]} << 32 | words[3]);
  }
  [[nodiscard]] std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_;
};

std::uint64_t digest_of(const SendRequest &request) {
  const Frame &frame = request.frame;
  Digest digest{1};
  digest.add(std::uint64_t{frame.id} << 32 | std::uint64_t{frame.dlc} << 8 |
             unsigned{frame.extended} << 2 | unsigned{frame.remote} << 1 |
             unsigned{request.one_shot});
  digest.add(std::bit_cast<std::uint64_t>(frame.data));
  digest.add(request.value);
  digest.add(request.since);
  digest.add(request.until);
  return digest.sum();
}

// A digest of its own for each buffer, so that a processor computes many at once.
std::uint64_t digest_of(const BufferContent &buffer) {
  Digest digest{static_cast<unsigned>(buffer.serviced) << 3 | unsigned{buffer.one_shot} << 2 |
                unsigned{buffer.guarded} << 1 | unsigned{buffer.words.stamped}};
  digest.add(buffer.words.word);
  digest.add(buffer.words.known);
  if (buffer.request) digest.add(digest_of(*buffer.request));
  return digest.sum();
}

}  // namespace

MessageBuffers::MessageBuffers(unsigned number) : block_{std::make_shared<Block>()} {
  block_->buffers.resize(number);
}

BufferContent &MessageBuffers::change(unsigned n) {
  if (block_.use_count() != 1) block_ = std::make_shared<Block>(*block_);
  block_->digest.reset();
  return block_->buffers[n];
}

std::uint64_t MessageBuffers::digest() const {
  if (!block_->digest) {
    Digest digest{0};
    for (const BufferContent &buffer : block_->buffers) digest.add(digest_of(buffer));
    block_->digest = digest.sum();
  }
  return *block_->digest;
}

}  // namespace vericansim
