// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Block transfers at the engine's port, RTL and model in lockstep: RN-40 to RN-43, RN-101.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

#include "remote/port_lockstep.hpp"
#include "remote/random_port.hpp"
#include "remote/remote_entries.hpp"

namespace vericansim {
namespace {

constexpr unsigned kBlock = 0x1FA, kData = 0x1FB;
enum Op : std::uint8_t { kAbort, kReadBlock, kWriteBlock };

Frame data_frame(unsigned id, std::initializer_list<unsigned> data) {
  Frame frame;
  frame.id = id;
  frame.dlc = static_cast<std::uint8_t>(data.size());
  std::transform(data.begin(), data.end(), frame.data.begin(),
                 [](unsigned byte) { return static_cast<std::uint8_t>(byte); });
  return frame;
}

Frame block_frame(Op op, unsigned address, unsigned count, unsigned gap = 0) {
  return data_frame(kBlock,
                    {op, 0x5A, address & 0xFF, address >> 8, count & 0xFF, count >> 8, gap});
}

Frame part(unsigned seq, unsigned n) {
  Frame frame = data_frame(kData, {seq});
  for (unsigned i = 0; i < n; ++i) frame.data[1 + i] = static_cast<std::uint8_t>(17 * seq + i + 1);
  frame.dlc = static_cast<std::uint8_t>(1 + n);
  return frame;
}

class PortBlocks : public ::testing::Test {
 protected:
  PortBlocks() { pair_.drain(); }

  void tell(const Frame &frame) {
    pair_.receive(frame);
    check();
  }
  void drain() {
    pair_.drain();
    check();
  }
  void ms() {
    pair_.ms();
    check();
  }
  void check() { ASSERT_EQ(pair_.compare(), "") << pair_.history(); }
  /// All frames of a write of `n` bytes.
  void write(unsigned address, unsigned n) {
    tell(block_frame(kWriteBlock, address, n));
    drain();
    for (unsigned seq = 0, at = 0; at < n; ++seq, at += 7)
      tell(part(seq & 0xFF, std::min(7U, n - at)));
    drain();
  }
  /// The answer of BLOCK that is sent next.
  [[nodiscard]] unsigned code() {
    const auto answer = pair_.model().wants();
    return answer && (answer->id & 0x7F) == 0x7A ? answer->data[2] : 0xFFFF;
  }

