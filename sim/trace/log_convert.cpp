// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// convert(): write what the format can hold, read it again, compare.
#include "trace/log_convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "trace/candump.hpp"
#include "trace/gvret.hpp"
#include "trace/input_error.hpp"
#include "trace/log_filter.hpp"
#include "trace/log_walk.hpp"
#include "trace/pcap_file.hpp"
#include "trace/pcapng_file.hpp"
#include "trace/python_log.hpp"
#include "trace/text.hpp"
#include "trace/trc.hpp"

namespace vericansim {
namespace {

/// What is lost, in the words for one and for several of it.
struct Phrase {
  std::string one, many;
  friend bool operator==(const Phrase &, const Phrase &) = default;
};

/// Losses by their phrase, in the order in which they were first seen.
class Losses {
 public:
  void count(const Phrase &phrase, std::size_t number = 1) {
    if (number == 0) return;
    const auto at = std::find_if(list_.begin(), list_.end(),
                                 [&](const auto &item) { return item.first == phrase; });
    if (at == list_.end())
      list_.emplace_back(phrase, number);
    else
      at->second += number;
  }
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> texts;
    for (const auto &[phrase, number] : list_)
      texts.push_back(text::counted(number, phrase.one, phrase.many));
    return texts;
  }

 private:
  std::vector<std::pair<Phrase, std::size_t>> list_;
};

/// With words behind the noun: "interface can3 (none now)", "interfaces can3 (none now)".
Phrase phrase(const std::string &one, const std::string &many, const std::string &rest) {
  return {one + rest, many + rest};
}

/// What of `log` the format has room for at all.
CanLog that_fits(const CanLog &log, const LogFormatTraits &traits, Losses &losses) {
  CanLog result;
  result.start_ns = log.start_ns;
  losses.count({"other line or packet", "other lines or packets"}, log.skipped - log.others.size());
  walk(
      log,
      [&](const LogEntry &entry) {
        if (entry.frame.remote && !traits.remote)
          return losses.count({"remote frame", "remote frames"});
        result.entries.push_back(entry);
        Frame &frame = result.entries.back().frame;
        if (frame.dlc <= 8 || traits.raw_dlc) return;
        losses.count(phrase("DLC", "DLCs", " of 9 to 15 (8 now)"));
        frame.dlc = 8;
      },
      [&](const ForeignEntry &entry) {
        const bool fd = entry.kind == ForeignEntry::Kind::kFd;
        if (!(fd ? traits.fd : traits.errors))
          return losses.count(fd ? Phrase{"CAN FD frame", "CAN FD frames"}
                                 : Phrase{"error message", "error messages"});
        result.others.push_back(entry);
        result.others.back().before = result.entries.size();
        ++result.skipped;
      });
  count_from_first(result);
  return result;
}

std::string bytes_of(const CanLog &log, LogFormat format, const std::string &path) {
  switch (format) {
    case LogFormat::kPcap: return pcap_bytes(log);
    case LogFormat::kPcapng: return pcapng_bytes(log);
    case LogFormat::kTrc: return trc_text(log);
    case LogFormat::kGvret: return gvret_text(log);
    case LogFormat::kAsc:
    case LogFormat::kBlf:
    case LogFormat::kCsv:
    case LogFormat::kSqlite: return python_log_bytes(log, format, path);
    case LogFormat::kCandump: break;
  }
  const auto below_us = [](const auto &entry) { return entry.time % kMicrosecond != 0; };
  const bool nanoseconds = log.start_ns % 1000 != 0 ||
                           std::any_of(log.entries.begin(), log.entries.end(), below_us) ||
                           std::any_of(log.others.begin(), log.others.end(), below_us);
  std::ostringstream text;
  CandumpWriter writer{text, log.start_ns, nanoseconds};
  const auto write = [&writer](const auto &entry) { writer.write(entry); };
  walk(log, write, write);
  return std::move(text).str();
}

/// Reads the new file. If it is refused, who wrote it is to blame; its lines lie nowhere.
CanLog read_again(const std::string &bytes, LogFormat format, const std::string &path) {
  try {
    return parse_log(bytes, "read again");
  } catch (const InputError &error) {
    throw InputError(path, 0,
                     fmt::format("the recording cannot be written to it as {}: {}",
                                 traits_of(format).option, error.what()));
  }
}

/// One entry of either kind, as text.
struct Item {
  Time time;
  std::string channel;
  Direction direction;
  std::string frame;
  bool error;
};

/// The text without CANFD_FDF, which newer kernels set in all CAN FD frames: "##" says the same.
std::string without_fdf(const ForeignEntry &entry) {
  constexpr std::string_view kDigits = "0123456789ABCDEF", kWithout = "0123012389AB89AB";
  std::string text = entry.text;
  if (entry.kind != ForeignEntry::Kind::kFd) return text;
  char &flags = text[text.find('#') + 2];
  const std::size_t value = kDigits.find(flags);
  if (value != std::string_view::npos) flags = kWithout[value];
  return text;
}

std::vector<Item> items_of(const CanLog &log) {
  std::vector<Item> items;
  walk(
      log,
      [&](const LogEntry &e) {
        items.push_back({e.time, e.channel, e.direction, candump_frame(e.frame), false});
      },
      [&](const ForeignEntry &e) {
        items.push_back(
            {e.time, e.channel, e.direction, without_fdf(e), e.kind == ForeignEntry::Kind::kError});
      });
  return items;
}

/// What the entry that was read lacks of the one that was written; false if it is another frame.
bool compare(const Item &written, const Item &read, Losses &losses) {
  if (written.channel != read.channel && !written.channel.empty())
    losses.count(phrase("interface", "interfaces",
                        fmt::format(" {} ({} now)", written.channel,
                                    read.channel.empty() ? "none" : read.channel)));
  if (written.direction != read.direction && written.direction != Direction::kUnknown)
    losses.count({"direction", "directions"});
  if (written.error && read.error && written.frame != read.frame) {
    losses.count({"content of an error message", "contents of error messages"});
    return true;
  }
  return written.frame == read.frame && written.error == read.error;
}

/// The first frame that is not the one that was written; empty if all are.
std::string first_difference(const std::vector<Item> &written, const std::vector<Item> &read,
                             Losses &losses) {
  std::string text;
  for (std::size_t i = 0; i < std::min(written.size(), read.size()); ++i)
    if (!compare(written[i], read[i], losses) && text.empty())
      text = fmt::format("frame {} is {}, not {}", i + 1, read[i].frame, written[i].frame);
  if (text.empty() && written.size() != read.size())
    text = fmt::format("there are {}, not {}", read.size(), written.size());
  return text;
}

/// Differences of the times since the first frame.
void compare_times(const std::vector<Item> &written, const std::vector<Item> &read,
                   Losses &losses) {
  std::size_t count = 0;
  Time most = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Time difference = std::abs(written[i].time - read[i].time);
    if (difference != 0) ++count;
    most = std::max(most, difference);
  }
  if (count != 0)
    losses.count(phrase("time", "times",
                        fmt::format(" since the first frame, by up to {} ns", most / kNanosecond)),
                 count);
}

}  // namespace

