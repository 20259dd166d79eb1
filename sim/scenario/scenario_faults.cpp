// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: faults. What can never hit is refused here if the fault alone shows it, else by
// check_faults().
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <string>

#include "scenario/fault_words.hpp"
#include "scenario/field_bits.hpp"
#include "scenario/scenario_parts.hpp"
#include "trace/input_error.hpp"

namespace vericansim::detail {
namespace {

std::string lower(std::string text) {
  for (char &c : text)
    c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

Field parse_field(const YamlValue &value) {
  std::string names;
  for (unsigned code = 0; code < 32; ++code) {
    const std::string name{field_name(static_cast<Field>(code))};
    if (name == "?") continue;
    if (lower(name) == lower(value.text())) return static_cast<Field>(code);
    names += (names.empty() ? "" : ", ") + name;
  }
  value.refuse(names);
}

void parse_window(YamlMap &map, Window &window) {
  map.with("from", [&](const YamlValue &v) { window.from = v.time(0, kLongestTime); });
  const auto to = map.find("to");
  const auto length = map.find("for");
  if (to && length) length->fail("either 'to' or 'for', not both");
  if (to) window.to = to->time(window.from + 1, kLongestTime);
  if (length) window.to = window.from + length->time(1, kLongestTime);
}

/// ": DLC has 4 bits", for a field that has a length.
std::string length_text(Field field) {
  const FieldBits bits = field_bits(field);
  const unsigned length = bits.most_before + 1;
  if (field == Field::kData) return ": DATA has 64 bits at most";
  if (!bits.fixed) return "";
  return fmt::format(": {} has {} bit{}", field_name(field), length, length == 1 ? "" : "s");
}

/// A number of bits, at most `most` of them where the field has an end.
std::optional<unsigned> parse_bit(YamlMap &map, const char *key, const PlaceSpec &place,
                                  unsigned most) {
  const auto value = map.find(key);
  if (!value) return std::nullopt;
  const auto number = static_cast<unsigned>(value->integer(0, FieldBits::kNoEnd));
  if (number > most)
    value->refuse((most == 0 ? "0" : fmt::format("0 to {}", most)) + length_text(*place.field));
  return number;
}

/// Bits before and after must belong to one bit of the field.
void check_length(YamlMap &map, const PlaceSpec &place) {
  if (!place.field || !place.index || !place.left) return;
  const unsigned length = *place.index + *place.left + 1;
  const FieldBits bits = field_bits(*place.field);
  const YamlValue value = map.need("bits_left");
  if (bits.fixed && length != bits.most_before + 1)
    value.refuse(fmt::format("{}, behind bit {} of the {} of {}", bits.most_before - *place.index,
                             *place.index, bits.most_before + 1, field_name(*place.field)));
  if (place.field == Field::kData && (length % 8 != 0 || length > 64))
    value.fail(fmt::format("bit {} with {} bits left makes {} bits of data; allowed: 8, 16, ... 64",
                           *place.index, *place.left, length));
}

void check_stuff(const YamlValue &value, const PlaceSpec &place) {
  if (!place.field || place.stuff != true) return;
  const FieldBits bits = field_bits(*place.field);
  if (!bits.stuffed)
    value.fail(
        fmt::format("{} has no stuff bits; allowed: ID to CRC, and CRC_DEL for that behind "
                    "the last bit of CRC",
                    field_name(*place.field)));
  const unsigned before =
      place.left ? bits.most_before - *place.left : place.index.value_or(bits.most_before);
  if (bits.fixed && before < bits.before_stuff)
    value.fail(fmt::format("no stuff bit comes before bit {} of {}; allowed: bit {} or later",
                           before, field_name(*place.field), bits.before_stuff));
}

void parse_quanta(YamlMap &map, FaultSpec &fault) {
  map.with("first_tq", [&](const YamlValue &v) {
    fault.first_quantum = static_cast<unsigned>(v.integer(0, 24));
  });
  map.with("last_tq", [&](const YamlValue &v) {
    fault.last_quantum = static_cast<unsigned>(v.integer(fault.first_quantum.value_or(0), 24));
  });
}

void parse_place(const YamlValue &value, const Scenario &scenario, FaultSpec &fault) {
  YamlMap map{value};
  PlaceSpec &place = fault.place;
  fault.kind = FaultSpec::Kind::kPlace;
  fault.watched = parse_node_name(map.need("node"), scenario);
  fault.node = fault.watched;
  map.with("field", [&](const YamlValue &v) { place.field = parse_field(v); });
  map.with("frame", [&](const YamlValue &v) {
    place.frame = static_cast<unsigned>(v.integer(1, 1'000'000'000));
  });
  const FieldBits bits =
      place.field ? field_bits(*place.field) : FieldBits{FieldBits::kNoEnd, 63, false, true};
  place.index = parse_bit(map, "bit", place, bits.most_before);
  place.left = parse_bit(map, "bits_left", place, bits.most_after);
  check_length(map, place);
  map.with("stuff", [&](const YamlValue &v) {
    place.stuff = v.boolean();
    check_stuff(v, place);
  });
  parse_quanta(map, fault);
  map.finish();
}

/// The seed of a noise that has none of its own: that of the scenario for the first one. Noises of
/// one seed would flip the same bits, so that two undo each other.
std::uint64_t noise_seed(const Scenario &scenario) {
  const auto earlier =
      std::count_if(scenario.faults.begin(), scenario.faults.end(),
                    [](const FaultSpec &fault) { return fault.kind == FaultSpec::Kind::kNoise; });
  constexpr std::uint64_t kApart = 0x9E3779B9;  // far from the seeds that a user counts through
  return (scenario.seed + static_cast<std::uint64_t>(earlier) * kApart) & 0xFFFFFFFF;
}

void parse_noise(YamlMap &map, NoiseConfig &noise, std::uint64_t seed) {
  noise.seed = seed;
  map.with("per_bit", [&](const YamlValue &v) { noise.per_bit = v.number(0, 1); });
  map.with("glitches_per_ms", [&](const YamlValue &v) { noise.per_ns = v.number(0, 1e6) / 1e6; });
  map.with("glitch", [&](const YamlValue &v) {
    noise.glitch = v.time(1, kSecond);
    if (noise.per_ns == 0)
      v.fail("is the length of glitches, and there are none; allowed: with 'glitches_per_ms'");
  });
  map.with("seed", [&](const YamlValue &v) { noise.seed = v.integer(0, 0xFFFFFFFF); });
  if (noise.per_bit == 0 && noise.per_ns == 0)
    map.value().fail(
        "noise without 'per_bit' and 'glitches_per_ms' changes nothing; one must be "
        "above 0");
}

/// The error of a node's clock before a fault of it at `from`.
double clock_before(const Scenario &scenario, NodeId node, Time from) {
  double ppm = scenario.nodes[node].clock.error_ppm;
  Time since = -1;
  for (const FaultSpec &other : scenario.faults)
    if (other.kind == FaultSpec::Kind::kClock && other.node == node && other.window.from <= from &&
        other.window.from >= since) {
      ppm = other.ppm;
      since = other.window.from;
    }
  return ppm;
}

/// Refuses errors that are there already, and two at one moment, of which only one could be.
void check_clock(YamlMap &map, const Scenario &scenario, const FaultSpec &fault) {
  const std::string &name = scenario.nodes[fault.node].name;
  for (const FaultSpec &other : scenario.faults)
    if (other.kind == fault.kind && other.node == fault.node &&
        other.window.from == fault.window.from)
      map.value().fail(fmt::format(
          "the clock of '{}' has a fault at that time already, of {:g} ppm", name, other.ppm));
  if (clock_before(scenario, fault.node, fault.window.from) == fault.ppm)
    map.need("ppm").fail(fmt::format("the clock of '{}' has {:g} ppm already", name, fault.ppm));
}

/// What the word for the kind says; keys of that kind.
void parse_kind(YamlMap &map, const Scenario &scenario, FaultSpec &fault) {
  const YamlValue kind = map.need("kind");
  const std::string word = kind.text();
  if (word == "flip" || word == "dominant" || word == "recessive") {
    fault.effect = word == "flip"       ? Effect::kFlip
                   : word == "dominant" ? Effect::kDominant
                                        : Effect::kRecessive;
    map.with("at", [&](const YamlValue &v) { parse_place(v, scenario, fault); });
  } else if (word == "noise") {
    fault.kind = FaultSpec::Kind::kNoise;
    parse_noise(map, fault.noise, noise_seed(scenario));
  } else if (word == "clock") {
    fault.kind = FaultSpec::Kind::kClock;
    fault.ppm = map.need("ppm").number(-50'000, 50'000);
    map.with("from", [&](const YamlValue &v) { fault.window.from = v.time(0, kLongestTime); });
  } else if (word == "cut" || word == "short") {
    fault.kind = word == "cut" ? FaultSpec::Kind::kCut : FaultSpec::Kind::kShort;
  } else {
    kind.refuse("flip, dominant, recessive, cut, short, clock, noise");
  }
}

void parse_victim(YamlMap &map, const Scenario &scenario, FaultSpec &fault) {
  using Kind = FaultSpec::Kind;
  const bool everyone =
      fault.kind == Kind::kLevel || fault.kind == Kind::kPlace || fault.kind == Kind::kNoise;
  const auto node = map.find("node");
  if (node && everyone && node->is_scalar() && node->text() == "all")
    fault.node = kAllNodes;
  else if (node)
    fault.node = parse_node_name(*node, scenario);
  else if (!everyone)
    map.value().fail("key 'node' is missing");
  if (fault.kind == Kind::kClock) check_clock(map, scenario, fault);
}

}  // namespace

FaultSpec parse_fault(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  FaultSpec fault;
  fault.line = value.line();
  parse_kind(map, scenario, fault);
  if (fault.kind != FaultSpec::Kind::kPlace && fault.kind != FaultSpec::Kind::kClock)
    parse_window(map, fault.window);
  parse_victim(map, scenario, fault);
  map.with("name", [&](const YamlValue &v) {
    fault.name = v.name();
    if (fault.name.empty()) v.refuse("a name");
  });
  map.with("hits", [&](const YamlValue &v) { fault.hits = parse_range(v, kCounts); });
  fault.noise.victim = fault.node;
  fault.noise.window = fault.window;
  map.finish();
  return fault;
}

// A fault without a name has that of its place in the list, which no other may have.
void check_fault_names(const Scenario &scenario) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scenario.faults.size(); ++i) {
    const std::string name = fault_name(scenario, i);
    if (!names.insert(name).second)
      throw InputError(scenario.file, scenario.faults[i].line,
                       fmt::format("faults[{}]: fault name {} is used twice; give one with 'name'",
                                   i, in_quotes(name)));
  }
}

}  // namespace vericansim::detail
