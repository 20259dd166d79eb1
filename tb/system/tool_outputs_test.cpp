// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tool writes: whole or not at all, to files, pipes and standard output; never over what
// it reads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"
#include "harness/shell.hpp"
#include "harness/small_disk.hpp"
#include "trace/log.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tb;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using vericansim::ScratchTest;
using Json = nlohmann::json;

const std::string kRun = "run examples/two-nodes.yaml ";
const std::string kFull = ": cannot be written to its end: No space left on device\n";

class ToolOutputs : public ScratchTest {
 protected:
  [[nodiscard]] std::string log() const {
    return file_with("in.log", "(1.000000) can0 123#112233\n(1.001000) can0 456#\n");
  }
  /// Commands that write a table or a recording, each to the path that follows.
  [[nodiscard]] std::vector<std::string> writers() const {
    const std::string database =
        file_with("in.dbc", "BO_ 291 M: 3 a\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" b\n");
    const std::string signals = "--dbc tb/signals/features.dbc --signals-csv ";
    std::vector<std::string> commands{kRun + signals,
                                      "replay " + log() + " " + signals,
                                      "replay " + log() + " --ids-csv ",
                                      "ids " + log() + " --csv ",
                                      "signals " + log() + " --dbc " + database + " --csv ",
                                      "convert " + log() + " " + in("other.log") + " --ids-csv "};
    for (const char *format : {"candump", "pcap", "pcapng", "trc", "gvret"})
      commands.push_back("convert " + log() + " --format " + format + " ");
    if (!vericansim::has_python_can()) return commands;
    for (const char *format : {"asc", "blf", "csv", "sqlite"})
      commands.push_back("convert " + log() + " --format " + format + " ");
    return commands;
  }
  /// Of the two frames of log().
  [[nodiscard]] std::string wave() const {
    EXPECT_EQ(run_tool("replay " + log() + " --vcd " + in("in.vcd")).code, 0);
    return in("in.vcd");
  }
  /// What a shell makes of `command`, in which TOOL is the tool.
  [[nodiscard]] ToolResult shell(std::string command) const {
    for (std::size_t at = 0; (at = command.find("TOOL")) != std::string::npos;)
      command.replace(at, 4, VERICAN_BINARY);
    const int status = std::system(("(" + command + ") 2> " + temporary(".err")).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", slurp(temporary(".err"))};
  }
  /// Exit code 2 and nothing but the message.
  static void expect_refused(const ToolResult &result, const std::string &message) {
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.error, "verican: " + message);
  }
};

// A waveform on standard output is made in a file first.
TEST_F(ToolOutputs, AMissingFolderForTemporaryFilesIsNamed) {
  const std::string name = "TMPDIR: '/no/such' is not allowed; allowed: a folder";
  for (const std::string &command :
       {"replay " + log() + " --fast --fst - -q",
        std::string{"linux --kernel /bin/true --dtb /dev/null --init /bin/true"}}) {
    const ToolResult result = shell("TMPDIR=/no/such TOOL " + command + " > /dev/null");
    EXPECT_EQ(result.code, 2) << command;
    EXPECT_THAT(result.error, StartsWith("verican: " + name));
  }
}

TEST_F(ToolOutputs, EveryOutputToAFullDeviceFails) {
  for (const char *option : {"--vcd", "--fst", "--candump", "--pcap", "--report"})
    expect_refused(run_tool(kRun + option + " /dev/full"), "/dev/full" + kFull);
  expect_refused(run_tool("decode " + wave() + " --candump /dev/full"), "/dev/full" + kFull);
  expect_refused(run_tool("decode " + wave() + " --pcap /dev/full"), "/dev/full" + kFull);
  for (const std::string &command : writers())
    expect_refused(run_tool(command + "/dev/full"), "/dev/full" + kFull);
}

// A disk without a free byte, and an older file on it, which stays.
TEST_F(ToolOutputs, EveryOutputOnAFullDiskFails) {
  const vericansim::test::SmallDisk disk{in("disk"), 64};
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const std::string input = wave(), path = disk.file("out");
  std::ofstream{path} << "old";
  std::ofstream{disk.file("filler")} << std::string(64 << 10, 'x');
  for (const char *option : {"--vcd", "--fst", "--candump", "--pcap", "--report"})
    for (const std::string &command : {kRun, "replay " + log() + " "})
      expect_refused(run_tool(command + option + " " + path), path + kFull);
  expect_refused(run_tool("report " + input + " --bitrate 500k -o " + path), path + kFull);
  for (const char *option : {" --candump ", " --pcap "})
    expect_refused(run_tool("decode " + input + option + path), path + kFull);
  for (const std::string &command : writers())
    expect_refused(run_tool(command + path), path + kFull);
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(disk.files(), 2U);
}

TEST_F(ToolOutputs, APaperThatFindsNoRoomFails) {
  const vericansim::test::SmallDisk disk{in("disk"), 64};
  if (!disk.mounted()) GTEST_SKIP() << disk.why();
  const ToolResult result = run_tool("paper --out " + disk.file("waves"));
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.error, StartsWith("verican: " + disk.file("waves/fig")));
  EXPECT_THAT(result.error, EndsWith(kFull));
}