std::int64_t written_start_ns(const CanLog &log) {
  return std::max(log.start_ns, -log.earliest() / kNanosecond);
}

Conversion convert(const CanLog &log, LogFormat format, const std::string &path) {
  Conversion result;
  Losses losses;
  CanLog fitting = that_fits(log, traits_of(format), losses);
  const std::int64_t start_ns = fitting.start_ns;
  // A trc file without a time of day has times since its own first entry.
  if (format != LogFormat::kTrc) fitting.start_ns = written_start_ns(fitting);
  result.bytes = bytes_of(fitting, format, path);
  // A file of some formats without a frame is no file of that format to a reader.
  const bool empty = fitting.entries.empty() && fitting.others.empty();
  const CanLog again = empty ? fitting : read_again(result.bytes, format, path);
  const auto written = items_of(fitting), read = items_of(again);
  result.frames = written.size();
  result.difference = first_difference(written, read, losses);
  result.faithful = result.difference.empty();
  if (written.size() == read.size()) compare_times(written, read, losses);
  if (start_ns != again.start_ns && start_ns != 0 && result.frames != 0)
    losses.count(phrase(
        "time of day", "times of day",
        again.start_ns == 0 ? "" : fmt::format(", by {} ns", std::abs(start_ns - again.start_ns))));
  result.lost = losses.texts();
  return result;
}

}  // namespace vericansim
