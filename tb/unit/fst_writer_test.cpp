// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FST files: GTKWave's own reader must give back what was written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <thread>

#include "harness/scratch_folder.hpp"
#include "harness/shell.hpp"
#include "trace/bus_wave.hpp"
#include "trace/input_error.hpp"
#include "trace/log.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

TEST(FstWriter, Fst2vcdGivesTheSameChanges) {
  if (!has_program("fst2vcd")) GTEST_SKIP() << "fst2vcd (GTKWave) is not installed";
  const std::string path = ::testing::TempDir() + "w.fst";
  {
    const auto sink = open_fst(path);
    const auto can = sink->add_wire("bus", "can", 1);
    const auto field = sink->add_text("node", "field");
    const auto tec = sink->add_wire("node", "tec", 9);
    sink->start();
    sink->set(0, can, 1);
    sink->set(2'000'001, can, 0);
    sink->set(2'000'001, field, std::string_view{"ERROR_FLAG"});
    sink->set(3'000'000, tec, 258);
    sink->finish(9'000'000);
  }
  ASSERT_EQ(std::system(("fst2vcd " + path + " > " + path + ".vcd").c_str()), 0);
  const std::string text = read_text_file(path + ".vcd");
  EXPECT_THAT(text, HasSubstr("1ps"));
  EXPECT_THAT(text, HasSubstr("#2000001\n0!"));
  EXPECT_THAT(text, HasSubstr("sERROR_FLAG"));
  EXPECT_THAT(text, HasSubstr("#3000000\nb100000010"));
}

// What cannot be written by name, or not as it is: the same bytes.
TEST(FstWriter, ToAPipeAndCompressed) {
  const ScratchFolder folder;
  const auto write = [](const std::string &path) {
    const auto sink = open_fst(path);
    const auto can = sink->add_wire("bus", "can", 1);
    sink->start();
    for (Time time = 0; time < 100; ++time) sink->set(time, can, time & 1);
    sink->finish(100);
  };
  const auto text_of = [](const std::string &path) {
    EXPECT_EQ(std::system(("fst2vcd " + path + " > " + path + ".vcd").c_str()), 0);
    const std::string text = read_text_file(path + ".vcd");
    return text.substr(text.find("$timescale"));  // behind the date
  };
  write(folder / "file");
  write(folder / "packed.gz");
  ASSERT_EQ(std::system(("gunzip " + (folder / "packed.gz")).c_str()), 0);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::thread reader{[&] {
    EXPECT_EQ(std::system(("cat " + (folder / "pipe") + " > " + (folder / "piped")).c_str()), 0);
  }};
  write(folder / "pipe");
  reader.join();
  if (!has_program("fst2vcd")) GTEST_SKIP() << "fst2vcd (GTKWave) is not installed";
  const std::string expected = text_of(folder / "file");
  EXPECT_THAT(expected, HasSubstr("#99\n1!"));
  EXPECT_EQ(text_of(folder / "packed"), expected);
  EXPECT_EQ(text_of(folder / "piped"), expected);
}

TEST(FstWriter, AFolderThatIsNotThere) {
  EXPECT_THROW(static_cast<void>(open_fst("/no/such/folder/a.fst")), InputError);
}

TEST(OpenWave, KnowsTheSuffixes) {
  EXPECT_NE(open_wave(::testing::TempDir() + "s.vcd"), nullptr);
  EXPECT_NE(open_wave(::testing::TempDir() + "s.fst"), nullptr);
  EXPECT_THROW(static_cast<void>(open_wave("s.txt")), InputError);
}

}  // namespace
}  // namespace vericansim