  PortLockstep pair_{"full", 3, 3};
};

// RN-40, RN-41: every short length and all of the memory, both ways.
TEST_F(PortBlocks, AnyLengthArrivesAndComesBack) {
  for (unsigned n = 1; n <= 20; ++n) {
    write(0x200 + n, n);
    tell(block_frame(kReadBlock, 0x200 + n, n));
    drain();
  }
  write(0, 3584);
  tell(block_frame(kReadBlock, 0, 3584));
  drain();
}

// RN-41: a frame that is lost, doubled or swapped, each of four.
TEST_F(PortBlocks, OrderIsKept) {
  for (unsigned which = 0; which < 4; ++which) {
    for (unsigned how = 0; how < 3; ++how) {
      tell(block_frame(kWriteBlock, 0x300, 28));
      drain();
      for (unsigned seq = 0; seq < 4; ++seq) {
        if (how == 0 && seq == which) continue;
        const unsigned other = which ^ 1;
        tell(part(how == 2 && seq == which ? other : how == 2 && seq == other ? which : seq, 7));
        if (how == 1 && seq == which) tell(part(seq, 7));
      }
      drain();
      tell(block_frame(kAbort, 0, 0));
      drain();
    }
  }
}

// RN-40, RN-65: a read goes on behind a frame that a map entry takes.
TEST_F(PortBlocks, AReadGoesOnBehindAMapEntry) {
  pair_.user_write(map_at(0) / 4, 0x07FF86A0U, 0xF);  // 6A0, compared as a whole
  pair_.user_write(map_at(0) / 4 + 1, 0x00000300U, 0xF);
  tell(block_frame(kReadBlock, 0x100, 20));
  EXPECT_TRUE(pair_.turn());
  tell(data_frame(0x6A0, {1, 2}));
  for (unsigned frames = 0; frames < 3; ++frames) EXPECT_TRUE(pair_.turn()) << frames;
  check();
}

// RN-42: a second transfer is refused while one runs, and while its answer waits; abort ends it.
TEST_F(PortBlocks, OneAtATime) {
  for (const Op op : {kReadBlock, kWriteBlock}) {
    tell(block_frame(op, 0x100, 20, 5));
    tell(block_frame(kReadBlock, 0x100, 3));
    tell(block_frame(kWriteBlock, 0x100, 3));
    drain();
    tell(data_frame(kBlock, {kAbort, 1, 0, 0, 0, 0}));
    EXPECT_EQ(code(), 0x14U);
    drain();
    tell(block_frame(kAbort, 0, 0));
    drain();
  }
}

// RN-42: without a frame for BLKTO the write is closed, up to 10 ms early; each frame begins anew.
TEST_F(PortBlocks, TimeOutClosesAWrite) {
  FramePort &port = pair_.port();
  for (const bool fed : {false, true}) {
    port.receive(block_frame(kWriteBlock, 0x100, 20));
    (void)port.drain();
    if (fed) {
      for (unsigned i = 0; i < 485; ++i) port.ms();
      port.receive(part(0, 7));
    }
    unsigned waited = 0;
    while (!port.asks() && waited < 600) {
      port.ms();
      ++waited;
    }
    EXPECT_GT(waited, 490U);
    EXPECT_LE(waited, 500U);
    const std::vector<Frame> answers = port.drain();
    ASSERT_EQ(answers.size(), 1U);
    EXPECT_EQ(answers[0].data[2], 0x13);
    EXPECT_EQ(answers[0].data[4], fed ? 7 : 0);
    EXPECT_EQ(port.peek(remote_map::kCounters + 6), fed ? 2 : 1);  // RN-35
    // RN-41: the next write ends with code 0.
    port.receive(block_frame(kWriteBlock, 0x100, 3));
    (void)port.drain();
    port.receive(part(0, 3));
    const std::vector<Frame> end = port.drain();
    ASSERT_EQ(end.size(), 1U);
    EXPECT_EQ(end[0].data[2], 0);
  }
}

// RN-40: `gap` ms between the frames of a read, to the tick.
TEST_F(PortBlocks, GapIsKept) {
  tell(block_frame(kReadBlock, 0x200, 24, 3));
  drain();
  for (unsigned i = 0; i < 14; ++i) {
    ms();
    drain();
  }
}

// RN-43: checks hold for each frame: what is locked, protected, or behind the end.
TEST_F(PortBlocks, EachFrameIsChecked) {
  pair_.user_write(0xF08 / 4, 1U << 4, 0xF);  // WP of 200..27F
  pair_.user_write(0xF10 / 4, 1U << 6, 0xF);  // RP of 300..37F
  for (const unsigned address : {0x1F0U, 0x2F0U, 0xDF0U, 0xDFBU, 0xEF8U, 0xF10U, 0xFE0U, 0xFEAU,
                                 0xFF0U, 0xFFBU, 0x1000U, 0x2000U, 0xFFF8U}) {
    write(address, 24);
    tell(block_frame(kReadBlock, address, 24));
    drain();
  }
}

// RN-43: the bit of the page in which a frame begins, wherever the one before has ended.
TEST_F(PortBlocks, AFrameBeginsInThePageOfItsStart) {
  pair_.user_write(0xF10 / 4, 1U << 7, 0xF);  // RP of 380..3FF
  for (unsigned address = 0x68; address < 0x80; ++address) {
    tell(block_frame(kReadBlock, address, 14));
    for (unsigned frames = 0; frames < 3; ++frames) EXPECT_TRUE(pair_.turn()) << address;
    EXPECT_FALSE(pair_.turn()) << address;
    check();
  }
}

// RN-41, RN-43: lengths that a frame or the transfer does not have.
TEST_F(PortBlocks, LengthsAreChecked) {
  for (unsigned left = 1; left <= 8; ++left) {
    for (unsigned n = 0; n <= 14; ++n) {
      tell(block_frame(kWriteBlock, 0x400, left));
      drain();
      Frame frame = part(0, 7);
      frame.dlc = static_cast<std::uint8_t>(n);
      for (unsigned i = n; i < 8; ++i) frame.data[i] = 0;
      tell(frame);
      drain();
      tell(block_frame(kAbort, 0, 0));
      drain();
    }
  }
}

// RN-101: transfers among other commands, in any order, with errors.
TEST(PortBlocksRandom, TransfersAreThoseOfTheModel) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    PortLockstep pair{"full", 3, 3};
    RandomHost host{seed};
    unsigned seq = 0;
    for (unsigned i = 0; i < 500; ++i) {
      switch (host.upto(10)) {
        case 0: {
          const Op op = host.once_in(6) ? kAbort : host.once_in(2) ? kReadBlock : kWriteBlock;
          const unsigned at = host.once_in(3) ? host.upto(0x1100) : host.upto(0x400);
          pair.receive(block_frame(op, at, 1 + host.upto(host.once_in(3) ? 90 : 40), host.upto(4)));
          seq = 0;
          break;
        }
        case 1:
        case 2:
        case 3:
        case 4:
          pair.receive(part(seq & 0xFF, host.once_in(4) ? 1 + host.upto(7) : 7));
          if (!host.once_in(12)) ++seq;
          if (host.once_in(40)) ++seq;
          break;
        case 5: pair.drain(); break;
        default: random_port_step(pair, host); break;
      }
      ASSERT_EQ(pair.compare(), "") << "seed " << seed << " step " << i << "\n" << pair.history();
    }
  }
}

}  // namespace
}  // namespace vericansim