TEST_F(ToolOutputs, StandardOutputThatIsFullFails) {
  for (const std::string &command :
       {kRun, kRun + "--json", "replay " + log(), "replay " + log() + " --json", "decode " + wave(),
        std::string{"bittime -b 500k"}, std::string{"bittime -b 500k --json"},
        std::string{"--help"}, std::string{"run --help"}, std::string{"--version"},
        kRun + "--candump -", kRun + "--report -"})
    expect_refused(shell("TOOL " + command + " > /dev/full"), "standard output" + kFull);
}

// A file above the limit of its size, and an older one, which stays.
TEST_F(ToolOutputs, AFileAboveTheLimitOfTheShellIsNoticed) {
  const std::string path = file_with("out", "old");
  const std::string limited = "ulimit -f 1; TOOL " + kRun;
  for (const char *option : {"--vcd ", "--fst ", "--report "})
    expect_refused(shell(limited + option + path + " > /dev/null"),
                   path + ": cannot be written to its end: File too large\n");
  EXPECT_EQ(slurp(path), "old");
  EXPECT_EQ(files(), 1U);
  std::ofstream{in("printed")} << std::string(1 << 10, '-');
  expect_refused(shell(limited + ">> " + in("printed")),
                 "standard output: cannot be written to its end: File too large\n");
}

// Who reads only the first lines wants no message; what was written aside is gone.
TEST_F(ToolOutputs, AReaderThatGoesEndsItSilently) {
  const ToolResult result = shell("{ TOOL " + kRun + "--vcd - --candump " + in("a.log") + " 2> " +
                                  in("err") + "; echo $? > " + in("code") + "; } | true");
  EXPECT_EQ(slurp(in("code")), "141\n");
  EXPECT_EQ(slurp(in("err")), "");
  EXPECT_EQ(files(), 2U);
}

TEST_F(ToolOutputs, MinusIsStandardOutput) {
  ASSERT_EQ(run_tool(kRun + "--candump " + in("a.log") + " --vcd " + in("a.vcd") + " --pcap " +
                     in("a.pcap"))
                .code,
            0);
  for (const auto &[option, name] :
       {std::pair{"--candump", "a.log"}, {"--vcd", "a.vcd"}, {"--pcap", "a.pcap"}}) {
    const ToolResult result = run_tool(kRun + option + " -");
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.out, slurp(in(name)));
    EXPECT_THAT(result.error, HasSubstr("frames 13"));  // the summary
  }
  const ToolResult page = run_tool(kRun + "--report - --json");
  EXPECT_TRUE(page.out.starts_with("<!DOCTYPE html>"));
  EXPECT_TRUE(page.out.ends_with("</html>\n"));
  EXPECT_EQ(Json::parse(page.error)["runs"][0]["frames"], 13);
  const ToolResult fst = run_tool("replay " + log() + " --fst -");
  EXPECT_EQ(fst.out.substr(0, 9), std::string("\0\0\0\0\0\0\0\x01\x49", 9));  // its header block
  const ToolResult decoded = run_tool("decode " + in("a.vcd") + " --candump - --quiet");
  EXPECT_EQ(std::count(decoded.out.begin(), decoded.out.end(), '\n'), 13);
  EXPECT_EQ(decoded.error, "");
}

