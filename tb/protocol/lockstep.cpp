// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Lockstep: see lockstep.hpp.
#include "protocol/lockstep.hpp"

#include <algorithm>

namespace vericansim {
namespace {

NodeConfig model_config(const CoreConfig &config) {
  return {.listen_only = config.listen_only,
          .loop_back = config.loop_back,
          .fd_tolerant = config.fd_tolerant,
          .boff_rec = config.boff_rec};
}

}  // namespace

Lockstep::Lockstep(CoreBench &bench) : bench_{bench}, followers_(bench.size()) {
  for (unsigned i = 0; i < bench.size(); ++i) {
    followers_[i].rules.model().config() = model_config(bench.dut(i).config());
  }
  bench.on_bit = [this](unsigned i, const DutBit &bit) { follow(i, bit); };
}

void Lockstep::start() { bench_.start(); }

void Lockstep::request(unsigned dut, const Frame &frame, bool one_shot) {
  Follower &follower = followers_[dut];
  bench_.dut(dut).request(frame, one_shot);
  follower.rules.model().config().one_shot = one_shot;
  if (follower.rules.model().pending()) {
    follower.queue.push_back(frame);
  } else {
    follower.rules.model().request(frame);
  }
}

void Lockstep::cancel(unsigned dut) {
  bench_.dut(dut).cancel();
  followers_[dut].queue.clear();
  followers_[dut].rules.model().cancel();
}

void Lockstep::preset_counters(unsigned dut, std::uint8_t tec, std::uint8_t rec) {
  bench_.dut(dut).preset_counters(tec, rec);
  followers_[dut].rules.model().preset_counters(tec, rec);
}

void Lockstep::follow(unsigned i, const DutBit &bit) {
  Follower &follower = followers_[i];
  NodeModel &model = follower.rules.model();
  const BitPlace at = model.state();
  if (mismatches_.empty() && i == 0) history_.push_back(bit.rx == Level::kDominant ? '0' : '1');
  const std::vector<std::string> differences = follower.rules.follow(bit);
  for (const std::string &what : differences) mismatch(i, at, what);
  const bool delivered = bit.delivered && !bit.transmitter;
  if (differences.empty() && delivered && bench_.dut(i).received().back() != model.received())
    mismatch(i, at, "delivers a frame other than that on the bus");
  if (!model.pending() && !follower.queue.empty()) {
    model.request(follower.queue.front());
    follower.queue.pop_front();
  }
}

void Lockstep::mismatch(unsigned i, const BitPlace &at, const std::string &what) {
  if (mismatches_.size() >= kMaxReports) return;
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
