// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The tool on recordings: convert, ids, and the choice of an interface in replay.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"

namespace vericansim {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

Said run_tool(const std::string &arguments) {
  return shell(std::string{VERICAN_BINARY} + " " + arguments + " 2>&1");
}

const std::string kTwoBuses =
    "(0000000100.000000) can0 123#11\n(0000000100.001000) can1 124#22\n"
    "(0000000100.002000) can0 123#12\n";

TEST(ToolRecordings, ConvertReadsStandardInputAndGzip) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  const Said out = run_tool("convert " + log + " - --format pcapng | " + VERICAN_BINARY +
                            " convert - - --format candump 2> /dev/null");
  EXPECT_THAT(out.text, HasSubstr(kTwoBuses));
  ASSERT_EQ(run_tool("convert " + log + " " + (folder / "b.log.gz")).code, 0);
  EXPECT_EQ(shell("gzip -dc " + (folder / "b.log.gz")).text, kTwoBuses);
  EXPECT_THAT(run_tool("ids " + (folder / "b.log.gz")).text, HasSubstr("3 frames, 2 identifiers"));
}

TEST(ToolRecordings, ConvertTellsLossesAndRefusesItsInputAsOutput) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  const Said said = run_tool("convert " + log + " " + (folder / "a.pcap") + " --filter 123:7FF");
  EXPECT_EQ(said.code, 0);
  EXPECT_THAT(said.text, AllOf(HasSubstr("(pcap): 2 frames\n"),
                               HasSubstr("lost: 2 interfaces can0 (none now)\n")));
  const Said same = run_tool("convert " + log + " " + log);
  EXPECT_EQ(same.code, 2);
  EXPECT_THAT(same.text, HasSubstr("is the file of the recording and of the new file"));
  const Said none = run_tool("convert " + log + " " + (folder / "none"));
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.text, HasSubstr("the name tells no format; allowed: --format with one of"));
}

// A filter or a database that fits nothing costs no file that is there.
TEST(ToolRecordings, NoFileIsReplacedByAnEmptyOne) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  const std::string old = folder.file("e.log", "precious");
  const std::string table = folder / "t.csv";
  const Said empty = run_tool("convert " + log + " " + old + " --from '1 s' --ids-csv " + table);
  EXPECT_EQ(empty.code, 1);
  EXPECT_EQ(empty.text, "verican: " + log + ": no frame to convert; not written\n");
  EXPECT_EQ(shell("cat " + old).text, "precious");
  EXPECT_EQ(shell("test -e " + table).code, 1);
  EXPECT_EQ(run_tool("ids " + log + " --from '1 s' --csv " + old).code, 1);
  const std::string others = folder.file("o.log", "(1.0) can0 7FF#\n");
  EXPECT_EQ(run_tool("signals " + others + " --dbc examples/engine.dbc --csv " + old).code, 1);
  EXPECT_EQ(shell("cat " + old).text, "precious");
}

// A Python that loses a frame as the file is written stands for any mistake of a library.
TEST(ToolRecordings, ConvertReplacesNoFileByOneThatIsNotFaithful) {
  if (!has_python_can()) GTEST_SKIP() << "python3-can is not installed";
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  const std::string python =
      folder.file("python",
                  "#!/bin/sh\ncase \"$*\" in *' write '*) sed 1d | /usr/bin/python3 \"$@\";;\n"
                  "*) exec /usr/bin/python3 \"$@\";; esac\n");
  const std::string old = folder.file("a.db", "precious");
  ASSERT_EQ(shell("chmod +x " + python).code, 0);
  const Said said = shell("VERICAN_PYTHON=" + python + " " + VERICAN_BINARY + " convert " + log +
                          " " + old + " 2>&1");
  EXPECT_EQ(said.code, 1);
  EXPECT_EQ(said.text, "verican: " + old + ": read again, its frames are not those of " + log +
                           ": frame 1 is 124#22, not 123#11; not written\n");
  EXPECT_EQ(shell("cat " + old).text, "precious");
}

