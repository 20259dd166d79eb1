// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses the reader of a log by the first bytes of the file.
#include "trace/log.hpp"

#include <sys/stat.h>
#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

#include "trace/candump.hpp"
#include "trace/gvret.hpp"
#include "trace/input_error.hpp"
#include "trace/pcap_file.hpp"
#include "trace/trc.hpp"

namespace vericansim {
namespace {

/// Magic numbers of pcap (micro- and nanoseconds, both byte orders) and of pcapng.
bool looks_like_pcap(std::string_view head) {
  static constexpr std::array<std::string_view, 5> kMagic = {"\xd4\xc3\xb2\xa1", "\xa1\xb2\xc3\xd4",
                                                             "\x4d\x3c\xb2\xa1", "\xa1\xb2\x3c\x4d",
                                                             "\x0a\x0d\x0d\x0a"};
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

}  // namespace

const char *name_of(LogFormat format) {
  switch (format) {
    case LogFormat::kCandump: return "candump";
    case LogFormat::kPcap: return "pcap";
    case LogFormat::kTrc: return "PCAN-View trc";
    case LogFormat::kGvret: return "GVRET csv";
  }
  return "";
}

std::string read_text_file(const std::string &path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw InputError(path, 0, "no such file");
  if (S_ISDIR(status.st_mode)) throw InputError(path, 0, "is a directory, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, 0, "cannot be opened for reading");
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

LogFormat detect_log_format(std::string_view text, const std::string &path) {
  if (looks_like_pcap(text)) return LogFormat::kPcap;
  const std::string_view line = first_line(text);
  if (line.starts_with(";")) return LogFormat::kTrc;
  if (line.starts_with("Time Stamp,")) return LogFormat::kGvret;
  if (line.starts_with("(") || looks_like_candump_text(line)) return LogFormat::kCandump;
  throw InputError(path, 0,
                   text.empty() ? "the file is empty"
                                : "unknown kind of log; known are candump, pcap and pcapng, "
                                  "PCAN-View .trc 1.1, SavvyCAN GVRET .csv");
}

LogFormat detect_log_format(const std::string &path) {
  return detect_log_format(read_text_file(path), path);
}

CanLog parse_log(std::string_view text, const std::string &path) {
  switch (detect_log_format(text, path)) {
    case LogFormat::kPcap: return parse_pcap(text, path);
    case LogFormat::kTrc: return parse_trc(text, path);
    case LogFormat::kGvret: return parse_gvret(text, path);
    case LogFormat::kCandump: break;
  }
  return parse_candump(text, path);
}

CanLog read_log(const std::string &path) { return parse_log(read_text_file(path), path); }

}  // namespace vericansim
