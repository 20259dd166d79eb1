// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Real recordings through whole cores: every node has every frame, bit-exact and in order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "session/replay.hpp"
#include "trace/candump.hpp"

namespace vericansim {
namespace {

const std::string kTraffic = "../shared/data/traffic/";

bool exists(const std::string &path) { return std::ifstream(path).good(); }

std::string differences(const ReplayReport &report) {
  std::string text;
  for (const ReplayNode &node : report.nodes)
    if (!node.complete) text += node.name + ": " + node.first_difference + "\n";
  return text;
}

// The candump sample whole: 2,368 frames of an NMEA 2000 network at 250 kbit/s, here on 16 clocks a
// bit.
TEST(Replay, CandumpSampleWhole) {
  const std::string path = kTraffic + "canboat_candumpSample3.txt";
  if (!exists(path)) GTEST_SKIP() << path << " is not here";
  const CanLog log = read_log(path);
  ASSERT_EQ(log.entries.size(), 2368U);
  EXPECT_EQ(log.skipped, 0U);
  const ReplayReport report =
      replay(log, {.nodes = 2, .bitrate = 250e3, .clock_hz = 4e6, .ppm = 100, .fast = true});
  EXPECT_EQ(differences(report), "");
  EXPECT_EQ(report.on_bus, 2368U);
  EXPECT_EQ(report.error_frames, 0U);
  EXPECT_EQ(report.nodes.at(1).received, 2368U);
  EXPECT_GT(report.load, 0.97);  // back to back
}

struct Recording {
  const char *name;
  const char *file;
  std::size_t entries;
  double bitrate;
  unsigned nodes;
  unsigned senders;
};

/// GoogleTest shows it where a test is listed or skipped.
void PrintTo(const Recording &recording, std::ostream *out) { *out << recording.name; }

class Recordings : public ::testing::TestWithParam<Recording> {};

// Of the others as many frames as take some seconds, from several senders at once: arbitration in
// every frame.
TEST_P(Recordings, FirstFramesThroughSeveralSenders) {
  const Recording &recording = GetParam();
  const std::string path = kTraffic + recording.file;
  if (!exists(path)) GTEST_SKIP() << path << " is not here";
  const CanLog log = read_log(path);
  EXPECT_EQ(log.entries.size(), recording.entries);
  EXPECT_EQ(log.skipped, 0U);
  const ReplayReport report = replay(log, {.nodes = recording.nodes,
                                           .senders = recording.senders,
                                           .bitrate = recording.bitrate,
                                           .clock_hz = 16 * recording.bitrate,
                                           .ppm = 200,
                                           .cable_m = 20,
                                           .fast = true,
                                           .limit = 500});
  EXPECT_EQ(differences(report), "");
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.on_bus, 500U);
}
// Numbers of entries: SOURCES.md beside the recordings.
INSTANTIATE_TEST_SUITE_P(
    All, Recordings,
    ::testing::Values(Recording{"Pcap", "canboat_nmea2000_can0-1.pcap", 49928, 250e3, 3, 3},
                      Recording{"Trc", "canboat_sample3_PCAN-View.trc", 12274, 250e3, 2, 2},
                      Recording{"Gvret", "savvycan_GVRET_Log.csv", 12974, 500e3, 4, 3}),
    [](const auto &item) { return std::string(item.param.name); });

// As recorded: the frames keep their distances.
TEST(Replay, AsRecordedKeepsTheTimes) {
  const CanLog log = parse_candump(
      "(10.000000) can0 123#11\n(10.004000) can0 456#22\n(10.004000) can0 457#\n", "log");
  const ReplayReport report = replay(log, {.nodes = 3, .bitrate = 500e3, .ppm = 0});
  EXPECT_TRUE(report.ok()) << differences(report);
  EXPECT_GE(report.duration, 4 * kMillisecond);
  EXPECT_LE(report.duration, 5 * kMillisecond);
}

// The check itself: a node whose cable is open for a while lacks frames, and that is noticed.
TEST(Replay, NoticesALostFrame) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += "(1.0) can0 123#0" + std::to_string(i % 10) + "\n";
  CutFault cut{2, {kMillisecond, 2 * kMillisecond}};
  const ReplayReport report = replay(parse_candump(text, "log"),
                                     {.nodes = 3, .bitrate = 500e3, .fast = true, .fault = &cut});
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.nodes.at(1).complete);
  EXPECT_FALSE(report.nodes.at(2).complete);
  EXPECT_NE(report.nodes.at(2).first_difference, "");
}

