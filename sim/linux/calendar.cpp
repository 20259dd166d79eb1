// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Calendar: see calendar.hpp.
#include "linux/calendar.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "trace/input_error.hpp"

namespace vericansim {

TimeMessage Calendar::answer(const TimeMessage &message, std::uint64_t now) {
  TimeMessage ack{static_cast<std::uint32_t>(TimeOp::kAck), message.seq, 0};
  switch (static_cast<TimeOp>(message.op)) {
    case TimeOp::kStart: break;
    case TimeOp::kRequest: goal_ = message.time; break;
    case TimeOp::kWait: waiting_ = true; break;
    case TimeOp::kUpdate: guest_time_ = std::max(guest_time_, message.time); break;
    case TimeOp::kGet:
      if (waiting_) guest_time_ = std::max(guest_time_, std::min(now, goal_));
      ack.time = guest_time_;
      break;
    case TimeOp::kGetTod: ack.time = time_of_day_ + guest_time_; break;
    default:
      throw InputError("the guest", 0,
                       "sent time message " + std::to_string(message.op) +
                           ", which no guest sends; allowed: 1 to 5, 8");
  }
  return ack;
}

TimeMessage Calendar::run() {
  if (!waiting_) throw std::logic_error("a guest that does not wait cannot be told to run");
  guest_time_ = std::max(guest_time_, goal_);
  waiting_ = false;
  goal_ = kNever;
  return {static_cast<std::uint32_t>(TimeOp::kRun), ++sequence_, guest_time_};
}

}  // namespace vericansim
