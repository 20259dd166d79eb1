// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SoftDriver: its interrupts and buffers (flexcan.md 3 and 4).
#include <bit>
#include <utility>

#include "model/registers.hpp"
#include "softerror/driver.hpp"
#include "softerror/driver_map.hpp"

namespace vericansim {
namespace {

using namespace driver_map;

Frame to_frame(std::uint32_t cs, std::uint32_t id, std::uint32_t low, std::uint32_t high) {
  Frame frame;
  frame.extended = (cs & reg::kCsIde) != 0;
  frame.remote = (cs & reg::kCsRtr) != 0;
  frame.dlc = (cs >> 16) & 0xF;
  frame.id = frame.extended ? id & 0x1FFFFFFF : (id >> 18) & 0x7FF;
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    frame.data[i] = static_cast<std::uint8_t>((i < 4 ? low : high) >> (24 - 8 * (i % 4)));
  }
  return frame;
}

// A buffer that reads BUSY is read again, but not for ever.
constexpr unsigned kBusyReads = 32;
// One frame in so many is asked to be given up as soon as it is loaded.
constexpr unsigned kAbortEvery = 11;

}  // namespace

Task<> SoftDriver::load() {
  for (unsigned i = 0; i < kTxBuffers; ++i) {
    if (slots_[i].busy || (waiting_.empty() && to_send_ == 0)) continue;
    if (waiting_.empty()) {
      --to_send_;
      waiting_.push_back(ledger_.next(0));
    }
    slots_[i] = {true, false, waiting_.front()};
    waiting_.erase(waiting_.begin());
    co_await activate(i);
    if (++loads_ % kAbortEvery == 0) {
      slots_[i].abort = true;
      write(reg::mb(kFirstTx + i), kCodeAbort);
    }
  }
}

Task<> SoftDriver::activate(unsigned slot) {
  const unsigned n = kFirstTx + slot;
  const Frame frame = make_frame(slots_[slot].tag);
  const std::uint32_t format = (frame.extended ? reg::kCsIde | reg::kCsSrr : 0) |
                               (frame.remote ? reg::kCsRtr : 0) |
                               static_cast<std::uint32_t>(frame.dlc) << 16;
  write(reg::mb(n, 2), frame.data_word(0));
  write(reg::mb(n, 3), frame.data_word(4));
  write(reg::mb(n, 1), frame.extended ? frame.id : frame.id << 18);
  if (kTimeUnit && loads_ % kLaunchEvery == 0) {
    write(VERICAN_TTX_OFFSET, co_await read(VERICAN_TIMELO_OFFSET) + kLaunchIn);
    write(VERICAN_TTXMB_OFFSET, VERICAN_TTXMB_HOLD_MASK | n);
  }
  static_cast<void>(co_await node_.ahb().write(reg::mb(n), reg::kCodeTxData | format));
}

Task<> SoftDriver::serve() {
  const std::uint8_t lines = node_.irq_lines();
  if ((lines & ~(kIrqAll | kIrqMb)) != 0) {
    const std::uint32_t esr = co_await read(reg::kEsr);
    write(reg::kEsr, esr & reg::kEsrInterrupts);
  }
  if ((lines & kIrqMb) == 0) co_return;
  std::uint64_t flags = co_await read(reg::kIflag1);
  flags |= static_cast<std::uint64_t>(co_await read(reg::kIflag2)) << 32;
  if ((flags & (reg::kIflagFifoOvf | reg::kIflagFifoWarn)) != 0) {
    if ((flags & reg::kIflagFifoOvf) != 0) ++overruns_;
    write(reg::kIflag1, flags & (reg::kIflagFifoOvf | reg::kIflagFifoWarn));
  }
  if ((flags & reg::kIflagFifo) != 0) co_await serve_fifo();
  for (flags &= ~0xFFULL; flags != 0; flags &= flags - 1) {
    const auto n = static_cast<unsigned>(std::countr_zero(flags));
    if (n >= kFirstTx && n < kEndTx) {
      co_await serve_sent(n - kFirstTx);
    } else {
      co_await serve_mailbox(n);
    }
  }
}

Task<> SoftDriver::serve_fifo() {
  auto &ahb = node_.ahb();
  const auto cs = ahb.submit({.address = reg::mb(0)});
  const auto id = ahb.submit({.address = reg::mb(0, 1)});
  const auto low = ahb.submit({.address = reg::mb(0, 2)});
  const auto high = ahb.submit({.address = reg::mb(0, 3)});
  static_cast<void>(co_await ahb.read(reg::kRxfir));
  const Frame frame = to_frame(ahb.result(cs).data, ahb.result(id).data, ahb.result(low).data,
                               ahb.result(high).data);
  static_cast<void>(co_await ahb.write(reg::kIflag1, reg::kIflagFifo));
  on_received(frame);
}

// C/S (which locks), ID, data, W1C of the flag, TIMER (which unlocks): the order matters, see 3.6.
Task<> SoftDriver::serve_mailbox(unsigned mb) {
  auto &ahb = node_.ahb();
  std::uint32_t cs = co_await read(reg::mb(mb));
  for (unsigned i = 0; i < kBusyReads && (cs & reg::kCodeRxBusy) != 0; ++i) {
    cs = co_await read(reg::mb(mb));
  }
  const auto id = ahb.submit({.address = reg::mb(mb, 1)});
  const auto low = ahb.submit({.address = reg::mb(mb, 2)});
  const auto high = ahb.submit({.address = reg::mb(mb, 3)});
  write(mb < 32 ? reg::kIflag1 : reg::kIflag2, 1u << (mb % 32));
  static_cast<void>(co_await ahb.read(reg::kTimer));
  const std::uint32_t code = cs & reg::kCodeMask;
  if (code == reg::kCodeRxOverrun) ++overruns_;
  // A flag without a frame, which a driver drops: the buffer was not filled.
  if (code != reg::kCodeRxOverrun && code != VERICAN_MB_CS_CODE_SET(2)) co_return;
  on_received(to_frame(cs, ahb.result(id).data, ahb.result(low).data, ahb.result(high).data));
}

Task<> SoftDriver::serve_sent(unsigned slot) {
  const std::uint32_t cs = co_await read(reg::mb(kFirstTx + slot));
  static_cast<void>(co_await node_.ahb().write(reg::kIflag2, 1u << (kFirstTx + slot - 32)));
  // A flag of a buffer that is still to be sent, or of none: cleared, and that is all.
  if (!slots_[slot].busy || (cs & reg::kCodeMask) == reg::kCodeTxData) co_return;
  const FrameTag tag = slots_[slot].tag;
  slots_[slot].busy = false;
  write(reg::mb(kFirstTx + slot), reg::kCodeTxInactive);
  if ((cs & reg::kCodeMask) == kCodeAbort) {
    ledger_.aborted(tag);
  } else {
    ledger_.sent(tag, false);
  }
}

}  // namespace vericansim