// One of a thing is told in the singular.
TEST(ToolRecordings, ConvertTellsSingleLosses) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log",
                                      "(0000000100.000000) vcan3 123#11\n"
                                      "(0000000100.0010005) vcan3 20000004#0010000000000000\n"
                                      "(0000000100.002000) vcan3 124##122\n"
                                      "(0000000100.003000) vcan3 124#R\n");
  const Said csv = run_tool("convert " + log + " " + (folder / "a.csv"));
  EXPECT_THAT(csv.text, HasSubstr("lost: 1 CAN FD frame\n"));
  EXPECT_THAT(csv.text, HasSubstr("lost: 3 interfaces vcan3 (none now)\n"));
  const Said trc = run_tool("convert " + log + " " + (folder / "a.trc") + " --to '0 s'");
  EXPECT_THAT(trc.text, HasSubstr("(PCAN-View trc): 1 frame\n"));
  EXPECT_THAT(trc.text, HasSubstr("lost: 1 interface vcan3 (can3 now)\n"));
  const Said all = run_tool("convert " + log + " " + (folder / "b.trc"));
  EXPECT_THAT(all.text, HasSubstr("lost: 1 error message\n"));
  const Said gvret = run_tool("convert " + log + " " + (folder / "b.csv") + " --format gvret");
  EXPECT_THAT(gvret.text, HasSubstr("lost: 1 remote frame\n"));
  EXPECT_THAT(run_tool("ids " + log + " --filter 123:7FF").text,
              HasSubstr(": 1 frame, 1 identifier\n"));
}

TEST(ToolRecordings, ReplayAsksForOneOfSeveralInterfaces) {
  const ScratchFolder folder;
  const std::string replay = "replay --fast " + folder.file("a.log", kTwoBuses);
  const Said asked = run_tool(replay);
  EXPECT_EQ(asked.code, 2);
  EXPECT_THAT(asked.text, HasSubstr("holds several interfaces: can0 (2 frames), can1 (1 frame)"));
  const Said all = run_tool(replay + " --interface all --ids");
  EXPECT_EQ(all.code, 0) << all.text;
  EXPECT_THAT(all.text, HasSubstr("all interfaces as one bus: can0 (2 frames), can1 (1 frame)"));
  // On the bus, one behind the other; the recording's own table keeps times and interfaces.
  EXPECT_THAT(all.text, ContainsRegex("can0       124            1          -.* 0.0001"));
  const auto both = nlohmann::json::parse(run_tool(replay + " --interface all --json").text);
  EXPECT_EQ(both["identifiers"][0]["period_mean_ps"], 2e9);
  EXPECT_EQ(both["identifiers"][1]["interface"], "can1");
  const Said one = run_tool(replay + " --interface can0 --json");
  EXPECT_EQ(one.code, 0) << one.text;
  const auto json = nlohmann::json::parse(one.text);
  EXPECT_EQ(json["frames"], 2);
  EXPECT_EQ(json["identifiers"].size(), 1U);
  EXPECT_EQ(json["identifiers"][0]["count"], 2);
}

// The help asks for an interface only where a command does.
TEST(ToolRecordings, HelpSaysWhereAnInterfaceIsNeeded) {
  for (const char *command : {"replay", "report", "ids", "convert"}) {
    const std::string help = run_tool(std::string(command) + " --help").text;
    const bool asks = command[0] == 'r';
    EXPECT_EQ(help.find("to be told") != std::string::npos, asks) << help;
  }
}

