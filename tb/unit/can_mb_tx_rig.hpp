// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// MbTx: can_mb_tx with 64 buffers beside a model that sorts (flexcan.md 3.3). The tests of it are
// can_mb_tx_test (who wins), can_mb_tx_loss_test (a winner that is lost) and can_mb_tx_status_test
// (passes for ESR2).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "Vcan_mb_tx.h"
#include "verilated.h"

namespace vericansim {

inline constexpr unsigned kBuffers = 64, kPass = 2 * kBuffers;  // a read in every second clock
inline constexpr std::uint32_t kActive = 0xC, kAnswer = 0xE, kIde = 1u << 21, kRtr = 1u << 20;

inline bool is_active(std::uint32_t cs) { return (cs >> 24) == kActive || (cs >> 24) == kAnswer; }

struct Buffer {
  std::uint32_t cs = 0, id = 0;
};

struct Mode {
  unsigned lbuf, lprio;
};

class MbTx : public ::testing::TestWithParam<Mode> {
 protected:
  MbTx() {
    top_.rst_ni = 1;
    top_.eval();
    top_.rst_ni = 0;
    top_.eval();
    top_.rst_ni = 1;
    top_.maxmb_i = 63;
    top_.running_i = 1;
    top_.lbuf_i = GetParam().lbuf;
    top_.lprio_en_i = GetParam().lprio;
  }

  // Bits as they go over the bus, as a string: the smaller string wins arbitration (AR-01); PRIO
  // comes before them.
  std::string bits(const Buffer &buffer) const {
    const auto field = [](std::uint32_t value, unsigned width) {
      std::string text;
      for (unsigned i = width; i-- > 0;) text += ((value >> i) & 1) != 0 ? '1' : '0';
      return text;
    };
    const std::string rtr = (buffer.cs & kRtr) != 0 ? "1" : "0";
    const std::string prio = top_.lprio_en_i != 0 ? field(buffer.id >> 29, 3) : "";
    const std::string base = prio + field((buffer.id >> 18) & 0x7FF, 11);
    if ((buffer.cs & kIde) == 0) return base + rtr + "0";
    return base + "11" + field(buffer.id & 0x3FFFF, 18) + rtr;
  }

  std::optional<unsigned> expected() const {
    std::vector<std::tuple<std::string, unsigned>> active;
    for (unsigned i = top_.first_i; i < kBuffers && i <= top_.maxmb_i; ++i) {
      if (!is_active(buffers_[i].cs) || (top_.off_i != 0 && i == top_.cur_idx_i)) continue;
      active.emplace_back(top_.lbuf_i != 0 ? "" : bits(buffers_[i]), i);
    }
    if (active.empty()) return {};
    return std::get<1>(*std::min_element(active.begin(), active.end()));
  }

  // One clock: `write` is the buffer whose C/S word the CPU writes in it; slots are granted at
  // random.
  void clock(std::optional<unsigned> write, std::uint32_t cs, unsigned grant_percent) {
    top_.eval();
    const bool ins = top_.ins_req_o != 0;
    const bool scan = !ins && top_.scan_req_o != 0 && rng_() % 100 < grant_percent;
    top_.ins_gnt_i = ins;
    top_.scan_gnt_i = scan;
    top_.eval();
    const Buffer read = buffers_[ins ? top_.ins_idx_o : top_.scan_idx_o];
    if (write) buffers_[*write].cs = cs;
    top_.clk_i = 1;
    top_.eval();
    top_.clk_i = 0;
    if (ins || scan) {
      top_.cs_i = read.cs;
      top_.id_i = read.id;
    }
    top_.cs_written_i = write.has_value();
    top_.cs_written_act_i = write && is_active(cs);
    if (write) top_.cs_written_idx_i = *write;
    top_.start_i = 0;
    top_.retry_i = 0;
  }

  // The CPU prepares a buffer that is not active, then writes its C/S word; or takes one away.
  void random_write(unsigned grant_percent) {
    const unsigned i = rng_() % kBuffers;
    Buffer &buffer = buffers_[i];
    const bool was_active = is_active(buffer.cs);
    const std::uint32_t code = rng_() % 4 == 0 ? kAnswer : kActive;
    std::uint32_t cs = (was_active || rng_() % 4 == 0) ? 0x08000000u : code << 24;
    if (!was_active) {
      // Few different identifiers: ties and near ties are what is hard.
      buffer.id =
          ((rng_() % 4) << 18) | (rng_() % 3 == 0 ? rng_() & 0x3FFFF : rng_() % 3) | (rng_() << 29);
      cs |= (rng_() % 2 != 0 ? kIde : 0) | (rng_() % 2 != 0 ? kRtr : 0);
    }
    if (top_.off_i != 0 && i == top_.cur_idx_i) return clock({}, 0, grant_percent);
    clock(i, cs, grant_percent);
  }

  void settle() {
    for (unsigned i = 0; i < 800; ++i) clock({}, 0, 50);
    top_.eval();
  }

  // Starts anew with buffers 1, which TTXMB holds and which would win, and 2, which therefore is
  // the winner.
  void settle_beside_a_held_one() {
    top_.running_i = 0;
    buffers_ = {};
    buffers_[1] = {kActive << 24, 0x020u << 18};
    buffers_[2] = {kActive << 24, 0x400u << 18};
    top_.held_i = 1;
    top_.held_idx_i = 1;
    clock({}, 0, 100);
    top_.running_i = 1;
    settle();
    ASSERT_TRUE(top_.settled_o != 0 && top_.best_idx_o == 2);
  }

  // Buffer `index` goes on the bus and has been there for `clocks`; then its frame fails.
  void send_for(unsigned index, unsigned clocks) {
    top_.cur_idx_i = index;
    top_.start_i = 1;
    clock({}, 0, 100);
    top_.off_i = 1;
    for (unsigned i = 0; i < clocks; ++i) clock({}, 0, 100);
  }
  void fail() {
    top_.off_i = 0;
    top_.retry_i = 1;
  }
  // Whoever is settled, for as long as three passes may take, is `index`; somebody is in the end.
  void expect_settled(unsigned index) {
    for (unsigned i = 0; i < 3 * kPass; ++i) {
      clock({}, 0, 100);
      top_.eval();
      if (top_.settled_o != 0) {
        ASSERT_EQ(top_.best_idx_o, index) << "clock " << i;
      }
    }
    EXPECT_TRUE(top_.settled_o);
  }

  void check() {
    const std::optional<unsigned> winner = expected();
    ASSERT_EQ(top_.settled_o != 0, winner.has_value());
    ASSERT_EQ(winner.value_or(top_.best_idx_o), top_.best_idx_o);
  }

  std::array<Buffer, kBuffers> buffers_{};
  std::mt19937 rng_{7};
  Vcan_mb_tx top_;
};

/// Values of MbTx, all there are.
inline const auto kMbTxModes = ::testing::Values(Mode{0, 0}, Mode{1, 0}, Mode{0, 1}, Mode{1, 1});

}  // namespace vericansim
