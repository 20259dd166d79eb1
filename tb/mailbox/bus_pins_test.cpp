// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the masters of bus_wrappers_test never do, on the pins: AXI4-Lite with both directions
// always waiting, or one answer channel closed (PK-22, PK-23); kinds of access (PROT) that AHB-Lite
// has not; Wishbone strobes outside of a cycle.
#include <gtest/gtest.h>

#include <string>

#include "Vcan_apb64.h"
#include "Vcan_apb64___024root.h"
#include "Vcan_axil64.h"
#include "Vcan_axil64___024root.h"
#include "Vcan_wb64.h"
#include "Vcan_wb64___024root.h"
#include "Vcan_wb64_pipelined.h"
#include "Vcan_wb64_pipelined___024root.h"
#include "model/registers.hpp"
#include "node/bus_pins.hpp"
#include "node/model_context.hpp"

namespace vericansim {
namespace {

/// A model, its clock and its reset.
template <typename Model, typename Pins>
class Bench {
 public:
  Bench() {
    top_.can_rx_i = 1;
    reset();
    for (int i = 0; i < 300; ++i) (void)clock({});  // until the buffer RAM is cleared
  }
  ~Bench() { top_.final(); }
  Bench(const Bench &) = delete;
  Bench &operator=(const Bench &) = delete;

  void reset() {
    Pins::reset(top_, true);
    (void)clock({});
    Pins::reset(top_, false);
  }
  /// What the wrapper answers at the end of a clock in which a request is shown.
  using Request = std::remove_cvref_t<decltype(std::declval<typename Pins::Master>().request())>;
  auto clock(const Request &request) {
    Pins::clock(top_) = 0;
    Pins::show(top_, request);
    top_.eval();
    const auto seen = Pins::seen(top_);
    Pins::clock(top_) = 1;
    top_.eval();
    return seen;
  }

