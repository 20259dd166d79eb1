// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModel: requests to the node's memory, its own or of all nodes (sections 3.1, 3.2, 4).
#include "model/remote_model.hpp"

namespace vericansim {
namespace {

/// Bytes 0 and 1 of a port's data.
unsigned address_of(const Frame &frame) { return frame.data[0] | frame.data[1] << 8; }

}  // namespace

void RemoteModel::accept(const Request &request, bool write) {
  fed();
  status_.accept(request.a);
  if (write && flag(remote_flags::kWrites) && !request.broadcast) outbox_.status();
}

void RemoteModel::refuse(const Request &request, RemoteCode why) {
  status_.refuse(request.a, why);
  if (flag(remote_flags::kErrors) && !request.broadcast) outbox_.status();
}

void RemoteModel::memory_request(const Request &request) {
  if (request.a >= config_.first_port())
    port_request(request, static_cast<RemotePort>(request.a - config_.first_port()));
  else if (request.frame.remote)
    direct_read(request);
  else
    direct_write(request);
}

// RN-20
void RemoteModel::direct_write(const Request &request) {
  const unsigned n = request.frame.dlc;
  if (n == 0 || n > 8) return refuse(request, RemoteCode::kValue);
  if (request.a + n > config_.first_port()) return refuse(request, RemoteCode::kAddress);
  write_checked(request, request.a, 0);
}

// RN-21
void RemoteModel::direct_read(const Request &request) {
  const unsigned n = request.frame.dlc;
  if (n == 0 || n > 8) return refuse(request, RemoteCode::kValue);
  if (request.a + n > config_.first_port()) return refuse(request, RemoteCode::kAddress);
  answer(request, 0, request.a, n);
}

// Code 1 comes before all others (RN-32), so first of all whether the port has this command.
void RemoteModel::port_request(const Request &request, RemotePort port) {
  const bool row_port = port == RemotePort::kStatus || port == RemotePort::kIdent;
  if (port == RemotePort::kNone || request.frame.remote != row_port)
    return refuse(request, RemoteCode::kFunction);
  switch (port) {
    case RemotePort::kRead: return read(request);
    case RemotePort::kWrite: return write(request);
    case RemotePort::kStatus: return row(request, remote_map::kStatus);
    case RemotePort::kIdent: return row(request, remote_map::kIdent);
    default: break;
  }
  const bool transfer = port == RemotePort::kBlock || port == RemotePort::kData;
  if (request.broadcast || (transfer && !config_.block))  // RN-23
    return refuse(request, RemoteCode::kFunction);
  if (port == RemotePort::kSetup) return setup(request);
  port == RemotePort::kBlock ? block(request) : block_data(request);
}

void RemoteModel::read(const Request &request) {
  const unsigned n = request.frame.data[2];
  if (request.frame.dlc != 3 || n == 0 || n > 6) return refuse(request, RemoteCode::kValue);
  answer(request, 2, address_of(request.frame), n);
}

void RemoteModel::write(const Request &request) {
  if (request.frame.dlc < 3 || request.frame.dlc > 8) return refuse(request, RemoteCode::kValue);
  write_checked(request, address_of(request.frame), 2);
}

void RemoteModel::row(const Request &request, unsigned address) {
  const unsigned n = request.frame.dlc;
  if (n == 0 || n > 8) return refuse(request, RemoteCode::kValue);
  answer(request, 0, address, n);
}

// Writes the bytes of the frame from its byte `first` on to `address`.
void RemoteModel::write_checked(const Request &request, unsigned address, unsigned first) {
  const unsigned n = request.frame.dlc - first;
  const RemoteCode code = memory_.check_write(address, n, status_.unlocked);
  if (code != RemoteCode::kAccepted) return refuse(request, code);
  memory_.bus_write(address, {request.frame.data.data() + first, n});
  done_.push_back({false, address, n});
  accept(request, true);
  show();
}

// Answers with the first `head` bytes of the request and `n` bytes from `address`.
void RemoteModel::answer(const Request &request, unsigned head, unsigned address, unsigned n) {
  const RemoteCode code = memory_.check_read(address, n);
  if (code != RemoteCode::kAccepted) return refuse(request, code);
  if (has_number() && outbox_.full()) return refuse(request, RemoteCode::kBusy);
  fed();
  if (!has_number()) return;  // RN-07
  const bool direct = request.a < config_.first_port();
  Frame frame;
  frame.id = config_.same_id && direct ? request.frame.id : config_.id(1, number_, request.a);
  frame.dlc = static_cast<std::uint8_t>(head + n);
  for (unsigned i = 0; i < head; ++i) frame.data[i] = request.frame.data[i];
  for (unsigned i = 0; i < n; ++i) frame.data[head + i] = memory_[address + i];
  outbox_.answer(frame);
}

}  // namespace vericansim
