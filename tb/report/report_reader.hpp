// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads a report back as docs/report-format.md has it, with nothing of the writer.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bus/field.hpp"
#include "bus/types.hpp"
#include "model/frame.hpp"

namespace vericansim {

/// One bit of a lane.
struct ReportBit {
  Field field = Field::kIdle;
  bool stuff = false;
  Level seen = Level::kRecessive, sent = Level::kRecessive;
  int q = 0;
};

/// A report in memory.
class ReportPage {
 public:
  /// Throws std::runtime_error if `path` is no report.
  explicit ReportPage(const std::string &path);
  /// As above, from the text of a page.
  static ReportPage parse(std::string text) { return ReportPage{std::move(text), 0}; }

  nlohmann::json meta;
  std::string html;

  /// A column; std::runtime_error if it is not there.
  [[nodiscard]] const std::vector<double> &column(const std::string &name) const;
  [[nodiscard]] bool has(const std::string &name) const { return columns_.contains(name); }
  [[nodiscard]] double at(const std::string &name, std::size_t row) const {
    return column(name).at(row);
  }
  [[nodiscard]] std::size_t size(const std::string &name) const { return column(name).size(); }

  [[nodiscard]] Frame frame(std::size_t row) const;
  [[nodiscard]] std::vector<ReportBit> bits(std::size_t lane) const;
  /// Changes of a level: time in ns and level, the level at time 0 first.
  [[nodiscard]] std::vector<std::pair<double, Level>> edges(const std::string &name) const;
  /// Text and rule of an event's cause.
  [[nodiscard]] std::pair<std::string, std::string> cause(std::size_t event) const;

 private:
  ReportPage(std::string text, int);
  void read();

  std::map<std::string, std::vector<double>> columns_;
};

}  // namespace vericansim
