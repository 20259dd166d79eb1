// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// YAML with places: every value knows its file, line and key, and every refusal names them.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bus/types.hpp"

namespace vericansim {

/// A value of a YAML file. All readers throw InputError "file:line: key: 'value' is not allowed;
/// allowed: ...".
class YamlValue {
 public:
  YamlValue(std::string file, std::string key, const YAML::Node &node, std::size_t line)
      : file_{std::move(file)}, key_{std::move(key)}, node_{node}, line_{line} {}

  /// Reads and parses a whole file.
  static YamlValue load(const std::string &path);
  /// Parses `text` as if it stood in the file `path`.
  static YamlValue parse(const std::string &path, const std::string &text);

  [[noreturn]] void fail(const std::string &message) const;
  /// fail() with the value and what is allowed.
  [[noreturn]] void refuse(const std::string &allowed) const;

  [[nodiscard]] bool is_map() const { return node_.IsMap(); }
  [[nodiscard]] bool is_list() const { return node_.IsSequence(); }
  [[nodiscard]] bool is_scalar() const { return node_.IsScalar(); }
  [[nodiscard]] std::string text() const;
  /// The same of what is printed in tables: control characters are refused.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::uint64_t integer(std::uint64_t least, std::uint64_t most) const;
  [[nodiscard]] double number(double least, double most) const;
  [[nodiscard]] bool boolean() const;
  /// Nothing if it is no truth value.
  [[nodiscard]] std::optional<bool> as_boolean() const;
  [[nodiscard]] double frequency(double least, double most) const;
  [[nodiscard]] double bitrate() const;  ///< 1 kbit/s to 1 Mbit/s
  [[nodiscard]] Time time(Time least, Time most) const;
  [[nodiscard]] double length(double most_m) const;
  [[nodiscard]] double part(double least, double most) const;
  /// Items of a list; a single value counts as a list of one.
  [[nodiscard]] std::vector<YamlValue> items() const;

  [[nodiscard]] const std::string &key() const { return key_; }
  [[nodiscard]] const std::string &file() const { return file_; }
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  friend class YamlMap;

  std::string file_;
  std::string key_;
  YAML::Node node_;
  std::size_t line_;
};

/// A map whose keys are asked for one by one; finish() refuses the keys that nobody asked for.
class YamlMap {
 public:
  /// Throws if `value` is no map or has a key twice.
  explicit YamlMap(YamlValue value);

  /// The value of `key`, if it is there.
  [[nodiscard]] std::optional<YamlValue> find(const std::string &key);
  /// The value of `key`; throws if it is not there.
  [[nodiscard]] YamlValue need(const std::string &key);
  /// Calls `use(value)` if the key is there.
  template <typename Use>
  void with(const std::string &key, Use use) {
    if (const auto value = find(key)) use(*value);
  }
  /// Throws if the map has a key that was not asked for; the message lists those that were.
  void finish() const;
  /// Throws if the map is empty, with `allowed` or else the keys that were asked for: it would ask
  /// for nothing.
  void need_some(const std::string &allowed = "") const;
  [[nodiscard]] const YamlValue &value() const { return value_; }
  /// All keys, in the order of the file.
  [[nodiscard]] std::vector<std::string> keys() const;

 private:
  [[nodiscard]] std::string asked() const;

  YamlValue value_;
  std::set<std::string> asked_;
};

}  // namespace vericansim
