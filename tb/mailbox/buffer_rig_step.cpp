// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferRig, one clock: accesses, bus, and what the model hears of them.
#include "mailbox/buffer_rig.hpp"

namespace vericansim {
namespace {

/// The engine tells its events one clock after they are decided, and a C/S write acts one clock
/// after its data phase: the model hears of accesses this much later, so that an event of the same
/// moment comes first and its window is open.
constexpr unsigned kAccessLag = 2;

/// An idle bus and a buffer that waits this long: the core is stuck.
constexpr unsigned kLongestWait = 400;

std::uint32_t lanes_of(const AhbTransfer &transfer) {
  const std::uint32_t width = transfer.size == AhbSize::kByte   ? 0xFF
                              : transfer.size == AhbSize::kHalf ? 0xFFFF
                                                                : 0xFFFFFFFF;
  return width << (8 * (transfer.address & 3));
}

}  // namespace

Level BufferRig::rx_level() const {
  const Level wire = node_->tx() & peer_level_;
  const bool hit =
      disturbance_ && in_frame_ && disturbance_->second != 0 && bit_ == disturbance_->first;
  return hit ? !wire : wire;
}

void BufferRig::step() {
  drive_accesses();
  peer_level_ = peer_next_level_;
  const Level rx = rx_level();
  if (wave_) wave_->clock(node_->tx() & peer_level_);
  node_->clock(rx);
  if (wave_) wave_->node(0, rx);
  ++clock_;
  const std::uint64_t word = node_->trace();
  const Trace trace = decode_trace(word);
  if ((word & (kTraceEvents | kTraceBoundary)) != 0) bus_event(trace);
  if (trace.sample) sampled(trace);
  // Stopped between the decision to send and the SOF, or by a soft reset: the attempt never was.
  // What the engine tells of its last clock comes one clock later.
  if (stopped_ && model.sending()) model.send_not_begun(clock_);
  stopped_ = was_running_ && !trace.running;
  was_running_ = trace.running;
  collect_accesses();
  tell_model(false);
}

void BufferRig::drive_accesses() {
  while (!planned_.empty() && planned_.begin()->first <= clock_) {
    const AhbTransfer transfer = planned_.begin()->second;
    planned_.erase(planned_.begin());
    under_way_.emplace_back(node_->master().submit(transfer), transfer);
  }
}

void BufferRig::collect_accesses() {
  while (!under_way_.empty() && node_->master().done(under_way_.front().first)) {
    const auto &[ticket, transfer] = under_way_.front();
    const AhbResult &result = node_->master().result(ticket);
    done_.push_back({clock_ - result.late, transfer, result});
    under_way_.pop_front();
  }
}

void BufferRig::tell_model(bool all) {
  while (!done_.empty() && (all || done_.front().clock + kAccessLag <= clock_)) {
    const Done done = done_.front();
    done_.pop_front();
    const std::uint32_t address = done.transfer.address & ~3u;
    const unsigned shift = 8 * (done.transfer.address & 3);
    if (done.transfer.write) {
      model.cpu_write(address, done.transfer.data << shift, done.clock, lanes_of(done.transfer));
    } else {
      model.cpu_read(address, done.result.data, done.clock);
    }
    check_model();
  }
}

void BufferRig::check_model() {
  if (model.ok() || failed_) return;
  failed_ = true;  // once
  ADD_FAILURE() << "clock " << clock_ << ", frame " << starts_ << ": " << model.failure();
}

// The peer and the core share one bit: the peer samples with the core, and its next level is on the
// wire early enough to be through the core's synchroniser at the start of the next bit.
void BufferRig::sampled(const Trace &trace) {
  if (!trace.running) return;
  ++timer_;
  if (trace.field != Field::kIdle) idle_since_ = clock_;
  const Level wire = node_->tx() & peer_level_;
  if (!peer_.pending() && !peer_queue_.empty()) {
    peer_.request(peer_queue_.front());
    foreign_ = peer_queue_.front();
    peer_queue_.pop_front();
  }
  peer_.sample(wire);
  peer_next_level_ = peer_.drive();
  if (in_frame_) bits_.push_back(wire);
  // The match may begin with the last bits of the identifier.
  const bool past_header = trace.field > Field::kId && trace.field <= Field::kCrc;
  if (in_frame_ && past_header && !header_told_) {
    header_told_ = true;
    model.header(trace.transmitter ? std::nullopt : std::optional{foreign_}, stamp_, clock_);
  }
  check_liveness();
}

void BufferRig::bus_event(const Trace &trace) {
  if (trace.start) {
    ++starts_;
    start_clock_ = clock_;
    in_frame_ = true;
    header_told_ = false;
    // A sender decides before its SOF, a receiver knows after it has sampled one.
    const bool sof_to_come = trace.field == Field::kSof;
    bit_ = sof_to_come ? ~0u : 0;
    bits_.clear();
    if (!sof_to_come) bits_.push_back(Level::kDominant);
    model.frame_started(trace.transmitter, clock_);
  }
  if (trace.errors != 0) model.receive_failed(clock_);
  if (trace.rx_valid) model.received(clock_);
  if (trace.tx_fail) {
    model.send_failed(clock_);
    header_told_ = false;  // the frame of the winner
  }
  if (trace.tx_ok) {
    const DecodeResult wire = decode_frame(bits_);
    if (!wire.frame) ADD_FAILURE() << "what was sent is no frame: " << to_string(bits_);
    sent_.push_back(wire.frame.value_or(Frame{}));
    model.sent(sent_.back(), clock_);
  }
  if (trace.rx_valid || trace.tx_ok || trace.tx_fail || trace.errors != 0) end_clock_ = clock_;
  check_model();
  if (trace.boundary && trace.running) end_bit(trace.field);
}

void BufferRig::end_bit(Field field) {
  if (disturbance_ && in_frame_ && disturbance_->second != 0 && bit_ == disturbance_->first)
    if (--disturbance_->second == 0) disturbance_.reset();
  if (++bit_ == 1) stamp_ = timer_;
  if (field == Field::kIdle) in_frame_ = false;
}

// A buffer that may send does so at the next opportunity (3.3).
void BufferRig::check_liveness() {
  if (failed_ || clock_ < idle_since_ + kLongestWait) return;
  if (!model.must_send_since(clock_ - kLongestWait)) return;
  failed_ = true;
  ADD_FAILURE() << "clock " << clock_ << ": the bus is idle, but a waiting buffer is not sent";
}

}  // namespace vericansim
