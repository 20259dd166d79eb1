// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reading of sw/remote/vectors.yaml.
#include "remote/golden_vectors.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

#include "scenario/yaml_value.hpp"
#include "trace/candump.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim::golden {
namespace {

const std::map<std::string, std::set<std::string>> kProfiles{
    {"small", {"stage"}},
    {"standard", {"stage", "producers", "map", "queue", "protection"}},
    {"full", {"stage", "producers", "map", "queue", "protection", "block", "rate", "counters"}}};

Frame read_frame(const YamlValue &value) {
  Frame frame;
  if (!parse_candump_frame(value.text(), frame, {value.file(), value.line()}))
    value.refuse("a classical frame, as in 1A0#5A");
  return frame;
}

std::vector<Frame> read_frames(const YamlValue &value) {
  std::vector<Frame> frames;
  for (const YamlValue &item : value.items()) frames.push_back(read_frame(item));
  return frames;
}

/// "5A -- 02": bytes with blanks between, each known or not.
std::vector<std::optional<std::uint8_t>> read_pattern(const YamlValue &value) {
  std::vector<std::optional<std::uint8_t>> bytes;
  std::istringstream words{value.text()};
  for (std::string word; words >> word;) {
    const auto byte = text::parse_unsigned(word, 16);
    if (word.size() != 2 || (!byte && word != "--")) value.refuse("bytes, as in '5A 00'");
    bytes.push_back(byte ? std::optional{static_cast<std::uint8_t>(*byte)} : std::nullopt);
  }
  return bytes;
}

std::vector<std::uint8_t> read_bytes(const YamlValue &value) {
  std::vector<std::uint8_t> bytes;
  for (const auto &byte : read_pattern(value)) {
    if (!byte) value.refuse("bytes, as in '5A 00'");
    bytes.push_back(*byte);
  }
  return bytes;
}

/// A key that is a number, as in {0x020: ...} or {4: ...}.
unsigned numeric_key(const YamlMap &map, const std::string &key, unsigned most) {
  const auto number = parse_integer(key);
  if (!number || *number > most)
    map.value().fail(in_quotes(key) + " is not allowed; allowed: 0 to " + std::to_string(most));
  return static_cast<unsigned>(*number);
}

Step read_step(const YamlValue &value) {
  YamlMap map{value};
  Step step;
  step.send = read_frame(map.need("send"));
  map.with("from", [&](const YamlValue &from) {
    if (from.text() != "node") from.refuse("node");
    step.from_node = true;
  });
  map.with("answers", [&](const YamlValue &answers) {
    if (!answers.is_map()) {
      step.answers[""] = read_frames(answers);
      return;
    }
    YamlMap profiles{answers};
    for (const auto &[name, features] : kProfiles)
      step.answers[name] = read_frames(profiles.need(name));
    profiles.finish();
  });
  map.with("others", [&](const YamlValue &others) {
    YamlMap nodes{others};
    for (const std::string &key : nodes.keys())
      step.others[numeric_key(nodes, key, 31)] = read_frame(nodes.need(key));
  });
  map.finish();
  return step;
}

/// What a call gives: bytes, bytes by profile, bytes by number, or "here".
void read_gives(const YamlValue &gives, Call &call) {
  if (call.what == "select") {
    call.here = gives.text() == "here";
    if (!call.here && gives.text() != "nobody") gives.refuse("here, nobody");
  } else if (!gives.is_map()) {
    call.gives[""] = read_bytes(gives);
  } else if (YamlMap map{gives}; call.what == "poll") {
    for (const std::string &key : map.keys())
      call.nodes[numeric_key(map, key, 31)] = read_bytes(map.need(key));
  } else {
    for (const auto &[name, features] : kProfiles) call.gives[name] = read_bytes(map.need(name));
    map.finish();
  }
}

Call read_call(const YamlValue &value) {
  YamlMap map{value};
  Call call;
  if (const auto frame = map.find("frame")) {
    call.what = "frame";
    call.frame = read_frame(*frame);
    map.finish();
    return call;
  }
  call.what = map.need("do").text();
  const auto number = [&](const char *key, unsigned most, auto &into) {
    map.with(key, [&](const YamlValue &given) {
      into = static_cast<std::uint32_t>(given.integer(0, most));
    });
  };
  number("node", 31, call.node);
  number("address", 0xFFF, call.address);
  number("length", 0x1000, call.length);
  number("count", 255, call.count);
  number("tag", 255, call.tag);
  number("value", 0xFFFFFFFF, call.value);
  number("mask", 0xFFFFFFFF, call.mask);
  map.with("command", [&](const YamlValue &command) { call.command = command.text(); });
  map.with("data", [&](const YamlValue &data) { call.data = read_bytes(data); });
  map.with("gives", [&](const YamlValue &gives) { read_gives(gives, call); });
  map.finish();
  return call;
}

void read_expectations(YamlMap &map, Vector &vector) {
  map.with("memory", [&](const YamlValue &memory) {
    YamlMap places{memory};
    for (const std::string &key : places.keys()) {
      const unsigned address = numeric_key(places, key, 0xFFF);
      vector.memory[static_cast<std::uint16_t>(address)] = read_bytes(places.need(key));
    }
  });
  map.with("status", [&](const YamlValue &status) {
    const auto bytes = read_pattern(status);
    if (bytes.size() != 8) status.refuse("eight bytes");
    vector.status.emplace();
    std::copy(bytes.begin(), bytes.end(), vector.status->begin());
  });
  map.with("number", [&](const YamlValue &number) {
    vector.node = static_cast<unsigned>(number.integer(0, 31));
  });
}

Vector read_vector(const YamlValue &value) {
  YamlMap map{value};
  Vector vector;
  vector.number = static_cast<unsigned>(map.need("vector").integer(1, 999));
  vector.what = map.need("what").text();
  map.with("needs", [&](const YamlValue &needs) {
    for (const YamlValue &item : needs.items()) {
      if (features_of("full").count(item.text()) == 0) item.refuse("a feature of IDENT");
      vector.needs.insert(item.text());
    }
  });
  for (const YamlValue &item : map.need("steps").items()) vector.steps.push_back(read_step(item));
  map.with("calls", [&](const YamlValue &calls) {
    for (const YamlValue &item : calls.items()) vector.calls.push_back(read_call(item));
  });
  read_expectations(map, vector);
  map.finish();
  return vector;
}

Life read_life(const YamlValue &value) {
  YamlMap map{value};
  Life life;
  life.name_bits = static_cast<unsigned>(map.need("name_bits").integer(3, 5));
  life.number = static_cast<unsigned>(map.need("number").integer(0, 31));
  life.serial = static_cast<std::uint32_t>(map.need("serial").integer(0, 0xFFFFFFFF));
  life.boot = read_frame(map.need("boot"));
  for (const YamlValue &item : map.need("vectors").items())
    life.vectors.push_back(read_vector(item));
  map.finish();
  return life;
}

}  // namespace

