// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The way of `verican memory` to a bus: a CAN interface, or a socketcand server.
#pragma once

#include <memory>
#include <string>

#include "verican_remote.h"

namespace vericansim::cli {

/// A connection with the three functions of the C client.
class MemoryLink {
 public:
  virtual ~MemoryLink() = default;
  /// The link must outlive what uses the functions.
  [[nodiscard]] virtual verican_remote_port_t port() = 0;
  /// Whether remote frames reach the bus.
  [[nodiscard]] virtual bool remote_frames() const = 0;
  /// What else there is to say behind a failure, "; ..."; empty: nothing.
  [[nodiscard]] virtual std::string remarks() const { return {}; }
};

/// A CAN interface of this computer. Throws InputError if it is not there, down or not permitted.
[[nodiscard]] std::unique_ptr<MemoryLink> open_interface(const std::string &name);

/// Bus `bus` of a socketcand server at `address`, "[HOST:]PORT". Throws InputError if nobody
/// answers there, or the server has no such bus.
[[nodiscard]] std::unique_ptr<MemoryLink> open_socketcand(const std::string &address,
                                                          const std::string &bus);

}  // namespace vericansim::cli