TEST(Replay, RefusesImpossibleSettings) {
  const CanLog log = parse_candump("(1.0) can0 123#11\n", "log");
  for (const ReplayOptions &options :
       {ReplayOptions{.nodes = 1}, ReplayOptions{.nodes = 65},
        ReplayOptions{.nodes = 2, .senders = 0}, ReplayOptions{.nodes = 2, .senders = 3}})
    EXPECT_THAT([&] { static_cast<void>(replay(log, options)); },
                ::testing::ThrowsMessage<std::invalid_argument>(
                    "a replay needs 2 to 64 nodes and 1 to that many senders"));
}

// Every identifier has one sender, and all of them have some.
TEST(Replay, SendersShareTheIdentifiers) {
  std::string text;
  for (int id = 100; id < 130; ++id) text += "(1.0) can0 " + std::to_string(id) + "#\n";
  const ReplayReport report = replay(parse_candump(text, "log"),
                                     {.nodes = 3, .senders = 3, .bitrate = 500e3, .fast = true});
  EXPECT_TRUE(report.ok()) << differences(report);
  std::uint64_t sum = 0;
  for (const ReplayNode &node : report.nodes) {
    EXPECT_GT(node.sent, 0U);
    sum += node.sent;
  }
  EXPECT_EQ(sum, 30U);
}

/// Of one frame, in which node 0 sees bit `index` of `field` flipped.
ReplayReport replay_with_flip(Field field, unsigned index) {
  PlaceSpec place;
  place.field = field;
  place.index = index;
  place.frame = 1;
  PlaceFault flip{0, place, Effect::kFlip};
  return replay(parse_candump("(1.0) can0 123#11\n", "log"),
                {.nodes = 2, .bitrate = 500e3, .fast = true, .fault = &flip});
}

// All frames have arrived, but only at the second attempt.
TEST(Replay, AnErrorFrameIsNoSuccess) {
  const ReplayReport report = replay_with_flip(Field::kCrc, 3);
  EXPECT_EQ(differences(report), "");
  EXPECT_EQ(report.on_bus, 1U);
  EXPECT_EQ(report.error_frames, 1U);
  EXPECT_FALSE(report.ok());
}

// VA-03: an error in the last bit of EOF repeats a frame that receivers have already.
TEST(Replay, AFrameThatComesTwiceIsNoticed) {
  const ReplayReport report = replay_with_flip(Field::kEof, 6);
  EXPECT_EQ(report.nodes.at(1).received, 2U);
  EXPECT_EQ(report.nodes.at(1).first_difference, "1 frames more than were sent");
  EXPECT_FALSE(report.ok());
}

// A replay of nothing is no success, and says why.
TEST(Replay, NothingToReplayIsAFailure) {
  const ReplayReport none = replay(CanLog{}, {.nodes = 2});
  EXPECT_FALSE(none.ok());
  EXPECT_EQ(none.on_bus, 0U);
  EXPECT_NE(none.failure.find("holds no classical CAN frame"), std::string::npos) << none.failure;
  const CanLog foreign =
      parse_candump("(1.0) can0 123##1AABB\n(1.1) can0 20000080#0000000000000000\n", "log");
  const ReplayReport other = replay(foreign, {.nodes = 2});
  EXPECT_FALSE(other.ok());
  EXPECT_NE(other.failure.find("2 entries are none"), std::string::npos) << other.failure;
}

// An hour without a frame is passed over: its 57,600 million node-cycles are not simulated. Time is
// kept all the same.
TEST(Replay, GapsArePassedOver) {
  const ReplayReport report =
      replay(parse_candump("(1.0) can0 123#11\n(3601.0) can0 124#22\n", "log"), {.nodes = 2});
  EXPECT_TRUE(report.ok()) << differences(report);
  EXPECT_EQ(report.on_bus, 2U);
  EXPECT_GE(report.duration, 3600 * kSecond);
  EXPECT_LE(report.duration, 3601 * kSecond);
  EXPECT_LT(report.node_cycles, 100'000U);
  EXPECT_EQ(report.longest_gap, 3600 * kSecond);
}

// AK-03: with the cable of the sender open nobody acknowledges. What was not on the bus is not
// counted as sent.
TEST(Replay, GivesUpAndSaysWhy) {
  CutFault cut{0, {0, 1000 * kSecond}};
  const ReplayReport report = replay(parse_candump("(1.0) can0 123#11\n(1.1) can0 124#\n", "log"),
                                     {.nodes = 2, .bitrate = 500e3, .fast = true, .fault = &cut});
  EXPECT_FALSE(report.ok());
  EXPECT_EQ(report.nodes.at(0).to_send, 2U);
  EXPECT_EQ(report.nodes.at(0).sent, 0U);
  EXPECT_NE(report.failure.find("gave up after "), std::string::npos) << report.failure;
  EXPECT_NE(report.failure.find("with 0 of 2 frames sent: nobody acknowledges"), std::string::npos)
      << report.failure;
}

}  // namespace
}  // namespace vericansim
