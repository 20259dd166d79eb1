// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortNode: see port_node.hpp.
#include "port_node.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "frame_form.hpp"

namespace vericansim {
namespace {

HostConfig host_config(const BitTiming &timing, const PortOptions &options) {
  HostConfig config;
  config.timing = timing;
  config.boff_rec = true;  // recovery is begun by restart()
  // With one buffer the order of the programs is the order on the bus.
  config.tx_buffers = options.by_identifier ? PortNode::kRoom : 1;
  config.lowest_buffer_first = !options.by_identifier;
  return config;
}

// Format and number; a data frame and a remote frame may share them.
canid_t identifier_of(const can_frame &frame) { return frame.can_id & ~CAN_RTR_FLAG; }

}  // namespace

// ---- Outbox

void Outbox::expect(Time time) {
  Slot slot;
  slot.message.time = time;
  slots_.push_back(slot);
  ++expected_;
}

std::deque<Outbox::Slot>::iterator Outbox::first_expected() {
  return std::find_if(slots_.begin(), slots_.end(), [](const Slot &slot) { return !slot.ready; });
}

void Outbox::fill(const can_frame &frame, bool wanted) {
  const auto slot = first_expected();
  if (slot == slots_.end()) throw std::logic_error("a frame was read that the bus has not had");
  slot->message.frame = frame;
  slot->wanted = wanted;
  slot->ready = true;
  --expected_;
}

void Outbox::lose() {
  const auto slot = first_expected();
  if (slot == slots_.end()) return;
  slots_.erase(slot);
  --expected_;
}

bool Outbox::give_to(CanPort &port, PortCounts &counts) {
  for (; !slots_.empty() && slots_.front().ready; slots_.pop_front()) {
    const PortMessage &message = slots_.front().message;
    if (!slots_.front().wanted) continue;
    if (port.up() && !port.put(message) && port.up()) return false;
    if (!port.up())
      ++counts.away;
    else if ((message.frame.can_id & CAN_ERR_FLAG) != 0)
      ++counts.errors;
    else
      ++(message.echo ? counts.echoes : counts.to_host);
  }
  return true;
}

// ---- PortNode

PortNode::PortNode(CanPort &port, RtlNode &node, const BitTiming &timing,
                   const PortOptions &options)
    : port_{port},
      node_{node},
      options_{options},
      bit_time_{static_cast<Time>(
          std::llround(timing.clocks_per_bit() * 1e12 / node.oscillator().nominal_hz()))},
      after_sample_{bit_time_ * timing.ps2 / timing.quanta()},
      errors_{options.errors},
      host_{node, host_config(timing, options)} {
  host_.on_received = [this](const HostFrame &frame) { on_received(frame); };
  host_.on_sent = [this](const HostFrame &frame) { on_told(frame); };
}

void PortNode::take() {
  while (queue_.size() < kRoom) {
    const auto message = port_.take();
    if (!message) return;
    const auto frame = from_can_frame(message->frame);
    if (!frame) {
      ++counts_.rejected;
      continue;
    }
    ++counts_.from_host;
    // Of equal identifiers the core sends that in the lowest buffer, not the oldest: it has one.
    const bool goes =
        !options_.by_identifier || first_of(identifier_of(message->frame)) == queue_.end();
    queue_.push_back(*message);
    if (goes) host_.send(*frame);
  }
}

std::deque<PortMessage>::iterator PortNode::first_of(canid_t identifier) {
  return std::find_if(queue_.begin(), queue_.end(), [&](const PortMessage &message) {
    return identifier_of(message.frame) == identifier;
  });
}

void PortNode::on_bit(const BitRecord &bit) {
  const Trace &after = bit.after;
  // VA-01: valid for a receiver at EOF6; VA-02: for the transmitter at EOF7.
  if (after.rx_valid && !after.transmitter) {
    ++counts_.received;
    outbox_.expect(bit.time + after_sample_ + bit_time_);
  }
  if (after.tx_ok) on_sent(bit.time + after_sample_);
  if (auto message = errors_.on_bit(bit)) outbox_.push({.frame = *message, .time = bit.time});
  if (after.bus_off == bus_off_) return;
  bus_off_ = after.bus_off;
  recovering_ = false;
  if (bus_off_) enter_bus_off();
}

void PortNode::on_received(const HostFrame &frame) {
  if (frame.overrun) {
    ++counts_.overruns;
    outbox_.lose();
  }
  const can_frame message = to_can_frame(frame.frame);
  const bool wanted = passes(options_.filters, message.can_id);
  if (!wanted) ++counts_.filtered;
  outbox_.fill(message, wanted);
}

void PortNode::on_sent(Time end) {
  if (queue_.empty()) throw std::logic_error("a frame has left that nobody has sent");
  ++counts_.sent;
  if (options_.by_identifier) return ends_.push_back(end);  // which one it was, the host tells
  const PortMessage message = queue_.front();
  queue_.pop_front();
  echo(message, end);
}

void PortNode::on_told(const HostFrame &sent) {
  if (!options_.by_identifier) return;  // seen earlier, in on_bit()
  const canid_t identifier = identifier_of(to_can_frame(sent.frame));
  const auto found = first_of(identifier);
  if (found == queue_.end() || ends_.empty())
    throw std::logic_error("a frame has left that nobody has sent");
  const PortMessage message = *found;
  queue_.erase(found);
  echo(message, ends_.front());
  ends_.pop_front();
  const auto next = first_of(identifier);
  if (next != queue_.end()) host_.send(*from_can_frame(next->frame));
}

void PortNode::echo(PortMessage message, Time end) {
  if (!port_.wants_echo()) return;
  message.time = end;
  message.echo = true;
  outbox_.push(message);
}

void PortNode::enter_bus_off() {
  const std::uint64_t this_time = ++counts_.bus_off;
  if (options_.restart == 0) return;
  Bus &bus = *node_.bus();
  // The user may have restarted the node before; the next bus-off then waits for its own time.
  bus.at(bus.now() + options_.restart, [this, this_time] {
    if (counts_.bus_off == this_time) restart();
  });
}

void PortNode::restart() {
  if (!bus_off_ || recovering_) return;
  recovering_ = true;
  ++counts_.restarts;
  host_.recover();
}

bool PortNode::quiet() const {
  if (bus_off_) return !recovering_;
  return queue_.empty() && host_.pending() == 0 && !outbox_.expecting() &&
         trace_field(node_.trace()) == Field::kIdle;
}

}  // namespace vericansim
