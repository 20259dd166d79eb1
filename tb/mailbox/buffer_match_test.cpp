// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Matching: every row of the table of flexcan.md 3.5 with every code, every combination of IDE, RTR
// and mask bits; then which of many buffers gets the frame.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

// BCC, RRS, EACEN as the bits of a number.
BufferConfig table_config(unsigned bits, unsigned num_mb) {
  return {.num_mb = num_mb,
          .maxmb = num_mb - 1,
          .bcc = (bits & 1) != 0,
          .eacen = (bits & 4) != 0,
          .rrs = (bits & 2) != 0};
}

std::string table_name(const ::testing::TestParamInfo<unsigned> &test) {
  const BufferConfig config = table_config(test.param, 16);
  return std::string{config.bcc ? "Bcc" : "NoBcc"} + (config.rrs ? "Rrs" : "NoRrs") +
         (config.eacen ? "Eacen" : "NoEacen");
}

constexpr std::uint32_t kId = 0x0AAAB555;  // of extended frames; standard ones take the upper part

Frame frame_of(bool extended, bool remote, std::uint32_t flip) {
  const std::uint32_t id = kId ^ flip;
  return {.id = extended ? id : id >> 18,
          .extended = extended,
          .remote = remote,
          .dlc = 1,
          .data = {static_cast<std::uint8_t>(remote ? 0 : 0x5A)}};
}

class MatchTable : public ::testing::TestWithParam<unsigned> {
 protected:
  MatchTable() : rig_{table_config(GetParam(), 16)} {
    rig_.go();
    rig_.freeze();
  }
  void set_mask(std::uint32_t mask) {
    for (const std::uint32_t address : {reg::kRxgmask, reg::kRx14mask, reg::kRx15mask})
      rig_.write(address, rig_.config().bcc ? ~mask : mask);
    for (unsigned mb = 0; mb < 16; ++mb)
      rig_.write(reg::rximr(mb), rig_.config().bcc ? mask : ~mask);
  }
  // One frame against one buffer of each code, one after the other.
  void each_code(unsigned mb, std::uint32_t header, const Frame &frame) {
    for (unsigned code = 0; code < 16; ++code) {
      SCOPED_TRACE(testing::Message() << "code " << code);
      rig_.put(mb, {.cs = (code << 24) | header, .id = kId});
      rig_.quiet();
      rig_.receive(frame);
      rig_.read(reg::kIflag1);
      rig_.read(reg::mb(mb, 1));
      rig_.read(reg::mb(mb, 2));
      rig_.read_cs(mb);
      rig_.write(reg::mb(mb), 0);
      rig_.write(reg::kIflag1, 0xFFFF);
    }
  }
  BufferRig rig_;
};

// FX-3.5.a: only 0100, 0010, 0110, and 1010 for requests; FX-3.2.m: all other codes are inactive.
// FX-3.5.b, FX-3.5.c: data frames with EACEN=0 and 1. FX-3.5.d, FX-3.5.i: remote frames, RRS=0.
// FX-3.5.e, FX-3.5.f: remote frames, RRS=1. FX-CTRL2.EACEN, FX-CTRL2.RRS, FX-MCR.BCC, FX-1.9.b.
// FF-13: the format on the wire decides, whatever the masks say.
TEST_P(MatchTable, EveryRowEveryCode) {
  unsigned mb = 3;
  for (unsigned bits = 0; bits < 16 && !HasFailure(); ++bits) {
    const std::uint32_t header =
        (bits & 1 ? reg::kCsIde | reg::kCsSrr : 0) | (bits & 2 ? reg::kCsRtr : 0) | 0x00010000;
    const std::uint32_t mask = 0x1FFFFFFF | (bits & 4 ? 1u << 30 : 0) | (bits & 8 ? 1u << 31 : 0);
    rig_.freeze();
    set_mask(mask);
    rig_.go();
    for (unsigned frame = 0; frame < 4; ++frame) {
      SCOPED_TRACE(testing::Message() << "IDE, RTR and masks " << bits << ", frame " << frame);
      mb = mb == 15 ? 2 : mb + 1;
      each_code(mb, header, frame_of((frame & 1) != 0, (frame & 2) != 0, 0));
    }
  }
}

