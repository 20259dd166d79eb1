// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MessageBuffers: copies are independent, and a difference in any part makes them different.
#include "model/message_buffers.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace vericansim {
namespace {

MessageBuffers with_request() {
  MessageBuffers buffers{16};
  buffers.change(3).request = SendRequest{.frame = {}, .value = 5, .since = 6, .until = 7};
  return buffers;
}

TEST(MessageBuffers, CopyKeepsWhatItHadWhenTheOriginalChanges) {
  MessageBuffers original = with_request();
  const MessageBuffers copy = original;
  EXPECT_EQ(original, copy);
  original.change(3).request->value = 9;
  EXPECT_EQ(copy[3].request->value, 5u);
  EXPECT_EQ(original[3].request->value, 9u);
  EXPECT_FALSE(original == copy);
  original.change(3).request->value = 5;
  EXPECT_EQ(original, copy) << "equal again";
}

TEST(MessageBuffers, EveryPartCounts) {
  const std::vector<std::function<void(BufferContent &)>> parts{
      [](BufferContent &b) { b.words.word[0] ^= 1; },
      [](BufferContent &b) { b.words.word[1] ^= 1; },
      [](BufferContent &b) { b.words.word[2] ^= 1; },
      [](BufferContent &b) { b.words.word[3] ^= 1; },
      [](BufferContent &b) { b.words.known[0] ^= 1; },
      [](BufferContent &b) { b.words.known[1] ^= 1; },
      [](BufferContent &b) { b.words.known[2] ^= 1; },
      [](BufferContent &b) { b.words.known[3] ^= 1; },
      [](BufferContent &b) { b.words.stamped = true; },
      [](BufferContent &b) { b.serviced = Serviced::kYes; },
      [](BufferContent &b) { b.serviced = Serviced::kOpen; },
      [](BufferContent &b) { b.guarded = true; },
      [](BufferContent &b) { b.request.reset(); },
      [](BufferContent &b) { b.request->value ^= 1; },
      [](BufferContent &b) { b.request->since ^= 1; },
      [](BufferContent &b) { b.request->until ^= 1; },
      [](BufferContent &b) { b.request->one_shot = true; },
      [](BufferContent &b) { b.request->frame.id ^= 1; },
      [](BufferContent &b) { b.request->frame.extended = true; },
      [](BufferContent &b) { b.request->frame.remote = true; },
      [](BufferContent &b) { b.request->frame.dlc ^= 1; },
      [](BufferContent &b) { b.request->frame.data[0] ^= 1; },
      [](BufferContent &b) { b.request->frame.data[7] ^= 1; },
  };
  std::vector<MessageBuffers> all{with_request()};
  for (const auto &change : parts) {
    all.push_back(with_request());
    change(all.back().change(3));
  }
  all.push_back(with_request());
  all.back().change(4).request = all.back()[3].request;  // the same in another buffer
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(all[i] == all[j]) << i << ", " << j;
}

}  // namespace
}  // namespace vericansim
