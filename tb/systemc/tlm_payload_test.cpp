// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Generic payloads as AHB transfers: against what IEEE 1666 says of the attributes, byte by byte.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "systemc/payload.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

using Bytes = std::vector<unsigned char>;

struct Refusal {
  const char *name;
  tlm::tlm_command command;
  std::uint64_t address;
  unsigned length, width;
  Bytes enables;
  tlm::tlm_response_status status;
};

void PrintTo(const Refusal &refusal, std::ostream *out) { *out << refusal.name; }

class Refused : public ::testing::TestWithParam<Refusal> {};

TEST_P(Refused, WithTheStatusThatNamesTheReason) {
  const Refusal &c = GetParam();
  Bytes data(64), enables = c.enables;
  tlm::tlm_generic_payload payload;
  Master::fill(payload, c.command, c.address, data.data(), c.length);
  payload.set_streaming_width(c.width);
  if (!enables.empty()) {
    payload.set_byte_enable_ptr(enables.data());
    payload.set_byte_enable_length(static_cast<unsigned>(enables.size()));
  }
  std::vector<Beat> beats;
  EXPECT_EQ(plan_beats(payload, beats), c.status);
}

constexpr auto kRead = tlm::TLM_READ_COMMAND;
constexpr auto kWrite = tlm::TLM_WRITE_COMMAND;
constexpr unsigned char kOn = 0xFF, kOff = 0;

INSTANTIATE_TEST_SUITE_P(
    Reasons, Refused,
    ::testing::Values(
        Refusal{"Ignore", tlm::TLM_IGNORE_COMMAND, 0, 4, 4, {}, tlm::TLM_COMMAND_ERROR_RESPONSE},
        Refusal{"NoLength", kRead, 0, 0, 4, {}, tlm::TLM_BURST_ERROR_RESPONSE},
        Refusal{"ThreeBytes", kRead, 0, 3, 3, {}, tlm::TLM_BURST_ERROR_RESPONSE},
        Refusal{"SixBytes", kRead, 0, 6, 6, {}, tlm::TLM_BURST_ERROR_RESPONSE},
        Refusal{"NoWidth", kRead, 0, 4, 0, {}, tlm::TLM_BURST_ERROR_RESPONSE},
        Refusal{"LengthNotOfWidth", kRead, 0, 12, 8, {}, tlm::TLM_BURST_ERROR_RESPONSE},
        Refusal{"WordAtTwo", kRead, 2, 4, 4, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"HalfAtOne", kWrite, 1, 2, 2, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"Beyond", kRead, 0x10000, 4, 4, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"AcrossTheEnd", kRead, 0xFFFC, 8, 8, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"FarBeyond", kRead, 0x1'0000'0000, 4, 4, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"Wrapping", kRead, ~3ULL, 8, 8, {}, tlm::TLM_ADDRESS_ERROR_RESPONSE},
        Refusal{"ThreeLanes",
                kWrite,
                0,
                4,
                4,
                {kOn, kOn, kOn, kOff},
                tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE},
        Refusal{"MiddleLanes",
                kWrite,
                0,
                4,
                4,
                {kOff, kOn, kOn, kOff},
                tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE},
        Refusal{"SplitLanes", kRead, 0, 4, 4, {kOn, kOff}, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE},
        Refusal{"NeitherOnNorOff", kRead, 0, 4, 4, {1}, tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE},
        Refusal{"BadInTheSecondWord",
                kWrite,
                0,
                8,
                8,
                {kOn, kOn, kOn, kOn, kOn, kOff, kOn, kOff},
                tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE}),
    [](const auto &param) { return std::string{param.param.name}; });

TEST(Payload, WithoutDataIsRefused) {
  tlm::tlm_generic_payload payload;
  Master::fill(payload, kRead, 0, nullptr, 4);
  std::vector<Beat> beats;
  EXPECT_EQ(plan_beats(payload, beats), tlm::TLM_GENERIC_ERROR_RESPONSE);
}

// Bytes of a slave, and an AHB-Lite master's view of them.
struct Memory {
  Bytes bytes = Bytes(0x2400);

  std::uint32_t run(const AhbTransfer &t) {
    const unsigned size = 1u << static_cast<unsigned>(t.size);
    EXPECT_EQ(t.address % size, 0u);
    std::uint32_t value = 0;
    for (unsigned i = 0; i < size; ++i) {
      if (t.write) bytes[t.address + i] = static_cast<unsigned char>(t.data >> (8 * i));
      value |= std::uint32_t{bytes[t.address + i]} << (8 * i);
    }
    return value;
  }
};

