// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncLoop: see sync_loop.hpp.
#include "timesync/sync_loop.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "model/frame_codec.hpp"
#include "timesync/picoseconds.hpp"

namespace vericansim {
namespace {

// Software: when it sees to SYNC and FUP, and how long a follower takes to handle FUP.
constexpr double kSoftwareGap = 100e3, kHandle = 200e3;
constexpr double kEarly = 300;  // ns, of a displaced edge, at most

std::size_t bits_of(std::span<const std::uint8_t, 8> data) {
  constexpr std::size_t kIntermission = 3;
  Frame frame;
  frame.id = kSyncId;
  frame.dlc = 8;
  std::copy(data.begin(), data.end(), frame.data.begin());
  return encode_frame(frame).bits.size() + kIntermission;
}

}  // namespace

SyncLoop::SyncLoop(const SyncCase &setting, std::uint64_t seed)
    : setting_{setting}, dice_{seed}, traffic_{setting, dice_()} {
  for (unsigned n = 0; n <= setting.followers; ++n) {
    const Oscillator oscillator{setting.clocks.frequency_hz, error_of(n), dice_()};
    nodes.emplace_back(oscillator, dice_() >> 3);
  }
  verican_servo_config_t config{};
  verican_servo_config_default(&config);
  config.interval_us = static_cast<std::uint32_t>(std::llround(setting.interval_s * 1e6));
  config.filter = setting.filter;
  // A constant is calibrated: the mean of what is uneven, too.
  config.delay_ns =
      -static_cast<std::int32_t>(setting.master_late_ns + setting.master_uneven_ns / 2);
  servos.resize(setting.followers);
  for (verican_servo_t &servo : servos) verican_servo_init(&servo, &config);
  verican_tsyn_rules_default(&rules_);
  receivers_.resize(setting.followers);
  if (setting.hardware) hardware_.assign(setting.followers, HardwareFollower{setting, kSyncId});
}

OscillatorError SyncLoop::error_of(unsigned node) {
  const SyncClocks &clocks = setting_.clocks;
  const double spread = clocks.spread_ppm * 1e-6;
  double constant = uniform(-spread, spread);
  if (clocks.opposed) constant = node == 0 ? 0 : node % 2 == 1 ? spread : -spread;
  return {constant, clocks.wander, clocks.sine_ppm * 1e-6, clocks.sine_period_s};
}

double SyncLoop::uniform(double low, double high) {
  return std::uniform_real_distribution<double>{low, high}(dice_);
}

const SyncRun &SyncLoop::run() {
  for (unsigned n = 0; n < setting_.intervals; ++n) {
    if (setting_.master_cut && n == setting_.intervals / 2) cut_master();
    sync(setting_.interval_s);
  }
  return result;
}

// TM-89: the first follower has heard nothing for three intervals and half of one, its rank, and
// sends from then on, with its clock as it stands.
void SyncLoop::cut_master() {
  const Nanoseconds interval = setting_.interval_s * 1e9L;
  for (const double part : {1.25, 2.5, 3.25}) look(now + part * interval);
  now += 2.5L * interval;
  master_ = 1;
  sender_ = {};
}

void SyncLoop::sync(double interval_s, const std::function<bool(unsigned)> &lost) {
  const Nanoseconds before = now;
  now = std::max(now + interval_s * 1e9L, looked_);
  const Pair pair = send();
  look((before + now) / 2);
  look(pair.handled);
  for (unsigned n = 0; n < setting_.followers; ++n)
    if (pair.has_sync && n + 1 != master_ && (!lost || !lost(n))) follow(n, pair);
  look(pair.handled + 1e3L);
}

// SYNC leaves at an edge of the master's clock; FUP follows when software has seen its end. A SYNC
// that is not sent within R is aborted (TM-50).
SyncLoop::Pair SyncLoop::send() {
  ClockNode &master = nodes[master_];
  Pair pair{};
  const Nanoseconds queued = now + uniform(0, kSoftwareGap);
  verican_tsyn_write_sync(&sender_, &rules_, master.now(queued), pair.sync);
  const std::size_t bits = bits_of(pair.sync);
  const Nanoseconds sof = queued + traffic_.until_sof(bits);
  const Nanoseconds given_up = queued + setting_.interval_s * 1e9L;
  if (sof + traffic_.duration(bits) > given_up) {
    pair.handled = given_up;
    return pair;
  }
  pair.has_sync = true;
  const std::int64_t sent = master.oscillator.edge_after(sof);
  pair.edge = master.oscillator.time_of(sent, sof);
  const std::uint64_t t1 = master_stamp(sent, pair.edge);
  pair.has_fup = verican_tsyn_write_fup(&sender_, &rules_, t1, pair.fup);
  const std::size_t fup_bits = bits_of(pair.fup);
  const Nanoseconds fup_queued = sof + traffic_.duration(bits) + uniform(0, kSoftwareGap);
  pair.handled = fup_queued + traffic_.until_sof(fup_bits) + traffic_.duration(fup_bits) +
                 (setting_.hardware ? HardwareFollower::kWorkedOff * master.oscillator.nominal()
                                    : Nanoseconds{uniform(0, kHandle)});
  result.frames += pair.has_fup ? 2 : 1;
  result.repeated = traffic_.failed();
  return pair;
}

// The time of SYNC as FUP tells it: the stamp less its latency.
std::uint64_t SyncLoop::master_stamp(std::int64_t sent, Nanoseconds edge) {
  ClockNode &master = nodes[master_];
  if (setting_.own_pin) {
    const std::uint64_t half_clocks = kReceiveLatency * master.increment();
    return master.receive_stamp(edge) - (half_clocks >> 33);
  }
  if (setting_.master_late_ns == 0) return master.at(sent);
  const double late = setting_.master_late_ns + uniform(0, setting_.master_uneven_ns);
  return master.now(edge + late);
}

void SyncLoop::follow(unsigned n, const Pair &pair) {
  ClockNode &node = nodes[n + 1];
  Nanoseconds edge = pair.edge;
  if (setting_.displaced > 0 && uniform(0, 1) < setting_.displaced) edge -= uniform(0, kEarly);
  const std::uint64_t stamp = node.receive_stamp(edge);
  if (setting_.hardware) return follow_in_hardware(n, pair, stamp);
  verican_sync_pair_t local{};
  (void)receive(n, pair.sync, stamp, local);
  const std::int64_t last = node.oscillator.last_edge(pair.handled);
  if (pair.has_fup && receive(n, pair.fup, node.at(last), local) == VERICAN_TSYN_PAIR)
    correct(n, local, last, pair.handled);
  else
    ++result.refused;
}

void SyncLoop::follow_in_hardware(unsigned n, const Pair &pair, std::uint64_t stamp) {
  ClockNode &node = nodes[n + 1];
  const std::int64_t last = node.oscillator.last_edge(pair.handled);
  (void)hardware_[n].frame(pair.sync, stamp, last, node);
  if (!pair.has_fup) return;
  auto action = hardware_[n].frame(pair.fup, node.at(last), last, node);
  if (!action) return;
  action->at = to_picoseconds(pair.handled);
  action->follower = n;
  result.actions.push_back(*action);
}

verican_tsyn_heard_t SyncLoop::receive(unsigned n, const std::uint8_t (&data)[8],
                                       std::uint64_t stamp, verican_sync_pair_t &pair) {
  const verican_servo_config_t &config = servos[n].config;
  const std::uint64_t silence = config.hold_after * std::uint64_t{config.interval_us} * 1000;
  return verican_tsyn_receive(&receivers_[n], &rules_, data, 8, stamp, silence, &pair);
}

void SyncLoop::correct(unsigned n, verican_sync_pair_t &pair, std::int64_t edge, Nanoseconds t) {
  ClockNode &node = nodes[n + 1];
  pair.now = node.at(edge);
  pair.increment = node.increment();
  pair.latency = kReceiveLatency;
  verican_correction_t correction{};
  verican_servo_pair(&servos[n], &pair, &correction);
  node.apply(edge, correction);
  receivers_[n].stamp += static_cast<std::uint64_t>(correction.shift);
  result.actions.push_back({to_picoseconds(t), n, correction.shift, correction.increment,
                            correction.events, servos[n].state});
  if (on_correction) on_correction(n, correction);
}

// Of a follower; one that has become the master is with itself.
std::uint8_t SyncLoop::state_of(unsigned n, std::uint64_t clock) {
  if (n + 1 == master_) return VERICAN_SYNC_LOCKED;
  if (setting_.hardware) return hardware_[n].state(clock);
  verican_servo_poll(&servos[n], clock);
  return servos[n].state;
}

void SyncLoop::look(Nanoseconds t) {
  if (t < looked_) return;
  looked_ = t;
  SyncLook look{to_picoseconds(t), {}};
  for (unsigned n = 0; n < setting_.followers; ++n) {
    ClockNode &node = nodes[n + 1];
    look.followers.push_back(
        {to_picoseconds(node.ahead_of(nodes[master_], t)), state_of(n, node.now(t))});
  }
  result.looks.push_back(std::move(look));
}

SyncRun run_by_model(const SyncCase &setting, std::uint64_t seed) {
  SyncLoop loop{setting, seed};
  loop.run();
  return std::move(loop.result);
}

}  // namespace vericansim
