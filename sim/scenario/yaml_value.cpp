// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// YAML with places.
#include "scenario/yaml_value.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <cstddef>
#include <sstream>

#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

std::size_t line_of(const YAML::Mark &mark) {
  return mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1;
}

/// Where a document begins, and what is in it, if anything.
class DocumentMarks : public YAML::EventHandler {
 public:
  YAML::Mark start, content = YAML::Mark::null_mark();

  void OnDocumentStart(const YAML::Mark &mark) override { start = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark &, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark &mark, YAML::anchor_t) override { note(mark); }
  void OnScalar(const YAML::Mark &mark, const std::string &, YAML::anchor_t,
                const std::string &) override {
    note(mark);
  }
  void OnSequenceStart(const YAML::Mark &mark, const std::string &, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark &mark, const std::string &, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    note(mark);
  }
  void OnMapEnd() override {}

 private:
  void note(const YAML::Mark &mark) {
    if (content.is_null()) content = mark;
  }
};

/// Refuses what follows the first document. yaml-cpp takes a comma outside of lists and maps for a
/// document that is empty and never ends, again and again.
void check_documents(const std::string &path, const std::string &text) {
  std::istringstream stream{text};
  YAML::Parser parser{stream};
  int before = -1;
  for (unsigned number = 0;; ++number) {
    DocumentMarks document;
    if (!parser.HandleNextDocument(document)) return;
    if (document.start.pos == before)
      throw InputError(path, line_of(document.start),
                       "no valid YAML: no document begins like this");
    before = document.start.pos;
    if (number != 0 && !document.content.is_null())
      throw InputError(path, line_of(document.content),
                       "a second document begins here; allowed: one in a file");
  }
}

}  // namespace

YamlValue YamlValue::load(const std::string &path) {
  return parse(path, read_text_file(path, kMostWritten));
}

YamlValue YamlValue::parse(const std::string &path, const std::string &text) {
  try {
    check_documents(path, text);
    const YAML::Node root = YAML::Load(text);
    const std::size_t line = line_of(root.Mark());
    return {path, "", root, line};
  } catch (const YAML::Exception &error) {
    throw InputError(path, line_of(error.mark), "no valid YAML: " + error.msg);
  }
}

void YamlValue::fail(const std::string &message) const {
  throw InputError(file_, line_, key_.empty() ? message : key_ + ": " + message);
}

void YamlValue::refuse(const std::string &allowed) const {
  const std::string what = node_.IsScalar()     ? in_quotes(node_.Scalar()) + " is not allowed"
                           : node_.IsMap()      ? "a map is not allowed"
                           : node_.IsSequence() ? "a list is not allowed"
                           : key_.empty()       ? "is empty"
                                                : "nothing is given";
  fail(what + "; allowed: " + allowed);
}

std::string YamlValue::text() const {
  if (!node_.IsScalar()) refuse("a word");
  return node_.Scalar();
}

std::string YamlValue::name() const {
  std::string name = text();
  if (text::has_control(name))
    fail("a control character is in it; allowed: a name without control characters");
  return name;
}

std::uint64_t YamlValue::integer(std::uint64_t least, std::uint64_t most) const {
  const auto value = node_.IsScalar() ? parse_integer(node_.Scalar()) : std::nullopt;
  if (!value || *value < least || *value > most)
    refuse(node_.IsScalar() && node_.Scalar().starts_with("0x")  // as the user writes it
               ? fmt::format("0x{:X} to 0x{:X}", least, most)
               : fmt::format("{} to {}", least, most));
  return *value;
}

double YamlValue::number(double least, double most) const {
  const auto value = node_.IsScalar() ? parse_number(node_.Scalar()) : std::nullopt;
  if (!value || *value < least || *value > most)
    refuse(fmt::format("a number from {:.15g} to {:.15g}", least, most));
  return *value;
}

std::optional<bool> YamlValue::as_boolean() const {
  const std::string value = node_.IsScalar() ? node_.Scalar() : "";
  if (value == "true" || value == "yes" || value == "on") return true;
  if (value == "false" || value == "no" || value == "off") return false;
  return std::nullopt;
}

bool YamlValue::boolean() const {
  const auto value = as_boolean();
  if (!value) refuse("true or false");
  return *value;
}