TEST_F(ToolOutputs, GzIsCompressed) {
  ASSERT_EQ(run_tool(kRun + "--candump " + in("a.log") + " --vcd " + in("a.vcd") + " --report " +
                     in("a.html"))
                .code,
            0);
  ASSERT_EQ(run_tool(kRun + "--candump " + in("b.log.gz") + " --vcd " + in("b.vcd.gz") +
                     " --pcap " + in("b.pcap.gz"))
                .code,
            0);
  for (const char *name : {"b.log", "b.vcd", "b.pcap"})
    ASSERT_EQ(std::system(("gunzip " + in(name) + ".gz").c_str()), 0);
  EXPECT_EQ(slurp(in("b.log")), slurp(in("a.log")));
  EXPECT_EQ(slurp(in("b.vcd")), slurp(in("a.vcd")));
  EXPECT_EQ(vericansim::read_log(in("b.pcap")).entries.size(), 13U);
}

TEST_F(ToolOutputs, NoInputIsWrittenOver) {
  const std::string scenario = file_with("a.yaml", slurp("examples/two-nodes.yaml"));
  const std::string recorded = log(), text = slurp(recorded);
  fs::create_hard_link(recorded, in("hard.log"));
  fs::create_symlink("in.log", in("soft.log"));
  const std::string refused = " is the file of the log and of --vcd; allowed: a file of its own\n";
  for (const std::string &name :
       {in("in.log"), in("hard.log"), in("soft.log"), in("./in.log"),
        in("../" + fs::path{folder.path()}.filename().string() + "/in.log")})
    expect_refused(run_tool("replay " + recorded + " --vcd " + name), name + ":" + refused);
  expect_refused(
      run_tool("report " + recorded + " -o " + in("hard.log")),
      in("hard.log") + ": is the file of the log and of --report; allowed: a file of its own\n");
  expect_refused(run_tool("run " + scenario + " --candump " + scenario),
                 scenario +
                     ": is the file of the scenario and of --candump; allowed: a file of its "
                     "own\n");
  EXPECT_EQ(slurp(recorded), text);
}

// A database is an input, too, whichever way it was named.
TEST_F(ToolOutputs, NoDatabaseIsWrittenOver) {
  const std::string text = slurp("tb/signals/features.dbc"), dbc = file_with("a.dbc", text);
  const std::string waveform = wave();
  for (const auto &[command, role] : {std::pair{kRun + "--signals --candump ", "--candump"},
                                      {"replay " + log() + " --signals --vcd ", "--vcd"},
                                      {"report examples/two-nodes.yaml -o ", "--report"},
                                      {"report " + log() + " -o ", "--report"},
                                      {"report " + waveform + " --bitrate 500k -o ", "--report"},
                                      {"decode " + waveform + " --pcap ", "--pcap"},
                                      {"signals " + log() + " --csv ", "--csv"}})
    expect_refused(
        run_tool(command + dbc + " --dbc " + dbc),
        dbc + ": is the file of the database and of " + role + "; allowed: a file of its own\n");
  EXPECT_EQ(slurp(dbc), text);
}

// What fails leaves nothing, also what could be written before.
TEST_F(ToolOutputs, AConversionWhoseTableCannotBeWrittenIsNone) {
  const std::string recorded = log();
  const std::size_t before = files();
  for (const std::string table : {"/no/such/folder/ids.csv", "/dev/full"}) {
    const ToolResult result =
        run_tool("convert " + recorded + " " + in("new.pcap") + " --ids-csv " + table);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(files(), before) << table;
  }
}

TEST_F(ToolOutputs, NoRecordingIsWrittenOverByATable) {
  const std::string recorded = log(), text = slurp(recorded);
  const std::string refused =
      recorded + ": is the file of the recording and of --csv; allowed: a file of its own\n";
  expect_refused(run_tool("ids " + recorded + " --csv " + recorded), refused);
  expect_refused(
      run_tool("decode " + wave() + " --pcap " + in("in.vcd")),
      in("in.vcd") + ": is the file of the waveform and of --pcap; allowed: a file of its own\n");
  EXPECT_EQ(slurp(recorded), text);
}

