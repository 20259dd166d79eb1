// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The table of formats, and the reader of a file by its first bytes.
#include "trace/log_format.hpp"

#include <array>

#include "trace/candump_screen.hpp"
#include "trace/input_error.hpp"
#include "trace/input_file.hpp"

namespace vericansim {
namespace {

constexpr bool kYes = true, kNo = false;
// In the order of LogFormat.
constexpr std::array<LogFormatTraits, 9> kFormats = {{
    {LogFormat::kCandump, "candump", "candump", ".log", kNo, kYes, kYes, kYes, kYes},
    {LogFormat::kPcap, "pcap", "pcap", ".pcap", kNo, kYes, kYes, kYes, kYes},
    {LogFormat::kPcapng, "pcapng", "pcapng", ".pcapng", kNo, kYes, kYes, kYes, kYes},
    {LogFormat::kTrc, "trc", "PCAN-View trc", ".trc", kNo, kYes, kNo, kYes, kYes},
    {LogFormat::kGvret, "gvret", "GVRET csv", "", kNo, kNo, kNo, kNo, kNo},
    {LogFormat::kAsc, "asc", "Vector ASC", ".asc", kYes, kYes, kYes, kYes, kYes},
    {LogFormat::kBlf, "blf", "Vector BLF", ".blf", kYes, kYes, kYes, kYes, kYes},
    {LogFormat::kCsv, "csv", "python-can csv", ".csv", kYes, kNo, kYes, kYes, kYes},
    {LogFormat::kSqlite, "sqlite", "python-can SQLite", ".db", kYes, kNo, kYes, kYes, kYes},
}};

/// Magic numbers of pcap: micro- and nanoseconds, both byte orders.
bool looks_like_pcap(std::string_view head) {
  static constexpr std::array<std::string_view, 4> kMagic = {
      "\xd4\xc3\xb2\xa1", "\xa1\xb2\xc3\xd4", "\x4d\x3c\xb2\xa1", "\xa1\xb2\x3c\x4d"};
  for (const std::string_view magic : kMagic)
    if (head.substr(0, 4) == magic) return true;
  return false;
}

/// First line that is neither empty nor a '#' comment.
std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start != std::string_view::npos && line[start] != '#') return line.substr(start);
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return {};
}

bool looks_like_asc(std::string_view line) {
  return line.starts_with("date ") || line.starts_with("base hex") ||
         line.starts_with("base dec") || line.starts_with("// version ");
}

/// The names, and in brackets the endings.
std::string all_formats() {
  std::string text;
  for (const LogFormatTraits &traits : kFormats)
    text += (text.empty() ? "" : ", ") + std::string(traits.option) +
            (*traits.ending != '\0' ? " (" + std::string(traits.ending) + ")" : "");
  return text;
}

}  // namespace

const LogFormatTraits &traits_of(LogFormat format) {
  return kFormats[static_cast<std::size_t>(format)];
}

const char *name_of(LogFormat format) { return traits_of(format).name; }

LogFormat output_format(const std::string &option, const std::string &path) {
  for (const LogFormatTraits &traits : kFormats)
    if (option.empty() ? *traits.ending != '\0' && without_gz(path).ends_with(traits.ending)
                       : option == traits.option)
      return traits.format;
  if (!option.empty())
    throw InputError("--format", 0, in_quotes(option) + " is no format; allowed: " + all_formats());
  throw InputError(path, 0,
                   "the name tells no format; allowed: --format with one of " + all_formats());
}

LogFormat detect_log_format(std::string_view text, const std::string &path) {
  if (looks_like_pcap(text)) return LogFormat::kPcap;
  if (text.starts_with("\x0a\x0d\x0d\x0a")) return LogFormat::kPcapng;
  if (text.starts_with("LOGG")) return LogFormat::kBlf;
  if (text.starts_with("SQLite format 3")) return LogFormat::kSqlite;
  refuse_utf16(text, path);
  const std::string_view line = first_line(text);
  if (line.starts_with(";")) return LogFormat::kTrc;
  if (line.starts_with("Time Stamp,")) return LogFormat::kGvret;
  if (line.starts_with("timestamp,arbitration_id,")) return LogFormat::kCsv;
  if (looks_like_asc(line)) return LogFormat::kAsc;
  if (line.starts_with("(") || looks_like_candump_screen(line)) return LogFormat::kCandump;
  if (line.starts_with("$"))
    throw InputError(path, 0,
                     "is a waveform, no recording of frames; allowed: with 'verican decode' or "
                     "'verican report'");
  throw InputError(path, 0,
                   text.empty() ? "the file is empty"
                                : "unknown kind of log; known are candump, pcap and pcapng, Vector "
                                  ".asc and .blf, PCAN-View .trc, SavvyCAN GVRET .csv, python-can "
                                  ".csv and .db");
}

LogFormat detect_log_format(const std::string &path) {
  return detect_log_format(read_text_file(path), path);
}

}  // namespace vericansim
