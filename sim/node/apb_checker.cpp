// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ApbChecker: see apb_checker.hpp.
#include "node/apb_checker.hpp"

namespace vericansim {

void ApbChecker::clock(const ApbRequest &request, const ApbResponse &response) {
  ++cycle_;
  check_master(request);
  const bool access = request.psel && request.penable;
  if (response.pslverr && !(access && response.pready))
    report_.violation("APB", cycle_, "PSLVERR without PSEL, PENABLE and PREADY");
  if (access && response.pready) {
    report_.ended(response.pslverr);
    waits_ = 0;
  } else if (access) {
    report_.waited(++waits_);
  }
  access_ = (request.psel && !request.penable) || (access && !response.pready);
  previous_ = request;
}

void ApbChecker::check_master(const ApbRequest &request) {
  const auto broken = [this](const char *rule) { report_.violation("APB", cycle_, rule); };
  if (access_ && !(request.psel && request.penable))
    broken("no access phase behind a setup phase");
  else if (access_ && !request.same_transfer(previous_))
    broken("a transfer changed before PREADY");
  if (!access_ && request.psel && request.penable) broken("PENABLE without a setup phase");
  if (request.psel && !request.pwrite && request.pstrb != 0) broken("PSTRB of a read");
}

}  // namespace vericansim
