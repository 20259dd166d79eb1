// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reset of the bus wrappers (PK-17): asynchronous, in any clock of a transfer; no answer is given
// in it, whatever the master shows, and none afterwards of what was open.
#include <gtest/gtest.h>

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

// What a master that does not care for answers shows, and whether there is one.
ApbRequest busy(const ApbRequest & /*kind*/, bool write, std::uint32_t at, unsigned clock) {
  return {.psel = true, .penable = clock != 0, .paddr = at, .pwrite = write, .pstrb = 0xF};
}
AxilRequest busy(const AxilRequest & /*kind*/, bool write, std::uint32_t at, unsigned clock) {
  AxilRequest request;  // its answers stay: it is not ready for them until later
  request.awvalid = request.wvalid = write;
  request.arvalid = !write;
  request.awaddr = request.araddr = at;
  request.wstrb = 0xF;
  request.bready = request.rready = clock > 4;
  return request;
}
WbRequest busy(const WbRequest & /*kind*/, bool write, std::uint32_t at, unsigned /*clock*/) {
  WbRequest request;
  request.cyc = request.stb = true;
  request.we = write;
  request.adr = at >> 2;
  request.sel = 0xF;
  return request;
}
// PREADY may be high in reset.
bool answers(const ApbResponse &seen) { return seen.pslverr; }
bool answers(const AxilResponse &seen) {
  return seen.awready || seen.wready || seen.bvalid || seen.arready || seen.rvalid;
}
bool answers(const WbResponse &seen) { return seen.ack || seen.err; }

template <typename Wrapper>
class BusReset : public ::testing::Test {
 protected:
  using Pins = typename Wrapper::second_type;
  using Request = std::remove_cvref_t<decltype(std::declval<typename Pins::Master>().request())>;

  BusReset() {
    top_.can_rx_i = 1;
    reset();
  }
  ~BusReset() override { top_.final(); }

  void clock() {
    Pins::clock(top_) = 0;
    top_.eval();
    Pins::clock(top_) = 1;
    top_.eval();
  }
  void show(const Request &request) {
    Pins::clock(top_) = 0;
    Pins::show(top_, request);
    top_.eval();
  }
  bool answered() { return answers(Pins::seen(top_)); }
  void reset() {
    Pins::reset(top_, true);
    clock();
    Pins::reset(top_, false);
    clock();
  }

  SerialContext context_;
  typename Wrapper::first_type top_{&context_, "core"};
};

template <typename Model, typename Pins>
using Wrapper = std::pair<Model, Pins>;
using Wrappers =
    ::testing::Types<Wrapper<Vcan_apb64, ApbPins>, Wrapper<Vcan_axil64, AxilPins>,
                     Wrapper<Vcan_wb64, WbPins<false>>, Wrapper<Vcan_wb64_pipelined, WbPins<true>>>;
TYPED_TEST_SUITE(BusReset, Wrappers);

TYPED_TEST(BusReset, EndsEveryTransferWithoutAnAnswer) {
  unsigned before = 0;
  for (const bool write : {false, true}) {
    for (const std::uint32_t at : {reg::kImask1, reg::kImask1 | 1u << 13}) {
      for (unsigned clocks = 0; clocks < 9; ++clocks) {
        for (unsigned i = 0; i <= clocks; ++i) {
          this->show(busy(typename TestFixture::Request{}, write, at, i));
          if (this->answered()) ++before;
          if (i < clocks) this->clock();
        }
        TypeParam::second_type::reset(this->top_, true);
        this->top_.eval();
        EXPECT_FALSE(this->answered()) << "asynchronous, after " << clocks << " clocks";
        for (unsigned i = 0; i < 3; ++i) {
          this->clock();
          this->show(busy(typename TestFixture::Request{}, write, at, 1));
          EXPECT_FALSE(this->answered()) << "in reset, after " << clocks << " clocks";
        }
        this->show(typename TestFixture::Request{});
        TypeParam::second_type::reset(this->top_, false);
        for (unsigned i = 0; i < 4; ++i) {
          this->clock();
          EXPECT_FALSE(this->answered()) << "an answer to nobody";
        }
      }
    }
  }
  EXPECT_GT(before, 8u) << "transfers that were not reset are answered";
}

}  // namespace
}  // namespace vericansim