TEST_F(ToolOutputs, NoFileIsWrittenTwice) {
  const auto refused = [](const std::string &path, const std::string &first) {
    return path + ": is the file of " + first + " and of --pcap; allowed: a file of its own\n";
  };
  fs::create_symlink("new", in("link"));  // to a file that is not there yet
  expect_refused(run_tool(kRun + "--candump " + in("new") + " --pcap " + in("new")),
                 refused(in("new"), "--candump"));
  expect_refused(run_tool(kRun + "--vcd " + in("new") + " --pcap " + in("link")),
                 refused(in("link"), "--vcd"));
  // A bare name, in the folder from which the tool is run.
  expect_refused(run_tool(kRun + "--candump tool_outputs.new --pcap ./tool_outputs.new"),
                 refused("./tool_outputs.new", "--candump"));
  EXPECT_FALSE(fs::remove("tool_outputs.new"));
  expect_refused(run_tool(kRun + "--candump - --pcap /dev/stdout"),
                 refused("standard output", "--candump"));
  EXPECT_EQ(files(), 1U);
  EXPECT_EQ(run_tool(kRun + "--candump /dev/null --pcap /dev/null").code, 0);
}

// A viewer takes the name's word for the format.
TEST_F(ToolOutputs, AWaveformIsNotNamedAsTheOtherKind) {
  for (const auto &[option, name, other] : {std::tuple{"--vcd", "a.fst", "--fst"},
                                            {"--vcd", "a.fst.gz", "--fst"},
                                            {"--fst", "a.vcd", "--vcd"}})
    expect_refused(run_tool(kRun + option + " " + in(name)),
                   in(name) + ": is named as the waveforms of " + other + "; allowed for " +
                       option + ": other endings\n");
  EXPECT_EQ(files(), 0U);
  EXPECT_EQ(run_tool(kRun + "--vcd " + in("fst")).code, 0);
}

TEST_F(ToolOutputs, SeveralBitRatesHaveSeveralFiles) {
  std::string text = slurp("examples/two-nodes.yaml");
  text.replace(text.find("500k"), 4, "[500k, 250k]");
  const std::string run = "run " + file_with("a.yaml", text) + " --duration '5 ms' --candump ";
  fs::create_directories(in("b.d"));
  EXPECT_EQ(run_tool(run + in("b.d/bus")).code, 1);  // fewer frames than expected
  EXPECT_EQ(run_tool(run + in("bus.log.gz")).code, 1);
  for (const char *name : {"b.d/bus-500k", "b.d/bus-250k", "bus-500k.log.gz", "bus-250k.log.gz"})
    EXPECT_TRUE(fs::exists(in(name))) << name;
  // A device has no second name.
  EXPECT_EQ(run_tool(run + "/dev/null").code, 1);
  EXPECT_FALSE(fs::exists("/dev/null-500k"));
  expect_refused(run_tool(run + "-"),
                 "-: cannot take the outputs of several bit rates; allowed: a file's name, or one "
                 "bit rate\n");
}

TEST_F(ToolOutputs, QuietPrintsErrorsAlone) {
  for (const std::string &command :
       {kRun, "replay " + log(), "decode " + wave(), "report " + log() + " -o " + in("a.html"),
        "paper --out " + in("waves")}) {
    const ToolResult result = run_tool(command + " --quiet");
    EXPECT_EQ(result.code, 0) << command;
    EXPECT_EQ(result.out + result.error, "") << command;
  }
  const ToolResult failed = run_tool(kRun + "-q --duration '10 ms'");
  EXPECT_EQ(failed.code, 1);
  EXPECT_EQ(failed.out + failed.error, "");
  expect_refused(run_tool("run -q /no/such.yaml"), "/no/such.yaml: no such file\n");
  EXPECT_EQ(run_tool(kRun + "--quiet --json").code, 2);
}

}  // namespace