TEST(ToolRecordings, IdsOfNothingFail) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  for (const char *part : {" --from '5 s'", " --filter 7FF:7FF"}) {
    const Said said = run_tool("ids " + log + part);
    EXPECT_EQ(said.code, 1) << part;
    EXPECT_THAT(said.text, HasSubstr("verican: " + log + ": none of its 3 frames is chosen\n"));
  }
  const Said fd = run_tool("ids " + folder.file("fd.log", "(1.0) can0 123##011\n"));
  EXPECT_EQ(fd.code, 1);
  EXPECT_THAT(fd.text, HasSubstr(": holds no classical CAN frame, only 1 CAN FD frame\n"));
}

TEST(ToolRecordings, FiltersAreOfIdentifiersThatThereAre) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  for (const char *filter : {"999999:7FF", "800:7FF", "800~7FF"}) {
    const Said said = run_tool("ids " + log + " --filter " + filter);
    EXPECT_EQ(said.code, 2) << filter;
    EXPECT_THAT(said.text, HasSubstr(std::string{"--filter: '"} + filter +
                                     "' is not allowed; allowed: identifiers up to 7FF, or of "
                                     "eight digits for 29 bits\n"));
  }
  // What follows a filter is the recording.
  EXPECT_THAT(run_tool("ids --filter 123:7FF " + log).text,
              HasSubstr(": 2 frames, 1 identifier\n"));
}

TEST(ToolRecordings, TimesThatGoBackAreTold) {
  const ScratchFolder folder;
  const std::string log = folder.file(
      "a.log", "(2.000000) can0 123#11\n(1.500000) can0 123#12\n(1.000000) can0 123#13\n");
  const std::string warning =
      "verican: warning: " + log + ": frame 2 is 500.000 ms before frame 1\n";
  for (const char *command : {"ids ", "replay "}) {
    const Said said = run_tool(command + log);
    EXPECT_EQ(said.code, 0) << said.text;
    EXPECT_THAT(said.text, HasSubstr(warning));
    const Said quiet =
        shell(VERICAN_BINARY + (" " + std::string{command} + log + " --json") + " 2> /dev/null");
    auto json = nlohmann::json::parse(quiet.text);
    EXPECT_EQ(json["step_back"]["frame"], 2);
    EXPECT_EQ(json["step_back"]["by_ps"], 500'000'000'000);
  }
  const std::string good = folder.file("b.log", kTwoBuses);
  EXPECT_TRUE(nlohmann::json::parse(run_tool("ids --json " + good).text)["step_back"].is_null());
}

TEST(ToolRecordings, APageOfStandardInputNeedsAName) {
  const ScratchFolder folder;
  const Said said =
      shell(VERICAN_BINARY + (" report - < " + folder.file("a.log", kTwoBuses)) + " 2>&1");
  EXPECT_EQ(said.code, 2);
  EXPECT_EQ(said.text,
            "verican: --out: is missing, and standard input has no name; allowed: the page's name, "
            "or -\n");
}

TEST(ToolRecordings, SignalsAreATableOrJson) {
  const ScratchFolder folder;
  const Said said = run_tool("signals " + folder.file("a.log", kTwoBuses) +
                             " --dbc examples/engine.dbc --table --json");
  EXPECT_EQ(said.code, 2);
  EXPECT_THAT(said.text, HasSubstr("--table excludes --json"));
}

TEST(ToolRecordings, IdsAsCsvAndJson) {
  const ScratchFolder folder;
  const std::string log = folder.file("a.log", kTwoBuses);
  const Said csv = shell(std::string{VERICAN_BINARY} + " ids " + log + " --csv - 2> /dev/null");
  EXPECT_THAT(csv.text, HasSubstr("interface,id,extended,remote,count,"));
  EXPECT_THAT(csv.text, HasSubstr("\ncan1,124,0,0,1,"));
  const auto json = nlohmann::json::parse(run_tool("ids --json " + log).text);
  EXPECT_EQ(json["interfaces"]["can0"], 2);
  EXPECT_EQ(json["identifiers"][0]["period_mean_ps"], 2e9);
}

}  // namespace
}  // namespace vericansim
