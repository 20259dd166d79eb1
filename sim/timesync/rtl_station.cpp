// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RtlStation: see rtl_station.hpp.
#include "timesync/rtl_station.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace vericansim {

RtlStation::RtlStation(Bus &bus, std::string name, const ClockConfig &clock, std::uint32_t bitrate)
    : bus_{bus}, rtl_{RtlNode::create_with_time(std::move(name), clock)} {
  bus_.add(*rtl_);
  verican_config_default(&config_);
  config_.port.read32 = [](void *self, std::uint32_t offset) {
    return static_cast<RtlStation *>(self)->rtl_->read32(offset);
  };
  config_.port.write32 = [](void *self, std::uint32_t offset, std::uint32_t value) {
    static_cast<RtlStation *>(self)->rtl_->write32(offset, value);
  };
  config_.port.context = this;
  config_.clock_hz = static_cast<std::uint32_t>(clock.frequency_hz);
  config_.bitrate = bitrate;
  config_.rx_ring = ring_.data();
  config_.rx_ring_size = static_cast<std::uint16_t>(ring_.size());
  config_.callbacks.user = this;
  config_.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
    const auto &tell = static_cast<RtlStation *>(self)->on_sent;
    if (tell) tell(*event);
  };
}

void RtlStation::start(std::uint32_t id, std::uint32_t mask) {
  const verican_filter_t filter{id, mask, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_ONLY_0};
  verican_result_t result = verican_init(&dev, &config_);
  if (result == VERICAN_OK) result = verican_set_filters(&dev, &filter, 1);
  if (result == VERICAN_OK) result = verican_start(&dev);
  if (result != VERICAN_OK)
    throw std::runtime_error(rtl_->name() + ": " + verican_result_name(result));
  arm();
}

Task<> RtlStation::wait() {
  co_await rtl_->interrupt();
  interrupted_ = true;
  bus_.stop();
}

void RtlStation::serve() {
  verican_irq_handler(&dev);
  interrupted_ = false;
  arm();
}

bool RtlStation::receive(verican_frame_t &frame) {
  return verican_receive(&dev, &frame) == VERICAN_OK;
}

bool RtlStation::silent() const {
  std::uint8_t waiting = 0;
  return verican_tx_waiting(&dev, &waiting) == VERICAN_OK && waiting == 0;
}

bool RtlStation::sending() const {
  const Trace trace = decode_trace(rtl_->trace());
  return trace.transmitter && trace.field >= Field::kSof && trace.field <= Field::kEof;
}

RtlStation::Reading RtlStation::reading() {
  const std::uint64_t whole = rtl_->time_of_clock();
  const Clock &clock = std::as_const(*rtl_).oscillator();
  const double edges =
      1 - static_cast<double>(clock.next() - bus_.now()) / clock.period_ps();  // since the last
  return {whole, edges * std::ldexp(static_cast<double>(dev.increment), -32)};
}

Time ahead(const RtlStation::Reading &one, const RtlStation::Reading &other) {
  constexpr std::int64_t kMost = std::numeric_limits<Time>::max() / 1001;
  const auto whole = static_cast<std::int64_t>(one.whole - other.whole);
  return std::clamp(whole, -kMost, kMost) * kNanosecond +
         std::llround((one.since - other.since) * static_cast<double>(kNanosecond));
}

}  // namespace vericansim
