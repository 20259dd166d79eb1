// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SoftDriver: see driver.hpp. Set-up, orders and the main loop; the buffers are in
// driver_buffers.cpp.
#include "softerror/driver.hpp"

#include <utility>

#include "model/registers.hpp"
#include "softerror/driver_map.hpp"

namespace vericansim {
namespace {

using namespace driver_map;

// Longer than the longest frame at the bit rates of these runs: a wait of more never ends.
constexpr std::uint64_t kModeLimit = 20'000;
// Without interrupts the driver looks for work this often, in clocks.
constexpr std::uint64_t kIdleClocks = 4'000;
constexpr std::uint64_t kRestlessClocks = 40;

}  // namespace

SoftDriver::SoftDriver(RtlNode &node, const BitTiming &timing, Ledger &ledger)
    : node_{node}, timing_{timing}, ledger_{ledger} {}

SoftDriver::~SoftDriver() {
  node_.forget_waiter();
  node_.ahb().reset();
}

void SoftDriver::start() { main_ = main(); }

void SoftDriver::give(Order order) {
  order_ = order;
  node_.wake();
}

void SoftDriver::send(unsigned count) {
  to_send_ = count;
  node_.wake();
}

void SoftDriver::inspect() {
  inspecting_ = true;
  node_.wake();
}

unsigned SoftDriver::pending() const {
  unsigned count = to_send_ + static_cast<unsigned>(waiting_.size());
  for (const Slot &slot : slots_) count += slot.busy ? 1 : 0;
  return count;
}

void SoftDriver::write(std::uint32_t address, std::uint32_t data) {
  node_.ahb().submit({.address = address, .write = true, .data = data});
}

Task<std::uint32_t> SoftDriver::read(std::uint32_t address) {
  const AhbResult result = co_await node_.ahb().read(address);
  if (result.error) ++bus_errors_;
  co_return result.data;
}

Task<> SoftDriver::main() {
  co_await set_up();
  ready_ = true;
  for (;;) {
    if (order_ != Order::kNone) co_await obey();
    if (inspecting_) co_await look_at_everything();
    co_await load();
    co_await node_.interrupt(restless_ ? kRestlessClocks : kIdleClocks);
    if (node_.irq()) co_await serve();
    if (restless_) co_await look_around();
  }
}

Task<> SoftDriver::wait_for(std::uint32_t mask, std::uint32_t value) {
  const std::uint64_t begin = node_.cycles();
  while ((co_await read(reg::kMcr) & mask) != value) {
    if (node_.cycles() - begin > kModeLimit) {
      ++unanswered_;
      co_return;
    }
  }
}

Task<> SoftDriver::obey() {
  const Order order = order_;
  switch (order) {
    case Order::kFreeze:
      write(reg::kMcr, kMode | reg::kMcrFrz | reg::kMcrHalt);
      co_await wait_for(reg::kMcrFrzAck, reg::kMcrFrzAck);
      break;
    case Order::kDisable:
      write(reg::kMcr, kMode | reg::kMcrMdis | reg::kMcrFrz);
      co_await wait_for(reg::kMcrLpmAck, reg::kMcrLpmAck);
      break;
    case Order::kRun:
      write(reg::kMcr, kMode | reg::kMcrFrz);
      co_await wait_for(reg::kMcrFrzAck | reg::kMcrLpmAck, 0);
      break;
    case Order::kRenew: co_await renew(); break;
    case Order::kReconfigure:
      write(reg::kMcr, kMode | reg::kMcrFrz | reg::kMcrHalt);
      co_await wait_for(reg::kMcrFrzAck, reg::kMcrFrzAck);
      co_await configure();
      break;
    case Order::kSoftReset: co_await set_up(); break;
    case Order::kNone: break;
  }
  if (order_ == order) order_ = Order::kNone;
}

Task<> SoftDriver::set_up() {
  write(reg::kMcr, reg::kMcrFrz | reg::kMcrHalt | 0xF);  // MDIS = 0
  co_await wait_for(reg::kMcrLpmAck, 0);
  write(reg::kMcr, reg::kMcrSoftRst);
  co_await wait_for(reg::kMcrSoftRst | reg::kMcrFrzAck, reg::kMcrFrzAck);
  co_await configure();
}

// In freeze mode: everything that the driver ever writes.
Task<> SoftDriver::configure() {
  write(reg::kMcr, (kMode & ~reg::kMcrFen) | reg::kMcrFrz | reg::kMcrHalt);  // empties the FIFO
  write(reg::kMcr, kMode | reg::kMcrFrz | reg::kMcrHalt);
  write(reg::kCtrl, timing_.ctrl_fields() | kCtrlBits);
  write(reg::kCtrl2, kCtrl2);
  write(reg::kExtControl, 0);
  if (kTimeUnit) co_await start_clock();
  write(reg::kEcr, 0);
  for (unsigned n = 0; n < kFilters; ++n) {
    write(reg::filter(n), kFilterExtended);
    write(reg::rximr(n), kFilterExtended);
  }
  for (unsigned n = kFirstRx; n < kBuffers; ++n) {
    const bool receives = n < kFirstTx;
    write(reg::rximr(n), receives ? kMaskFormat : ~0u);
    write(reg::mb(n, 1), 0);
    write(reg::mb(n), receives ? reg::kCodeRxEmpty : n < kEndTx ? reg::kCodeTxInactive : 0);
  }
  write(reg::kIflag1, ~0u);
  write(reg::kIflag2, ~0u);
  write(reg::kImask1, ~0u);
  write(reg::kImask2, ~0u);
  write(reg::kEsr, reg::kEsrInterrupts);
  requeue();
  write(reg::kMcr, kMode | reg::kMcrFrz);  // HALT = 0
  co_await wait_for(reg::kMcrFrzAck, 0);
}

// Pulses at the output, and no buffer held.
Task<> SoftDriver::start_clock() {
  write(VERICAN_TTXMB_OFFSET, 0);
  write(VERICAN_TCTRL_OFFSET, kTctrl);
  write(VERICAN_TCMPH_OFFSET, kPulse);
  write(VERICAN_TCMP_OFFSET, co_await read(VERICAN_TIMELO_OFFSET) + kPulse);
}

// What was in the transmit buffers is sent anew.
void SoftDriver::requeue() {
  for (Slot &slot : slots_) {
    if (slot.busy) waiting_.push_back(slot.tag);
    slot = {};
  }
}

// The mildest thing to do for a controller that seems stuck, on the bus.
Task<> SoftDriver::renew() {
  write(reg::kEsr, reg::kEsrInterrupts);
  if (kTimeUnit) write(VERICAN_TTXMB_OFFSET, 0);
  write(reg::kIflag2, ~0u);
  // The places of the FIFO, twice over: whatever is in it is old by now.
  for (unsigned n = 0; n < 12; ++n) write(reg::kIflag1, ~0u);
  write(reg::kImask1, ~0u);
  write(reg::kImask2, ~0u);
  co_await read(reg::kTimer);
  for (unsigned n = kFirstRx; n < kFirstTx; ++n) write(reg::mb(n), reg::kCodeRxEmpty);
  for (unsigned n = kFirstTx; n < kEndTx; ++n) write(reg::mb(n), kCodeAbort);
  co_await node_.delay(400 * timing_.clocks_per_bit());
  write(reg::kIflag2, ~0u);
  for (unsigned n = kFirstTx; n < kEndTx; ++n) write(reg::mb(n), reg::kCodeTxInactive);
  requeue();
  co_await read(reg::kMcr);
}

// The periodic check of docs/soft-errors.md, and the status registers.
Task<> SoftDriver::look_at_everything() {
  const std::pair<std::uint32_t, std::uint32_t> written[] = {
      {reg::kCtrl, timing_.ctrl_fields() | kCtrlBits},
      {reg::kCtrl2, kCtrl2},
      {reg::kExtControl, 0},
      {reg::kImask1, ~0u},
      {reg::kImask2, ~0u}};
  constexpr std::uint32_t kModeBits =
      ~(VERICAN_MCR_NOT_RDY_MASK | VERICAN_MCR_SOFT_RST_MASK | reg::kMcrFrzAck | reg::kMcrLpmAck);
  config_wrong_ = (co_await read(reg::kMcr) & kModeBits) != (kMode | reg::kMcrFrz) ? 1 : 0;
  for (const auto &[address, value] : written) {
    if (co_await read(address) != value) ++config_wrong_;
  }
  if (kTimeUnit && co_await read(VERICAN_TCTRL_OFFSET) != kTctrl) ++config_wrong_;
  status_.clear();
  for (const std::uint32_t address :
       {reg::kEcr, reg::kEsr, reg::kIflag1, reg::kIflag2, std::uint32_t{VERICAN_ESR2_OFFSET},
        std::uint32_t{VERICAN_CRCR_OFFSET}, reg::kTimer}) {
    const std::uint32_t value = co_await read(address);
    status_.push_back(value);
  }
  inspecting_ = false;
}

// Accesses at any moment, as a busy CPU has them; none changes anything.
Task<> SoftDriver::look_around() {
  for (unsigned i = 0; i < 6; ++i) {
    random_ = mix(random_);
    const unsigned n = kFirstRx + (random_ >> 8) % (kBuffers - kFirstRx);
    switch (random_ % 6) {
      case 0: co_await read(reg::mb(n)); break;
      case 1: co_await read(reg::mb(n, 1 + (random_ >> 16) % 3)); break;
      case 2: co_await read(reg::kMcr + 4 * ((random_ >> 16) % 20)); break;
      case 3: write(reg::kImask2, ~0u); break;
      case 4: write(reg::mb(kEndTx + (random_ >> 16) % (kBuffers - kEndTx), 2), n); break;
      default: co_await read(reg::kTimer); break;
    }
  }
  co_await read(reg::kTimer);  // leaves no buffer locked
}

}  // namespace vericansim
