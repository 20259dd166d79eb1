// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AHB-Lite: wait states, ERROR responses, byte lanes, bursts; judged by the checker at the pins.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {
namespace {

class Access : public ::testing::Test {
 protected:
  Access() : rig_{1} { rig_.configure(0); }
  ~Access() override {
    for (const std::string &rule : rig_.node(0).ahb().checker().violations()) ADD_FAILURE() << rule;
  }
  static AhbTransfer read(std::uint32_t address, AhbSize size = AhbSize::kWord) {
    return {.address = address, .size = size};
  }
  static AhbTransfer write(std::uint32_t address, std::uint32_t data,
                           AhbSize size = AhbSize::kWord) {
    return {.address = address, .write = true, .size = size, .data = data};
  }
  MailboxRig rig_;
};

// Any mix, back to back, while the engine looks at its buffers: what lies in the buffers' RAM, and
// TIMER, has one wait state, everything else none (PK-39).
TEST_F(Access, WaitStates) {
  rig_.go(0);
  const auto in_ram = [](const AhbTransfer &transfer) {
    if (transfer.address >= 0x880) return !transfer.write;  // masks are not written now
    if (transfer.address >= 0x80) return true;
    return std::set<std::uint32_t>{0x08, 0x10, 0x14, 0x18, 0x48, 0x4C}.count(transfer.address) != 0;
  };
  std::mt19937 rng{1};
  for (unsigned round = 0; round < 200; ++round) {
    std::vector<AhbTransfer> transfers;
    for (unsigned i = 0; i < 20; ++i) {
      const unsigned pick = rng() % 4, mb = rng() % 64, word = rng() % 4;
      const std::uint32_t address = pick == 0   ? 4 * (rng() % 0x14)
                                    : pick == 1 ? reg::rximr(mb)
                                                : reg::mb(mb, word);
      // MCR and CTRL1 stay as they are.
      const bool is_write = rng() % 2 == 0 && address >= 0x80;
      transfers.push_back(is_write ? write(address, rng() & 0x007FFFFF) : read(address));
    }
    const auto results = rig_.burst(0, transfers);
    ASSERT_EQ(results.size(), transfers.size());
    for (unsigned i = 0; i < results.size(); ++i) {
      EXPECT_EQ(results[i].waits, in_ram(transfers[i]) ? 1u : 0u)
          << std::hex << transfers[i].address;
      EXPECT_FALSE(results[i].error);
    }
  }
}

TEST_F(Access, ReadRightAfterAWriteSeesIt) {
  std::mt19937 rng{2};
  for (unsigned i = 0; i < 500; ++i) {
    const std::uint32_t address =
        rng() % 2 == 0 ? reg::mb(rng() % 64, 1 + rng() % 3) : reg::rximr(rng() % 64);
    const std::uint32_t value = rng();
    const auto results = rig_.burst(0, {write(address, value), read(address), read(address)});
    EXPECT_EQ(results[1].data, value);
    EXPECT_EQ(results[2].data, value);
    for (const AhbResult &result : results) EXPECT_EQ(result.waits, 1u);
  }
}

TEST_F(Access, ByteAndHalfWordLanesOfBuffersAndMasks) {
  std::mt19937 rng{3};
  std::map<std::uint32_t, std::uint32_t> memory;  // independent picture of the words
  for (unsigned i = 0; i < 4000; ++i) {
    const std::uint32_t word =
        rng() % 2 == 0 ? reg::mb(rng() % 8, 1 + rng() % 3) : reg::rximr(rng() % 8);
    if (memory.count(word) == 0) rig_.write(0, word, memory[word] = rng());
    const auto size = static_cast<AhbSize>(rng() % 3);
    const unsigned bytes = 1u << static_cast<unsigned>(size);
    const unsigned offset = rng() % (4 / bytes) * bytes;
    const std::uint32_t mask = bytes == 4 ? 0xFFFFFFFF : (1u << (8 * bytes)) - 1;
    if (rng() % 2 == 0) {
      const std::uint32_t value = rng() & mask;
      const auto results = rig_.burst(0, {write(word + offset, value, size), read(word)});
      memory[word] = (memory[word] & ~(mask << (8 * offset))) | (value << (8 * offset));
      ASSERT_EQ(results[1].data, memory[word]) << std::hex << word + offset;
    } else {
      const AhbResult result = rig_.access(0, read(word + offset, size));
      ASSERT_EQ(result.data, (memory[word] >> (8 * offset)) & mask);
    }
  }
}

TEST_F(Access, ErrorForUnalignedTooWideAndBeyondTheWindow) {
  for (bool is_write : {false, true}) {
    for (AhbTransfer transfer :
         {read(reg::mb(3, 2) + 2), read(reg::mb(3, 2) + 1), read(reg::mb(3, 2) + 3),
          read(reg::mb(3, 2) + 1, AhbSize::kHalf), read(reg::mb(3, 2) + 3, AhbSize::kHalf),
          read(reg::mb(3, 2), AhbSize::kDouble), read(0x2000), read(0x2000 + reg::mb(3, 2)),
          read(0xE000 + reg::mb(3, 2))}) {
      transfer.write = is_write;
      transfer.data = 0xFFFFFFFF;
      const AhbResult result = rig_.access(0, transfer);
      EXPECT_TRUE(result.error) << std::hex << transfer.address;
    }
  }
  EXPECT_EQ(rig_.read(0, reg::mb(3, 2)), 0u) << "a refused write writes nothing";
}

TEST_F(Access, AddressBitsOfTheRegionDoNotMatter) {
  for (unsigned bit = 16; bit < 32; ++bit) {
    rig_.write(0, (1u << bit) + reg::mb(3, 2), 0x12345600u + bit);
    EXPECT_EQ(rig_.read(0, reg::mb(3, 2)), 0x12345600u + bit) << "address bit " << bit;
  }
}

TEST_F(Access, EveryWidthAboveAWordGetsAnError) {
  for (unsigned size = 3; size < 8; ++size) {
    const AhbTransfer transfer = write(reg::mb(3, 2), 0xFFFFFFFF, static_cast<AhbSize>(size));
    EXPECT_TRUE(rig_.access(0, transfer).error) << "HSIZE " << size;
  }
  EXPECT_EQ(rig_.read(0, reg::mb(3, 2)), 0u);
}

TEST_F(Access, KindOfAccessDoesNotMatter) {  // HPROT with CheckHprot = 0
  for (unsigned hprot = 0; hprot < 16; ++hprot) {
    AhbTransfer transfer = write(reg::mb(3, 2), 0xA5A50000u + hprot);
    transfer.hprot = static_cast<std::uint8_t>(hprot);
    EXPECT_FALSE(rig_.access(0, transfer).error);
    transfer.write = false;
    EXPECT_EQ(rig_.access(0, transfer).data, 0xA5A50000u + hprot) << "HPROT " << hprot;
  }
}

TEST_F(Access, ReservedOffsetsReadZeroWithoutError) {
  for (std::uint32_t address :
       {0x00Cu, 0x03Cu, 0x050u, 0x480u, 0x700u, 0x980u, 0xFFCu, 0x1010u, 0x1FFCu}) {
    const auto results = rig_.burst(0, {write(address, 0xFFFFFFFF), read(address)});
    EXPECT_FALSE(results[0].error || results[1].error) << std::hex << address;
    EXPECT_EQ(results[1].data, 0u) << std::hex << address;
  }
}

TEST_F(Access, TransferAfterAnErrorIsNotLost) {
  const auto results =
      rig_.burst(0, {write(reg::mb(1, 2), 0x11), read(0x2000), write(reg::mb(1, 3), 0x22),
                     read(0x82), read(reg::mb(1, 2)), read(reg::mb(1, 3))});
  EXPECT_TRUE(results[1].error && results[3].error);
  EXPECT_EQ(results[4].data, 0x11u);
  EXPECT_EQ(results[5].data, 0x22u);
}

TEST_F(Access, BurstsWithBusyAndIdleBetween) {
  AhbMaster &ahb = rig_.node(0).ahb();
  for (AhbBurst burst : {AhbBurst::kIncr4, AhbBurst::kIncr8, AhbBurst::kWrap4, AhbBurst::kWrap8,
                         AhbBurst::kIncr16}) {
    std::vector<std::uint32_t> data(ahb_beats(burst));
    for (std::uint32_t &word : data)
      word = 0x1000 + static_cast<std::uint32_t>(&word - data.data());
    const std::uint32_t base = reg::rximr(8);  // aligned, so that wrapping bursts stay in place
    auto ticket = ahb.submit_burst(base, burst, true, data);
    ticket = ahb.submit_burst(base, burst, false, data);
    ASSERT_TRUE(rig_.run_until([&] { return ahb.done(ticket + data.size() - 1); }, 200));
    for (unsigned i = 0; i < data.size(); ++i) EXPECT_EQ(ahb.result(ticket + i).data, data[i]);
  }
  const auto results =
      rig_.burst(0, {{.address = reg::mb(2, 2), .write = true, .data = 5, .pause = 2},
                     {.address = reg::mb(2, 2), .pause = 3}});
  EXPECT_EQ(results[1].data, 5u);
}

TEST_F(Access, ExtensionPageNeverStalls) {
  rig_.node(0).reset();
  for (unsigned i = 0; i < 300; ++i) {  // while the RAM is being cleared after reset, too
    const auto results = rig_.burst(0, {read(0x1000), read(0x1004), read(0x1008), read(0x100C)});
    EXPECT_EQ(results[0].data, 0x5643414Eu);
    for (const AhbResult &result : results) EXPECT_EQ(result.waits, 0u);
  }
}

TEST_F(Access, BuffersReadZeroAfterReset) {
  rig_.write(0, reg::mb(17, 2), 0xFFFFFFFF);
  rig_.node(0).reset();
  EXPECT_EQ(rig_.read(0, reg::mb(17, 2)), 0u);
  rig_.run(300);
  for (unsigned mb = 0; mb < 64; ++mb)
    for (unsigned word = 0; word < 4; ++word) EXPECT_EQ(rig_.read(0, reg::mb(mb, word)), 0u);
}

// A CPU that reads a C/S word in every clock meets the core's write of it when the frame has been
// sent: the word is the one before or the one after, never a mixture.
TEST(AccessWhileSending, ControlWordIsTheOldOrTheNewOne) {  // FX-3.2.f, FX-3.3.j
  MailboxRig rig{2};
  for (unsigned n = 0; n < 2; ++n) rig.configure(n), rig.go(n);
  const std::vector<AhbTransfer> reads(200, {.address = reg::mb(5)});
  constexpr std::uint32_t kHeader = 0x007F0000, kStamp = 0x0000FFFF;
  for (unsigned alignment = 0; alignment < 4; ++alignment) {
    rig.put_tx(0, 5, {.id = 0x1234567 + alignment, .extended = true, .dlc = 5});
    const std::uint32_t header = rig.read(0, reg::mb(5)) & kHeader;
    rig.run(alignment);
    std::vector<AhbResult> results;
    while (results.size() < 1400)
      for (const AhbResult &result : rig.burst(0, reads)) results.push_back(result);
    const std::uint32_t last = results.back().data;
    ASSERT_EQ(last >> 24, 0x8u) << "sent";
    unsigned changes = 0;
    for (std::size_t i = 1; i < results.size(); ++i) {
      const std::uint32_t word = results[i].data;
      changes += (word ^ results[i - 1].data) >> 24 != 0;
      ASSERT_EQ(word & kHeader, header) << i;
      ASSERT_TRUE(word >> 24 == 0xC || word == last) << i << ": " << std::hex << word;
      ASSERT_TRUE((word & kStamp) == 0 || (word & kStamp) == (last & kStamp)) << i;
      ASSERT_LE(results[i].waits, 1u);
    }
    EXPECT_EQ(changes, 1u);
    rig.clear_flag(0, 5);
  }
}

}  // namespace
}  // namespace vericansim
