// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A case on RTL: see rtl_sync.hpp.
#include "timesync/rtl_sync.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "timesync/rtl_bench.hpp"
#include "verican/timesync.h"

namespace vericansim {
namespace {

// Times an interval that each node's software polls.
constexpr int kPolls = 10;
// Software gets to its poll so much later, evenly, as in the model.
constexpr double kPollLate = 100.0 * kMicrosecond;

// Constant errors: even within the spread, or as `opposed` says.
std::vector<double> errors_of(const SyncCase &setting, std::uint64_t seed) {
  std::mt19937_64 dice{seed};
  const double spread = setting.clocks.spread_ppm;
  std::vector<double> errors;
  for (unsigned n = 0; n <= setting.followers; ++n) {
    double error = std::uniform_real_distribution<double>{-spread, spread}(dice);
    if (setting.clocks.opposed) error = n == 0 ? 0 : n % 2 == 1 ? spread : -spread;
    errors.push_back(error);
  }
  return errors;
}

class RtlSync {
 public:
  RtlSync(const SyncCase &setting, IdleGaps gaps, std::uint64_t seed)
      : setting_{setting},
        interval_{std::llround(setting.interval_s * static_cast<double>(kSecond))},
        errors_{errors_of(setting, seed)},
        bench_{setting, gaps, seed, [this](unsigned n) { return errors_[n]; }, {kSyncId, 0x7FF}},
        tsyns_(bench_.size()),
        events_(bench_.size()) {
    bench_.handler = [this](unsigned n) { handle(n); };
    bench_.on_error = [this] { run_.repeated += bench_.station(0).sending() ? 1 : 0; };
    bench_.displace();
    for (unsigned n = 0; n < bench_.size(); ++n) start(n);
  }

  SyncRun run() {
    const Time begin = bench_.bus.now();
    const Time end = begin + (setting_.intervals + 1) * interval_;
    for (unsigned n = 0; n < bench_.size(); ++n)
      poll(n, begin + (n + 1) * interval_ / (kPolls * bench_.size()));
    for (Time t = begin; t < end; t += interval_ / kLooks) bench_.at(t, [this] { look(); });
    bench_.run(end);
    for (unsigned n = 1; n < bench_.size(); ++n) count_refused(n);
    return std::move(run_);
  }

 private:
  void start(unsigned n) {
    verican_tsyn_config_t config;
    verican_tsyn_config_default(&config);
    config.masters[0] = kSyncId;
    config.servo.interval_us = static_cast<std::uint32_t>(interval_ / kMicrosecond);
    config.servo.filter = setting_.filter;
    config.servo.delay_ns = bench_.delay_ns();
    config.user = &events_[n];
    config.on_event = [](void *user, verican_tsyn_t *, std::uint8_t events) {
      *static_cast<std::uint8_t *>(user) = events;
    };
    verican_t *dev = &bench_.station(n).dev;
    verican_tsyn_t *tsyn = &tsyns_[n];
    verican_result_t result = verican_tsyn_init(tsyn, dev, &config);
    if (n == 0 && result == VERICAN_OK) {
      result = verican_clock_set(dev, kMasterTime);
      verican_clock_point(dev, VERICAN_STAMP_EDGE, setting_.own_pin);
    }
    if (result == VERICAN_OK)
      result = n == 0 ? verican_tsyn_start_master(tsyn) : verican_tsyn_start_follower(tsyn);
    if (result != VERICAN_OK) throw std::runtime_error(verican_result_name(result));
    bench_.station(n).on_sent = [this, tsyn](const verican_tx_event_t &event) {
      if (event.outcome == VERICAN_TX_SENT) ++run_.frames;
      (void)verican_tsyn_on_sent(tsyn, &event);
    };
  }

  void poll(unsigned n, Time when) {
    bench_.at(when + std::llround(bench_.uniform(0, kPollLate)), [this, n, when] {
      if (n == 0) bench_.displace();
      verican_tsyn_poll(&tsyns_[n]);
      tell(n);
      poll(n, when + interval_ / kPolls);
    });
  }

  void handle(unsigned n) {
    bench_.station(n).serve();
    verican_frame_t frame;
    while (bench_.station(n).receive(frame)) {
      verican_tsyn_on_frame(&tsyns_[n], &frame);
      tell(n);
    }
  }

  // What the servo has done, if it has.
  void tell(unsigned n) {
    if (n == 0 || events_[n] == 0) return;
    const verican_tsyn_t &tsyn = tsyns_[n];
    run_.actions.push_back({bench_.bus.now(), n - 1, tsyn.shift, tsyn.dev->increment,
                            std::exchange(events_[n], std::uint8_t{0}), tsyn.servo.state});
  }

  void look() {
    run_.looks.push_back(bench_.look([this](unsigned n) { return tsyns_[n].servo.state; }));
  }

  void count_refused(unsigned n) {
    verican_tsyn_status_t status;
    if (verican_tsyn_status(&tsyns_[n], &status) != VERICAN_OK) return;
    run_.refused += status.refused[VERICAN_TSYN_LATE] + status.refused[VERICAN_TSYN_MISSING];
  }

  SyncCase setting_;
  Time interval_;
  std::vector<double> errors_;
  RtlBench bench_;
  std::vector<verican_tsyn_t> tsyns_;
  std::vector<std::uint8_t> events_;
  SyncRun run_;
};

// As verican_init() looks for it.
bool has_bit_timing(const SyncCase &setting) {
  verican_timing_t timing;
  return verican_timing_find(static_cast<std::uint32_t>(setting.clocks.frequency_hz),
                             static_cast<std::uint32_t>(setting.bitrate), 0, &timing) == VERICAN_OK;
}

}  // namespace

const char *missing_on_rtl(const SyncCase &setting) {
  if (!has_bit_timing(setting)) return "bit timing for this bit rate at this clock";
  if (setting.displaced != 0 && (setting.load != 0 || setting.load_above != 0))
    return "displaced edges with load";
  if (setting.clocks.wander != 0 && setting.clocks.sine_ppm != 0) return "wander with a swing";
  if (setting.hardware) return "followers in hardware";
  if (setting.master_cut) return "cut master";
  if (setting.master_late_ns != 0 || setting.master_uneven_ns != 0) return "late master";
  return nullptr;
}

SyncCase loaded_for_20_s(const SyncCase &setting) {
  SyncCase result = setting;
  if (setting.load == 0 && setting.load_above == 0) return result;
  result.interval_s = 0.1;
  result.intervals = 200;
  result.seeds = 1;
  return result;
}

SyncRun run_by_rtl(const SyncCase &setting, std::uint64_t seed) {
  return RtlSync{setting, IdleGaps::kClocked, seed}.run();
}

SyncRun run_by_skip(const SyncCase &setting, std::uint64_t seed) {
  return RtlSync{setting, IdleGaps::kSkipped, seed}.run();
}

}  // namespace vericansim
