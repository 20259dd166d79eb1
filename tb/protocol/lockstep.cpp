// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Lockstep: see lockstep.hpp.
#include "protocol/lockstep.hpp"

#include <algorithm>

#include "judge/rule_tolerance.hpp"

namespace vericansim {
namespace {

NodeConfig model_config(const CoreConfig &config) {
  return {.listen_only = config.listen_only,
          .loop_back = config.loop_back,
          .fd_tolerant = config.fd_tolerant,
          .boff_rec = config.boff_rec};
}

/// The bit of the trace that stands for an error.
std::uint8_t trace_bit(NodeError error) {
  switch (error) {
    case NodeError::kBit0: return kErrBit0;
    case NodeError::kBit1: return kErrBit1;
    case NodeError::kAck: return kErrAck;
    case NodeError::kCrc: return kErrCrc;
    case NodeError::kForm: return kErrForm;
    case NodeError::kStuff: return kErrStuff;
    default: return 0;
  }
}

std::string differs(const char *what, unsigned dut, unsigned model) {
  return std::string{what} + " " + std::to_string(dut) + ", the rules say " + std::to_string(model);
}

}  // namespace

Lockstep::Lockstep(CoreBench &bench) : bench_{bench}, followers_(bench.size()) {
  for (unsigned i = 0; i < bench.size(); ++i) {
    followers_[i].model.config() = model_config(bench.dut(i).config());
  }
  bench.on_bit = [this](unsigned i, const DutBit &bit) { follow(i, bit); };
}

void Lockstep::start() { bench_.start(); }

void Lockstep::request(unsigned dut, const Frame &frame, bool one_shot) {
  Follower &follower = followers_[dut];
  bench_.dut(dut).request(frame, one_shot);
  follower.model.config().one_shot = one_shot;
  if (follower.model.pending()) {
    follower.queue.push_back(frame);
  } else {
    follower.model.request(frame);
  }
}

void Lockstep::cancel(unsigned dut) {
  bench_.dut(dut).cancel();
  followers_[dut].queue.clear();
  followers_[dut].model.cancel();
}

void Lockstep::preset_counters(unsigned dut, std::uint8_t tec, std::uint8_t rec) {
  bench_.dut(dut).preset_counters(tec, rec);
  followers_[dut].model.preset_counters(tec, rec);
}

void Lockstep::follow(unsigned i, const DutBit &bit) {
  Follower &follower = followers_[i];
  NodeModel &model = follower.model;
  const Level expected = model.internal_level();
  follower.last_rec = model.rec();
  if (mismatches_.empty() && i == 0) history_.push_back(bit.rx == Level::kDominant ? '0' : '1');
  if (bit.sent_level != expected) {
    mismatch(i, differs("sends", static_cast<unsigned>(bit.sent_level),
                        static_cast<unsigned>(expected)));
  }
  compare_place(i, bit);
  model.sample(bit.rx);
  compare_events(i, bit);
  compare_counters(i, bit);
  if (!model.pending() && !follower.queue.empty()) {
    model.request(follower.queue.front());
    follower.queue.pop_front();
  }
}

void Lockstep::compare_place(unsigned i, const DutBit &bit) {
  const BitPlace place = followers_[i].model.state();
  if (place.field == bit.field && place.is_stuff == bit.stuff) return;
  const auto name = [](Field field, bool stuff) {
    return std::string{field_name(field)} + (stuff ? " (stuff bit)" : "");
  };
  mismatch(i, "is at " + name(bit.field, bit.stuff) + ", the rules say " +
                  name(place.field, place.is_stuff));
}

void Lockstep::compare_events(unsigned i, const DutBit &bit) {
  const NodeModel &model = followers_[i].model;
  const NodeEvents &events = model.events();
  const bool delivered = bit.delivered && !bit.transmitter;
  if (bit.sent != events.sent_ok) mismatch(i, differs("success", bit.sent, events.sent_ok));
  if (bit.failed != events.tx_fail) mismatch(i, differs("failure", bit.failed, events.tx_fail));
  if (bit.errors != trace_bit(events.error)) {
    mismatch(i, differs("error kinds", bit.errors, trace_bit(events.error)));
  }
  const bool own = events.delivered && model.role() == Role::kTransmitter;
  if (own || (bit.delivered && bit.transmitter)) return;
  if (delivered != events.delivered) {
    mismatch(i, differs("delivery", delivered, events.delivered));
  } else if (delivered && bench_.dut(i).received().back() != model.received()) {
    mismatch(i, "delivers a frame other than that on the bus");
  }
}

void Lockstep::compare_counters(unsigned i, const DutBit &bit) {
  Follower &follower = followers_[i];
  NodeModel &model = follower.model;
  const bool off = model.error_state() == ErrorState::kBusOff;
  if (bit.bus_off != off) mismatch(i, differs("bus-off", bit.bus_off, off));
  if (bit.bus_off || off) return;
  if (static_cast<int>(bit.tec) != model.tec() && !settle_tec(model, bit)) {
    mismatch(i, differs("TEC", bit.tec, static_cast<unsigned>(model.tec())));
  }
  const bool rec_equal = static_cast<int>(bit.rec) == model.rec();
  if (!rec_equal && !settle_rec(model, follower.last_rec, follower.crc_step, bit)) {
    mismatch(i, differs("REC", bit.rec, static_cast<unsigned>(model.rec())));
  }
  if (rec_equal) follower.crc_step = false;
  const bool passive = model.error_state() == ErrorState::kPassive;
  if (bit.passive != passive && !follower.crc_step) {
    mismatch(i, differs("error passive", bit.passive, passive));
  }
}

void Lockstep::mismatch(unsigned i, const std::string &what) {
  if (mismatches_.size() >= kMaxReports) return;
  const BitPlace at = followers_[i].model.state();
  mismatches_.push_back("bit " + std::to_string(bench_.bits()) + ", DUT " + std::to_string(i) +
                        " (" + std::string{field_name(at.field)} + "[" + std::to_string(at.index) +
                        "]): " + what);
}

std::string Lockstep::report() const {
  if (agrees()) return "";
  std::string text;
  for (const std::string &line : mismatches_) text += line + "\n";
  const std::size_t shown = std::min<std::size_t>(history_.size(), 200);
  return text + "levels seen by DUT 0 up to the first: " + history_.substr(history_.size() - shown);
}

}  // namespace vericansim
