// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DriverHost: see driver_host.hpp.
#include "driver_host.hpp"

DriverHost::DriverHost(const sc_core::sc_module_name &name, const Settings &settings)
    : sc_core::sc_module{name}, settings_{settings} {
  SC_HAS_PROCESS(DriverHost);
  SC_THREAD(software);
}

// ---- The driver's way to the registers

void DriverHost::access(tlm::tlm_command command, std::uint32_t offset, std::uint32_t &word) {
  tlm::tlm_generic_payload payload;
  payload.set_command(command);
  payload.set_address(offset);
  payload.set_data_ptr(reinterpret_cast<unsigned char *>(&word));
  payload.set_data_length(4);
  payload.set_streaming_width(4);
  payload.set_byte_enable_ptr(nullptr);
  payload.set_dmi_allowed(false);
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  sc_core::sc_time local = keeper_.get_local_time();
  socket->b_transport(payload, local);
  ++accesses_;
  keeper_.set(local);
  if (keeper_.need_sync()) keeper_.sync();
  if (payload.is_response_error()) SC_REPORT_ERROR(name(), payload.get_response_string().c_str());
}

std::uint32_t DriverHost::read(void *self, std::uint32_t offset) {
  std::uint32_t word = 0;
  static_cast<DriverHost *>(self)->access(tlm::TLM_READ_COMMAND, offset, word);
  return word;
}

void DriverHost::write(void *self, std::uint32_t offset, std::uint32_t value) {
  static_cast<DriverHost *>(self)->access(tlm::TLM_WRITE_COMMAND, offset, value);
}

void DriverHost::sent_one(void *self, verican_t *, const verican_tx_event_t *event) {
  auto &host = *static_cast<DriverHost *>(self);
  if (event->outcome != VERICAN_TX_SENT) return;
  ++host.sent_;
  if (host.on_sent) host.on_sent(host.keeper_.get_current_time(), host.sent_);
}

// ---- The program

verican_frame_t DriverHost::frame(unsigned number) const {
  verican_frame_t frame{};
  frame.id = settings_.base_id + number % 16;
  frame.dlc = static_cast<std::uint8_t>(number % 9);
  for (unsigned i = 0; i < frame.dlc; ++i)
    frame.data[i] = static_cast<std::uint8_t>(number * 7 + i * 29);
  return frame;
}

void DriverHost::set_up() {
  verican_config_t config;
  verican_config_default(&config);
  config.port.read32 = &read;
  config.port.write32 = &write;
  config.port.context = this;
  config.clock_hz = settings_.clock_hz;
  config.bitrate = settings_.bitrate;
  config.tx_order = VERICAN_TX_IN_ORDER;
  config.rx_ring = ring_.data();
  config.rx_ring_size = static_cast<std::uint16_t>(ring_.size());
  config.callbacks.on_sent = &sent_one;
  config.callbacks.user = this;
  result_ = verican_init(&device_, &config);
  if (result_ == VERICAN_OK) result_ = verican_start(&device_);
}

void DriverHost::send_more() {
  while (queued_ < settings_.to_send) {
    const verican_frame_t next = frame(queued_);
    if (verican_send(&device_, &next, nullptr) != VERICAN_OK) return;
    ++queued_;
  }
}

void DriverHost::take_received() {
  verican_frame_t frame;
  while (verican_receive(&device_, &frame) == VERICAN_OK) {
    received_.push_back(frame);
    if (on_frame) on_frame(keeper_.get_current_time(), frame);
  }
}

// The local time is given back to SystemC before waiting, so that it and the line agree.
void DriverHost::wait_for_interrupt() {
  keeper_.sync();
  while (!irq.read()) wait(irq.posedge_event());
  keeper_.reset();
}

void DriverHost::software() {
  keeper_.reset();
  set_up();
  if (result_ != VERICAN_OK) SC_REPORT_ERROR(name(), verican_result_name(result_));
  bool told = false;
  for (;;) {
    send_more();
    if (!told && sent_ == settings_.to_send && received_.size() >= settings_.to_receive) {
      told = true;
      if (on_done) on_done();
    }
    wait_for_interrupt();
    ++interrupts_;
    verican_irq_handler(&device_);
    take_received();
  }
}
