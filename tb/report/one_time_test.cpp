// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// One origin of time in logs, captures, waveforms and pages (docs/scenario.md), and one that
// can-utils' tools read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "harness/shell.hpp"
#include "report/report_run.hpp"
#include "session/runner.hpp"
#include "trace/log.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

constexpr double kSecondNs = 1e9;

struct Written {
  ReportPage page;
  CanLog candump, pcap;
  WaveDecodeResult wave;
};

const Written &written() {
  static const Written all = [] {
    Scenario scenario = busy_scenario();
    scenario.outputs.report = report_file(".html");
    scenario.outputs.candump = report_file(".log");
    scenario.outputs.pcap = report_file(".pcap");
    scenario.outputs.vcd = report_file(".vcd");
    (void)run_scenario(scenario, scenario.bitrates.front());
    WaveDecodeOptions decode;
    decode.signal = "bus.can";
    decode.bitrate = 500e3;
    return Written{ReportPage{scenario.outputs.report}, read_log(scenario.outputs.candump),
                   read_log(scenario.outputs.pcap), decode_wave(scenario.outputs.vcd, decode)};
  }();
  return all;
}

/// Absolute, ns.
double stamp(const CanLog &log, std::size_t entry) {
  return static_cast<double>(log.start_ns) +
         static_cast<double>(log.entries[entry].time) / kNanosecond;
}

TEST(OneTime, EveryFrameHasTheSameTimeEverywhere) {
  const Written &all = written();
  const double origin = all.page.meta.at("origin_ns");
  const std::size_t frames = all.page.size("f.start");
  ASSERT_GT(frames, 40U);
  ASSERT_EQ(all.candump.entries.size(), frames);
  ASSERT_EQ(all.pcap.entries.size(), frames);
  std::vector<double> decoded;
  for (const BusEvent &event : all.wave.events)
    if (event.kind == BusEventKind::kFrame)
      decoded.push_back(static_cast<double>(event.start) / kNanosecond);
  ASSERT_EQ(decoded.size(), frames);
  for (std::size_t i = 0; i < frames; ++i) {
    const double bus = all.page.at("f.start", i) + origin;
    EXPECT_NEAR(decoded[i], bus, 1.0) << i;  // the waveform has nanoseconds
    EXPECT_NEAR(stamp(all.pcap, i), bus + kSecondNs, 1.0) << i;
    EXPECT_NEAR(stamp(all.candump, i), bus + kSecondNs, 1000.0) << i;  // microseconds
  }
}

// log2asc takes times below 1 s for "no frame yet": a header for each frame, all at 0.
TEST(OneTime, Log2ascReadsTheLog) {
  if (!has_program("log2asc")) GTEST_SKIP() << "log2asc (can-utils) is not installed";
  const std::string log = report_file(".log");
  Scenario scenario = busy_scenario();
  scenario.outputs.candump = log;
  const std::uint64_t frames = run_scenario(scenario, scenario.bitrates.front()).frames;
  const std::string text = report_file(".asc");
  ASSERT_EQ(std::system(("log2asc -I " + log + " can0 > " + text).c_str()), 0);
  std::istringstream lines{read_text_file(text)};
  std::size_t headers = 0, rows = 0;
  double last = -1;
  for (std::string line; std::getline(lines, line);) {
    headers += line.starts_with("date ") ? 1 : 0;
    if (line.find(" Rx ") == std::string::npos) continue;
    ++rows;
    EXPECT_GT(std::stod(line), last) << line;
    last = std::stod(line);
  }
  EXPECT_EQ(headers, 1U);
  EXPECT_EQ(rows, frames);
}

}  // namespace
}  // namespace vericansim
