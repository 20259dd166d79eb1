// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BroadcastManager: a socketcand client's periodic jobs and its filters (BCM mode), in simulated
// time. Semantics: Linux, Documentation/networking/can.rst, "Broadcast Manager".
#pragma once

#include <linux/can.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "can_port.hpp"

namespace vericansim {

/// The jobs and filters of one client.
class BroadcastManager {
 public:
  /// Most jobs, and most filters, of one client.
  static constexpr std::size_t kMost = 1024;
  /// A job whose bus is busy catches up what it missed within this time; older periods are left
  /// out.
  static constexpr Time kCatchUp = 100 * kMillisecond;

  /// Sends `frame` now and then at each `interval`. Replaces the job with this identifier.
  /// CommandError: interval 0, too many jobs.
  void add_job(const can_frame &frame, Time interval, Time now);
  /// New content, same times. CommandError: no such job.
  void update_job(const can_frame &frame);
  /// CommandError: no such job.
  void delete_job(canid_t id);
  /// The frame of the job that has waited longest; empty if none is due.
  [[nodiscard]] std::optional<can_frame> due(Time now);
  /// Periods that were left out because the bus was busy for longer than kCatchUp.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }

  /// All frames with this identifier, at most one each `throttle`. Like the two below, it replaces
  /// what there is for the identifier. CommandError: too many filters.
  void subscribe(canid_t id, Time throttle);
  /// Frames that differ from the last one in a bit of `mask` (eight bytes, first one on top).
  void filter(canid_t id, Time throttle, std::uint64_t mask);
  /// As filter(), with a mask of its own for each value that the bits of tuples[0] can have:
  /// tuples[1..] hold value and mask.
  void mux_filter(canid_t id, Time throttle, const std::vector<std::uint64_t> &tuples);
  /// CommandError: nothing there.
  void unsubscribe(canid_t id);

  /// A frame of the bus, or of other programs; what is to be shown now is appended to `out`.
  void receive(const PortMessage &message, std::vector<PortMessage> &out);
  /// What throttles have held back and is due now.
  void release(Time now, std::vector<PortMessage> &out);
  /// True: there is a job, or something is held back.
  [[nodiscard]] bool awaits_time() const;
  /// Ends all jobs and filters.
  void clear();

 private:
  struct Job {
    can_frame frame;
    Time interval;
    Time due;
  };
  struct Content {
    std::uint64_t value = 0;  ///< of the multiplex bits
    std::uint64_t mask = 0;
    std::optional<std::uint64_t> last{};
    std::optional<PortMessage> held{};
  };
  struct Filter {
    Time throttle = 0;
    bool always = false;  ///< a subscription: content does not matter
    std::uint64_t mux = 0;
    std::vector<Content> contents{};
    std::optional<Time> shown{};
  };

  void put_filter(canid_t id, Filter filter);

  std::map<canid_t, Job> jobs_;
  std::map<canid_t, Filter> filters_;
  std::uint64_t missed_ = 0;
};

/// Eight bytes of data as a number, the first on top; what a frame does not have is 0.
[[nodiscard]] std::uint64_t content_of(const can_frame &frame);

}  // namespace vericansim
