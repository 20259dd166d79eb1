// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What faults have done, as text and as JSON.
#include "results/fault_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace vericansim {
namespace {

using Json = nlohmann::ordered_json;

Json times_json(const FaultReport &fault, double unit) {
  Json times = Json::array();
  for (const Window &time : fault.times) {
    if (unit == 1)
      times.push_back({time.from, time.to});
    else
      times.push_back({static_cast<double>(time.from) / unit, static_cast<double>(time.to) / unit});
  }
  return times;
}

Json fault_json(const FaultReport &fault, const Json &node) {
  return {{"name", fault.name}, {"kind", fault.kind}, {"node", node},      {"text", fault.text},
          {"line", fault.line}, {"hits", fault.hits}, {"more", fault.more}};
}

}  // namespace

std::string faults_text(const std::vector<FaultReport> &faults) {
  if (faults.empty()) return "";
  std::size_t width = 14;
  for (const FaultReport &fault : faults) width = std::max(width, fault.name.size());
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "  {:<{}} {:>8} {:>11}  {}\n", "fault", width, "hits", "first ms", "what");
  for (const FaultReport &fault : faults) {
    const std::string first =
        fault.times.empty()
            ? "never"
            : fmt::format("{:.3f}", static_cast<double>(fault.times.front().from) / kMillisecond);
    fmt::format_to(out, "  {:<{}} {:>8} {:>11}  {}\n", fault.name, width, fault.hits, first,
                   fault.text);
  }
  for (const FaultReport &fault : faults)
    if (fault.unsaid)
      fmt::format_to(out, "  warning: {} (line {}) never took effect\n", fault.name, fault.line);
  return text;
}

Json faults_json(const std::vector<FaultReport> &faults) {
  Json list = Json::array();
  for (const FaultReport &fault : faults) {
    Json json = fault_json(fault, fault.node);
    json["took_effect"] = fault.hits != 0;
    json["times_ps"] = times_json(fault, 1);
    list.push_back(std::move(json));
  }
  return list;
}

Json faults_meta(const std::vector<FaultReport> &faults) {
  Json list = Json::array();
  for (const FaultReport &fault : faults) {
    Json json = fault_json(fault, fault.id >= Bus::kMaxNodes ? Json(nullptr) : Json(fault.id));
    json["times_ns"] = times_json(fault, kNanosecond);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace vericansim
