// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Mistakes that are told in the words of the tool and with their exit code, wherever standard error
// goes and whatever was typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "firmware/tool_run.hpp"
#include "harness/scratch_test.hpp"

namespace {

namespace fs = std::filesystem;
using namespace tb;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ToolMistakes : public vericansim::ScratchTest {
 protected:
  /// Exit code of the tool in a shell, its messages where `redirection` says.
  [[nodiscard]] static int code(const std::string &arguments, const std::string &redirection) {
    const std::string command = VERICAN_BINARY + (" " + arguments + " > /dev/null " + redirection);
    const int status = std::system(("(" + command + ")").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Exit code 2, nothing on stdout, one line.
  static void expect_refused(const std::string &arguments, const std::string &what) {
    const ToolResult result = run_tool(arguments);
    EXPECT_EQ(result.code, 2) << arguments.substr(0, 80);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.error, StartsWith("verican: "));
    EXPECT_THAT(result.error, HasSubstr(what));
    EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << result.error;
    EXPECT_LT(result.error.size(), 500U);
  }
};

TEST_F(ToolMistakes, KeepTheirCodeWhereNobodyIsTold) {
  const std::string log = file_with("a.log", "(1.0) can0 20000004#0000080000000000\n");
  for (const char *redirection : {"2> /dev/full", "2>&-"}) {
    EXPECT_EQ(code("run nofile", redirection), 2) << redirection;
    EXPECT_EQ(code("bittime -b fast", redirection), 2) << redirection;
    EXPECT_EQ(code("bittime -c 8M -b 970k", redirection), 0) << redirection;  // with a warning
    EXPECT_EQ(code("convert " + log + " " + in("b.log") + " --from '1 s'", redirection), 1)
        << redirection;
  }
}

// A file that is opened while standard error is closed gets no messages.
TEST_F(ToolMistakes, GoIntoNoFileThatIsOpen) {
  const std::string log =
      file_with("a.log", "(1.0) can3 123#11\n(1.1) can3 20000004#0000080000000000\n");
  EXPECT_EQ(code("convert " + log + " " + in("open.trc"), "2>&-"), 0);
  EXPECT_EQ(code("convert " + log + " " + in("told.trc"), "2> /dev/null"), 0);
  EXPECT_EQ(slurp(in("open.trc")), slurp(in("told.trc")));
}

TEST_F(ToolMistakes, ValuesAreCitedAsTyped) {
  const std::string whole = " is not allowed; allowed: whole numbers, decimal or hexadecimal as ";
  expect_refused("bittime -b 500k --rows 3.0", "--rows: '3.0'" + whole);
  expect_refused("bittime -b 500k --rows 10x", "--rows: '10x'" + whole);
  expect_refused("bittime -b 500k --rows 1e+999", "--rows: '1e+999'" + whole);
  expect_refused("bittime -b 500k --rows 0x", "--rows: '0x'" + whole);
  expect_refused("bittime -b 500k --rows 99999999999999999999",
                 "--rows: '99999999999999999999' is not allowed; allowed: smaller numbers");
  for (const char *value : {"--cable: '1,5'", "--sample-point: '87.5%'"}) {
    std::string option = value;
    option.replace(option.find(": "), 2, " ");
    expect_refused("bittime -b 500k " + option,
                   std::string(value) + " is not allowed; allowed: a number, as in 12.5");
  }
  expect_refused("run x.yaml --bitrate 1e+400", "Value 1e+400 not in range 1000 to 1000000;");
  expect_refused(
      "bittime -b 1,5M",
      "--bitrate: '1,5M' is not allowed; allowed: bit/s, as in 500000, 500k or '500 kbit/s'");
  expect_refused("run x.yaml --bitrate=1e+400", "Value 1e+400 not in range 1000 to 1000000;");
  expect_refused("replay x.log --nodes 1.0", "Value 1.0 not in range 2 to 64;");
  expect_refused("bittime -b 500k x1e+3", "not expected: x1e+3;");
}

TEST_F(ToolMistakes, UnknownOptionsAreNamedBesideThoseThatThereAre) {
  const std::string of_run = "verican: run: '--candmp' is no option; allowed: --help, --vcd, ";
  for (const char *rest : {" x.log", "=x.log", ""})
    expect_refused(std::string("run x.yaml --candmp") + rest, of_run);
  expect_refused("replay x.log -x 3", "verican: replay: '-x' is no option; allowed: --help, --bus");
  expect_refused("memory --socketcand 1 read 6 0 --fast",
                 "verican: read: '--fast' is no option; allowed: --help, --if, --socketcand, ");
  expect_refused("-q run x.yaml", "verican: '-q' is no option; allowed: --help, --version\n");
}

TEST_F(ToolMistakes, TheHelpThatIsNamedIsThatOfTheCommand) {
  for (const std::string command : {"bittime", "run", "memory", "memory --if can0 read"}) {
    const std::string words = command.substr(0, command.find(" --"));
    const bool inner = words != command;
    expect_refused(command, "; try 'verican " + words + (inner ? " read" : "") + " --help'\n");
  }
  expect_refused("bittime -b 500k 3", "not expected: 3; try 'verican bittime --help'\n");
  expect_refused("", "; try 'verican --help'\n");
}

TEST_F(ToolMistakes, FlagsTakeNoValue) {
  for (const std::string flag : {"--json", "--ids", "--quiet"})
    for (const std::string value : {"3", "no", "maybe"})
      expect_refused("run examples/two-nodes.yaml " + flag + "=" + value,
                     "verican: " + flag + " takes no value; try 'verican run --help'\n");
}

TEST_F(ToolMistakes, OptionsThatWouldSayNothingAreRefused) {
  // Also where the value is the one that holds without the option.
  expect_refused("run examples/two-nodes.yaml --report-frames 200000", "no page is written");
  expect_refused("bittime -b 500k --rows 0", "--rows: '0' is not allowed; allowed: 1 or more");
  expect_refused("bittime -b 500k --rows 3 --json", "--rows excludes --json");
  expect_refused("paper --no-waves --fst", "--fst excludes --no-waves");
  expect_refused("paper --no-waves --out " + in("waves"), "--out excludes --no-waves");
  const std::string log = file_with("a.log", "(1.0) can0 123#11\n");
  for (const std::string command : {"replay ", "report -o x.html "})
    expect_refused(command + log + " --senders 3",
                   "--senders: 3 are more than the 2 nodes; allowed: 1 to 2, or --nodes 3\n");
}

// Nobody could tell which of two files came first.
TEST_F(ToolMistakes, StandardInputIsOneFile) {
  const std::string log = file_with("a.log", "(1.0) can0 123#11\n");
  const std::string dbc =
      file_with("a.dbc", "BO_ 291 A: 8 B\n SG_ S : 0|8@1+ (1,0) [0|0] \"\" B\n");
  for (const char *first : {"-", "/dev/stdin"})
    for (const char *second : {"-", "/proc/self/fd/0"})
      expect_refused(std::string("signals ") + first + " --dbc " + second + " < " + log,
                     "standard input: is the file of log and of --dbc; allowed: of one of them");
  for (const char *command :
       {"run - --signals", "replay - --signals", "report - -o /dev/null", "decode - --json"})
    expect_refused(command + std::string(" --dbc - < ") + log, "standard input: is the file of ");
  expect_refused("signals " + log + " --dbc - --dbc - < " + dbc, "of --dbc and of --dbc");
  expect_refused("replay - --bus - < " + log, "standard input: is the file of log and of --bus");
  const std::string two = "nodes: [{name: a, replay: -}, {name: b, replay: -}]\n";
  expect_refused("run - < " + file_with("two.yaml", two), "standard input: has been read already");
  EXPECT_EQ(run_tool("signals " + log + " --dbc - < " + dbc).code, 0);
  EXPECT_EQ(run_tool("signals - --dbc " + dbc + " < " + log).code, 0);
}

TEST_F(ToolMistakes, AnEmptyFileIsCalledSo) {
  const std::string empty = file_with("empty", "");
  expect_refused("run " + empty, empty + ": is empty; allowed: a map of keys and values\n");
  expect_refused("ids " + empty, empty + ": the file is empty\n");
}

TEST_F(ToolMistakes, WaveformsAreNotTakenForOtherFiles) {
  const std::string vcd = in("a.vcd"), fst = in("a.fst");
  ASSERT_EQ(run_tool("run examples/two-nodes.yaml --vcd " + vcd + " --fst " + fst).code, 0);
  for (const std::string command : {"ids ", "replay ", "convert - x.log < "})
    expect_refused(command + vcd, "is a waveform, no recording of frames; allowed: with 'verican ");
  expect_refused("decode " + fst, fst + ": FST cannot be read; allowed: VCD, as 'fst2vcd'");
}

// What `>` writes in PowerShell.
TEST_F(ToolMistakes, TextOfAnotherEncodingIsCalledSo) {
  const std::string utf16 = file_with("utf16",
                                      "\xFF\xFE(\0"
                                      "1\0)\0");
  const std::string log = file_with("a.log", "(1.0) can0 123#11\n");
  const std::string said = utf16 + ": is text in UTF-16; allowed: UTF-8, as 'iconv -f UTF-16'";
  expect_refused("ids " + utf16, said);
  expect_refused("decode " + utf16, said);
  expect_refused("signals " + log + " --dbc " + utf16, said);
}

TEST_F(ToolMistakes, LongValuesAreShortened) {
  const std::string digits(60'000, '1'), begin = std::string(40, '1') + "...";
  expect_refused("bittime -b 500k --rows " + digits, "--rows: '" + begin + "' is not allowed");
  expect_refused("replay x.log --nodes " + digits, "Value " + begin + " not in range 2 to 64;");
  expect_refused("bittime -b 500k " + digits, "not expected: " + begin + ";");
  expect_refused("bittime -b " + digits, "--bitrate");
}

TEST_F(ToolMistakes, FilesThatCannotBeReadAreNamedWithTheReason) {
  fs::create_symlink("loop", in("loop"));
  const std::string cannot = ": cannot be opened for reading: ";
  for (const std::string command : {"run ", "ids ", "replay ", "decode ", "report -o x.html "}) {
    expect_refused(command + in("loop"), in("loop") + cannot + "Too many levels of symbolic");
    expect_refused(command + std::string(300, 'x'), "xxx" + cannot + "File name too long");
  }
  expect_refused("firmware " + in("loop") + " --bus examples/two-nodes.yaml", in("loop"));
}

// What root may read is tried as another user.
TEST_F(ToolMistakes, FoldersThatAreClosedAreNoInternalError) {
  const std::string log = file_with("a.log", "(1.0) can0 123#11\n");
  fs::create_directory(in("closed"));
  fs::copy_file(log, in("closed/a.log"));
  fs::permissions(in("closed"), ::geteuid() == 0 ? fs::perms::owner_all : fs::perms::none);
  if (::geteuid() != 0) {
    expect_refused("ids " + in("closed/a.log"), "cannot be opened for reading: Permission denied");
    fs::permissions(in("closed"), fs::perms::owner_all);
    return;
  }
  fs::permissions(folder.path(), fs::perms::others_exec | fs::perms::owner_all);
  const std::string as_nobody = "setpriv --reuid=65534 --regid=65534 --clear-groups ";
  if (std::system((as_nobody + VERICAN_BINARY + " --version > /dev/null 2>&1").c_str()) != 0)
    GTEST_SKIP() << "no other user can run the tool";
  const std::string said = temporary(".err");
  const int status = std::system((as_nobody + VERICAN_BINARY + " ids " + in("closed/a.log") +
                                  " 2>&1 > /dev/null | cat > " + said)
                                     .c_str());
  EXPECT_EQ(status, 0);
  EXPECT_EQ(slurp(said), "verican: " + in("closed/a.log") +
                             ": cannot be opened for reading: Permission denied\n");
}

}  // namespace
