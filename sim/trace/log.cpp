// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses the reader of a log by the first bytes of the file.
#include "trace/log.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/candump.hpp"
#include "trace/gvret.hpp"
#include "trace/log_walk.hpp"
#include "trace/pcap_file.hpp"
#include "trace/pcapng_file.hpp"
#include "trace/python_log.hpp"
#include "trace/text.hpp"
#include "trace/trc.hpp"

namespace vericansim {

std::size_t CanLog::count(ForeignEntry::Kind kind) const {
  return static_cast<std::size_t>(std::count_if(
      others.begin(), others.end(), [kind](const ForeignEntry &e) { return e.kind == kind; }));
}

Time CanLog::earliest() const {
  Time time = 0;
  const auto note = [&time](const auto &entry) { time = std::min(time, entry.time); };
  walk(*this, note, note);
  return time;
}

std::string skipped_text(const CanLog &log) {
  const std::size_t fd = log.count(ForeignEntry::Kind::kFd);
  const std::size_t errors = log.count(ForeignEntry::Kind::kError);
  std::string text;
  const auto add = [&text](std::size_t count, const char *one, const char *many) {
    if (count != 0) text += (text.empty() ? "" : ", ") + text::counted(count, one, many);
  };
  add(fd, "CAN FD frame", "CAN FD frames");
  add(errors, "error message", "error messages");
  add(log.skipped - fd - errors, "other line or packet", "other lines or packets");
  return text;
}

CanLog parse_log(std::string_view text, const std::string &path) {
  const LogFormat format = detect_log_format(text, path);
  switch (format) {
    case LogFormat::kCandump: return parse_candump(text, path);
    case LogFormat::kPcap: return parse_pcap(text, path);
    case LogFormat::kPcapng: return parse_pcapng(text, path);
    case LogFormat::kTrc: return parse_trc(text, path);
    case LogFormat::kGvret: return parse_gvret(text, path);
    case LogFormat::kAsc:
    case LogFormat::kBlf:
    case LogFormat::kCsv:
    case LogFormat::kSqlite: break;
  }
  return parse_python_log(text, format, path);
}

CanLog read_log(const std::string &path) { return parse_log(read_text_file(path), path); }

}  // namespace vericansim
