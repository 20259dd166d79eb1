// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: accesses to registers and buffers.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "model/registers.hpp"
#include "scenario/access_step.hpp"
#include "scenario/register_name.hpp"
#include "scenario/scenario_parts.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

using AccessKind = AccessStep::Kind;

struct Verb {
  std::string_view name;
  AccessKind kind;
  unsigned words;  // with itself
};

constexpr Verb kVerbs[] = {{"read", AccessKind::kRead, 2},   {"write", AccessKind::kWrite, 3},
                           {"set", AccessKind::kSet, 3},     {"clear", AccessKind::kClear, 3},
                           {"until", AccessKind::kUntil, 4}, {"if", AccessKind::kIf, 4},
                           {"check", AccessKind::kCheck, 4}};

constexpr std::string_view kAllowed =
    "read REG, write REG VALUE, set REG BITS, clear REG BITS, until REG MASK VALUE, "
    "if REG MASK VALUE, check REG MASK VALUE";

std::uint32_t parse_word(const YamlValue &value, std::string_view text) {
  const auto number = parse_integer(text);
  if (!number || *number > 0xFFFFFFFF)
    value.fail(fmt::format("'{}' is no value; allowed: 0 to 0xFFFFFFFF", text));
  return static_cast<std::uint32_t>(*number);
}

AccessStep parse_step(const YamlValue &value, unsigned buffers) {
  const std::string line = value.text();
  const auto words = text::split_blanks(line);
  for (const Verb &verb : kVerbs) {
    if (words.empty() || words[0] != verb.name || words.size() != verb.words) continue;
    AccessStep step{.kind = verb.kind};
    const auto address = register_address(words[1], buffers);
    if (!address)
      value.fail(fmt::format(
          "'{0}' is no register; allowed: the names of docs/registers.md, MB0.CS to MB{1}.DATA1, "
          "RXIMR0 to RXIMR{1}, FILTER0 to FILTER127, or an address, a multiple of 4 below 0x2000",
          words[1], buffers - 1));
    step.address = *address;
    if (verb.words > 2) step.value = parse_word(value, words.back());
    if (verb.words > 3) step.mask = parse_word(value, words[2]);
    if (verb.words > 3 && step.mask == 0)
      value.fail("MASK 0 looks at no bit; allowed: 0x1 to 0xFFFFFFFF");
    if (verb.words > 3 && (step.value & ~step.mask) != 0)
      value.fail(
          fmt::format("VALUE 0x{:X} has bits outside MASK, which nobody would look at; "
                      "allowed: bits of 0x{:X}",
                      step.value, step.mask));
    return step;
  }
  value.refuse(std::string{kAllowed});
}

bool writes(const AccessStep &step) {
  return step.kind == AccessKind::kWrite || step.kind == AccessKind::kSet ||
         step.kind == AccessKind::kClear;
}

}  // namespace

bool writes_buffers(const AccessSpec &access) {
  constexpr std::uint32_t kOfBuffers[] = {reg::kIflag1, reg::kIflag2, reg::kImask1, reg::kImask2};
  return std::ranges::any_of(access.steps, [&](const AccessStep &step) {
    const bool flags = std::ranges::find(kOfBuffers, step.address) != std::end(kOfBuffers);
    const bool words = step.address >= reg::mb(0) && step.address <= reg::mb(63, 3);
    return writes(step) && (flags || words);
  });
}

std::string to_text(const AccessStep &step, unsigned buffers) {
  for (const Verb &verb : kVerbs) {
    if (verb.kind != step.kind) continue;
    std::string text = fmt::format("{} {}", verb.name, register_name(step.address, buffers));
    if (verb.words > 3) text += fmt::format(" 0x{:X}", step.mask);
    if (verb.words > 2) text += fmt::format(" 0x{:X}", step.value);
    return text;
  }
  return {};
}

AccessSpec detail::parse_access(const YamlValue &value, const Scenario &scenario) {
  YamlMap map{value};
  AccessSpec access;
  const YamlValue node = map.need("node");
  access.node = parse_node_name(node, scenario);
  if (std::holds_alternative<RemoteRole>(scenario.nodes[access.node].role))
    node.fail(in_quotes(node.text()) +
              " is a remote node and has no registers; allowed: other nodes");
  map.with("at", [&](const YamlValue &v) { access.at = v.time(0, kLongestTime); });
  const YamlValue steps = map.need("do");
  const unsigned buffers = scenario.nodes[access.node].num_mb;
  for (const YamlValue &item : steps.items()) access.steps.push_back(parse_step(item, buffers));
  if (access.steps.empty()) steps.refuse(std::string{kAllowed});
  if (has_programs(scenario.nodes[access.node].role) && writes_buffers(access))
    steps.fail(fmt::format("writes buffers of {}, which programs of the host work; allowed: {}",
                           in_quotes(scenario.nodes[access.node].name), kBesidePrograms));
  map.finish();
  return access;
}

}  // namespace vericansim
