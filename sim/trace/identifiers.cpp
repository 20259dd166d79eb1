// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// IdentifierTable: see identifiers.hpp.
#include "trace/identifiers.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "trace/text.hpp"

namespace vericansim {
namespace {

std::string id_text(const IdentifierTable::Key &key) {
  const auto &[channel, remote, extended, id] = key;
  return fmt::format("{:0{}X}", id, extended ? 8 : 3);
}

/// "11 22* 33": the last data, '*' behind bytes that change; "remote" has none.
std::string data_text(const IdentifierRow &row, const char *mark) {
  if (row.last_frame.remote) return "remote";
  std::string text;
  for (std::size_t i = 0; i < row.last_frame.payload_size(); ++i)
    text += fmt::format("{}{:02X}{}", i == 0 ? "" : " ", row.last_frame.data[i],
                        row.changed[i] ? mark : "");
  return text;
}

double seconds(double ps) { return ps / static_cast<double>(kSecond); }
double milliseconds(double ps) { return ps / static_cast<double>(kMillisecond); }

/// Numbers of the bytes that change, from 0.
template <typename Use>
void for_changed(const IdentifierRow &row, Use use) {
  for (std::size_t i = 0; i < row.changed.size(); ++i)
    if (row.changed[i]) use(i);
}

}  // namespace

double IdentifierRow::jitter() const {
  return count < 2 ? 0 : std::sqrt(square_sum / static_cast<double>(count - 1));
}

void IdentifierTable::add(const std::string &channel, const Frame &frame, Time time) {
  IdentifierRow &row = rows_[{channel, frame.remote, frame.extended, frame.id}];
  if (++row.count == 1) {
    row.first = time;
  } else {
    const Time period = time - row.last;
    row.shortest_period = row.count == 2 ? period : std::min(row.shortest_period, period);
    row.longest_period = row.count == 2 ? period : std::max(row.longest_period, period);
    // Welford's way: no large sums that differ by little.
    const double difference = static_cast<double>(period) - row.mean_period;
    row.mean_period += difference / static_cast<double>(row.count - 1);
    row.square_sum += difference * (static_cast<double>(period) - row.mean_period);
    const std::size_t before = row.last_frame.payload_size(), now = frame.payload_size();
    for (std::size_t i = 0; i < std::max(before, now); ++i)
      row.changed[i] =
          row.changed[i] || i >= std::min(before, now) || row.last_frame.data[i] != frame.data[i];
  }
  row.last = time;
  row.last_frame = frame;
}

std::string to_text(const IdentifierTable &table) {
  const bool named = std::any_of(table.rows().begin(), table.rows().end(),
                                 [](const auto &row) { return !std::get<0>(row.first).empty(); });
  std::string text =
      fmt::format("  {}{:<8} {:>7} {:>10} {:>10} {:>10} {:>10} {:>11} {:>11}  {}\n",
                  named ? "interface  " : "", "id", "count", "mean ms", "min ms", "max ms",
                  "jitter ms", "first s", "last s", "last data, * changes");
  for (const auto &[key, row] : table.rows()) {
    text += named ? fmt::format("  {:<9}  ", std::get<0>(key)) : "  ";
    text += fmt::format("{:<8} {:>7} ", id_text(key), row.count);
    if (row.count < 2)
      text += fmt::format("{:>10} {:>10} {:>10} {:>10}", "-", "-", "-", "-");
    else
      text += fmt::format("{:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f}", milliseconds(row.mean_period),
                          milliseconds(static_cast<double>(row.shortest_period)),
                          milliseconds(static_cast<double>(row.longest_period)),
                          milliseconds(row.jitter()));
    text += fmt::format(" {:>11.6f} {:>11.6f}  {}\n", seconds(static_cast<double>(row.first)),
                        seconds(static_cast<double>(row.last)), data_text(row, "*"));
  }
  return text;
}

nlohmann::ordered_json to_json(const IdentifierTable &table) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto &[key, row] : table.rows()) {
    const auto &[channel, remote, extended, id] = key;
    nlohmann::ordered_json changed = nlohmann::ordered_json::array();
    for_changed(row, [&changed](std::size_t i) { changed.push_back(i); });
    list.push_back({{"interface", channel},
                    {"id", id},
                    {"extended", extended},
                    {"remote", remote},
                    {"count", row.count},
                    {"period_mean_ps", row.mean_period},
                    {"period_min_ps", row.shortest_period},
                    {"period_max_ps", row.longest_period},
                    {"period_jitter_ps", row.jitter()},
                    {"first_ps", row.first},
                    {"last_ps", row.last},
                    {"last_dlc", row.last_frame.dlc},
                    {"last_data", remote ? "" : data_text(row, "")},
                    {"changed_bytes", changed}});
  }
  return list;
}

void write_csv(const IdentifierTable &table, std::ostream &out) {
  out << "interface,id,extended,remote,count,period_mean_s,period_min_s,period_max_s,"
         "period_jitter_s,first_s,last_s,last_dlc,last_data,changed_bytes\n";
  for (const auto &[key, row] : table.rows()) {
    const auto &[channel, remote, extended, id] = key;
    std::string changed;
    for_changed(row, [&changed](std::size_t i) {
      changed += (changed.empty() ? "" : " ") + std::to_string(i);
    });
    fmt::print(out, "{},{},{:d},{:d},{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{},{},{}\n",
               text::csv_field(channel), id_text(key), extended, remote, row.count,
               seconds(row.mean_period), seconds(static_cast<double>(row.shortest_period)),
               seconds(static_cast<double>(row.longest_period)), seconds(row.jitter()),
               seconds(static_cast<double>(row.first)), seconds(static_cast<double>(row.last)),
               row.last_frame.dlc, remote ? "" : data_text(row, ""), changed);
  }
}

}  // namespace vericansim
