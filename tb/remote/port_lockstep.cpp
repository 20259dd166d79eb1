// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// PortLockstep: see port_lockstep.hpp.
#include "remote/port_lockstep.hpp"

#include <fmt/format.h>

#include "remote/remote_text.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kSerial = 0xCAFE1234;
constexpr unsigned kAnswerBits = 8;  // within which an answer is offered
constexpr unsigned kAll = 240;  // clocks in which a node with producers has looked at all of them

// As tb/CMakeLists.txt has it.
RemoteConfig odd_config(unsigned name_bits) {
  if (name_bits == 5)
    return {.name_bits = 5,
            .mem_bytes = 2048,
            .stage_bytes = 16,
            .tx_depth = 4,
            .num_map = 8,
            .protect = true};
  return {.mem_bytes = 1024,
          .stage_bytes = 0,
          .num_prod = 4,
          .num_map = 4,
          .block = true,
          .counters = true};
}

RemoteConfig config_of(const std::string &profile, unsigned name_bits) {
  const bool odd = profile == "odd";
  const bool clock = profile == "time", wide = profile == "standard16";
  RemoteConfig config =
      odd ? odd_config(name_bits) : RemoteConfig::profile(clock || wide ? "standard" : profile);
  config.time_sync = clock;
  if (wide) config.stage_bytes = 16;
  config.name_bits = name_bits;
  config.serial = kSerial;
  return config;
}

}  // namespace

PortLockstep::PortLockstep(const std::string &profile, unsigned name_bits, unsigned number)
    : config_{config_of(profile, name_bits)},
      number_{number},
      port_{FramePort::create(profile, name_bits, kSerial, number)},
      model_{std::make_unique<RemoteModel>(config_, number)} {
  start();
}

void PortLockstep::reset() {
  note("reset");
  port_->reset();
  model_ = std::make_unique<RemoteModel>(config_, number_);
}

void PortLockstep::start() {
  port_->start();
  model_->start();
}

void PortLockstep::note(const std::string &step) {
  steps_.push_back(step);
  if (steps_.size() > 40) steps_.erase(steps_.begin());
}

std::string PortLockstep::history() const {
  std::string text;
  for (const std::string &step : steps_) text += step + "\n";
  return text;
}

void PortLockstep::differ(const std::string &what, const std::string &rtl,
                          const std::string &model) {
  if (difference_.empty()) difference_ = what + ": " + rtl + ", model: " + model;
}

// The model needs no time for its producers and block transfers.
void PortLockstep::work() {
  if (config_.num_prod != 0) port_->clocks(kAll);
}

void PortLockstep::receive(const Frame &frame) {
  note(candump_frame(frame));
  work();
  port_->receive(frame);
  model_->receive(frame);
  model_->intermission();
  restart();
}

// The RTL has been off the bus and is back by itself.
void PortLockstep::restart() {
  if (!model_->restarting()) return;
  port_->clocks(32);
  model_->stopped();
}

void PortLockstep::receive_broken(const Frame &frame, unsigned bytes) {
  note(fmt::format("broken {}, {} bytes", candump_frame(frame), bytes));
  work();
  port_->receive_broken(frame, bytes);
}

bool PortLockstep::turn(FramePort::End end) {
  work();
  for (unsigned bits = 0; bits < kAnswerBits && !port_->asks(); ++bits) port_->bit();
  const std::optional<Frame> wanted = model_->wants();
  if (!port_->asks()) {
    if (wanted) differ("offers nothing", "-", text_of(wanted));
    return false;
  }
  if (!wanted) {
    differ("offers", text_of(port_->send(end)), "nothing");
    return false;
  }
  model_->attempt();
  const Frame sent = port_->send(end);
  note(fmt::format("{} {}",
                   end == FramePort::End::kSent    ? "sends"
                   : end == FramePort::End::kError ? "fails with"
                                                   : "loses",
                   text_of(wanted)));
  const bool head_only = end == FramePort::End::kLost;
  if (head_only ? sent.id != wanted->id || sent.dlc != wanted->dlc : sent != *wanted)
    differ("sends", text_of(sent), text_of(wanted));
  if (end == FramePort::End::kSent) model_->sent();
  if (end == FramePort::End::kError) model_->failed();
  if (end == FramePort::End::kLost) model_->lost_arbitration();
  return true;
}

void PortLockstep::drain() {
  for (unsigned i = 0; i < 1000 && turn(); ++i) {
  }
}

void PortLockstep::ms() {
  note("ms");
  work();
  port_->ms();
  model_->tick();
}

void PortLockstep::user_write(unsigned word, std::uint32_t data, unsigned lanes) {
  note(fmt::format("user writes {:03X} {:08X} {:X}", 4 * word, data, lanes));
  work();
  port_->user_write(word, data, lanes);
  model_->user_write(word, data, lanes);
}

void PortLockstep::hold(bool on) {
  port_->hold(on);
  model_->hold(on);
}

void PortLockstep::event(unsigned k) {
  if (k >= config_.num_prod) return;
  note(fmt::format("event {}", k));
  work();
  port_->event(1U << k);
  work();
  model_->event(k);
}

void PortLockstep::set_counters(unsigned tec, unsigned rec) {
  note(fmt::format("TEC {}, REC {}", tec, rec));
  port_->set_counters(tec, rec, tec > 127 || rec > 127, false);
  model_->set_errors(tec, rec);
}

void PortLockstep::set_clock(const std::array<std::uint8_t, 16> &row) {
  note(fmt::format("clock {:02X}", fmt::join(row, " ")));
  work();
  port_->set_clock(row);
  model_->set_clock(row);
}

void PortLockstep::bus_off(bool off) {
  note(off ? "bus-off" : "recovered");
  work();
  port_->set_counters(0, 0, false, off);
  port_->clocks(64);
  model_->set_errors(0, 0);
  off ? model_->went_bus_off() : model_->recovered();
}

void PortLockstep::compare_byte(unsigned address) {
  const unsigned rtl = port_->peek(address);
  const unsigned model = model_->memory()[address];
  if (rtl != model)
    differ(fmt::format("byte {:03X}", address), fmt::format("{:02X}", rtl),
           fmt::format("{:02X}", model));
}

const std::string &PortLockstep::compare() {
  if (port_->state() != model_->state())
    differ("state", std::to_string(static_cast<int>(port_->state())),
           std::to_string(static_cast<int>(model_->state())));
  const std::string pulses = text_of(port_->take_pulses());
  const std::string expected = text_of(model_->take_pulses());
  if (pulses != expected) differ("pulses", pulses, expected);
  for (unsigned address = 0; address < remote_map::kHidden; ++address) compare_byte(address);
  for (unsigned address = remote_map::kNode; address < remote_map::kConfigEnd; ++address)
    compare_byte(address);
  const unsigned producers = remote_map::kProducers;
  for (unsigned i = 0; i < 8 * config_.num_prod; ++i) compare_byte(producers + i);
  for (unsigned i = 0; i < 8 * config_.num_map; ++i) compare_byte(remote_map::kMaps + i);
  const unsigned counters = config_.counters ? 8 : 0;
  for (unsigned i = 0; i < counters; ++i) compare_byte(remote_map::kCounters + i);
  // State, TEC and REC are brought up to date before anybody on the bus sees them.
  for (unsigned address = remote_map::kStatus + 3; address < remote_map::kSize; ++address)
    compare_byte(address);
  return difference_;
}

}  // namespace vericansim
