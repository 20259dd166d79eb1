// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// LogFilter: see log_filter.hpp.
#include "trace/log_filter.hpp"

#include <fmt/format.h>

#include <utility>

#include "trace/input_error.hpp"
#include "trace/log_walk.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

constexpr const char *kAll = "all";

/// Throws if the interface that the filter wants is not there, or none is told where several are.
void check_interface(const CanLog &log, const LogFilter &filter, const std::string &path) {
  const auto interfaces = interfaces_of(log);
  if (filter.interface == kAll) return;
  if (filter.interface.empty()) {
    if (filter.several || interfaces.size() <= 1) return;
    throw InputError(path, 0,
                     fmt::format("holds several interfaces: {}; allowed: --interface NAME, or "
                                 "--interface all for them as one bus",
                                 interfaces_text(interfaces)));
  }
  if (!interfaces.contains(filter.interface))
    throw InputError("--interface", 0,
                     fmt::format("{} is not in {}; allowed: all, {}", in_quotes(filter.interface),
                                 path, interfaces_text(interfaces)));
}

/// The identifier of a CAN FD frame with SocketCAN's flags.
canid_t can_id_of(const ForeignEntry &entry) {
  const std::size_t digits = entry.text.find('#');
  const auto id = text::parse_unsigned(std::string_view{entry.text}.substr(0, digits), 16);
  return static_cast<canid_t>(id.value_or(0)) | (digits == 8 ? CAN_EFF_FLAG : 0);
}

bool has_wanted_id(const std::vector<IdFilter> &ids, const LogEntry &entry) {
  return passes(ids, can_id_of(entry.frame));
}
/// An error message has a class in the identifier's place: no filter lets it pass, as in the
/// kernel.
bool has_wanted_id(const std::vector<IdFilter> &ids, const ForeignEntry &entry) {
  return entry.kind == ForeignEntry::Kind::kError ? ids.empty() : passes(ids, can_id_of(entry));
}

}  // namespace

void count_from_first(CanLog &log) {
  if (log.entries.empty() && log.others.empty()) return;
  const Time first = log.entries.empty() ? log.others.front().time : log.entries.front().time;
  const auto move = [first](auto &entry) { entry.time -= first; };
  walk(log, move, move);
  if (log.start_ns != 0) log.start_ns += first / kNanosecond;
}

std::map<std::string, std::size_t> interfaces_of(const CanLog &log) {
  std::map<std::string, std::size_t> interfaces;
  const auto count = [&interfaces](const auto &entry) { ++interfaces[entry.channel]; };
  walk(log, count, count);
  return interfaces;
}

std::string interfaces_text(const std::map<std::string, std::size_t> &interfaces) {
  std::string text;
  for (const auto &[name, count] : interfaces)
    text += fmt::format("{}{} ({} frame{})", text.empty() ? "" : ", ",
                        name.empty() ? "without a name" : name, count, count == 1 ? "" : "s");
  return text;
}

CanLog filtered(CanLog log, const LogFilter &filter, const std::string &path) {
  check_interface(log, filter, path);
  if (filter.from && filter.to && *filter.from > *filter.to)
    throw InputError("--from", 0, "is behind --to; allowed: a time before it");
  const auto wanted = [&filter](const auto &entry) {
    return (filter.interface.empty() || filter.interface == kAll ||
            entry.channel == filter.interface) &&
           has_wanted_id(filter.ids, entry) && entry.time >= filter.from.value_or(entry.time) &&
           entry.time <= filter.to.value_or(entry.time);
  };
  CanLog result;
  result.start_ns = log.start_ns;
  result.skipped = log.skipped - log.others.size();
  walk(
      log,
      [&](LogEntry &entry) {
        if (wanted(entry)) result.entries.push_back(std::move(entry));
      },
      [&](ForeignEntry &entry) {
        if (!wanted(entry)) return;
        entry.before = result.entries.size();
        result.others.push_back(std::move(entry));
      });
  result.skipped += result.others.size();
  count_from_first(result);
  return result;
}

}  // namespace vericansim
