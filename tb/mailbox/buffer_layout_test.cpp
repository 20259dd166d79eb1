// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The words of a message buffer (flexcan.md 3.1), both ways, for every length and format.
#include <gtest/gtest.h>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr BufferConfig kAll{.num_mb = 16, .maxmb = 15, .eacen = true, .rrs = true};

// Standard and extended, data and remote, DLC 0 to 15.
class BufferLayout : public ::testing::TestWithParam<unsigned> {
 protected:
  static Frame frame() {
    const unsigned kind = GetParam() / 16;
    Frame frame{.id = (kind & 1) != 0 ? 0x15A5C3F0u : 0x5A3u,
                .extended = (kind & 1) != 0,
                .remote = (kind & 2) != 0,
                .dlc = static_cast<std::uint8_t>(GetParam() % 16)};
    for (unsigned i = 0; i < frame.payload_size(); ++i)
      frame.data[i] = static_cast<std::uint8_t>(0x11 * (i + 1));
    return frame;
  }
};

// FX-3.1.a, FX-3.1.b, FX-3.1.c, FX-3.1.d: what the words say goes out, PRIO does not; DLC above 8
// sends eight bytes, RTR=1 none. FF-07.
TEST_P(BufferLayout, Sent) {
  BufferRig rig{kAll};
  rig.go();
  const std::uint32_t id = frame().extended ? 0xE0000000 | 0x15A5C3F0 : 0xE0000000 | (0x5A3u << 18);
  const std::uint32_t header =
      (frame().extended ? 3u << 21 : 0) | (frame().remote ? 1u << 20 : 0) | (GetParam() % 16) << 16;
  rig.put(7, {.cs = 0x0C000000 | header, .id = id, .low = 0x11223344, .high = 0x55667788});
  rig.quiet();
  ASSERT_EQ(rig.sent().size(), 1u);
  EXPECT_EQ(rig.sent()[0], frame());
  rig.compare();
}

// FX-3.1.a, FX-3.1.b, FX-3.1.c, FX-3.1.e, FX-3.1.f: a frame received; bits 31:28 and 23 are 0, the
// low bits of a standard identifier too. FF-08.
TEST_P(BufferLayout, Received) {
  BufferRig rig{kAll};
  for (unsigned mb = 0; mb < 16; ++mb) rig.write(reg::rximr(mb), 0);
  rig.put(7, {.cs = 0x04000000, .id = 0x1FFFFFFF, .low = ~0u, .high = ~0u});
  rig.go();
  rig.receive(frame());
  const std::uint32_t cs = rig.read(reg::mb(7));
  EXPECT_EQ(cs & 0xFFBF0000, 0x02000000u | (frame().extended ? 1u << 21 : 0) |
                                 (frame().remote ? 1u << 20 : 0) | (GetParam() % 16) << 16);
  EXPECT_NE(cs & reg::kCsSrr, 0u);  // a base frame has none: 1
  EXPECT_EQ(rig.read(reg::mb(7, 1)) & 0x1FFFFFFF, frame().extended ? 0x15A5C3F0 : 0x5A3u << 18);
  for (unsigned i = 0; i < frame().payload_size(); ++i)
    EXPECT_EQ((rig.read(reg::mb(7, 2 + i / 4)) >> (24 - 8 * (i % 4))) & 0xFF, 0x11 * (i + 1));
  rig.compare();
}

// Nothing of an earlier frame is left where this one has no bytes.
TEST_P(BufferLayout, BytesThatWereNotReceivedAreZero) {
  BufferRig rig{kAll};
  for (unsigned mb = 0; mb < 16; ++mb) rig.write(reg::rximr(mb), 0);
  rig.put(7, {.cs = 0x04000000, .id = 0x1FFFFFFF, .low = ~0u, .high = ~0u});
  rig.go();
  Frame earlier{.id = 0x123, .dlc = 8};
  earlier.data.fill(0xFF);
  rig.receive(earlier);
  EXPECT_EQ(rig.read(reg::mb(7, 2)) & rig.read(reg::mb(7, 3)), 0xFFFFFFFFu);
  rig.receive(frame());
  for (unsigned i = 0; i < 8; ++i)
    EXPECT_EQ((rig.read(reg::mb(7, 2 + i / 4)) >> (24 - 8 * (i % 4))) & 0xFF,
              i < frame().payload_size() ? 0x11 * (i + 1) : 0u)
        << i;
}

INSTANTIATE_TEST_SUITE_P(EveryFormatAndLength, BufferLayout, ::testing::Range(0u, 64u));

}  // namespace
}  // namespace vericansim