// A random payload that the port can express.
struct RandomPayload {
  explicit RandomPayload(std::mt19937 &random) {
    static constexpr unsigned kWidths[] = {1, 2, 4, 8, 12, 64, 100};
    width = kWidths[random() % 7];
    length = width * (1 + random() % 3);
    address = random() % 0x800 * 4 + (width < 4 ? random() % 4 / width * width : 0);
    data.resize(length);
    for (auto &byte : data) byte = static_cast<unsigned char>(random());
    if (random() % 2 == 0) return;
    static constexpr unsigned char kLanes[] = {0, 1, 2, 4, 8, 3, 12, 15};
    enables.resize(4 * (1 + random() % 5));
    for (std::size_t i = 0; i < enables.size(); i += 4) {
      const unsigned lanes = kLanes[random() % 8];
      for (unsigned k = 0; k < 4; ++k) enables[i + k] = (lanes >> k & 1) != 0 ? kOn : kOff;
    }
  }
  [[nodiscard]] bool enabled(unsigned byte) const {
    return enables.empty() || enables[byte % enables.size()] == kOn;
  }

  unsigned width = 0, length = 0;
  std::uint64_t address = 0;
  Bytes data, enables;
};

// IEEE 1666, 14.17: byte i of the data belongs to address + i % streaming width, if enabled.
TEST(Payload, RandomOnesDoWhatTheStandardSaysToEachByte) {
  std::mt19937 random(5);
  for (int round = 0; round < 5000; ++round) {
    RandomPayload p(random);
    Memory memory, expected;
    for (auto &byte : memory.bytes) byte = static_cast<unsigned char>(random());
    expected = memory;
    Bytes expected_data = p.data, data = p.data;
    const bool write = random() % 2 == 0;
    for (unsigned i = 0; i < p.length; ++i) {
      if (!p.enabled(i)) continue;
      unsigned char &cell = expected.bytes[p.address + i % p.width];
      if (write)
        cell = p.data[i];
      else
        expected_data[i] = cell;
    }
    tlm::tlm_generic_payload payload;
    Master::fill(payload, write ? kWrite : kRead, p.address, data.data(), p.length);
    payload.set_streaming_width(p.width);
    if (!p.enables.empty()) {
      payload.set_byte_enable_ptr(p.enables.data());
      payload.set_byte_enable_length(static_cast<unsigned>(p.enables.size()));
    }
    std::vector<Beat> beats;
    ASSERT_EQ(plan_beats(payload, beats), tlm::TLM_OK_RESPONSE);
    for (const Beat &beat : beats) {
      const std::uint32_t value = memory.run(beat.transfer);
      if (!write) store_read(payload, beat, value);
    }
    ASSERT_EQ(memory.bytes, expected.bytes) << "round " << round;
    ASSERT_EQ(data, expected_data) << "round " << round;
  }
}

// AHB-Lite: a burst's later beats are SEQ at the next address, it does not cross 1 KiB; what is
// handed to the bus at once never splits a burst and is short enough for its results to be kept.
TEST(Payload, BurstsAreThoseOfAhb) {
  Bytes data(4096);
  for (const std::uint64_t address : {0x0ULL, 0x3F8ULL, 0x7C4ULL}) {
    tlm::tlm_generic_payload payload;
    Master::fill(payload, kRead, address, data.data(), 2048);
    std::vector<Beat> beats;
    ASSERT_EQ(plan_beats(payload, beats), tlm::TLM_OK_RESPONSE);
    ASSERT_EQ(beats.size(), 512u);
    AhbChecker checker;
    for (const Beat &beat : beats) {
      const AhbTransfer &t = beat.transfer;
      if (t.address % 0x400 == 0) {
        EXPECT_EQ(t.trans, AhbTrans::kNonseq);
      }
      checker.clock({.haddr = t.address, .htrans = t.trans, .hsize = t.size, .hburst = t.burst},
                    {});
    }
    EXPECT_TRUE(checker.violations().empty()) << checker.violations().front();
    EXPECT_GT(std::count_if(beats.begin(), beats.end(),
                            [](const Beat &b) { return b.transfer.trans == AhbTrans::kSeq; }),
              470);
    std::size_t begin = 0;
    for (; begin < beats.size(); begin = chunk_end(beats, begin)) {
      EXPECT_EQ(beats[begin].transfer.trans, AhbTrans::kNonseq);
      EXPECT_LE(chunk_end(beats, begin) - begin, 32u);
    }
    EXPECT_EQ(begin, beats.size());
  }
}

}  // namespace
}  // namespace vericansim
