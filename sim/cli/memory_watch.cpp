// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican memory watch: see memory_work.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "cli/cli.hpp"
#include "cli/memory_work.hpp"
#include "cli/output_files.hpp"
#include "simulation/stop_request.hpp"
#include "trace/candump.hpp"
#include "trace/remote_words.hpp"

namespace vericansim::cli {

int memory_watch(MemoryLink &link, const MemoryOptions &options) {
  constexpr std::uint32_t kLook = 100'000;  // us
  const verican_remote_port_t port = link.port();
  const StopSignals signals;
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t seen = 0; !stop_requested();) {
    verican_remote_frame_t got{};
    const verican_remote_result_t result = port.receive(port.context, &got, kLook);
    if (result == VERICAN_REMOTE_BUS_OFF) throw MemoryFailure("the way to the bus is gone");
    if (result != VERICAN_REMOTE_OK) continue;
    Frame frame{got.id, false, got.remote, got.dlc, {}};
    if (!got.remote) std::copy_n(got.data, got.dlc, frame.data.begin());
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    const std::string words = remote_words(frame, options.name_bits);
    if (options.json)
      fmt::print(
          "{}\n",
          Json{{"time_s", time.count()}, {"frame", candump_frame(frame)}, {"words", words}}.dump());
    else
      fmt::print("{:>12.6f}  {:<20}  {}\n", time.count(), candump_frame(frame), words);
    flush_standard_output();
    if (++seen == options.frames) break;
  }
  return kOk;
}

}  // namespace vericansim::cli
