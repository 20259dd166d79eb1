// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Trigger skew: see trigger_skew.hpp.
#include "remote/trigger_skew.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "node/remote_node.hpp"
#include "remote/random_host.hpp"
#include "remote/random_remotes.hpp"

namespace vericansim {
namespace {

/// A node on the line and when it acted on the last trigger.
struct Place {
  std::unique_ptr<RemoteNode> node;
  BitTiming timing;
  double metres = 0;
  Time acted = 0;
  unsigned times = 0;

  [[nodiscard]] double clock_ps() const { return node->oscillator().period_ps(); }
  [[nodiscard]] double quantum_ps() const { return timing.prescaler * clock_ps(); }
};

class Line {
 public:
  Line(const std::string &profile, unsigned seed) : dice_{seed} {
    slower_ = 1U << dice_.upto(4);
    tolerance_ppm_ = dice_.once_in(2) ? 100 : 1000;
    const auto count = 2 + dice_.upto(15);
    for (unsigned i = 0; i < count; ++i) draw_place();
    draw_metres();
    const RemoteClock &clock = remote_clocks()[dice_.upto(4)];
    host_ = std::make_unique<CoreNode>("host", CoreConfig{.timing = timing_of(clock)},
                                       clock_of(clock.hz));
    bus_.add(*host_);
    for (unsigned i = 0; i < count; ++i) connect(profile, i);
    host_->start();
    bus_.run_for(20 * bit());
    for (Place &place : places_) place.node->start();
    bus_.run_for(1000 * bit());  // BOOT frames
    send(0, {1, 0});
  }

  TriggerSkew trigger(unsigned count) {
    for (Place &place : places_) place.times = 0;
    send(1, {static_cast<std::uint8_t>(count)});
    TriggerSkew skew;
    skew.triggers = 1;
    for (const Place &place : places_) skew.lost |= place.times != 1;
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) judge(places_[i], places_[k], skew);
    return skew;
  }

 private:
  [[nodiscard]] Time bit() const { return slower_ * kMicrosecond; }
  [[nodiscard]] BitTiming timing_of(const RemoteClock &clock) const {
    BitTiming timing = clock.timing;
    timing.prescaler *= slower_;
    return timing;
  }
  ClockConfig clock_of(double hz) {
    ClockConfig clock;
    clock.frequency_hz = hz;
    clock.error_ppm = (static_cast<double>(dice_.upto(2001)) / 1000 - 1) * tolerance_ppm_;
    clock.phase = dice_.upto(1000 * 1000);
    return clock;
  }

  void draw_place() {
    const RemoteClock &clock = remote_clocks()[dice_.upto(8)];
    clocks_.push_back(clock.hz);
    places_.push_back({nullptr, timing_of(clock), 0});
  }

  // As far as the shortest PROP_SEG allows (BT-06): there and back, and three clocks at each end.
  void draw_metres() {
    double room = 1e12;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double clock = 1e12 / clocks_[i];
      room = std::min(room, places_[i].timing.prescaler * places_[i].timing.prop * clock);
    }
    const double slowest = 1e12 / *std::min_element(clocks_.begin(), clocks_.end());
    const double reach = std::clamp((room - 6 * slowest) / 2 / 5000, 0.0, 40.0);
    for (Place &place : places_) place.metres = reach * dice_.upto(1001) / 1000;
  }

  void connect(const std::string &profile, unsigned i) {
    Place &place = places_[i];
    place.node = RemoteNode::create("node" + std::to_string(i), RemoteConfig::profile(profile),
                                    i < 6 ? 2 + i : 0, place.timing, clock_of(clocks_[i]));
    const NodeId id = bus_.add(*place.node);
    bus_.set_delay(0, id, cable_delay(place.metres));
    bus_.set_delay(id, 0, cable_delay(place.metres));
    for (unsigned k = 0; k < i; ++k) {
      const Time delay = cable_delay(std::abs(place.metres - places_[k].metres));
      bus_.set_delay(1 + k, id, delay);
      bus_.set_delay(id, 1 + k, delay);
    }
    place.node->on_pulse = [this, i](const RemotePulse &pulse) {
      if (!pulse.apply) return;
      places_[i].acted = bus_.now();
      ++places_[i].times;
    };
  }

  void send(unsigned a, std::initializer_list<std::uint8_t> data) {
    Frame frame;
    frame.id = a;
    frame.dlc = static_cast<std::uint8_t>(data.size());
    std::copy(data.begin(), data.end(), frame.data.begin());
    host_->request(frame);
    bus_.run_for((70 + dice_.upto(20)) * bit() + dice_.upto(1000) * kNanosecond);
  }

  // RN-47; the sample points are equal (S = 0).
  void judge(const Place &a, const Place &b, TriggerSkew &skew) const {
    const double bound = 5000 * std::abs(a.metres - b.metres) +
                         std::max(a.quantum_ps(), b.quantum_ps()) +
                         3 * std::max(a.clock_ps(), b.clock_ps()) +
                         44e-6 * tolerance_ppm_ * static_cast<double>(bit());
    const Time apart = std::abs(a.acted - b.acted);
    ++skew.pairs;
    skew.above += static_cast<double>(apart) > bound;
    skew.largest = std::max(skew.largest, apart);
    const double part = static_cast<double>(apart) / bound;
    if (part <= skew.part) return;
    skew.part = part;
    skew.worst = fmt::format("{:.0f} and {:.0f} MHz, {:.1f} and {:.1f} m, {} ppm, {} kbit/s",
                             a.node->oscillator().nominal_hz() / 1e6,
                             b.node->oscillator().nominal_hz() / 1e6, a.metres, b.metres,
                             tolerance_ppm_, 1000 / slower_);
  }

  RandomHost dice_;
  unsigned slower_ = 1;
  double tolerance_ppm_ = 100;
  std::vector<double> clocks_;
  std::vector<Place> places_;
  std::unique_ptr<CoreNode> host_;
  Bus bus_;
};

}  // namespace

TriggerSkew &TriggerSkew::operator+=(const TriggerSkew &other) {
  triggers += other.triggers;
  pairs += other.pairs;
  lost += other.lost;
  above += other.above;
  largest = std::max(largest, other.largest);
  if (other.part > part) {
    part = other.part;
    worst = other.worst;
  }
  return *this;
}

TriggerSkew measure_triggers(const std::string &profile, unsigned seed, unsigned triggers) {
  Line line{profile, seed};
  TriggerSkew sum;
  for (unsigned i = 0; i < triggers; ++i) sum += line.trigger(i);
  return sum;
}

}  // namespace vericansim