double YamlValue::frequency(double least, double most) const {
  const auto value = node_.IsScalar() ? parse_frequency(node_.Scalar()) : std::nullopt;
  if (!value || *value < least || *value > most)
    refuse(fmt::format("{:.15g} to {:.15g} Hz, as in '8 MHz'", least, most));
  return *value;
}

double YamlValue::bitrate() const {
  const auto value = node_.IsScalar() ? parse_bitrate(node_.Scalar()) : std::nullopt;
  if (!value || *value < 1e3 || *value > 1e6) refuse("1 kbit/s to 1 Mbit/s, as in '500k'");
  return *value;
}

Time YamlValue::time(Time least, Time most) const {
  const auto value = node_.IsScalar() ? parse_time(node_.Scalar()) : std::nullopt;
  if (!value || *value < least || *value > most) {
    refuse(fmt::format("{} to {}, as in '10 ms' (ps, ns, us, ms, s)", exact_time(least),
                       exact_time(most)));
  }
  return *value;
}

double YamlValue::length(double most_m) const {
  const auto value = node_.IsScalar() ? parse_length(node_.Scalar()) : std::nullopt;
  if (!value || *value < 0 || *value > most_m) refuse(fmt::format("0 to {:g} m", most_m));
  return *value;
}

double YamlValue::part(double least, double most) const {
  const auto value = node_.IsScalar() ? parse_part(node_.Scalar()) : std::nullopt;
  if (!value || *value < least || *value > most)
    refuse(fmt::format("{:g} % to {:g} %, as in '80 %'", least * 100, most * 100));
  return *value;
}

std::vector<YamlValue> YamlValue::items() const {
  if (!node_.IsSequence()) return {*this};
  std::vector<YamlValue> items;
  for (const YAML::Node &node : node_) {
    const std::size_t line = line_of(node.Mark());
    items.emplace_back(file_, fmt::format("{}[{}]", key_, items.size()), node,
                       line != 0 ? line : line_);
  }
  return items;
}

YamlMap::YamlMap(YamlValue value) : value_{std::move(value)} {
  if (!value_.node_.IsMap()) value_.refuse("a map of keys and values");
  std::set<std::string> seen;
  for (const auto &entry : value_.node_) {
    const YamlValue key{value_.file_, value_.key_, entry.first, line_of(entry.first.Mark())};
    if (!seen.insert(key.text()).second)
      key.fail("key " + in_quotes(key.text()) + " is given twice");
  }
}

std::optional<YamlValue> YamlMap::find(const std::string &key) {
  asked_.insert(key);
  const YAML::Node &map = value_.node_;
  for (const auto &entry : map) {
    if (entry.first.Scalar() != key) continue;
    const std::size_t line = line_of(entry.second.Mark());
    return YamlValue{value_.file_, value_.key_.empty() ? key : value_.key_ + "." + key,
                     entry.second, line != 0 ? line : line_of(entry.first.Mark())};
  }
  return std::nullopt;
}

YamlValue YamlMap::need(const std::string &key) {
  const auto value = find(key);
  if (value) return *value;
  std::string given;  // one of them may be meant for it
  for (const std::string &name : keys()) given += (given.empty() ? "" : ", ") + in_quotes(name);
  value_.fail("key '" + key + "' is missing" + (given.empty() ? "" : "; given: " + given));
}

std::vector<std::string> YamlMap::keys() const {
  std::vector<std::string> keys;
  for (const auto &entry : value_.node_) keys.push_back(entry.first.Scalar());
  return keys;
}

void YamlMap::finish() const {
  for (const auto &entry : value_.node_) {
    const std::string &key = entry.first.Scalar();
    if (asked_.count(key) != 0) continue;
    const YamlValue place{value_.file_, value_.key_, entry.first, line_of(entry.first.Mark())};
    place.fail("unknown key " + in_quotes(key) + "; allowed: " + asked());
  }
}

void YamlMap::need_some(const std::string &allowed) const {
  if (value_.node_.size() == 0)
    value_.fail("nothing is in it; allowed: " + (allowed.empty() ? asked() : allowed));
}

std::string YamlMap::asked() const {
  std::string names;
  for (const std::string &name : asked_) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

}  // namespace vericansim
