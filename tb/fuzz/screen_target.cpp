// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Target: frames as candump prints them on the screen, with any of its options.
#include <fmt/format.h>

#include "fuzz/target.hpp"
#include "trace/candump.hpp"

namespace vericansim::fuzz {
namespace {

/// One line, and what a log has to say of it.
struct Line {
  std::string screen;
  std::string log;  ///< the frame as candump -l writes it
  bool fd = false;
  std::int64_t ns = 0;
};

/// Options: -t, -x, -8, and -a behind the bytes.
struct Options {
  bool absolute, columns, ascii;
};

constexpr unsigned kFdLengths[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 20, 24, 32, 48, 64};

/// Length and bytes for both forms.
void add_data(Reader &reader, unsigned length, Line &line, const Options &options) {
  std::string ascii;
  for (unsigned i = 0; i < length; ++i) {
    const std::uint8_t byte = reader.byte();
    line.screen += fmt::format(" {:02X}", byte);
    line.log += fmt::format("{:02X}", byte);
    ascii += byte > 0x20 && byte < 0x7F ? static_cast<char>(byte) : '.';
  }
  if (options.ascii) line.screen += "   '" + ascii + "'";
}

void add_classical(Reader &reader, unsigned dlc, bool remote, Line &line, const Options &options) {
  const unsigned length = std::min(dlc, 8U);
  const std::string raw = dlc > 8 ? fmt::format("{:X}", dlc) : "";
  line.screen += raw.empty() ? fmt::format("  [{}] ", length) : "  {" + raw + "} ";
  line.log += '#';
  if (remote) {
    line.screen += " remote request";
    line.log += length == 0 ? "R" : fmt::format("R{}", length);
  } else {
    add_data(reader, length, line, options);
  }
  if (!raw.empty()) line.log += "_" + raw;
}

Line make_line(Reader &reader, std::int64_t &time, const Options &options) {
  const std::uint8_t form = reader.byte(), dlc = reader.byte() & 15;
  const bool extended = (form & 1) != 0, remote = (form & 2) != 0, sent = (form & 4) != 0;
  Line line;
  line.fd = (form & 8) != 0;
  const std::uint64_t id = reader.number(4) & (extended ? 0x1FFFFFFF : 0x7FF);
  if (options.absolute) {
    time += static_cast<std::int64_t>(reader.number(3));
    line.ns = time * 1000;
    line.screen = fmt::format(" ({:010}.{:06})", time / 1'000'000, time % 1'000'000);
  }
  line.screen += "  can0 ";
  const bool fast = line.fd && (form & 16) != 0, passive = line.fd && (form & 32) != 0;
  if (options.columns)
    line.screen +=
        fmt::format(" {} {} {}", sent ? "TX" : "RX", fast ? 'B' : '-', passive ? 'E' : '-');
  line.log = extended ? fmt::format("{:08X}", id) : fmt::format("{:03X}", id);
  line.screen += " " + line.log;
  if (!line.fd) {
    add_classical(reader, dlc, remote, line, options);
    return line;
  }
  line.screen += fmt::format("  [{:02}] ", kFdLengths[dlc]);
  line.log += fmt::format("##{}", options.columns ? (fast ? 1 : 0) + (passive ? 2 : 0) : 0);
  add_data(reader, kFdLengths[dlc], line, options);
  return line;
}

}  // namespace

void fuzz_screen(Bytes input) {
  Reader reader{input};
  const std::uint8_t form = reader.byte();
  const Options options{(form & 1) != 0, (form & 2) != 0, (form & 4) != 0};
  std::int64_t time = 1'000'000;  // us; times from zero on are differences
  std::string text;
  std::vector<Line> frames, others;
  while (!reader.empty()) {
    const Line line = make_line(reader, time, options);
    text += line.screen + "\n";
    (line.fd ? others : frames).push_back(line);
  }
  if (text.empty()) return;
  require(detect_log_format(text, "input") == LogFormat::kCandump, "the form is recognised");
  const CanLog log = parse_candump(text, "input");
  require_valid(log);
  require(log.entries.size() == frames.size() && log.others.size() == others.size(),
          "every line is read");
  for (std::size_t i = 0; i < frames.size(); ++i) {
    require(candump_frame(log.entries[i].frame) == frames[i].log, "the frame that was printed");
    require(log.start_ns + log.entries[i].time / kNanosecond == frames[i].ns,
            "the time that was printed");
  }
  for (std::size_t i = 0; i < others.size(); ++i)
    require(log.others[i].text == others[i].log, "the CAN FD frame that was printed");
}

}  // namespace vericansim::fuzz
