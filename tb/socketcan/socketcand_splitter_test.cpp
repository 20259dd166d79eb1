// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The splitter: the same commands however the bytes were cut; rubbish is named once.
#include "bridge/socketcand_splitter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Commands as they are, complaints with a '!' in front.
std::vector<std::string> drain(CommandSplitter &splitter) {
  std::vector<std::string> all;
  while (const auto item = splitter.next()) all.push_back((item->good ? "" : "!") + item->text);
  return all;
}

std::vector<std::string> split(const std::string &bytes) {
  CommandSplitter splitter;
  splitter.feed(bytes);
  return drain(splitter);
}

TEST(SocketcandSplitter, TwoCommandsInOneSegment) {
  EXPECT_THAT(split("< open can0 >< rawmode >"), ElementsAre(" open can0 ", " rawmode "));
}

TEST(SocketcandSplitter, BlanksAndLineFeedsBetweenCommandsAreNothing) {
  EXPECT_THAT(split("\r\n <echo>\t\n< echo >\n"), ElementsAre("echo", " echo "));
}

TEST(SocketcandSplitter, LineFeedInACommandIsABlank) {
  EXPECT_THAT(split("<send\n1\t0>"), ElementsAre("send 1 0"));
}

TEST(SocketcandSplitter, ACommandWaitsForItsEnd) {
  CommandSplitter splitter;
  splitter.feed("< ec");
  EXPECT_EQ(splitter.next(), std::nullopt);
  splitter.feed("ho >");
  EXPECT_THAT(drain(splitter), ElementsAre(" echo "));
}

TEST(SocketcandSplitter, RubbishIsNamedOnceAndSkipped) {
  EXPECT_THAT(split("xyz 12 > > < echo >"),
              ElementsAre("!text outside of a command: 'x'; allowed: commands, each in angle "
                          "brackets",
                          " echo "));
}

TEST(SocketcandSplitter, ACommandInsideACommandEndsTheFirst) {
  EXPECT_THAT(split("< send 1 < echo >"),
              ElementsAre("!a command began inside ' send 1 '", " echo "));
}

TEST(SocketcandSplitter, BytesThatAreNotAsciiSpoilOneCommand) {
  for (const char byte : {'\0', '\x01', '\x1B', '\x7F', '\x80', '\xC3', '\xFF'})
    EXPECT_THAT(
        split(std::string("< open c") + byte + "n >< echo >"),
        ElementsAre(HasSubstr("!a command holds a byte that is not printable ASCII"), " echo "));
}

TEST(SocketcandSplitter, TheLongestCommandPasses) {
  const std::string text(CommandSplitter::kLongest, 'a');
  EXPECT_THAT(split("<" + text + ">"), ElementsAre(text));
}

TEST(SocketcandSplitter, OneCharacterMoreIsTooLong) {
  const std::string text(CommandSplitter::kLongest + 1, 'a');
  EXPECT_THAT(split("<" + text + ">< echo >"),
              ElementsAre(HasSubstr("!a command is longer than 8192 characters"), " echo "));
}

TEST(SocketcandSplitter, AnEndlessCommandTakesNoMemory) {
  CommandSplitter splitter;
  splitter.feed("<");
  for (int i = 0; i < 1000; ++i) {
    splitter.feed(std::string(4096, 'a'));
    drain(splitter);
    ASSERT_EQ(splitter.waiting(), 0U);
  }
}

TEST(SocketcandSplitter, AnEndInsideACommandIsAComplaint) {
  CommandSplitter splitter;
  splitter.feed("< echo >< send 1");
  splitter.finish();
  EXPECT_THAT(drain(splitter), ElementsAre(" echo ", "!the connection ended inside a command"));
}

class SocketcandSplitterFuzz : public testing::TestWithParam<unsigned> {};

// Bytes that are likely to mean something, and all others.
std::string random_bytes(std::mt19937 &random, std::size_t count) {
  static const std::string kLikely = "<<<>>> \n send open can0 echo 123 8 FF";
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i)
    bytes += random() % 4 == 0 ? static_cast<char>(random()) : kLikely[random() % kLikely.size()];
  return bytes;
}

TEST_P(SocketcandSplitterFuzz, CutsDoNotMatter) {
  std::mt19937 random(GetParam());
  const std::string bytes = random_bytes(random, 20'000);
  const auto whole = split(bytes);
  EXPECT_GT(whole.size(), 1000U);
  CommandSplitter splitter;
  std::vector<std::string> pieces;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t size = 1 + random() % 40;
    splitter.feed(std::string_view(bytes).substr(at, size));
    at += size;
    if (random() % 3 == 0) continue;
    for (auto &item : drain(splitter)) pieces.push_back(std::move(item));
  }
  for (auto &item : drain(splitter)) pieces.push_back(std::move(item));
  EXPECT_EQ(pieces, whole);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SocketcandSplitterFuzz, testing::Range(1U, 9U));

}  // namespace
}  // namespace vericansim
