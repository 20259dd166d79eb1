// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReplayResult: see replay_result.hpp.
#include "results/replay_result.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim {

std::string verdict(const ReplayResult &replay) {
  if (!replay.failure.empty()) return "NO: " + replay.failure;
  if (replay.late != 0) return fmt::format("NO: {} were due and have not left", replay.late);
  if (replay.none_of_share) return "nothing to send: no frame is of its share";
  for (const ReplayReceiver &receiver : replay.receivers)
    if (!receiver.first_difference.empty())
      return fmt::format("NO: {}: {}", receiver.node, receiver.first_difference);
  return fmt::format("yes, at {} node{}", replay.receivers.size(),
                     replay.receivers.size() == 1 ? "" : "s");
}

bool ReplayResult::ok() const {
  return failure.empty() && late == 0 &&
         std::all_of(receivers.begin(), receivers.end(),
                     [](const ReplayReceiver &r) { return r.first_difference.empty(); });
}

std::string to_text(const std::vector<ReplayResult> &replays) {
  std::string text = fmt::format("  {:<14} {:>8} {:>8} {:>12}  {}\n", "replay", "frames", "sent",
                                 "recorded", "every frame, bit-exact and in order");
  for (const ReplayResult &r : replays) {
    text += fmt::format("  {:<14} {:>8} {:>8} {:>12}  {}\n", r.node, r.frames, r.sent,
                        readable_time(r.recorded), verdict(r));
    if (r.longest_gap >= kLongGap)
      text += fmt::format("    no frame for {} before frame {}\n", long_time(r.longest_gap),
                          r.after_gap);
    if (r.skipped != 0)
      text += fmt::format("    left out of {}, as no classical frames: {}\n", r.file,
                          text::counted(r.skipped, "entry", "entries"));
    for (const std::string &warning : r.warnings)
      text += fmt::format("    warning: {}: {}\n", r.file, warning);
  }
  return text;
}

nlohmann::ordered_json to_json(const ReplayResult &replay) {
  nlohmann::ordered_json receivers = nlohmann::ordered_json::array();
  for (const ReplayReceiver &r : replay.receivers)
    receivers.push_back({{"node", r.node},
                         {"expected", r.expected},
                         {"received", r.received},
                         {"first_difference", r.first_difference}});
  return {{"node", replay.node},
          {"file", replay.file},
          {"frames", replay.frames},
          {"sent", replay.sent},
          {"late", replay.late},
          {"skipped", replay.skipped},
          {"recorded_ps", replay.recorded},
          {"longest_gap_ps", replay.longest_gap},
          {"after_gap", replay.after_gap},
          {"warnings", replay.warnings},
          {"failure", replay.failure},
          {"receivers", receivers},
          {"ok", replay.ok()}};
}

std::string long_time(Time time) {
  const double hours = static_cast<double>(time) / kSecond / 3600;
  return hours < 48 ? fmt::format("{:.1f} hours", hours) : fmt::format("{:.1f} days", hours / 24);
}

}  // namespace vericansim
