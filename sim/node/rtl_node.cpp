// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlNode: see rtl_node.hpp; what has no part in the Verilated models (rtl_models.cpp).
#include "node/rtl_node.hpp"

#include <stdexcept>
#include <utility>

#include "bus/bus.hpp"

namespace vericansim {

void RtlNode::Waiter::await_suspend(std::coroutine_handle<> handle) const {
  node.disturbed();
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
  const BusMaster::Ticket ticket = master().submit(transfer);
  while (!master().done(ticket)) advance();
  return master().result(ticket);
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

void RtlNode::no_ahb() const { throw std::logic_error(name() + " has no AHB"); }

std::uint64_t RtlNode::time_of_clock() const {
  throw std::logic_error(name() + " has no time unit");
}

}  // namespace vericansim
