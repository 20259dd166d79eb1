// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Builds the bus of a scenario, runs it, and collects the report.
#include "session/runner.hpp"

#include "session/session.hpp"

namespace vericansim {

RunReport run_scenario(const Scenario &scenario, double bitrate,
                       const std::function<void(double)> &progress) {
  SessionOptions options;
  options.progress = progress;
  Session session{{{scenario, bitrate}}, std::move(options)};
  return session.run().front();
}

}  // namespace vericansim
