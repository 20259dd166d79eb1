// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: databases, messages and signals by name.
#include <fmt/format.h>

#include <filesystem>

#include "scenario/scenario_parts.hpp"
#include "signals/signal_codec.hpp"
#include "signals/signal_range.hpp"
#include "trace/input_error.hpp"
#include "trace/text.hpp"

namespace vericansim::detail {
namespace {

/// The message of that name; refuses unknown names and those of several messages.
const SignalMessage &parse_message_name(const YamlValue &value, const std::string &name,
                                        const Scenario &scenario) {
  if (!scenario.outputs.database) value.fail("needs a database; allowed: 'dbc' in the scenario");
  const auto found = scenario.outputs.database->named(name);
  if (found.empty()) value.fail("no message " + in_quotes(name) + " in the database");
  if (found.size() > 1)
    value.fail(fmt::format("message {} is in {} and in {}", in_quotes(name), found[0]->file,
                           found[1]->file));
  return *found[0];
}

/// Another identifier for a message: another source, destination or priority of its J1939 group.
void parse_group_id(const YamlValue &value, const SignalMessage &message, const Scenario &scenario,
                    Frame &frame) {
  const std::uint64_t id = value.integer(0, frame.extended ? 0x1FFFFFFF : 0x7FF);
  frame.id = static_cast<std::uint32_t>(id);
  if (scenario.outputs.database->find(frame.id, frame.extended) != &message)
    value.refuse(
        message.j1939
            ? fmt::format("an identifier of its parameter group {}", parameter_group(message.id))
            : fmt::format("none, for message {} has {:#x}", message.name, message.id));
}

/// A choice of the signal or a number.
SignalLimit parse_signal_limit(const YamlValue &value, const Signal &signal) {
  try {
    return limit_of(signal, value.text());
  } catch (const SignalError &error) {
    value.fail(error.what());
  }
}

/// The limits `min` and `max` of a map that may hold more.
SignalRange parse_signal_limits(const YamlValue &value, YamlMap &map, const Signal &signal) {
  SignalRange range;
  map.with("min", [&](const YamlValue &v) { range.least = parse_signal_limit(v, signal); });
  map.with("max", [&](const YamlValue &v) { range.most = parse_signal_limit(v, signal); });
  if (is_empty(signal, range)) value.fail("min is above max");
  return range;
}

SignalRange parse_signal_range(const YamlValue &value, const Signal &signal) {
  if (!value.is_map()) {
    const SignalLimit exact = parse_signal_limit(value, signal);
    return {exact, exact};
  }
  YamlMap map{value};
  const SignalRange range = parse_signal_limits(value, map, signal);
  map.finish();
  map.need_some();
  return range;
}

const Signal &parse_signal_name(const YamlValue &value, const SignalMessage &message,
                                const std::string &name) {
  if (const Signal *signal = message.find(name)) return *signal;
  value.fail("message " + message.name + " has no signal " + in_quotes(name));
}

SignalExpectation parse_expected_signal(const YamlValue &value, const std::string &name,
                                        const Scenario &scenario) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) value.fail("is no signal; allowed: message.signal");
  const SignalMessage &message = parse_message_name(value, name.substr(0, dot), scenario);
  SignalExpectation expectation;
  expectation.name = name;
  expectation.signal = &parse_signal_name(value, message, name.substr(dot + 1));
  if (!value.is_map()) {
    expectation.all = parse_signal_range(value, *expectation.signal);
    return expectation;
  }
  YamlMap map{value};
  expectation.all = parse_signal_limits(value, map, *expectation.signal);
  map.with("count", [&](const YamlValue &v) { expectation.count = parse_expected(v, kCounts); });
  map.with("mean", [&](const YamlValue &v) { expectation.mean = parse_range(v); });
  const auto range = [&](const char *key, auto &target) {
    map.with(key, [&](const YamlValue &v) { target = parse_signal_range(v, *expectation.signal); });
  };
  range("first", expectation.first);
  range("last", expectation.last);
  map.finish();
  map.need_some();
  return expectation;
}

}  // namespace

void parse_databases(YamlMap &map, Scenario &scenario) {
  map.with("dbc", [&](const YamlValue &list) {
    const std::filesystem::path folder = std::filesystem::path(list.file()).parent_path();
    std::vector<std::string> files;
    for (const YamlValue &item : list.items()) {
      if (item.text().empty()) item.refuse("the name of a file");
      files.push_back((folder / item.text()).string());
    }
    if (files.empty()) list.fail("no database is given");
    scenario.outputs.database = with_files(nullptr, files);
  });
}

const SignalMessage *parse_message(YamlMap &map, const Scenario &scenario, TrafficSpec &traffic) {
  const auto value = map.find("message");
  if (!value) return nullptr;
  const SignalMessage &message = parse_message_name(*value, value->text(), scenario);
  if (message.length > traffic.frame.data.size())
    value->fail(fmt::format("message {} has {} bytes; allowed: up to 8, as classical CAN carries",
                            message.name, message.length));
  traffic.name = message.name;
  traffic.frame.id = message.id;
  traffic.frame.extended = message.extended;
  traffic.frame.dlc = static_cast<std::uint8_t>(message.length);
  map.with("id", [&](const YamlValue &v) { parse_group_id(v, message, scenario, traffic.frame); });
  return &message;
}

void parse_signals(const YamlValue &value, const SignalMessage &message, Frame &frame) {
  SignalTexts texts;
  YamlMap map{value};
  for (const std::string &name : map.keys()) texts[name] = map.need(name).text();
  try {
    frame.data = encode(message, texts);
  } catch (const SignalError &error) {
    map.need(error.signal()).fail(error.what());
  }
}

void parse_expected_signals(const YamlValue &value, const Scenario &scenario,
                            Expectations &expect) {
  YamlMap map{value};
  for (const std::string &name : map.keys())
    expect.signals.push_back(parse_expected_signal(map.need(name), name, scenario));
  map.need_some("signals, as message.signal");
}

}  // namespace vericansim::detail
