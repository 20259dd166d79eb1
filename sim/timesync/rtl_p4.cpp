// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// P4 on RTL: see rtl_p4.hpp.
#include "timesync/rtl_p4.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "timesync/rtl_bench.hpp"
#include "verican/delay.h"
#include "verican/timesync.h"

namespace vericansim {
namespace {

// A follower's software looks so often whether one of its messages is due.
constexpr Time kRtlPoll = 200 * kMicrosecond;
// The first pairs are those before a delay is known.
constexpr unsigned kFirstPairs = 2;

class RtlP4 {
 public:
  RtlP4(const SyncCase &setting, IdleGaps gaps, std::uint64_t seed)
      : interval_{std::llround(setting.interval_s * static_cast<double>(kSecond))},
        intervals_{setting.intervals},
        bench_{setting,
               gaps,
               seed,
               [&setting](unsigned n) {
                 if (n == 0) return 0.0;
                 return n % 2 == 1 ? setting.clocks.spread_ppm : -setting.clocks.spread_ppm;
               },
               {}},
        followers_(setting.followers),
        pairs_(setting.followers),
        sent_(bench_.size()) {
    bench_.handler = [this](unsigned n) { handle(n); };
    for (unsigned n = 0; n < bench_.size(); ++n)
      bench_.station(n).on_sent = [this, n](const verican_tx_event_t &) { sent(n); };
    for (unsigned n = 0; n < followers_.size(); ++n)
      followers_[n].number = static_cast<std::uint8_t>(n + 1);
    verican_clock_set(&bench_.station(0).dev, kMasterTime);
  }

  SyncRun run() {
    const Time begin = bench_.bus.now();
    const Time end = begin + (intervals_ + 1) * interval_;
    for (unsigned k = 1; k <= intervals_; ++k)
      bench_.at(begin + k * interval_, [this] { send(0, VERICAN_P4_SYNC, nullptr); });
    for (Time t = begin; t < end; t += interval_ / kLooks) bench_.at(t, [this] { look(); });
    bench_.run(end);
    return std::move(run_);
  }

 private:
  std::uint64_t read(unsigned n) {
    std::uint64_t now = 0;
    verican_clock_get(&bench_.station(n).dev, &now);
    return now;
  }

  void send(unsigned n, std::uint32_t message, const std::uint8_t *data) {
    verican_frame_t frame{};
    frame.id = message;
    frame.dlc = data == nullptr ? 0 : 8;
    for (unsigned i = 0; i < frame.dlc; ++i) frame.data[i] = data[i];
    sent_[n] = message;
    verican_send(&bench_.station(n).dev, &frame, nullptr);
    ++run_.frames;
  }

  // What the handler reads before all else is the time of whatever has happened.
  void handle(unsigned n) {
    read_ = read(n);
    bench_.station(n).serve();
    verican_frame_t frame;
    while (bench_.station(n).receive(frame)) {
      if (n == 0)
        master_hears(frame);
      else
        follower_hears(n, frame);
    }
  }

  // A node has one frame under way: it waits for the answer to its own, or for its turn.
  void sent(unsigned n) {
    if (n == 0 && sent_[n] == VERICAN_P4_SYNC) answer(VERICAN_P4_FOLLOW_UP);
    if (n != 0 && sent_[n] == VERICAN_P4_DELAY_REQ) verican_p4_on_sent(&followers_[n - 1], read_);
  }

  void answer(std::uint32_t message) {
    std::uint8_t data[8];
    verican_p4_write_time(read_, data);
    send(0, message, data);
  }

  void master_hears(const verican_frame_t &frame) {
    if (frame.id == VERICAN_P4_DELAY_REQ) answer(VERICAN_P4_DELAY_RESP);
  }

  void follower_hears(unsigned n, const verican_frame_t &frame) {
    verican_p4_t &p4 = followers_[n - 1];
    if (frame.id == VERICAN_P4_SYNC) verican_p4_on_sync(&p4, read_);
    if (frame.id == VERICAN_P4_FOLLOW_UP) correct(n, frame);
    if (frame.id == VERICAN_P4_DELAY_RESP && verican_p4_on_response(&p4, frame.data, read(n)))
      poll(n);
  }

  void correct(unsigned n, const verican_frame_t &follow_up) {
    verican_p4_t &p4 = followers_[n - 1];
    const std::int64_t offset = verican_p4_on_follow_up(&p4, follow_up.data, read(n));
    verican_t *dev = &bench_.station(n).dev;
    verican_clock_shift(dev, -offset);
    verican_p4_shifted(&p4, -offset);
    ++pairs_[n - 1];
    run_.actions.push_back(
        {bench_.bus.now(), n - 1, -offset, dev->increment, VERICAN_SERVO_ACCEPTED, state(n)});
    poll(n);
  }

  // Until the message that is due has been sent.
  void poll(unsigned n) {
    bench_.at(bench_.bus.now() + kRtlPoll, [this, n] {
      verican_p4_t &p4 = followers_[n - 1];
      std::uint8_t data[8];
      const std::uint32_t message = verican_p4_poll(&p4, read(n), data);
      if (message != 0)
        send(n, message, message == VERICAN_P4_DELAY_OFFSET ? data : nullptr);
      else if (p4.next != 0)
        poll(n);
    });
  }

  [[nodiscard]] std::uint8_t state(unsigned n) const {
    return pairs_[n - 1] > kFirstPairs ? VERICAN_SYNC_LOCKED : VERICAN_SYNC_ACQUIRING;
  }

  void look() {
    run_.looks.push_back(bench_.look([this](unsigned n) { return state(n); }));
  }

  Time interval_;
  unsigned intervals_;
  RtlBench bench_;
  std::vector<verican_p4_t> followers_;
  std::vector<unsigned> pairs_;
  std::uint64_t read_ = 0;
  std::vector<std::uint32_t> sent_;  // the last message of each node
  SyncRun run_;
};

}  // namespace

SyncRun run_p4_by_rtl(const SyncCase &setting, std::uint64_t seed) {
  return RtlP4{setting, IdleGaps::kClocked, seed}.run();
}

SyncRun run_p4_by_skip(const SyncCase &setting, std::uint64_t seed) {
  return RtlP4{setting, IdleGaps::kSkipped, seed}.run();
}

}  // namespace vericansim
