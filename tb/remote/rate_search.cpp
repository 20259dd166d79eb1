// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RateSearch: see rate_search.hpp.
#include "remote/rate_search.hpp"

namespace vericansim {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : random_{seed} {}
  unsigned upto(unsigned n) { return static_cast<unsigned>(random_() % n); }
  bool once_in(unsigned n) { return upto(n) == 0; }
  Frame frame() {
    Frame frame;
    frame.extended = once_in(3);
    frame.id = upto(frame.extended ? 1U << 29 : 1U << 11);
    frame.dlc = static_cast<std::uint8_t>(upto(9));
    const unsigned alike = upto(4);  // all of one value: with few edges or many
    for (unsigned i = 0; i < frame.dlc; ++i)
      frame.data[i] = static_cast<std::uint8_t>(alike == 0 ? 0x00 : alike == 1 ? 0x55 : upto(256));
    return frame;
  }

 private:
  std::mt19937 random_;
};

// What the hosts send: frames with pauses.
class Traffic {
 public:
  Traffic(RateSearch &search, Dice &dice, unsigned hosts)
      : search_{search},
        dice_{dice},
        hosts_{hosts},
        same_{dice.once_in(3)},
        pause_{dice.once_in(3) ? 0 : dice.upto(400)},
        frame_{dice.frame()} {}

  void go_on() {
    const unsigned host = same_ ? 0 : dice_.upto(hosts_);
    if (!search_.host(host).pending()) search_.host(host).request(same_ ? frame_ : dice_.frame());
    // A full bus where there is no pause: the next frame waits before the last has gone.
    search_.run_bits(pause_ == 0 ? 20 : 100 + pause_);
  }

 private:
  RateSearch &search_;
  Dice &dice_;
  unsigned hosts_;
  bool same_;       // the same frame for ever
  unsigned pause_;  // bits
  Frame frame_;
};

}  // namespace

RateSearch::RateSearch(const RateSetting &setting) {
  const std::vector<RateRow> table = rate_table(setting.clock_hz);
  bit_ = kSecond / table.at(setting.row).bitrate;
  CoreConfig config;
  config.timing = table.at(setting.row).timing;
  ClockConfig clock;
  clock.frequency_hz = setting.clock_hz;
  clock.error_ppm = -setting.ppm;
  for (unsigned i = 0; i < setting.hosts; ++i) {
    hosts_.push_back(std::make_unique<CoreNode>("host" + std::to_string(i), config, clock));
    bus_.add(*hosts_.back());
  }
  clock.error_ppm = setting.ppm;
  node_ = RemoteNode::create("node", RemoteConfig::profile("full"), 3, table.at(0).timing, clock);
  std::vector<BitTiming> rates;
  for (const RateRow &row : table) rates.push_back(row.timing);
  node_->search(rates);
  bus_.add(*node_);
  if (setting.noise_per_bit != 0) {
    NoiseConfig noise;
    noise.per_bit = setting.noise_per_bit;
    noise.seed = setting.seed;
    noise_ = std::make_unique<NoiseFault>(noise);
    bus_.add(*noise_);
  }
  for (auto &host : hosts_) host->start();
}

RateTrial random_rate_trial(unsigned seed) {
  Dice dice{seed};
  RateTrial trial;
  RateSetting &setting = trial.setting;
  setting.seed = seed;
  setting.row = dice.upto(8);
  const double clocks[] = {8e6, 12e6, 16e6, 24e6, 40e6};
  setting.clock_hz = clocks[dice.upto(setting.row < 5 ? 5 : 1)];
  setting.hosts = 1 + dice.upto(4);
  setting.ppm = static_cast<double>(dice.upto(2001)) - 1000;
  if (dice.once_in(4)) setting.noise_per_bit = 1.0 / (500 + dice.upto(5000));
  RateSearch search{setting};
  search.run_bits(12);
  Traffic traffic{search, dice, setting.hosts};
  if (dice.once_in(2)) traffic.go_on();
  search.run_bits(dice.upto(200));
  search.start();
  const unsigned before = search.frames();
  while (search.listens() && trial.frames < kRateFrames) {
    traffic.go_on();
    trial.frames = search.frames() - before;
  }
  trial.found = !search.listens();
  trial.right = !trial.found || search.node().rate_row() == setting.row;
  return trial;
}

}  // namespace vericansim
