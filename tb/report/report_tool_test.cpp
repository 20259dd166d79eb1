// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Reports from the command line: every command that writes one, names, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "firmware/tool_run.hpp"
#include "model/frame_codec.hpp"
#include "paper/paper.hpp"
#include "report/page_template.hpp"
#include "report/report_run.hpp"
#include "simulation/wave_report.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

std::size_t count(const std::string &text, const std::string &part) {
  std::size_t number = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++number;
  return number;
}

std::string file_with(const std::string &ending, const std::string &text) {
  const std::string path = report_file(ending);
  std::ofstream(path) << text;
  return path;
}

void expect_refused(const std::string &arguments, const std::string &what) {
  const tb::ToolResult run = tb::run_tool(arguments);
  EXPECT_EQ(run.code, 2) << arguments;
  EXPECT_THAT(run.error, HasSubstr(what));
  EXPECT_EQ(count(run.error, "\n"), 1U) << run.error;
}

TEST(ReportTool, RunWritesOnePageForEachBitRate) {
  const std::string scenario = file_with(".yaml", R"(
bitrate: [125k, 1M]
duration: 3 ms
nodes: [{name: a}, {name: b}]
traffic: [{node: a, name: m, id: 0x10, period: 1 ms}]
)");
  const std::string page = report_file(".html");
  EXPECT_EQ(tb::run_tool("run " + scenario + " --report " + page).code, 0);
  const std::string stem = page.substr(0, page.size() - 5);
  EXPECT_EQ(ReportPage{stem + "-125k.html"}.meta.at("bitrate"), 125000);
  EXPECT_EQ(ReportPage{stem + "-1000k.html"}.meta.at("bitrate"), 1000000);
  EXPECT_EQ(tb::run_tool("report " + scenario + " -b 250k -o " + page).code, 0);
  EXPECT_EQ(ReportPage{page}.size("f.start"), 3U);
}

// The page is the template but for the two elements; no name can end one of them.
TEST(ReportTool, NamesCannotLeaveTheirElement) {
  const std::string name = "</script><!--<script>&\\\"\xE2\x82\xAC";
  const std::string page = report_file(".html");
  const std::string scenario = file_with(".yaml", R"(
name: '</script><!--<script>&\"€'
outputs: {report: )" + page + R"(}
duration: 2 ms
nodes: [{name: '</script>'}, {name: b}]
traffic: [{node: b, name: '<!--', id: 0x10, period: 1 ms}]
)");
  ASSERT_EQ(tb::run_tool("run " + scenario).code, 0);
  const ReportPage read{page};
  EXPECT_EQ(read.meta.at("title"), name);
  EXPECT_EQ(read.meta.at("nodes").at(0).at("name"), "</script>");
  EXPECT_EQ(read.meta.at("messages").at(0).at("name"), "<!--");
  const std::string empty{page_template()};
  EXPECT_EQ(count(read.html, "</script"), count(empty, "</script") + 2);
  EXPECT_EQ(count(read.html, "<!--"), count(empty, "<!--") - 2);
  EXPECT_TRUE(read.html.starts_with(empty.substr(0, empty.find(kMetaPlace))));
  EXPECT_TRUE(read.html.ends_with(empty.substr(empty.find(kDataPlace) + kDataPlace.size())));
}

// On the page a database takes the place of another one of its name.
TEST(ReportTool, DatabasesOfOneNameKeepTheirFolders) {
  const std::string folder = report_file(".dbcs"), page = report_file(".html");
  std::string options;
  int id = 291;
  for (const char *name : {"1/can.dbc", "2/can.dbc", "2/other.dbc"}) {
    const std::filesystem::path path = std::filesystem::path{folder} / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream{path} << "BO_ " << id++ << " M: 8 X\n";
    options += " --dbc " + path.string();
  }
  const std::string log = file_with(".log", "(1.0) can0 123#11\n");
  ASSERT_EQ(tb::run_tool("report " + log + options + " -o " + page).code, 0);
  const auto databases = ReportPage{page}.meta.at("databases");
  ASSERT_EQ(databases.size(), 3U);
  EXPECT_EQ(databases[0].at("name"), folder + "/1/can.dbc");
  EXPECT_EQ(databases[1].at("name"), folder + "/2/can.dbc");
  EXPECT_EQ(databases[2].at("name"), "other.dbc");
}

TEST(ReportTool, AnUnwritablePathIsRefusedBeforeTheRun) {
  const std::string nowhere = report_file(".folder") + "/no/page.html";
  expect_refused("run examples/two-nodes.yaml --report " + nowhere, "cannot be opened for writing");
  expect_refused("report examples/two-nodes.yaml -o " + nowhere, "cannot be opened for writing");
  expect_refused("run examples/two-nodes.yaml --report /dev/full", "cannot be written to its end");
  expect_refused("paper --no-waves --report /dev/null/pages", "cannot be created");
  expect_refused("run examples/two-nodes.yaml --report-frames 0", "report-frames");
}

