// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a socketcand server allows.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "results/port_report.hpp"

namespace vericansim {

struct SocketcandLimits {
  std::size_t clients = 64;  ///< connected at once; more are told and closed
  /// Clients that have left and whose frames wait for the bus; of more the oldest are given up.
  std::size_t departed = 256;
  /// Bytes that may wait for a client that does not read; then it is told and closed.
  std::size_t output = std::size_t{8} << 20U;
  /// Bytes of commands that are read ahead of a busy bus; the rest waits in TCP.
  std::size_t input = std::size_t{16} << 10U;
  /// Host time between the answer to rawmode and the first frame: python-can takes the answer only
  /// if it comes alone.
  std::chrono::milliseconds raw_pause{100};
  /// Host time that a client which was told to be too slow has to read that.
  std::chrono::milliseconds farewell{10'000};
};

/// Traffic of one bus, for "< stat ... >": data bytes and frames, received and sent.
struct SocketcandTraffic {
  std::uint64_t received_bytes = 0;
  std::uint64_t received_frames = 0;
  std::uint64_t sent_bytes = 0;
  std::uint64_t sent_frames = 0;
};

}  // namespace vericansim
