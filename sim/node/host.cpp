// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Host: see host.hpp. The access sequences are those of flexcan.md 2, 3.3 and 8.2.
#include "node/host.hpp"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "bus/bus.hpp"
#include "bus/range.hpp"
#include "model/registers.hpp"

namespace vericansim {
namespace {

// A mode change that takes longer than the longest frame is stuck: 160 bits x 256 clocks x 25
// quanta.
constexpr std::uint64_t kPollLimit = 160ULL * 256 * 25;

std::uint32_t id_word(std::uint32_t id, bool extended) { return extended ? id : id << 18; }

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

// Bits 31 (RTR) and 30 (IDE) of a mask count when CTRL2.EACEN is set.
std::uint32_t mask_word(const RxFilter &filter) {
  return id_word(filter.mask, filter.extended) | (filter.match_remote ? 1U << 31 : 0) |
         (filter.match_format ? 1U << 30 : 0);
}

}  // namespace

void RxFilter::validate() const {
  require_id("filter: identifier", id, extended);
  require_id("filter: mask", mask, extended);
}

Host::Host(RtlNode &node, HostConfig config)
    : node_{node}, config_{std::move(config)}, first_tx_{node.num_mb() - config_.tx_buffers} {
  config_.timing.validate();
  require_range("transmit buffers", config_.tx_buffers, 1, node.num_mb() - 1);
  if (config_.filters.size() > first_tx_) {
    throw std::invalid_argument("at most " + std::to_string(first_tx_) + " filters fit beside " +
                                std::to_string(config_.tx_buffers) + " transmit buffers");
  }
  for (const RxFilter &filter : config_.filters) filter.validate();
  if (config_.filters.empty()) {
    // Without CTRL2.EACEN a buffer takes either base or extended frames, so there are both.
    config_.filters.resize(first_tx_);
    for (unsigned n = 1; n < first_tx_; n += 2) config_.filters[n].extended = true;
  }
  tx_.resize(config_.tx_buffers);
}

Host::~Host() { stop(); }

// ---- For the user

void Host::start() {
  stop();
  main_ = run();
}

// Nobody may resume a coroutine that is destroyed. What it had put into buffers waits again.
void Host::stop() {
  if (!main_.done()) {
    node_.forget_waiter();
    node_.master().reset();
  }
  main_ = {};
  for (auto slot = tx_.rbegin(); slot != tx_.rend(); ++slot)
    if (std::exchange(slot->busy, false)) queue_.push_front(slot->frame);
  loaded_ = 0;
  ready_ = false;
}

void Host::start_and_wait() {
  start();
  while (!ready_) {
    check();
    node_.advance();
  }
}

void Host::check() {
  if (main_ && main_.done()) main_.result();
}

void Host::send(const Frame &frame) {
  frame.validate();
  queue_.push_back(frame);
  node_.wake();
}

bool Host::send_and_wait(const Frame &frame, Time limit) {
  frame.validate();
  if (!main_) throw std::logic_error(node_.name() + ": its host has not been started");
  send(frame);
  const Time end = time_behind(node_.oscillator().next(), limit);
  while (pending() != 0) {
    check();
    if (node_.oscillator().next() > end) return false;
    node_.advance();
  }
  return true;
}

void Host::recover() {
  write(reg::kCtrl, ctrl() & ~reg::kCtrlBoffRec);
  write(reg::kCtrl, ctrl());
}

// ---- Set-up

Task<> Host::run() {
  co_await set_up();
  ready_ = true;
  co_await serve();
}

void Host::write(std::uint32_t address, std::uint32_t data) {
  node_.ahb().submit({.address = address, .write = true, .data = data});
}

Task<> Host::poll(std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  const std::uint64_t begin = node_.cycles();
  while (((co_await node_.ahb().read(address)).data & mask) != value) {
    if (node_.cycles() - begin > kPollLimit) {
      throw std::runtime_error(node_.name() + ": no acknowledge of a mode change in MCR");
    }
  }
}

std::uint32_t Host::ctrl() const {
  return config_.timing.ctrl_fields() | reg::kCtrlBoffMsk | reg::kCtrlErrMsk |
         (config_.loop_back ? reg::kCtrlLpb : 0) | (config_.triple_sampling ? reg::kCtrlSmp : 0) |
         (config_.boff_rec ? reg::kCtrlBoffRec : 0) |
         (config_.lowest_buffer_first ? reg::kCtrlLbuf : 0) |
         (config_.listen_only ? reg::kCtrlLom : 0);
}

Task<> Host::set_up() {
  const std::uint32_t frozen = reg::kMcrFrz | reg::kMcrHalt;
  const std::uint32_t mode = reg::kMcrSupv | reg::kMcrWrnEn | reg::kMcrBcc | (node_.num_mb() - 1) |
                             (config_.self_reception || config_.loop_back ? 0 : reg::kMcrSrxDis);
  write(reg::kMcr, frozen | 0xF);  // MDIS = 0
  co_await poll(reg::kMcr, reg::kMcrLpmAck, 0);
  write(reg::kMcr, reg::kMcrSoftRst);
  co_await poll(reg::kMcr, reg::kMcrSoftRst | reg::kMcrFrzAck, reg::kMcrFrzAck);
  write(reg::kMcr, frozen | mode);
  write(reg::kCtrl, ctrl());
  write(reg::kCtrl2, reg::kCtrl2Eacen | reg::kCtrl2Rrs);
  write(reg::kExtControl, config_.fd_tolerant ? 1 : 0);
  co_await set_up_buffers();
  write(reg::kImask1, ~0u);
  write(reg::kImask2, ~0u);
  write(reg::kMcr, reg::kMcrFrz | mode);  // HALT = 0
  co_await poll(reg::kMcr, reg::kMcrFrzAck, 0);
}

Task<> Host::set_up_buffers() {
  for (unsigned n = 0; n < node_.num_mb(); ++n) {
    const bool receives = n < config_.filters.size();
    const RxFilter filter = receives ? config_.filters[n] : RxFilter{};
    const std::uint32_t format =
        (filter.extended ? reg::kCsIde : 0) | (filter.remote ? reg::kCsRtr : 0);
    write(reg::rximr(n), mask_word(filter));
    write(reg::mb(n, 1), id_word(filter.id, filter.extended));
    write(reg::mb(n), receives         ? reg::kCodeRxEmpty | format
                      : n >= first_tx_ ? reg::kCodeTxInactive
                                       : 0);
  }
  static_cast<void>(co_await node_.ahb().read(reg::kMcr));  // in order, so that all writes are done
}

// ---- Service

Task<> Host::serve() {
  for (;;) {
    co_await load_frames();
    co_await node_.interrupt();
    const std::uint8_t lines = node_.irq_lines();
    if ((lines & kIrqMb) != 0) co_await serve_buffers();
    if ((lines & ~(kIrqAll | kIrqMb)) != 0) co_await serve_errors();
  }
}

// Lowest free buffer first; with one buffer the order of send() is the order on the wire.
Task<> Host::load_frames() {
  for (unsigned slot = 0; slot < tx_.size() && !queue_.empty(); ++slot) {
    if (tx_[slot].busy) continue;
    const Frame frame = queue_.front();
    queue_.pop_front();
    ++loaded_;
    tx_[slot] = {true, frame};
    const unsigned n = first_tx_ + slot;
    const std::uint32_t format = (frame.extended ? reg::kCsIde | reg::kCsSrr : 0) |
                                 (frame.remote ? reg::kCsRtr : 0) |
                                 static_cast<std::uint32_t>(frame.dlc) << 16;
    if (frame.payload_size() > 0) write(reg::mb(n, 2), frame.data_word(0));
    if (frame.payload_size() > 4) write(reg::mb(n, 3), frame.data_word(4));
    write(reg::mb(n, 1), id_word(frame.id, frame.extended));
    static_cast<void>(co_await node_.ahb().write(reg::mb(n), reg::kCodeTxData | format));
  }
}

Task<> Host::serve_buffers() {
  std::uint64_t flags = 0;
  if (node_.num_mb() > 32) {
    const auto low = node_.ahb().submit({.address = reg::kIflag1});  // ends before the other
    flags = static_cast<std::uint64_t>((co_await node_.ahb().read(reg::kIflag2)).data) << 32;
    flags |= node_.ahb().result(low).data;
  } else {
    flags = (co_await node_.ahb().read(reg::kIflag1)).data;
  }
  std::vector<HostFrame> batch;
  for (; flags != 0; flags &= flags - 1) {
    const auto n = static_cast<unsigned>(std::countr_zero(flags));
    if (n >= first_tx_) {
      co_await finish_transmission(n);
    } else {
      batch.push_back(co_await read_buffer(n));
    }
  }
  deliver(batch);
}

// C/S (which locks), ID, data, W1C of the flag, TIMER (which unlocks): the order matters, see 3.6.
Task<HostFrame> Host::read_buffer(unsigned mb) {
  auto &ahb = node_.ahb();
  std::uint32_t cs = (co_await ahb.read(reg::mb(mb))).data;
  while ((cs & reg::kCodeRxBusy) != 0) cs = (co_await ahb.read(reg::mb(mb))).data;
  const auto id = ahb.submit({.address = reg::mb(mb, 1)});
  const auto low = ahb.submit({.address = reg::mb(mb, 2)});
  const auto high = ahb.submit({.address = reg::mb(mb, 3)});
  write(mb < 32 ? reg::kIflag1 : reg::kIflag2, 1u << (mb % 32));
  static_cast<void>(co_await ahb.read(reg::kTimer));
  HostFrame result;
  result.frame = to_frame(cs, ahb.result(id).data, ahb.result(low).data, ahb.result(high).data);
  result.stamp = cs & 0xFFFF;
  result.mb = mb;
  result.overrun = (cs & reg::kCodeMask) == reg::kCodeRxOverrun;
  result.time = node_.oscillator().next();
  co_return result;
}

// Frames of one batch leave in the order of their stamps, which lie within half of the TIMER's
// range.
void Host::deliver(std::vector<HostFrame> &batch) {
  std::sort(batch.begin(), batch.end(), [](const HostFrame &a, const HostFrame &b) {
    return static_cast<std::int16_t>(a.stamp - b.stamp) < 0;
  });
  for (HostFrame &frame : batch) {
    ++stats_.received;
    if (frame.overrun) ++stats_.overruns;
    if (on_received) {
      on_received(frame);
    } else {
      received_.push_back(frame);
    }
  }
}

Task<> Host::finish_transmission(unsigned mb) {
  TxSlot &slot = tx_[mb - first_tx_];
  const std::uint32_t cs = (co_await node_.ahb().read(reg::mb(mb))).data;
  // A remote frame leaves its buffer as a receive buffer; C/S first, then the flag.
  if (slot.frame.remote) write(reg::mb(mb), reg::kCodeTxInactive);
  write(mb < 32 ? reg::kIflag1 : reg::kIflag2, 1u << (mb % 32));
  HostFrame sent;
  sent.frame = slot.frame;
  sent.stamp = cs & 0xFFFF;
  sent.mb = mb;
  sent.time = node_.oscillator().next();
  slot.busy = false;
  --loaded_;
  ++stats_.sent;
  if (on_sent) {
    on_sent(sent);
  } else {
    sent_.push_back(sent);
  }
}

Task<> Host::serve_errors() {
  const std::uint32_t esr = (co_await node_.ahb().read(reg::kEsr)).data;
  stats_.esr |= esr;
  if ((esr & reg::kEsrErrInt) != 0) ++stats_.error_interrupts;
  if ((esr & reg::kEsrBoffInt) != 0) ++stats_.bus_off;
  static_cast<void>(co_await node_.ahb().write(reg::kEsr, esr & reg::kEsrInterrupts));
}

}  // namespace vericansim
