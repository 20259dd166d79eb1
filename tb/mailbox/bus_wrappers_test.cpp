// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bus wrappers: byte lanes, random accesses through each at once, speed, errors, dropped
// cycles. The tests of registers, driver and races run through each of them, too (CMakeLists.txt).
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "harness/bus_builds.hpp"
#include "mailbox/mailbox_rig.hpp"
#include "mailbox/register_table.hpp"
#include "node/axil_master.hpp"
#include "node/wb_master.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kWindow = 0x2000;

/// With MCR.AEN each write of a buffer waits for a clock.
constexpr std::uint32_t kAen = 1u << 12;

/// A node in freeze mode behind a bus.
std::unique_ptr<RtlNode> frozen(const std::string &bus) {
  auto node = make_bus_node(bus, bus);
  for (int i = 0; i < 300; ++i) node->advance();  // until the buffer RAM is cleared
  node->write32(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 63);
  while ((node->read32(reg::kMcr) & reg::kMcrFrzAck) == 0) {
  }
  return node;
}

std::vector<std::string> all_buses() { return {std::begin(kBusBuilds), std::end(kBusBuilds)}; }
/// Those with byte lanes.
std::vector<std::string> lane_buses() {
  std::vector<std::string> buses = all_buses();
  std::erase(buses, "ahb");
  return buses;
}

class Lanes : public ::testing::TestWithParam<std::string> {
 protected:
  void TearDown() override {
    EXPECT_EQ(node_->master().report().violations, std::vector<std::string>{});
    if (GetParam() == "axil_slow") return;  // waits for other reasons
    EXPECT_LE(node_->master().report().max_waits, 1u);
  }
  std::uint32_t write(std::uint32_t address, std::uint32_t data, int lanes) {
    EXPECT_FALSE(
        node_->access({.address = address, .write = true, .data = data, .lanes = lanes}).error);
    return node_->read32(address);
  }

  std::unique_ptr<RtlNode> node_ = frozen(GetParam());
};

std::string name_of(const ::testing::TestParamInfo<std::string> &test) { return test.param; }
INSTANTIATE_TEST_SUITE_P(Bus, Lanes, ::testing::ValuesIn(lane_buses()), name_of);

std::uint32_t bits_of(int lanes) {
  std::uint32_t bits = 0;
  for (int lane = 0; lane < 4; ++lane)
    if (((lanes >> lane) & 1) != 0) bits |= 0xFFu << (8 * lane);
  return bits;
}

// Every register, each with the sixteen patterns: a byte changes where its strobe is set, as far as
// the register map lets it. What a write does beside that is the matter of RegisterMap.
TEST_P(Lanes, EveryPatternWritesItsBytesInEveryRegister) {
  for (const RegisterRow &row : kRegisterTable) {
    if (row.offset == reg::kMcr || row.min_num_mb > 64) continue;
    const bool time_unit = row.missing(Features{}) == 0xFFFFFFFF;
    const unsigned count = row.count == 0 ? 64 : row.count;
    for (const unsigned i : {0u, count - 1}) {
      const std::uint32_t offset = row.offset + i * row.stride;
      SCOPED_TRACE(std::string{row.name} + " " + std::to_string(i));
      const std::uint32_t bits = time_unit ? 0 : (row.any | row.freeze) & ~row.missing(Features{});
      for (int lanes = 0; lanes < 16; ++lanes) {
        for (const std::uint32_t pattern : {0xFFFFFFFFu, 0u}) {
          const std::uint32_t old = node_->read32(offset);
          const std::uint32_t changed = bits & bits_of(lanes);
          const std::uint32_t cleared = pattern & row.w1c & bits_of(lanes);
          EXPECT_EQ(write(offset, pattern, lanes) & ~row.live,
                    ((old & ~changed & ~cleared) | (pattern & changed)) & ~row.live)
              << "lanes " << lanes << " of " << std::hex << pattern;
        }
      }
    }
  }
}

// Reserved bytes of MCR aside: its bytes are apart, too.
TEST_P(Lanes, McrTakesItsBytesApart) {
  const std::uint32_t old = node_->read32(reg::kMcr);
  for (int lanes = 0; lanes < 16; ++lanes) {
    const std::uint32_t changed = bits_of(lanes) & 0x7F;  // MAXMB
    EXPECT_EQ(write(reg::kMcr, (old & ~0x7Fu) | 0x15, lanes), (old & ~changed) | (0x15 & changed));
    (void)write(reg::kMcr, old, 0xF);
  }
}

