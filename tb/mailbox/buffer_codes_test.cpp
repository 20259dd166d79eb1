// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Codes of the message buffers: every transition of flexcan.md 3.2, from every code, by every
// sequence of three events; the model of the buffers is the judge.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

constexpr Frame kData{.id = 0x123, .dlc = 3, .data = {0xA1, 0xB2, 0xC3}};
constexpr Frame kRequest{.id = 0x123, .remote = true, .dlc = 2};
constexpr Frame kOther{.id = 0x124, .dlc = 1, .data = {0x55}};
constexpr unsigned kMb = 5;

// Configurations that decide what a code does.
struct Setting {
  const char *name;
  BufferConfig config;
};
const Setting kSettings[] = {
    {"Queue", {.num_mb = 16, .maxmb = 15}},
    {"NoQueue", {.num_mb = 16, .maxmb = 15, .bcc = false}},
    {"StoreRemote", {.num_mb = 16, .maxmb = 15, .eacen = true, .rrs = true}},
    {"Abort", {.num_mb = 16, .maxmb = 15, .aen = true}},
};

// What can happen to buffer kMb.
enum class Event : unsigned {
  kDataFrame,
  kRemoteFrame,
  kRead,
  kReadAndUnlock,
  kClearFlag,
  kWriteEmpty,
  kWriteInactive,
  kWriteSend,
  kCount
};
constexpr unsigned kEvents = static_cast<unsigned>(Event::kCount);

void apply(BufferRig &rig, Event event, std::uint32_t header) {
  switch (event) {
    case Event::kDataFrame: rig.receive(kData); break;
    case Event::kRemoteFrame: rig.receive(kRequest); break;
    case Event::kRead: rig.read_cs(kMb); break;
    case Event::kReadAndUnlock:
      rig.read_cs(kMb);
      rig.read(reg::kTimer);
      break;
    case Event::kClearFlag: rig.write(reg::kIflag1, 1u << kMb); break;
    case Event::kWriteEmpty: rig.write(reg::mb(kMb), (kRxEmpty << 24) | header); break;
    case Event::kWriteInactive: rig.write(reg::mb(kMb), (kTxInactive << 24) | header); break;
    case Event::kWriteSend: rig.write(reg::mb(kMb), (kTxActive << 24) | header); break;
    case Event::kCount: break;
  }
  rig.quiet();
}

// One rig for many sequences: the buffer is written anew, its flag cleared before each.
void prepare(BufferRig &rig, unsigned code, std::uint32_t header) {
  for (int i = 0; i < 2; ++i) {  // AEN=1: an aborted buffer is protected until its flag is cleared
    rig.write(reg::mb(kMb), header);
    rig.quiet();
    rig.write(reg::kIflag1, 0xFFFF);
  }
  rig.read(reg::kTimer);
  rig.put(kMb, {.cs = (code << 24) | header, .id = 0x123u << 18, .low = 0x11223344, .high = 0x55});
  rig.quiet();
}

class BufferCodes : public ::testing::TestWithParam<std::tuple<unsigned, unsigned>> {};

// FX-3.2.a, FX-3.2.b, FX-3.2.c, FX-3.2.d, FX-3.2.e: what a stored frame makes of the code.
// FX-3.2.f, FX-3.2.g, FX-3.2.h, FX-3.2.i: what a sent frame and a request make of it.
// FX-3.2.k, FX-3.2.m, FX-3.2.n, FX-3.6.a, FX-3.6.b, FX-3.6.g: writes, other codes, reads, services.
TEST_P(BufferCodes, EverySequenceOfThreeEvents) {
  const auto [code, setting] = GetParam();
  BufferRig rig{kSettings[setting].config};
  rig.go();
  for (unsigned sequence = 0; sequence < kEvents * kEvents * kEvents; ++sequence) {
    for (const std::uint32_t header : {0x00030000u, 0x00130000u}) {  // RTR = 0, 1
      const std::array<unsigned, 3> events{sequence % kEvents, sequence / kEvents % kEvents,
                                           sequence / kEvents / kEvents};
      SCOPED_TRACE(testing::Message() << "events " << events[0] << events[1] << events[2]
                                      << ", header " << std::hex << header);
      prepare(rig, code, header);
      for (const unsigned event : events) apply(rig, static_cast<Event>(event), header);
      rig.compare();
      if (testing::Test::HasFailure()) return;
    }
  }
}

// The frame in buffer 9 is the one with this number on the bus, and begins by then.
void expect_frame(BufferRig &rig, unsigned number, unsigned clocks) {
  EXPECT_TRUE(rig.run_until([&] { return rig.frames_started() == number; }, clocks));
  rig.quiet();
  ASSERT_FALSE(rig.sent().empty());
  EXPECT_EQ(rig.sent().back(), kOther);
  EXPECT_EQ(rig.frames_started(), number);
  rig.write(reg::kIflag1, 0xFFFF);
}

constexpr unsigned kSettle = 100 + BufferRig::kBit;  // docs/integration.md, and a bit

// A code that does not send, 1101 and 1111 too, neither goes on the bus nor keeps another buffer
// off it, although its identifier and its number would win: found when the node joins, standing
// while another buffer is activated, written after that.
TEST(InactiveCodes, NeitherSendNorDelay) {  // FX-3.2.m, FX-3.3.a, FX-3.3.g
  for (const unsigned code : {0x0u, 0x1u, 0x5u, 0x8u, 0x9u, 0xAu, 0xBu, 0xDu, 0xFu}) {
    for (const bool lbuf : {false, true}) {
      SCOPED_TRACE(testing::Message() << "code " << code << ", LBUF " << lbuf);
      BufferRig rig{{.num_mb = 16, .maxmb = 15, .lbuf = lbuf}};
      rig.put_tx(kMb, {.id = 0}, code);
      rig.put_tx(9, kOther);
      rig.go();
      expect_frame(rig, 1, kSettle);
      rig.put_tx(9, kOther);
      expect_frame(rig, 2, kSettle);
      rig.peer_sends(kData);
      ASSERT_TRUE(rig.run_until([&] { return rig.frames_started() == 3; }, 400));
      const std::uint64_t before = rig.end_clock();
      rig.put_tx(9, kOther);
      rig.put_tx(kMb, {.id = 0}, code);
      ASSERT_TRUE(rig.run_until([&] { return rig.end_clock() > before; }, 2000));
      expect_frame(rig, 4, 6 * BufferRig::kBit);  // EOF7, intermission, SOF
      rig.compare();
    }
  }
}

// Bits 31:28 and 23 mean nothing in a C/S word that sends.
TEST(InactiveCodes, ReservedBitsDoNotStopAFrame) {  // FX-3.3.a, flexcan.md section 0, item 5
  for (const unsigned bit : {23u, 28u, 29u, 30u, 31u}) {
    BufferRig rig{{.num_mb = 16, .maxmb = 15}};
    rig.go();
    MbWords words = mb_words(kOther, kTxActive);
    words.cs |= 1u << bit;
    rig.put(9, words);
    expect_frame(rig, 1, kSettle);
    rig.compare();
  }
}

INSTANTIATE_TEST_SUITE_P(All, BufferCodes,
                         ::testing::Combine(::testing::Range(0u, 16u),
                                            ::testing::Range(0u, unsigned{std::size(kSettings)})),
                         [](const auto &test) {
                           return std::string{kSettings[std::get<1>(test.param)].name} + "_Code" +
                                  std::to_string(std::get<0>(test.param));
                         });

}  // namespace
}  // namespace vericansim