TEST(ReportTool, TheLengthOfNoPageIsRefused) {
  const std::string frames = " --report-frames 5", none = "--report-frames: no page is written; ";
  expect_refused("run examples/two-nodes.yaml" + frames, none);
  expect_refused("replay examples/boat.log" + frames, none);
  expect_refused("replay examples/boat.log --bus examples/two-nodes.yaml" + frames, none);
}

TEST(ReportTool, InputsThatCannotBeShownAreRefused) {
  expect_refused("report " + report_file(".none.yaml"), "no such file");
  expect_refused("report " + report_file(".none.vcd"), "no such file");
  expect_refused("report " + file_with(".fst", "x"), "FST cannot be read");
  expect_refused("report " + file_with(".bin", "hello"), "unknown kind of log");
}

// A recorded waveform gives the frames of the run that it is a recording of, an error frame
// included.
TEST(ReportTool, AWaveformShowsTheSameFrames) {
  const std::string wave = report_file(".vcd"), page = report_file(".wave.html");
  Scenario scenario = disturbed_scenario();
  scenario.faults.erase(scenario.faults.begin());  // noise at single nodes
  scenario.faults.pop_back();
  // Ten dominant bits in a frame: an error frame that everybody sees.
  Window &window = scenario.faults.front().window;
  window.to = window.from + 40 * kMicrosecond;
  scenario.outputs.vcd = wave;
  const ReportedRun run = run_with_report(scenario);
  ASSERT_EQ(tb::run_tool("report " + wave + " -s bus.can -o " + page).code, 0);
  const ReportPage heard{page};
  ASSERT_EQ(heard.size("f.start"), run.page.size("f.start"));
  for (std::size_t i = 0; i < heard.size("f.start"); ++i) {
    EXPECT_EQ(heard.frame(i), run.page.frame(i));
    EXPECT_EQ(heard.at("f.sender", i), 255);
    EXPECT_NEAR(heard.at("f.start", i) - heard.at("f.start", 0),
                run.page.at("f.start", i) - run.page.at("f.start", 0), 1.1);
  }
  EXPECT_EQ(heard.meta.at("summary").at("error_frames"), run.report.error_frames);
  EXPECT_GT(run.report.error_frames, 0U);
  EXPECT_EQ(heard.meta.at("nodes").at(0).at("name"), "listener");
  // The first frame begins with the first edge of the wire, behind its initial level.
  EXPECT_NEAR(heard.at("f.start", 0), heard.edges("wire").at(1).first, 1.1);
  // A listener drives nothing and shows the bits of every frame.
  EXPECT_EQ(heard.size("tx0"), 0U);
  EXPECT_NE(heard.at("f.segment", 0), 4294967295.0);
}

/// A frame behind twelve recessive bits, acknowledged; the waveform ends `behind` bits after it.
Wave wave_of(const Frame &frame, int behind) {
  constexpr Time kBit = 2 * kMicrosecond, kRest = 12;
  const EncodedFrame encoded = encode_frame(frame);
  Wave wave{"can", 500e3, 0, {{0, Level::kRecessive}}};
  for (std::size_t i = 0; i < encoded.bits.size(); ++i) {
    const bool ack = i == encoded.stuffed_length + 1;
    const Level level = ack ? Level::kDominant : encoded.bits[i].level;
    if (level != wave.changes.back().second)
      wave.changes.emplace_back((kRest + static_cast<Time>(i)) * kBit, level);
  }
  wave.end = (kRest + static_cast<Time>(encoded.bits.size()) + behind) * kBit;
  return wave;
}

// Time and load of its page are those of the recording. Where the end of the last frame is cut off,
// the page lasts until the intermission behind it is over.
TEST(ReportTool, AWaveformsPageIsAsLongAsTheWaveform) {
  const Frame frame{.id = 0x123, .dlc = 2, .data = {0x00, 0xFF}};
  const double bits = static_cast<double>(encode_frame(frame).bits.size());
  for (const int behind : {20, 3, 1, 0, -1, -7}) {
    const std::string page = report_file(".html");
    const WaveReport report = report_wave(wave_of(frame, behind), "wave", {.report = page}, {});
    EXPECT_EQ(report.frames, 1U) << behind;
    const ReportPage read{page};
    const double length = 12 + bits + (behind >= 0 ? behind : 3);
    EXPECT_NEAR(read.meta.at("duration_ns").get<double>() / 2000, length, 1.1) << behind;
    EXPECT_NEAR(read.meta.at("summary").at("load").get<double>(), (bits + 3) / length, 0.02)
        << behind;
  }
}

