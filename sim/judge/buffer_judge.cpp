// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferJudge: see buffer_judge.hpp.
#include "judge/buffer_judge.hpp"

#include <algorithm>
#include <utility>

#include "model/registers.hpp"

namespace vericansim {
namespace {

/// A bit is complete two clocks after its sample point, and a C/S write acts one clock after its
/// data phase: the model hears of accesses this many clocks later, so that an event of the same
/// moment comes first and its window is open.
constexpr unsigned kAccessLag = 3;

bool is_mask(std::uint32_t address) {
  return address == reg::kRxgmask || address == reg::kRx14mask || address == reg::kRx15mask ||
         address == reg::kRxfgmask || (address >= reg::rximr(0) && address < reg::rximr(64));
}

// Bits after the start of a frame in which its stamp may be taken.
constexpr unsigned kStampBits = 2;

bool is_cs(std::uint32_t address) {
  return address >= reg::mb(0) && address < reg::mb(64) && address % 16 == 0;
}

std::uint32_t lanes_of(const AhbRequest &request) {
  const std::uint32_t width = request.hsize == AhbSize::kByte   ? 0xFF
                              : request.hsize == AhbSize::kHalf ? 0xFFFF
                                                                : 0xFFFFFFFF;
  return width << (8 * (request.haddr & 3));
}

bool same(const BufferConfig &a, const BufferConfig &b) {
  return a.maxmb == b.maxmb && a.bcc == b.bcc && a.srx_dis == b.srx_dis && a.aen == b.aen &&
         a.lprio_en == b.lprio_en && a.fen == b.fen && a.idam == b.idam && a.lbuf == b.lbuf &&
         a.eacen == b.eacen && a.rrs == b.rrs && a.mrp == b.mrp && a.rffn == b.rffn &&
         a.one_shot == b.one_shot && a.osmb == b.osmb;
}

}  // namespace

BufferJudge::BufferJudge(RtlNode &node, Report report)
    : node_{node},
      report_{std::move(report)},
      registers_{node.num_mb()},
      model_{registers_.buffers()} {
  node_.ahb().watch(
      [this](const AhbRequest &request, const AhbResponse &response) { watch(request, response); });
}

BufferJudge::~BufferJudge() { node_.ahb().watch({}); }

// ---- The CPU

// Called within the clock edge, before the node has counted it.
void BufferJudge::watch(const AhbRequest &request, const AhbResponse &response) {
  const std::uint64_t clock = node_.cycles() + 1;
  look_at_run(clock);
  if (!response.hready) return;
  if (phase_ && !response.hresp) {
    ++accesses_;
    done_.push_back({.clock = clock,
                     .address = phase_->haddr & 0x1FFC,
                     .data = phase_->hwrite ? request.hwdata : response.hrdata,
                     .lanes = lanes_of(*phase_),
                     .write = phase_->hwrite,
                     .running = was_running_});
  }
  phase_.reset();
  if (request.htrans == AhbTrans::kNonseq || request.htrans == AhbTrans::kSeq) phase_ = request;
}

// Stopped in a frame, or between the decision to send and the SOF: the attempt never was.
void BufferJudge::look_at_run(std::uint64_t clock) {
  const bool running = (node_.trace() & kTraceRunning) != 0;
  if (was_running_ && !running) {
    tell(clock);
    stopped_at_ = clock;
    interference_.stopped = true;
    if (on_stop) on_stop();
    if (model_.sending()) model_.send_failed(clock);
    if (std::exchange(reset_asked_, false)) soft_reset(clock);
    check();
  }
  if (running && !was_running_) back_at_ = clock;
  was_running_ = running;
}

void BufferJudge::tell(std::uint64_t until) {
  while (!done_.empty() && done_.front().clock + kAccessLag <= until) {
    tell(done_.front());
    done_.pop_front();
  }
}

void BufferJudge::tell(const Access &access) {
  if (!ok()) return;
  if (access.write) {
    write(access);
  } else if (access.lanes == 0xFFFFFFFF) {
    model_.cpu_read(access.address, access.data, access.clock);
  }
  check();
}

void BufferJudge::write(const Access &access) {
  const auto change = registers_.write(access.address, access.data, access.lanes, access.running);
  const bool frozen = !access.running && !registers_.disabled();
  if (is_cs(access.address)) last_cs_write_ = access.clock;
  if (change.soft_reset) {
    // It lets the bits that are being sent dominant end; 2.3 gives it time.
    reset_asked_ = access.running && stopped_at_ < access.clock;
    if (!reset_asked_) soft_reset(access.clock);
  } else if (change.configuration) {
    const BufferConfig config = registers_.buffers();
    if (!same(config, model_.config())) model_.configure(config, access.clock);
  } else if (access.address == reg::kTimer) {
    bits_ = static_cast<std::uint16_t>(access.data);
    // The core may have taken the stamp before or after.
    if (since_stamp_ <= kStampBits) stamp_.reset();
    model_.timer_written();
  } else if (access.address == reg::kEcr) {
    if (frozen) interference_.counters = {access.data & 0xFF, (access.data >> 8) & 0xFF};
  } else if (!is_mask(access.address) || frozen) {
    model_.cpu_write(access.address, access.data, access.clock, access.lanes);
  }
}

void BufferJudge::soft_reset(std::uint64_t clock) {
  interference_.soft_reset = true;
  bits_ = 0;
  model_.soft_reset(clock);
  model_.configure(registers_.buffers(), clock);
}

// Everything that has happened so far, the event of the last bit included.
void BufferJudge::finish() { tell(node_.cycles() + kAccessLag); }

// ---- The bus

BufferJudge::Interference BufferJudge::begin_bit(const NodeBit &bit) {
  tell(node_.cycles());
  // While the node integrates, too: the bits that it waits for are other nodes' intermission.
  model_.bus_free(bit.field == Field::kInteg || bit.field == Field::kIdle ||
                  bit.field == Field::kInt || bit.field == Field::kSuspend);
  if (!std::exchange(was_running_, true)) back_at_ = node_.cycles();
  ++bits_;
  ++since_stamp_;
  return std::exchange(interference_, {});
}

void BufferJudge::started(bool own, bool sof_to_come) {
  stamp_ = static_cast<std::uint16_t>(bits_ + (sof_to_come ? 1 : 0));
  since_stamp_ = 0;
  model_.frame_started(own, node_.cycles());
  check();
}

bool BufferJudge::must_send() const {
  const std::uint64_t now = node_.cycles();
  const std::uint64_t window = model_.windows().decision;
  const auto cs_write = [](const Access &access) { return access.write && is_cs(access.address); };
  if (std::any_of(done_.begin(), done_.end(), cs_write)) return false;
  return now > std::max(last_cs_write_, back_at_) + window && model_.must_send_since(now - window);
}

void BufferJudge::header(const std::optional<Frame> &foreign) {
  model_.header(foreign, stamp_, node_.cycles());
  check();
}

void BufferJudge::end_bit(const NodeBit &bit, const Frame &frame) {
  const std::uint64_t now = node_.cycles();
  if (bit.errors != 0) model_.receive_failed(now);
  if (bit.delivered && bit.transmitter) model_.received(now);
  if (bit.delivered && !bit.transmitter) model_.received(frame, now);
  if (bit.failed) model_.send_failed(now);
  if (bit.sent) model_.sent(frame, now);
  check();
}

void BufferJudge::check() {
  if (model_.ok() || reported_) return;
  reported_ = true;
  report_("buffers: " + model_.failure());
}

}  // namespace vericansim