const std::vector<Frame> &Step::answers_of(const std::string &profile) const {
  static const std::vector<Frame> none;
  const auto alone = answers.find("");
  if (alone != answers.end()) return alone->second;
  return answers.empty() ? none : answers.at(profile);
}

std::vector<std::uint8_t> Call::gives_with(const std::string &profile) const {
  if (gives.empty()) return {};
  const auto alone = gives.find("");
  return alone != gives.end() ? alone->second : gives.at(profile);
}

std::vector<Vector> Life::for_features(const std::set<std::string> &features) const {
  std::vector<Vector> kept;
  std::copy_if(vectors.begin(), vectors.end(), std::back_inserter(kept), [&](const Vector &v) {
    return std::includes(features.begin(), features.end(), v.needs.begin(), v.needs.end());
  });
  return kept;
}

const std::set<std::string> &features_of(const std::string &profile) {
  return kProfiles.at(profile);
}

std::vector<Life> load(const std::string &path) {
  YamlMap map{YamlValue::load(path)};
  std::vector<Life> lives;
  for (const YamlValue &item : map.need("lives").items()) lives.push_back(read_life(item));
  map.finish();
  return lives;
}

void PrintTo(const Vector &vector, std::ostream *out) {
  *out << vector.number << ' ' << vector.what;
}

}  // namespace vericansim::golden
