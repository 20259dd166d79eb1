// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: the bit of a node. Timing that cannot work is refused.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "scenario/scenario_parts.hpp"
#include "timing/bittime.hpp"

namespace vericansim::detail {
namespace {

BitTiming parse_timing(const YamlValue &value) {
  YamlMap map{value};
  BitTiming timing;
  timing.prescaler = static_cast<unsigned>(map.need("brp").integer(1, 256));
  timing.prop = static_cast<unsigned>(map.need("prop").integer(1, 8));
  timing.ps1 = static_cast<unsigned>(map.need("ps1").integer(1, 8));
  timing.ps2 = static_cast<unsigned>(map.need("ps2").integer(2, 8));
  const YamlValue sjw = map.need("sjw");
  timing.sjw = static_cast<unsigned>(sjw.integer(1, 4));
  map.finish();
  const unsigned widest = std::min(timing.ps1, timing.ps2);  // BT-03
  if (timing.sjw > widest)
    sjw.fail(
        fmt::format("{} is above ps1 or ps2; allowed: 1 to {}", timing.sjw, std::min(widest, 4U)));
  if (timing.quanta() < 8)  // BT-02
    value.fail(
        fmt::format("{} time quanta a bit are not allowed; allowed: 8 to 25", timing.quanta()));
  return timing;
}

/// One of the keys says what another says too.
void refuse_with_timing(YamlMap &map, const char *key) {
  map.with(key, [](const YamlValue &v) { v.fail("'timing' is given too; allowed: one of them"); });
}

}  // namespace

void parse_bit(YamlMap &map, NodeSpec &node, const std::vector<double> &bitrates) {
  map.with("bitrate", [&](const YamlValue &v) { node.bitrate = v.bitrate(); });
  map.with("timing", [&](const YamlValue &v) {
    refuse_with_timing(map, "sample_point");
    refuse_with_timing(map, "sjw");
    node.timing = parse_timing(v);
    for (const double bitrate : bitrates) {
      const std::string wrong =
          rate_mismatch(*node.timing, node.clock.frequency_hz, node.bitrate.value_or(bitrate));
      if (!wrong.empty()) v.fail(wrong);
    }
  });
  map.with("sample_point", [&](const YamlValue &v) { node.sample_point = v.part(0.5, 0.9); });
  map.with("sjw", [&](const YamlValue &v) { node.sjw = static_cast<unsigned>(v.integer(1, 4)); });
}

}  // namespace vericansim::detail