// A write without a strobe is none: it does not unlock a buffer, as a write of C/S would.
TEST_P(Lanes, NoStrobeNoWrite) {
  EXPECT_EQ(write(reg::mb(3), 0x0400'0000, 0xF), 0x0400'0000u);
  EXPECT_EQ(write(reg::mb(3), 0x0800'0000, 0), 0x0400'0000u);
  // Nor does it reach the core, where it would wait.
  node_->write32(reg::kMcr, node_->read32(reg::kMcr) | kAen);
  if (GetParam() == "axil_slow") return;  // waits for other reasons
  for (const int lanes : {0, 1})
    EXPECT_EQ(node_->access({.address = reg::mb(3), .write = true, .lanes = lanes}).waits,
              lanes == 0 ? 0u : 1u);
}

// SEL is passed on, but a read without a lane is a transfer as any (PK-12).
TEST_P(Lanes, AReadWithoutALaneIsOne) {
  (void)write(reg::mb(5, 2), 0x12345678, 0xF);
  EXPECT_NE(node_->read32(reg::kMcr), 0x12345678u);
  EXPECT_EQ(node_->access({.address = reg::mb(5, 2), .lanes = 0}).data, 0x12345678u);
}

// What is not of the bus reaches the core.
TEST_P(Lanes, StopRequestIsPassedOn) {
  const auto acknowledged = [&] { return (node_->read32(reg::kMcr) & reg::kMcrLpmAck) != 0; };
  EXPECT_FALSE(acknowledged());
  node_->request_stop(true);
  for (int i = 0; i < 50; ++i) node_->advance();
  EXPECT_TRUE(acknowledged());
  node_->request_stop(false);
  for (int i = 0; i < 50; ++i) node_->advance();
  EXPECT_FALSE(acknowledged());
}

// Each line is that of its own flag and mask; what raises them is the matter of InterruptLines.
TEST_P(Lanes, InterruptLinesArePassedOn) {
  constexpr std::uint32_t kMcr = reg::kMcrWrnEn | 1u << 26 | 1u << 22 | 63;    // WAK_MSK, SLF_WAK
  constexpr std::uint32_t kMasks = 1u << 15 | 1u << 14 | 1u << 11 | 1u << 10;  // BOFF to RWRN
  const auto run = [&](unsigned clocks, Level level) {
    for (; clocks != 0; --clocks) {
      node_->clock(level);
      node_->oscillator().tick();
    }
  };
  const auto join_with = [&](std::uint32_t counters) {
    node_->write32(reg::kMcr, kMcr | reg::kMcrFrz | reg::kMcrHalt);
    while ((node_->read32(reg::kMcr) & reg::kMcrFrzAck) == 0) {
    }
    node_->write32(reg::kCtrl, 2u << 19 | 1u << 16 | 1u | kMasks);  // 8 clocks a bit
    node_->write32(reg::kEcr, counters);
    node_->write32(reg::kEsr, reg::kEsrInterrupts | 1);
    node_->write32(reg::kMcr, kMcr);
    run(200, Level::kRecessive);
    EXPECT_EQ(node_->irq_lines(), 0);
  };
  join_with(0);
  node_->request_stop(true);
  run(60, Level::kRecessive);
  run(10, Level::kDominant);
  node_->request_stop(false);
  run(200, Level::kRecessive);
  EXPECT_EQ(node_->irq_lines(), kIrqAll | kIrqWake);
  join_with(95u << 8);  // REC: a frame that is none
  run(56, Level::kDominant);
  run(400, Level::kRecessive);
  EXPECT_EQ(node_->irq_lines(), kIrqAll | kIrqError | kIrqRxWarning);
  join_with(95);  // TEC: what it sends does not come back
  node_->write32(reg::mb(8), 0xCu << 24);
  run(20'000, Level::kRecessive);
  EXPECT_EQ(node_->irq_lines(), kIrqAll | kIrqError | kIrqTxWarning | kIrqBusOff);
  node_->write32(reg::kEsr, reg::kEsrInterrupts);
  run(3, Level::kRecessive);
  EXPECT_EQ(node_->irq_lines(), 0);
}

// CheckProt is 0: MCR.SUPV is stored, and nothing else. With 1: bus_rights_test.
TEST_P(Lanes, WithoutCheckProtUsersMay) {
  constexpr std::uint8_t kUser = 0b0001;
  node_->write32(reg::kMcr, node_->read32(reg::kMcr) | reg::kMcrSupv);
  node_->access({.address = reg::kImask1, .write = true, .data = 0x99, .hprot = kUser});
  EXPECT_EQ(node_->access({.address = reg::kImask1, .hprot = kUser}).data, 0x99u);
}

// Errors: outside the window, nowhere else, and with no effect; data 0, no wait.
TEST_P(Lanes, OutsideTheWindowIsAnError) {
  (void)write(reg::mb(5, 2), 0x12345678, 0xF);
  for (const std::uint32_t bit : {13u, 14u, 15u}) {
    const std::uint32_t far = reg::mb(5, 2) | 1u << bit;
    const AhbResult written = node_->access({.address = far, .write = true, .data = 1});
    const AhbResult read = node_->access({.address = far});
    EXPECT_TRUE(written.error && read.error);
    EXPECT_EQ(read.data, 0u);
    if (GetParam() == "axil_slow") continue;  // waits for other reasons
    EXPECT_EQ(written.waits + read.waits, 0u);
  }
  EXPECT_EQ(node_->read32(reg::mb(5, 2)), 0x12345678u);
  // Not of the region.
  for (unsigned bit = 31; bit >= 16; --bit) {
    const std::uint32_t same = reg::mb(5, 2) | 1u << bit;
    EXPECT_EQ(write(same, 0xA5A50000u + bit, 0xF), 0xA5A50000u + bit) << "address bit " << bit;
    EXPECT_EQ(node_->read32(reg::mb(5, 2)), 0xA5A50000u + bit) << "address bit " << bit;
  }
  EXPECT_EQ(write(reg::mb(5, 2), 0x12345678, 0xF), 0x12345678u);
  EXPECT_FALSE(node_->access({.address = kWindow - 4}).error);
}

// As many clocks as promised, back to back: reads and writes of registers, which never wait.
TEST_P(Lanes, TransfersTakeTheClocksThatTheyShould) {
  if (GetParam() == "axil_slow") GTEST_SKIP() << "has delays of its own";
  const bool pipelined = GetParam() == "wb_pipelined";
  for (const bool writing : {false, true}) {
    const unsigned clocks = pipelined ? 1 : GetParam() == "axil" && writing ? 3 : 2;
    const std::uint64_t before = node_->cycles();
    BusMaster::Ticket last = 0;
    for (int i = 0; i < 100; ++i)
      last = node_->master().submit({.address = reg::kImask1, .write = writing, .data = 5});
    while (!node_->master().done(last)) node_->advance();
    const auto taken = static_cast<unsigned>(node_->cycles() - before);
    EXPECT_GE(taken, 100 * clocks);
    EXPECT_LE(taken, 100 * clocks + 2);
  }
}

// A read and a write at the same time, with delays of all channels and AW and W in either order:
// each sees the word that it should.
TEST(AxilWrapper, ReadsAndWritesAtTheSameTime) {
  const auto node = frozen("axil_slow");
  auto &master = dynamic_cast<AxilMaster &>(node->master());
  master.overlap(true);
  constexpr unsigned kWords = 64, kFirst = 2;  // data words of buffers from 2 on
  const auto word = [](unsigned half, unsigned n) { return reg::mb(kFirst + n % 32, 2 + half); };
  std::vector<std::uint32_t> shadow(kWords, 0);
  std::mt19937 rng{7};
  // One in four is beyond the window: its error belongs to it alone.
  const auto beyond = [&rng] { return rng() % 4 == 0 ? kWindow : 0; };
  for (unsigned round = 0; round < 200; ++round) {
    const unsigned half = round % 2;  // the one that is written; the other is read
    std::vector<std::pair<BusMaster::Ticket, AhbResult>> wanted;
    for (unsigned i = 0; i < 20; ++i) {
      const unsigned n = rng() % 32, m = rng() % 32;
      const std::uint32_t lost = beyond(), nothing = beyond();
      const auto data = static_cast<std::uint32_t>(rng());
      if (lost == 0) shadow[half * 32 + n] = data;
      wanted.emplace_back(
          master.submit({.address = word(half, n) | lost, .write = true, .data = data}),
          AhbResult{.error = lost != 0});
      wanted.emplace_back(master.submit({.address = word(1 - half, m) | nothing}),
                          AhbResult{nothing != 0 ? 0 : shadow[(1 - half) * 32 + m], nothing != 0});
    }
    while (master.active()) node->advance();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const AhbResult &result = master.result(wanted[i].first);
      ASSERT_EQ(result.error, wanted[i].second.error) << "transfer " << i;
      if (i % 2 == 0) continue;
      ASSERT_EQ(result.data, wanted[i].second.data) << "transfer " << i;
    }
  }
  EXPECT_EQ(master.report().violations, std::vector<std::string>{});
}

class Dropped : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Bus, Dropped, ::testing::Values("wb", "wb_pipelined", "wb_stalled"),
                         name_of);

// A cycle that is dropped in any clock gets no answer, not even in a cycle that begins at once, and
// what comes then is as ever.
TEST_P(Dropped, GetsNoAnswer) {
  const auto node = frozen(GetParam());
  auto &master = dynamic_cast<WbMaster &>(node->master());
  node->write32(reg::kMcr, node->read32(reg::kMcr) | kAen);
  for (unsigned n = 0; n < 16; ++n) node->write32(reg::mb(n, 2), 0x1111 * n);
  std::mt19937 rng{11};
  const auto random = [&rng] { return static_cast<std::uint32_t>(rng()); };
  for (unsigned round = 0; round < 2000; ++round) {
    const std::uint32_t scratch = reg::mb(20 + rng() % 8, 2 + rng() % 2);
    if (rng() % 3 == 0) master.submit({.address = scratch, .write = true, .data = random()});
    const auto lost =
        master.submit({.address = scratch, .write = rng() % 2 != 0, .data = random()});
    for (unsigned clocks = rng() % 4; clocks != 0; --clocks) node->advance();
    master.drop();
    while (master.active() && !master.done(lost)) node->advance();  // what was not begun
    for (unsigned pause = rng() % 3; pause != 0; --pause) node->advance();
    const unsigned n = rng() % 16;
    ASSERT_EQ(node->read32(reg::mb(n, 2)), 0x1111 * n) << "round " << round;
  }
  EXPECT_EQ(master.report().violations, std::vector<std::string>{});
}

AhbTransfer random_transfer(std::mt19937 &rng) {
  AhbTransfer transfer;
  transfer.size = static_cast<AhbSize>(rng() % 3);
  const auto page = static_cast<std::uint32_t>(rng() % 8);
  const std::uint32_t span = page < 4 ? 0x480u : page < 6 ? 0x80u : kWindow;
  transfer.address = rng() % span & ~((1u << static_cast<unsigned>(transfer.size)) - 1);
  if (rng() % 64 == 0) transfer.address |= 1u << (13 + rng() % 3);
  transfer.write = rng() % 2 != 0;
  transfer.data = static_cast<std::uint32_t>(rng());
  transfer.pause = rng() % 4 == 0 ? rng() % 4 : 0;
  // MCR would leave freeze mode; ESR1, TIMER and ECR live with the clock, XCTRL with nothing.
  const std::uint32_t word = transfer.address & 0x1FFC;
  if (word == reg::kMcr || word == reg::kTimer || word == reg::kEsr || word == reg::kEcr)
    transfer.address ^= 0x100;
  // A read of ESR1 counts by its lanes, which APB and AXI do not have; all else reads whole words.
  return transfer;
}

// The same accesses, at the pace of each bus: 100,000 results, and no rule of a bus broken.
TEST(Differential, AllBusesReturnTheSameInFreezeMode) {
  constexpr unsigned kAccesses = 100'000, kBatch = 100;
  std::vector<std::unique_ptr<RtlNode>> nodes;
  for (const std::string &bus : all_buses()) nodes.push_back(frozen(bus));
  std::mt19937 rng{2026};
  for (unsigned done = 0; done < kAccesses; done += kBatch) {
    std::vector<AhbTransfer> transfers(kBatch);
    for (AhbTransfer &transfer : transfers) transfer = random_transfer(rng);
    std::vector<AhbResult> wanted;
    for (const auto &node : nodes) {
      std::vector<BusMaster::Ticket> tickets;
      for (const AhbTransfer &transfer : transfers)
        tickets.push_back(node->master().submit(transfer));
      while (!node->master().done(tickets.back())) node->advance();
      for (unsigned i = 0; i < kBatch; ++i) {
        const AhbResult &result = node->master().result(tickets[i]);
        if (node == nodes.front()) wanted.push_back(result);
        ASSERT_EQ(result.error, wanted[i].error) << node->name() << " access " << done + i;
        if (transfers[i].write) continue;
        ASSERT_EQ(result.error ? 0 : result.data, wanted[i].error ? 0 : wanted[i].data)
            << node->name() << " access " << done + i << " of " << std::hex << transfers[i].address;
      }
    }
  }
  for (const auto &node : nodes) {
    EXPECT_EQ(node->master().report().violations, std::vector<std::string>{}) << node->name();
    EXPECT_GE(node->master().report().transfers, kAccesses) << node->name();
    EXPECT_GT(node->master().report().errors, kAccesses / 100) << node->name();
  }
}

}  // namespace
}  // namespace vericansim
