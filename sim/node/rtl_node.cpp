// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlNode: see rtl_node.hpp. One class template serves the three Verilated sizes of can_ahb.
#include "node/rtl_node.hpp"

#include <stdexcept>
#include <utility>

#include "Vcan_host16.h"
#include "Vcan_host16___024root.h"
#include "Vcan_host32.h"
#include "Vcan_host32___024root.h"
#include "Vcan_host64.h"
#include "Vcan_host64___024root.h"
#include "bus/bus.hpp"
#include "node/split_core.hpp"

namespace vericansim {
namespace {

template <typename HostModel>
class RtlNodeOf final : public RtlNode {
 public:
  RtlNodeOf(std::string name, const ClockConfig &clock, unsigned num_mb)
      : RtlNode{std::move(name), clock, num_mb} {
    reset();
  }

  void reset() override {
    ahb().reset();
    show(ahb().request());
    top_.hready = 1;
    core_.engine().can_rx_i = 1;
    core_.reset(true);
    for (int i = 0; i < 4; ++i) core_.edge();
    core_.reset(false);
    core_.settle();
    core_.edge();
    drive(static_cast<Level>(core_.engine().can_tx_o));
  }

  void clock(Level rx) override {
    core_.engine().can_rx_i = static_cast<std::uint8_t>(rx);
    if (ahb().active()) {
      transfer_cycle();
    } else {
      core_.edge();
    }
    drive(static_cast<Level>(core_.engine().can_tx_o));
    after_edge();
  }

  [[nodiscard]] std::uint64_t trace() const override { return core_.engine().trace_o; }

  [[nodiscard]] std::uint8_t irq_lines() const override {
    return static_cast<std::uint8_t>(top_.irq_o | (top_.irq_mb_o << 1) | (top_.irq_boff_o << 2) |
                                     (top_.irq_err_o << 3) | (top_.irq_twrn_o << 4) |
                                     (top_.irq_rwrn_o << 5) | (top_.irq_wak_o << 6));
  }

  void request_stop(bool stop) override {
    top_.stop_req_i = stop;
    core_.touch();
  }

  [[nodiscard]] AhbResult peek(const AhbTransfer &transfer) override {
    const auto before = core_.save();
    AhbMaster probe;
    AhbTransfer read = transfer;
    read.write = false;
    const AhbMaster::Ticket ticket = probe.submit(read);
    while (!probe.done(ticket)) {
      AhbRequest request = probe.request();
      request.hwdata = ahb().request().hwdata;  // of the transfer under way
      probe.clock(cycle(request));
    }
    core_.restore(before);
    return probe.result(ticket);
  }

 private:
  void show(const AhbRequest &request) {
    top_.hsel = request.htrans != AhbTrans::kIdle;
    top_.haddr = request.haddr;
    top_.htrans = static_cast<std::uint8_t>(request.htrans);
    top_.hwrite = request.hwrite;
    top_.hsize = static_cast<std::uint8_t>(request.hsize);
    top_.hburst = static_cast<std::uint8_t>(request.hburst);
    top_.hprot = request.hprot;
    top_.hwdata = request.hwdata;
  }

  // HREADYOUT, HRESP and HRDATA are read as they have settled with this cycle's request.
  AhbResponse cycle(const AhbRequest &request) {
    show(request);
    top_.hready = top_.hreadyout;
    core_.settle();
    if (top_.hready != top_.hreadyout) {
      top_.hready = top_.hreadyout;
      core_.settle();
    }
    const AhbResponse response{top_.hrdata, top_.hreadyout != 0, top_.hresp != 0};
    core_.edge();
    return response;
  }

  void transfer_cycle() {
    ahb().clock(cycle(ahb().request()));
    if (!ahb().active()) {
      show(ahb().request());
      top_.hready = 1;
      core_.touch();
    }
  }

  SplitCore<HostModel> core_;
  HostModel &top_ = core_.host();
};

}  // namespace

std::unique_ptr<RtlNode> RtlNode::create(std::string name, const ClockConfig &clock,
                                         unsigned num_mb) {
  switch (num_mb) {
    case 16: return std::make_unique<RtlNodeOf<Vcan_host16>>(std::move(name), clock, num_mb);
    case 32: return std::make_unique<RtlNodeOf<Vcan_host32>>(std::move(name), clock, num_mb);
    case 64: return std::make_unique<RtlNodeOf<Vcan_host64>>(std::move(name), clock, num_mb);
    default:
      throw std::invalid_argument("message buffers must be 16, 32 or 64, got " +
                                  std::to_string(num_mb));
  }
}

void RtlNode::Waiter::await_suspend(std::coroutine_handle<> handle) const {
  node.waiter_ = handle;
  node.wait_irq_ = for_irq;
  node.wake_cycle_ = until;
}

void RtlNode::resume_waiter() { std::exchange(waiter_, nullptr).resume(); }

void RtlNode::advance() {
  if (bus() != nullptr) {
    bus()->step();
  } else {
    clock(Level::kRecessive);
    oscillator().tick();
  }
}

AhbResult RtlNode::access(const AhbTransfer &transfer) {
  const AhbMaster::Ticket ticket = ahb_.submit(transfer);
  while (!ahb_.done(ticket)) advance();
  return ahb_.result(ticket);
}

std::uint32_t RtlNode::read32(std::uint32_t address) {
  const AhbResult result = access({.address = address});
  if (result.error)
    throw std::runtime_error(name() + ": bus error reading " + std::to_string(address));
  return result.data;
}

void RtlNode::write32(std::uint32_t address, std::uint32_t data) {
  const AhbResult result = access({.address = address, .write = true, .data = data});
  if (result.error)
    throw std::runtime_error(name() + ": bus error writing " + std::to_string(address));
}

}  // namespace vericansim
