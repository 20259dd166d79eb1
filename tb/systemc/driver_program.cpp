// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DriverProgram: see driver_program.hpp.
#include "systemc/driver_program.hpp"

#include "model/registers.hpp"

namespace vericansim {
namespace {

// From the end of the set-up to the first frame: all others are on the bus by then.
constexpr unsigned kJoinClocks = 8000;

}  // namespace

// ---- The program

std::uint32_t DriverProgram::read(void *self, std::uint32_t offset) {
  return static_cast<DriverProgram *>(self)->processor_.access({{.address = offset}}).data;
}

void DriverProgram::write(void *self, std::uint32_t offset, std::uint32_t value) {
  static_cast<DriverProgram *>(self)->processor_.access(
      {{.address = offset, .write = true, .data = value}});
}

void DriverProgram::send_more() {
  while (queued_ < settings_.frames) {
    if (!have_next_) {
      next_ = {};
      next_.flags = (contents_() & 3) == 0 ? VERICAN_FRAME_EXTENDED : 0;
      next_.id = contents_() & (next_.flags != 0 ? 0x1FFFFFFCu : 0x7FCu);
      next_.id |= settings_.number;
      next_.dlc = static_cast<std::uint8_t>(contents_() % 9);
      for (unsigned i = 0; i < next_.dlc; ++i)
        next_.data[i] = static_cast<std::uint8_t>(contents_());
      have_next_ = true;
    }
    if (verican_send(&device_, &next_, nullptr) != VERICAN_OK) return;
    have_next_ = false;
    ++queued_;
  }
}

void DriverProgram::odd_access() {
  const auto buffer = static_cast<unsigned>(random_() % 64);
  std::vector<AhbTransfer> burst;
  switch (random_() % 8) {
    case 0: processor_.access({{.address = reg::kEcr, .size = AhbSize::kByte}}); break;
    case 1: processor_.access({{.address = reg::kEsr + 2, .size = AhbSize::kHalf}}); break;
    case 2: processor_.access({{.address = 0x2000u + 4 * buffer}}); break;  // ERROR
    case 3:
      for (unsigned i = 0; i < 3; ++i) {
        burst.push_back({.address = reg::mb(buffer, 1) + 4 * i,
                         .burst = AhbBurst::kIncr,
                         .trans = i == 0 ? AhbTrans::kNonseq : AhbTrans::kSeq});
      }
      processor_.access(burst);
      break;
    case 4: processor_.wait_clocks(1 + static_cast<unsigned>(random_() % 60)); break;
    default: break;
  }
}

void DriverProgram::run() {
  verican_config_t config;
  verican_config_default(&config);
  config.port.read32 = &read;
  config.port.write32 = &write;
  config.port.context = this;
  config.clock_hz = 8'000'000;
  config.bitrate = settings_.bitrate;
  config.rx_ring = ring_.data();
  config.rx_ring_size = static_cast<std::uint16_t>(ring_.size());
  config.callbacks.user = this;
  config.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
    if (event->outcome == VERICAN_TX_SENT) ++static_cast<DriverProgram *>(self)->sent;
  };
  result = verican_init(&device_, &config);
  if (result == VERICAN_OK) result = verican_start(&device_);
  if (result != VERICAN_OK) return;
  processor_.wait_clocks(kJoinClocks);
  for (;;) {
    send_more();
    if (settings_.odd_accesses) odd_access();
    processor_.wait_for_interrupt();
    verican_irq_handler(&device_);
    verican_frame_t frame;
    while (verican_receive(&device_, &frame) == VERICAN_OK) received.push_back(frame);
  }
}

// ---- In the C++ simulator

NodeProcessor::NodeProcessor(RtlNode &node, std::function<void(Processor &)> program)
    : node_{node}, program_{std::move(program)} {
  getcontext(&inside_);
  inside_.uc_stack.ss_sp = stack_.data();
  inside_.uc_stack.ss_size = stack_.size();
  inside_.uc_link = nullptr;
  const auto self = reinterpret_cast<std::uintptr_t>(this);
  makecontext(&inside_, reinterpret_cast<void (*)()>(&enter), 2, static_cast<unsigned>(self >> 32),
              static_cast<unsigned>(self));
}

NodeProcessor::~NodeProcessor() {
  node_.ahb().reset();
  node_.forget_waiter();
}

void NodeProcessor::enter(unsigned high, unsigned low) {
  auto &self = *reinterpret_cast<NodeProcessor *>((std::uintptr_t{high} << 32) | low);
  self.program_(self);
  self.give_way(Wish::kEnd);
}

void NodeProcessor::give_way(Wish wish) {
  wish_ = wish;
  swapcontext(&inside_, &outside_);
}

Task<> NodeProcessor::drive() {
  for (;;) {
    // An access ends while its clock edge is still being counted.
    const unsigned uncounted = wish_ == Wish::kAccess ? 1 : 0;
    swapcontext(&outside_, &inside_);
    switch (wish_) {
      case Wish::kAccess:
        for (std::size_t i = 0; i + 1 < transfers_->size(); ++i)
          node_.ahb().submit((*transfers_)[i]);
        result_ = co_await node_.ahb().access(transfers_->back());
        break;
      case Wish::kInterrupt: co_await node_.interrupt(); break;
      case Wish::kClocks: co_await node_.delay(clocks_ + uncounted); break;
      case Wish::kEnd: co_return;
    }
  }
}

AhbResult NodeProcessor::access(const std::vector<AhbTransfer> &transfers) {
  transfers_ = &transfers;
  give_way(Wish::kAccess);
  return result_;
}

void NodeProcessor::wait_for_interrupt() { give_way(Wish::kInterrupt); }

void NodeProcessor::wait_clocks(unsigned count) {
  clocks_ = count;
  give_way(Wish::kClocks);
}

}  // namespace vericansim
