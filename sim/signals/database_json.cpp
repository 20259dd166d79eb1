// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The JSON of a database. Numbers of the file are texts in it, so that their decimals are known.
#include "signals/database_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using Json = nlohmann::json;

double number(const Json &json) { return std::strtod(json.get<std::string>().c_str(), nullptr); }

/// Digits behind the point of a number such as "0.125" or "5E-7".
int decimals_of(const std::string &text) {
  const std::size_t exponent_at = text.find_first_of("eE");
  const std::size_t point = text.find('.');
  const std::size_t end = std::min(exponent_at, text.size());
  int digits = point == std::string::npos ? 0 : static_cast<int>(end - point) - 1;
  if (exponent_at != std::string::npos)
    digits -= static_cast<int>(std::strtol(text.c_str() + exponent_at + 1, nullptr, 10));
  return std::max(digits, 0);
}

std::size_t index_of(const Json &signals, const std::string &name) {
  const auto found = std::find_if(signals.begin(), signals.end(),
                                  [&](const Json &signal) { return signal.at("name") == name; });
  return static_cast<std::size_t>(found - signals.begin());
}

Signal signal_of(const Json &json, const Json &signals) {
  Signal signal;
  signal.name = json.at("name");
  signal.unit = json.at("unit");
  signal.start = json.at("start");
  signal.length = json.at("length");
  signal.little_endian = json.at("little_endian");
  signal.is_signed = json.at("signed");
  signal.is_float = json.at("float");
  signal.factor = number(json.at("factor"));
  signal.offset = number(json.at("offset"));
  signal.decimals = std::max(decimals_of(json.at("factor")), decimals_of(json.at("offset")));
  const double minimum = number(json.at("minimum")), maximum = number(json.at("maximum"));
  if (minimum < maximum) {  // [0|0] stands for no limits
    signal.minimum = minimum;
    signal.maximum = maximum;
  }
  signal.start_value = number(json.at("start_value"));
  for (const Json &choice : json.at("choices"))
    signal.choices.emplace_back(choice.at(0).get<std::int64_t>(), choice.at(1).get<std::string>());
  const Json &selection = json.at("multiplexed");
  if (!selection.is_null()) {
    signal.selection.emplace();
    signal.selection->multiplexer = index_of(signals, selection.at("signal"));
    for (const Json &range : selection.at("ranges"))
      signal.selection->ranges.emplace_back(range.at(0), range.at(1));
  }
  return signal;
}

SignalMessage message_of(const std::string &path, const Json &json) {
  SignalMessage message;
  message.file = path;
  message.name = json.at("name");
  message.id = json.at("id");
  message.extended = json.at("extended");
  message.j1939 = json.at("j1939");
  message.length = json.at("length");
  const Json &signals = json.at("signals");
  for (const Json &signal : signals) message.signals.push_back(signal_of(signal, signals));
  return message;
}

}  // namespace

DatabaseContent parse_database_json(const std::string &path, const std::string &json) {
  const Json database = Json::parse(json);
  if (const auto error = database.find("error"); error != database.end())
    throw InputError(path, error->at("line").get<std::size_t>(),
                     error->at("message").get<std::string>());
  DatabaseContent content;
  content.text = database.value("text", "");
  for (const Json &message : database.at("messages"))
    content.messages.push_back(message_of(path, message));
  return content;
}

}  // namespace vericansim