 private:
  SerialContext context_;
  Model top_{&context_, "core"};
};

// Reads and writes of a register wait all the time; how they were taken, in order.
struct AxilTurns : Bench<Vcan_axil64, AxilPins> {
  std::string taken(unsigned clocks, bool reads, bool writes, bool r_open, bool b_open) {
    AxilRequest request;
    request.arvalid = reads;
    request.awvalid = request.wvalid = writes;
    request.araddr = request.awaddr = reg::kImask1;
    request.wstrb = 0xF;
    request.rready = r_open;
    request.bready = b_open;
    std::string order;
    for (unsigned i = 0; i < clocks; ++i) {
      const AxilResponse seen = clock(request);
      EXPECT_EQ(seen.awready, seen.wready);
      if (seen.arready) order += 'r';
      if (seen.awready) order += 'w';
    }
    return order;
  }
};

// Turns, beginning with the read, after a reset too, whatever was before it.
TEST(AxilPins, ReadsAndWritesTakeTurns) {
  AxilTurns bench;
  std::string turns;
  for (int i = 0; i < 20; ++i) turns += "rw";
  for (const bool read_before : {true, false, true}) {
    const std::string order = bench.taken(50, true, true, true, true);
    ASSERT_GE(order.size(), 19u) << "a read takes two clocks and a write three";
    EXPECT_EQ(order, turns.substr(0, order.size()));
    (void)bench.taken(8, read_before, !read_before, true, true);
    bench.reset();
  }
}

// It is the turn of what was not the last, also after a while without either.
TEST(AxilPins, TheTurnIsKeptWhileNothingWaits) {
  for (const bool read : {false, true}) {
    for (unsigned pause = 0; pause < 6; ++pause) {
      AxilTurns bench;
      ASSERT_EQ(bench.taken(3, read, !read, true, true), read ? "r" : "w");
      (void)bench.taken(pause + 3, false, false, true, true);
      EXPECT_EQ(bench.taken(8, true, true, true, true).front(), read ? 'w' : 'r') << pause;
    }
  }
}

// A closed R channel does not stop writes, nor a closed B channel reads.
TEST(AxilPins, AClosedChannelStopsNotTheOther) {
  AxilTurns bench;
  const std::string writes = bench.taken(60, true, true, false, true);
  EXPECT_EQ(std::count(writes.begin(), writes.end(), 'r'), 1);
  EXPECT_GE(std::count(writes.begin(), writes.end(), 'w'), 12);
  (void)bench.taken(9, false, false, true, true);
  const std::string reads = bench.taken(60, true, true, true, false);
  EXPECT_EQ(std::count(reads.begin(), reads.end(), 'w'), 1);
  EXPECT_GE(std::count(reads.begin(), reads.end(), 'r'), 18);
}

// AW or W alone is no write, and does not hold up reads; both are taken together.
TEST(AxilPins, AWriteNeedsAddressAndData) {
  for (const bool address : {false, true}) {
    AxilTurns bench;
    AxilRequest request;
    request.arvalid = request.rready = request.bready = true;
    request.araddr = reg::kImask1;
    request.awaddr = reg::kImask1;
    request.wdata = 0x55;
    request.wstrb = 0xF;
    (address ? request.awvalid : request.wvalid) = true;
    unsigned reads = 0;
    for (unsigned i = 0; i < 40; ++i) {
      const AxilResponse seen = bench.clock(request);
      EXPECT_FALSE(seen.awready || seen.wready || seen.bvalid);
      if (seen.arready) ++reads;
      EXPECT_TRUE(!seen.rvalid || seen.rdata == 0);
    }
    EXPECT_GE(reads, 19u);
  }
}

// CheckProt is 0: every kind of access reads and writes.
TEST(AxilPins, ProtDoesNotMatter) {
  AxilTurns bench;
  for (unsigned i = 0; i < 9; ++i) {
    const auto prot = static_cast<std::uint8_t>(i % 8);
    AxilRequest request;
    request.awvalid = request.wvalid = request.bready = true;
    request.awaddr = request.araddr = reg::kImask1;
    request.awprot = request.arprot = prot;
    request.wdata = 0x50U + prot;
    request.wstrb = 0xF;
    while (!bench.clock(request).awready) {
    }
    request.awvalid = request.wvalid = false;
    AxilResponse seen = bench.clock(request);
    for (; !seen.bvalid; seen = bench.clock(request)) {
    }
    EXPECT_EQ(seen.bresp, 0) << +prot;
    request.arvalid = request.rready = true;
    while (!bench.clock(request).arready) {
    }
    request.arvalid = false;
    for (seen = bench.clock(request); !seen.rvalid; seen = bench.clock(request)) {
    }
    EXPECT_EQ(seen.rdata, 0x50U + prot) << +prot;
    EXPECT_EQ(seen.rresp, 0) << +prot;
  }
}

TEST(ApbPins, ProtDoesNotMatter) {
  Bench<Vcan_apb64, ApbPins> bench;
  for (std::uint8_t prot = 0; prot < 8; ++prot) {
    for (const bool write : {true, false}) {
      ApbRequest request;
      request.psel = true;
      request.paddr = reg::kImask1;
      request.pprot = prot;
      request.pwrite = write;
      request.pstrb = write ? 0xF : 0;
      request.pwdata = 0x50U + prot;
      (void)bench.clock(request);
      request.penable = true;
      ApbResponse seen = bench.clock(request);
      for (; !seen.pready; seen = bench.clock(request)) {
      }
      EXPECT_FALSE(seen.pslverr) << +prot;
      if (!write) {
        EXPECT_EQ(seen.prdata, 0x50U + prot) << +prot;
      }
      (void)bench.clock({});
    }
  }
}

template <typename Model>
class WbPinsTest : public ::testing::Test {
 protected:
  // Reads a word in a cycle of its own.
  std::uint32_t read(std::uint32_t at) {
    WbRequest request;
    request.cyc = request.stb = true;
    request.adr = at >> 2;
    request.sel = 0xF;
    const WbResponse first = bench_.clock(request);
    EXPECT_FALSE(first.ack || first.err) << "an answer in the clock of the strobe";
    for (unsigned i = 0; i < 4; ++i) {
      const WbResponse seen = bench_.clock(request);
      if (!seen.ack) continue;
      (void)bench_.clock({});
      return seen.dat;
    }
    ADD_FAILURE() << "no answer";
    return 0;
  }

  Bench<Model, WbPins<true>> bench_;
};
using WbModels = ::testing::Types<Vcan_wb64, Vcan_wb64_pipelined>;
TYPED_TEST_SUITE(WbPinsTest, WbModels);

// Nothing is taken, nothing answered.
TYPED_TEST(WbPinsTest, AStrobeOutsideOfACycleIsNone) {
  ASSERT_EQ(this->read(reg::kImask1), 0u);
  WbRequest request;
  request.stb = request.we = true;
  request.adr = reg::kImask1 >> 2;
  request.sel = 0xF;
  request.dat = 0x55;
  for (unsigned i = 0; i < 10; ++i) {
    const WbResponse seen = this->bench_.clock(request);
    EXPECT_FALSE(seen.ack || seen.err);
  }
  EXPECT_EQ(this->read(reg::kImask1), 0u);
}

}  // namespace
}  // namespace vericansim