// A recorder that counts from elsewhere: what it has not recorded is no time of a bus at rest.
TEST(ReportTool, AWaveformMayBeginAtAnyTime) {
  const Frame frame{.id = 0x123, .dlc = 2, .data = {0x00, 0xFF}};
  Wave wave = wave_of(frame, 3);
  const double length = static_cast<double>(wave.end) / kNanosecond;
  for (auto &change : wave.changes) change.first += kSecond;
  wave.end += kSecond;
  const std::string page = report_file(".html");
  EXPECT_EQ(report_wave(wave, "wave", {.report = page}, {}).frames, 1U);
  const ReportPage read{page};
  EXPECT_NEAR(read.meta.at("duration_ns").get<double>(), length, 2.0);
  EXPECT_EQ(read.meta.at("origin_ns"), 1e9);
  ASSERT_EQ(read.size("f.start"), 1U);
  EXPECT_NEAR(read.at("f.start", 0), 24'000.0, 2.0);
}

TEST(ReportTool, ALogIsSentThroughCores) {
  const std::string page = report_file(".html");
  const std::string log = file_with(".log", "(0.000000) can0 123#1122\n(0.001000) can0 7FF#R3\n");
  ASSERT_EQ(tb::run_tool("report " + log + " -b 250k -n 3 -o " + page).code, 0);
  const ReportPage read{page};
  ASSERT_EQ(read.size("f.start"), 2U);
  EXPECT_EQ(read.frame(0), (Frame{.id = 0x123, .dlc = 2, .data = {0x11, 0x22}}));
  EXPECT_EQ(read.frame(1), (Frame{.id = 0x7FF, .remote = true, .dlc = 3}));
  EXPECT_EQ(read.meta.at("nodes").size(), 3U);
  EXPECT_EQ(read.meta.at("bitrate"), 250000);
  EXPECT_EQ(tb::run_tool("replay " + log + " --report " + page).code, 0);
  EXPECT_EQ(ReportPage{page}.size("f.start"), 2U);
}

// As replay says it.
TEST(ReportTool, ALogOfWhichNothingIsSentFailsWithTheReason) {
  const std::string page = report_file(".html");
  const std::string fd = file_with(".log", "(0.000000) can0 123##1112233\n");
  const tb::ToolResult none = tb::run_tool("report " + fd + " -o " + page);
  EXPECT_EQ(none.code, 1);
  EXPECT_THAT(none.out, HasSubstr("FAIL  the recording holds no classical CAN frame"));
  const std::string log = file_with(".log", "(0.000000) can0 123#1122\n");
  const tb::ToolResult filtered = tb::run_tool("report " + log + " --filter 7FF:7FF -o " + page);
  EXPECT_EQ(filtered.code, 1);
  EXPECT_THAT(filtered.out, HasSubstr("FAIL  the recording holds no classical CAN frame"));
}

// Each page has the statements of its experiment, with moments that lie in it.
TEST(ReportTool, ThePaperHasAPageForEachExperiment) {
  const std::string folder = report_file(".pages");
  ASSERT_EQ(tb::run_tool("paper --no-waves --report " + folder).code, 0);
  const auto experiments = run_paper({.page_folder = report_file(".again")});
  ASSERT_EQ(experiments.size(), 5U);
  for (const PaperExperiment &experiment : experiments) {
    const std::string name = experiment.files.page.substr(experiment.files.page.rfind('/'));
    const ReportPage page{folder + name};
    const auto &statements = page.meta.at("statements");
    const double end = page.meta.at("duration_ns");
    ASSERT_EQ(statements.size(), experiment.checks.size());
    for (std::size_t i = 0; i < statements.size(); ++i) {
      EXPECT_EQ(statements.at(i).at("reported"), experiment.checks[i].reported);
      EXPECT_EQ(statements.at(i).at("seen"), experiment.checks[i].seen);
      EXPECT_EQ(statements.at(i).at("ok"), true);
      EXPECT_GT(statements.at(i).at("time_ns"), 0.0);
      EXPECT_LT(statements.at(i).at("time_ns"), end);
    }
    EXPECT_GE(page.meta.at("view").at("from_ns"), 0.0);
    EXPECT_LE(page.meta.at("view").at("to_ns"), end);
    EXPECT_LT(page.meta.at("view").at("from_ns"), page.meta.at("view").at("to_ns"));
  }
}

// Figure 13: the loss; 14 to 16: 16 active flags, then passive ones, which the wire does not show;
// 17, 18: bus-off and back.
TEST(ReportTool, ThePapersPagesShowItsFigures) {
  const std::string folder = report_file(".pages");
  ASSERT_EQ(tb::run_tool("paper --no-waves --report " + folder).code, 0);
  const ReportPage arbitration{folder + "/fig13-arbitration.html"};
  ASSERT_EQ(arbitration.size("l.time"), 1U);
  EXPECT_EQ(arbitration.at("l.time", 0), arbitration.meta.at("statements").at(0).at("time_ns"));
  EXPECT_EQ(arbitration.at("l.index", 0), 10);  // the identifiers differ in ID18
  const ReportPage missing{folder + "/fig14-16-missing-ack.html"};
  for (std::size_t e = 0; e < missing.size("e.kind"); ++e) {
    EXPECT_EQ(missing.at("e.kind", e), e < 16 ? 0 : 2) << e;
    EXPECT_THAT(missing.cause(e).first, HasSubstr("no node acknowledged the frame"));
  }
  EXPECT_GT(missing.size("e.kind"), 20U);
  const ReportPage off{folder + "/fig17-18-bus-off.html"};
  std::vector<double> states;
  for (const double state : off.column("c.state"))
    if (states.empty() || states.back() != state) states.push_back(state);
  EXPECT_EQ(states, (std::vector<double>{0, 1, 2, 0}));
}

}  // namespace
}  // namespace vericansim
