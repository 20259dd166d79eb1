// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SyncSetting: see sync_settings.hpp.
#include "timesync/sync_settings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scenario/yaml_value.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

using Text = const std::string &;

bool within(std::optional<double> value, double least, double most, double &target) {
  if (!value || !(*value >= least && *value <= most)) return false;
  target = *value;
  return true;
}

bool count(Text text, std::uint64_t most, unsigned &target) {
  const auto value = parse_integer(text);
  if (!value || *value == 0 || *value > most) return false;
  target = static_cast<unsigned>(*value);
  return true;
}

std::optional<double> seconds(Text text) {
  const auto time = parse_time(text);
  return time ? std::optional{static_cast<double>(*time) / 1e12} : std::nullopt;
}

bool filter(Text text, std::uint8_t &target) {
  const auto value = parse_integer(text);
  if (text == "automatic") {
    target = 0;
  } else if (value && *value >= 1 && *value <= 16 && (*value & (*value - 1)) == 0) {
    target = static_cast<std::uint8_t>(*value);
  } else {
    return false;
  }
  return true;
}

bool flag(Text text, bool &target) {
  if (text != "true" && text != "false") return false;
  target = text == "true";
  return true;
}

// The clock's increment has 8 bits of ns, and its slew needs 2 ns; R is what the servo takes.
const SyncSetting kSettings[] = {
    {"frequency", "Clock of every node (16 MHz)", "4 MHz to 400 MHz", false,
     [](SyncCase &c, Text t) {
       return within(parse_frequency(t), 4e6, 400e6, c.clocks.frequency_hz);
     }},
    {"spread", "Constant errors of the clocks are within +- so many ppm (100)", "0 to 400", false,
     [](SyncCase &c, Text t) { return within(parse_number(t), 0, 400, c.clocks.spread_ppm); }},
    {"opposed", "Master right, followers fast and slow in turn by the whole spread",
     "true or false", true, [](SyncCase &c, Text t) { return flag(t, c.clocks.opposed); }},
    {"wander", "Random walk of each frequency, density in 1/sqrt(s), as in 1e-8 (0)", "0 to 1e-6",
     false, [](SyncCase &c, Text t) { return within(parse_number(t), 0, 1e-6, c.clocks.wander); }},
    {"sine", "Slow swing of each frequency, ppm (0)", "0 to 100", false,
     [](SyncCase &c, Text t) { return within(parse_number(t), 0, 100, c.clocks.sine_ppm); }},
    {"sine-period", "Its period (120 s)", "a time of 10 s to 10000 s", false,
     [](SyncCase &c, Text t) { return within(seconds(t), 10, 10000, c.clocks.sine_period_s); }},
    {"followers", "Number of followers (8)", "1 to 32", false,
     [](SyncCase &c, Text t) { return count(t, 32, c.followers); }},
    {"bitrate", "Bit rate of the bus, bit/s (500k)", "100k to 1M", false,
     [](SyncCase &c, Text t) { return within(parse_bitrate(t), 100e3, 1e6, c.bitrate); }},
    {"load", "Part of the bus that frames below SYNC's priority take (0)", "0 to 100 %, or 0 to 1",
     false, [](SyncCase &c, Text t) { return within(parse_part(t), 0, 1, c.load); }},
    {"load-above", "Part of the bus that frames above SYNC's priority take (0)",
     "0 to 95 %, or 0 to 0.95", false,
     [](SyncCase &c, Text t) { return within(parse_part(t), 0, 0.95, c.load_above); }},
    {"bit-errors", "Probability of each bit to make an error frame, as in 1e-4 (0)", "0 to 1e-3",
     false, [](SyncCase &c, Text t) { return within(parse_number(t), 0, 1e-3, c.bit_errors); }},
    {"interval", "R, from SYNC to SYNC (1 s)", "a time of 50 ms to 5 s", false,
     [](SyncCase &c, Text t) { return within(seconds(t), 0.05, 5, c.interval_s); }},
    {"filter", "N, intervals that the servo looks at (8)", "1, 2, 4, 8, 16 or automatic", false,
     [](SyncCase &c, Text t) { return filter(t, c.filter); }},
    {"displaced", "Part of the edges that come up to 300 ns early (0)", "0 to 100 %, or 0 to 1",
     false, [](SyncCase &c, Text t) { return within(parse_part(t), 0, 1, c.displaced); }},
    {"own-pin", "The master stamps at its receive pin", "true or false", true,
     [](SyncCase &c, Text t) { return flag(t, c.own_pin); }},
    {"hardware", "Followers in hardware (can_time_sync), KD 2, PHALF 1", "true or false", true,
     [](SyncCase &c, Text t) { return flag(t, c.hardware); }},
    {"restless", "Of these the setting for restless oscillators: KD 1, PHALF 0", "true or false",
     true, [](SyncCase &c, Text t) { return flag(t, c.restless); }},
    {"master-cut", "Half-way the master is cut off, and the first follower takes over",
     "true or false", true, [](SyncCase &c, Text t) { return flag(t, c.master_cut); }},
    {"intervals", "Intervals that are simulated (260)", "1 to 100000", false,
     [](SyncCase &c, Text t) { return count(t, 100'000, c.intervals); }},
    {"seeds", "Runs with other random numbers (4)", "1 to 1000", false,
     [](SyncCase &c, Text t) { return count(t, 1000, c.seeds); }},
    {"first-seed", "The first of them (1)", "1 to 2^32 - 1", false,
     [](SyncCase &c, Text t) {
       unsigned seed = 0;
       if (!count(t, 0xFFFF'FFFF, seed)) return false;
       c.first_seed = seed;
       return true;
     }},
};

}  // namespace

std::string SyncSetting::key() const {
  std::string key = name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

std::span<const SyncSetting> sync_settings() { return kSettings; }

std::string read_case(const std::string &path, SyncCase &setting, SyncValues &values) {
  YamlMap map{YamlValue::load(path)};
  for (const SyncSetting &one : kSettings)
    map.with(one.key(), [&](const YamlValue &value) {
      if (!one.set(setting, value.text())) value.refuse(one.allowed);
      values[one.name] = value.text();
    });
  std::string name;
  map.with("name", [&](const YamlValue &value) { name = value.name(); });
  map.finish();
  return name;
}

}  // namespace vericansim
