// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Calendar: the time of a guest kernel, by the rules of user-mode Linux's time-travel=ext mode.
#pragma once

#include <cstdint>
#include <limits>

namespace vericansim {

/// Operations of a time message, both ways (include/uapi/linux/um_timetravel.h).
enum class TimeOp : std::uint32_t {
  kAck = 0,        ///< answers every other message, with its sequence number
  kStart = 1,      ///< guest: the connection begins
  kRequest = 2,    ///< guest: wants to run at `time`; replaces what it asked for before
  kWait = 3,       ///< guest: has nothing to do until a kRun
  kGet = 4,        ///< guest: what time is it; the answer carries it
  kUpdate = 5,     ///< guest: this is how far it has got
  kRun = 6,        ///< calendar: it is `time`, go on
  kFreeUntil = 7,  ///< calendar: run by yourself until `time`; not used here
  kGetTod = 8,     ///< guest: time of day at boot
};

/// A time message as it is on the socket, in the machine's byte order.
struct TimeMessage {
  std::uint32_t op = 0;
  std::uint32_t seq = 0;
  std::uint64_t time = 0;  ///< ns
};
static_assert(sizeof(TimeMessage) == 16);

/// What the guest's clock shows, when it wants to run next, and whether it waits. No socket and no
/// simulator in here: whoever has those asks goal() and tells how far it has come.
///
/// The guest computes in no time at all: its clock moves only while it waits. The simulator's may
/// move on meanwhile, since each access of a register takes some clocks; what the guest is told
/// therefore never lies beyond what it has asked for, or its events would be in its past.
class Calendar {
 public:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::int64_t>::max();

  /// `time_of_day`: of simulated time 0, ns since the Unix epoch.
  explicit Calendar(std::uint64_t time_of_day) : time_of_day_{time_of_day} {}

  /// Takes a message of the guest and returns the acknowledgement. `now`: the simulator's time, ns.
  /// Throws InputError for a message that a guest does not send.
  [[nodiscard]] TimeMessage answer(const TimeMessage &message, std::uint64_t now);

  /// True between the guest's kWait and run().
  [[nodiscard]] bool waiting() const { return waiting_; }
  /// When the guest wants to run, ns; kNever if it has not asked.
  [[nodiscard]] std::uint64_t goal() const { return goal_; }
  /// The guest's clock, ns.
  [[nodiscard]] std::uint64_t guest_time() const { return guest_time_; }

  /// The guest's turn: its clock shows goal(). std::logic_error if it does not wait.
  [[nodiscard]] TimeMessage run();

 private:
  std::uint64_t time_of_day_;
  std::uint64_t guest_time_ = 0;
  std::uint64_t goal_ = kNever;
  std::uint32_t sequence_ = 0;
  bool waiting_ = false;
};

}  // namespace vericansim
