// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VericanTlm, the socket's side: see verican_tlm.hpp.
#include <algorithm>
#include <cstring>

#include "systemc/can_bus.hpp"
#include "systemc/verican_tlm.hpp"

namespace vericansim {

void VericanTlm::b_transport(tlm::tlm_generic_payload &payload, sc_core::sc_time &delay) {
  payload.set_dmi_allowed(false);
  std::vector<Beat> beats;
  tlm::tlm_response_status status = plan_beats(payload, beats);
  if (status == tlm::TLM_OK_RESPONSE) status = run(payload, beats, delay);
  payload.set_response_status(status);
}

// One run of beats after the other, so that others get their turn between them. All are done even
// if one ends with ERROR, as a master on AHB does.
tlm::tlm_response_status VericanTlm::run(tlm::tlm_generic_payload &payload,
                                         const std::vector<Beat> &beats, sc_core::sc_time &delay) {
  tlm::tlm_response_status status = tlm::TLM_OK_RESPONSE;
  for (std::size_t begin = 0; begin < beats.size();) {
    const std::size_t end = chunk_end(beats, begin);
    const auto request = std::make_shared<Request>();
    for (std::size_t i = begin; i < end; ++i) request->transfers.push_back(beats[i].transfer);
    const bool ok = config_.timing == TlmTiming::kLooselyTimed ? run_loosely(*request, delay)
                                                               : run_exact(request, delay);
    if (!ok) return tlm::TLM_GENERIC_ERROR_RESPONSE;
    for (std::size_t i = begin; i < end; ++i) {
      const AhbResult &result = node_->ahb().result(request->first + (i - begin));
      if (result.error) {
        status = tlm::TLM_ADDRESS_ERROR_RESPONSE;
      } else if (payload.is_read()) {
        store_read(payload, beats[i], result.data);
      }
    }
    begin = end;
  }
  return status;
}

AhbMaster::Ticket VericanTlm::submit(const std::vector<AhbTransfer> &transfers) {
  AhbMaster::Ticket first = 0;
  for (std::size_t i = 0; i < transfers.size(); ++i) {
    const AhbMaster::Ticket ticket = node_->ahb().submit(transfers[i]);
    if (i == 0) first = ticket;
  }
  return first;
}

// False if a reset came first.
bool VericanTlm::run_exact(const std::shared_ptr<Request> &request, sc_core::sc_time &delay) {
  if (delay != sc_core::SC_ZERO_TIME) wait(delay);
  delay = sc_core::SC_ZERO_TIME;
  if (!reset_n_.now()) return false;
  request->arrival = sc_core::sc_time_stamp();
  requests_.push_back(request);
  while (!request->done && !request->aborted) wait(finished_);
  return request->done;
}

// Running ahead makes those late who access another module of the bus at the same time, and again
// and again if they are as busy; so an initiator that is not alone has no time of its own.
bool VericanTlm::run_loosely(Request &request, sc_core::sc_time &delay) {
  if (bus_->shared_with_others(*this) && delay != sc_core::SC_ZERO_TIME) {
    wait(delay);
    delay = sc_core::SC_ZERO_TIME;
  }
  if (!reset_n_.now()) return false;
  const sc_core::sc_time now = sc_core::sc_time_stamp();
  bus_->run_to(now + delay);
  request.first = submit(request.transfers);
  bus_->run_until_done(*node_, request.first + request.transfers.size() - 1);
  idle_from_ = bus_->kernel_time();
  delay = idle_from_ - now;
  return true;
}

unsigned VericanTlm::transport_dbg(tlm::tlm_generic_payload &payload) {
  const std::uint64_t address = payload.get_address();
  if (!payload.is_read() || payload.get_data_ptr() == nullptr || address >= kSocketWindow) return 0;
  if (config_.timing == TlmTiming::kLooselyTimed) bus_->catch_up();
  const auto count = static_cast<unsigned>(
      std::min<std::uint64_t>(payload.get_data_length(), kSocketWindow - address));
  for (unsigned done = 0; done < count;) {
    const auto byte = static_cast<std::uint32_t>(address) + done;
    const std::uint32_t word = node_->peek({.address = byte & ~3u}).data;
    const unsigned lane = byte & 3;
    const unsigned bytes = std::min(4 - lane, count - done);
    std::memcpy(payload.get_data_ptr() + done, reinterpret_cast<const char *>(&word) + lane, bytes);
    done += bytes;
  }
  return count;
}

bool VericanTlm::get_direct_mem_ptr(tlm::tlm_generic_payload &, tlm::tlm_dmi &dmi) {
  dmi.allow_none();
  dmi.set_start_address(0);
  dmi.set_end_address(~sc_dt::uint64{0});
  return false;
}

}  // namespace vericansim