// FX-1.9.a, FX-3.5.h, FX-3.5.j, FX-3.5.k: each bit of the identifier, compared and not compared;
// FX-3.5.d: an answer compares them all.
TEST_P(MatchTable, EveryIdentifierBit) {
  for (unsigned bit = 0; bit < 29 && !HasFailure(); ++bit) {
    for (const bool compared : {false, true}) {
      rig_.freeze();
      set_mask(compared ? 1u << bit : ~(1u << bit));
      rig_.go();
      for (unsigned kind = 0; kind < 8; ++kind) {
        const bool extended = (kind & 1) != 0, remote = (kind & 2) != 0;
        const std::uint32_t flip = (kind & 4) != 0 ? 1u << bit : 0;
        const unsigned mb = 13 + kind % 3;  // the general mask, that of 14, that of 15
        SCOPED_TRACE(testing::Message() << "bit " << bit << " kind " << kind);
        for (const unsigned code : {kRxEmpty, kTxAnswerWaits}) {
          const std::uint32_t header = (code << 24) | (extended ? reg::kCsIde | reg::kCsSrr : 0) |
                                       (remote ? reg::kCsRtr : 0);
          rig_.put(mb, {.cs = header, .id = kId});
          rig_.receive(frame_of(extended, remote, flip));
          rig_.read(reg::kIflag1);
          rig_.read_cs(mb);
          rig_.write(reg::mb(mb), 0);
          rig_.write(reg::kIflag1, 0xFFFF);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MatchTable, ::testing::Range(0u, 8u), table_name);

// Many buffers that fit: the rules of selection.
class MatchMany : public ::testing::TestWithParam<unsigned> {};

// FX-3.5.l, FX-3.5.m, FX-3.5.n: lowest free, else last; BCC=0: first. FX-MCR.MAXMB, FX-3.5.q:
// random buffers of all codes, random services, every word compared after each frame.
TEST_P(MatchMany, RandomBuffersAgainstTheModel) {
  for (const unsigned num_mb : {16u, 32u, 64u}) {
    std::mt19937 rng{1000 * num_mb + GetParam()};
    SCOPED_TRACE(testing::Message() << num_mb << " buffers, seed " << 1000 * num_mb + GetParam());
    BufferConfig config = table_config(GetParam(), num_mb);
    config.maxmb = num_mb - 1 - rng() % 3;
    BufferRig rig{config};
    for (unsigned mb = 0; mb < num_mb; ++mb)
      rig.write(reg::rximr(mb), 0x1FFC0000 | ((rng() & 3) << 30));
    for (unsigned round = 0; round < 12 && !HasFailure(); ++round) {
      for (unsigned mb = 0; mb < num_mb; ++mb) {
        if (rng() % 3 == 0) continue;
        const Frame like{.id = 0x100u + (rng() % 2 != 0 ? 1 : 0), .remote = (rng() & 3) == 0};
        const unsigned codes[] = {kRxEmpty, kRxFull, kRxOverrun, 0, kTxInactive, 3};
        rig.put_rx(mb, like, codes[rng() % 6]);
      }
      rig.go();
      for (unsigned frame = 0; frame < 10; ++frame) {
        rig.receive({.id = 0x100u + (rng() % 2 != 0 ? 1 : 0),
                     .remote = (rng() & 3) == 0,
                     .dlc = static_cast<std::uint8_t>(rng() % 3)});
        rig.compare_quietly();
        if (rng() % 2 == 0) rig.read_cs(rng() % num_mb);  // locks, and services the one before
        if (rng() % 4 == 0) rig.read(reg::kTimer);
      }
      rig.compare();
      ASSERT_TRUE(rig.freeze());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, MatchMany, ::testing::Range(0u, 8u), table_name);

}  // namespace
}  // namespace vericansim
