// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// WbChecker: see wb_checker.hpp.
#include "node/wb_checker.hpp"

namespace vericansim {

void WbChecker::reset() {
  previous_ = {};
  held_ = false;
  due_.clear();
}

void WbChecker::clock(const WbRequest &request, const WbResponse &response) {
  ++cycle_;
  const bool strobe = request.cyc && request.stb;
  if (request.stb && !request.cyc) report_.violation("Wishbone", cycle_, "STB without CYC");
  if (held_ && strobe && !request.same_transfer(previous_))
    report_.violation("Wishbone", cycle_, "a transfer changed before it was taken");
  if (!request.cyc) due_.clear();  // nobody waits any more
  if (strobe && !held_) since_ = cycle_;
  if (strobe && (pipelined_ ? !response.stall : due_.empty())) due_.push_back(since_);
  check_slave(request, response);
  held_ = strobe && (pipelined_ ? response.stall : !response.answers());
  previous_ = request;
}

void WbChecker::check_slave(const WbRequest &request, const WbResponse &response) {
  const auto broken = [this](const char *rule) { report_.violation("Wishbone", cycle_, rule); };
  if (response.ack && response.err) broken("ACK and ERR together");
  if (!response.answers()) return;
  if (!request.cyc) {
    broken("an answer without CYC");
  } else if (due_.empty()) {
    broken("an answer without a transfer");
  } else if (due_.front() == cycle_) {
    broken("an answer in the clock of its strobe");
  }
  if (due_.empty()) return;
  for (std::uint64_t clock = due_.front() + 1; clock < cycle_; ++clock)
    report_.waited(static_cast<unsigned>(clock - due_.front()));
  due_.pop_front();
  report_.ended(response.err);
}

}  // namespace vericansim
