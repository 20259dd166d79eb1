// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Clients that are too many, too fast, too slow, half there, gone, or mad.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "socketcan/socketcand_bench.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

SocketcandLimits limits_of(std::size_t clients, std::size_t output) {
  SocketcandLimits limits;
  limits.clients = clients;
  limits.output = output;
  limits.raw_pause = std::chrono::milliseconds(0);
  limits.farewell = std::chrono::milliseconds(200);
  return limits;
}

std::size_t frames_in(const std::string &text) {
  std::size_t count = 0;
  for (auto at = text.find("< frame "); at != std::string::npos; at = text.find("< frame ", at + 1))
    ++count;
  return count;
}

std::string send_text(unsigned number) {
  char text[64];
  std::snprintf(text, sizeof text, "< send %03X 4 %x %x %x %x >", number % 0x800, number & 0xFF,
                number >> 8 & 0xFF, number >> 16 & 0xFF, 0xA5);
  return text;
}

unsigned number_of(const can_frame &frame) {
  return frame.data[0] | frame.data[1] << 8U | frame.data[2] << 16U;
}

class SocketcandClients : public testing::Test {
 protected:
  // Bound to end: each frame of `sent` carries its number.
  void expect_in_order(unsigned count) {
    ASSERT_EQ(bench_.sent.size(), count);
    for (unsigned i = 0; i < count; ++i)
      ASSERT_EQ(number_of(bench_.sent[i].message.frame), i) << "frame " << i;
  }

  SocketcandBench bench_{{"can0"}, limits_of(3, 200'000)};
};

TEST_F(SocketcandClients, OneTooManyIsToldAndClosed) {
  auto a = bench_.raw_client();
  auto b = bench_.raw_client();
  auto c = bench_.raw_client();
  SocketcandTestClient d(bench_.port());
  EXPECT_TRUE(bench_.until([&] {
    d.read();
    return d.closed();
  }));
  EXPECT_EQ(d.received(), "< error there are 3 clients, more are not allowed >");
  EXPECT_EQ(bench_.server().counts().refused, 1U);
  b.reset();
  ASSERT_TRUE(bench_.until([&] { return bench_.server().receiving() == 2; }));
  auto e = bench_.raw_client();
  EXPECT_EQ(bench_.server().counts().clients, 4U);
}

// The bus takes nothing, so that the frames of those who have left wait, but not their places.
TEST_F(SocketcandClients, WhoHasLeftTakesNoPlace) {
  bench_.room = 0;
  for (unsigned i = 0; i < 5; ++i) {
    SocketcandTestClient client(bench_.port());
    ASSERT_TRUE(bench_.expect(client, "< hi >")) << "client " << i;
    ASSERT_TRUE(bench_.send(client, "< open can0 >" + send_text(i)));
    ASSERT_TRUE(bench_.expect(client, "< ok >"));
    client.vanish(false);
    for (unsigned round = 0; round < 3; ++round) bench_.step();
  }
  EXPECT_EQ(bench_.server().counts().refused, 0U);
  bench_.room = SIZE_MAX;
  ASSERT_TRUE(bench_.until([&] { return bench_.sent.size() == 5; }));
  EXPECT_TRUE(bench_.server().counts().ok());
}

TEST(SocketcandDepartedClients, TheOldestAreGivenUpAndCounted) {
  SocketcandLimits limits = limits_of(3, 200'000);
  limits.departed = 2;
  SocketcandBench bench{{"can0"}, limits};
  bench.room = 0;
  for (unsigned i = 0; i < 4; ++i) {
    SocketcandTestClient client(bench.port());
    ASSERT_TRUE(bench.send(client, "< open can0 >" + send_text(i) + send_text(i)));
    ASSERT_TRUE(bench.expect(client, "< ok >"));
  }
  ASSERT_TRUE(bench.until([&] { return bench.server().counts().given_up == 4; }));
  EXPECT_FALSE(bench.server().counts().ok());
  bench.room = SIZE_MAX;
  ASSERT_TRUE(bench.until([&] { return bench.sent.size() == 4; }));
  EXPECT_EQ(number_of(bench.sent.front().message.frame), 2U) << "the two youngest";
}

// The bus takes nothing: what the client sends fills TCP and then waits in the client; no frame is
// lost, and memory does not grow with it.
TEST_F(SocketcandClients, AClientThatIsFasterThanTheBusWaits) {
  auto client = bench_.raw_client();
  bench_.room = 0;
  std::string all;
  unsigned count = 0;
  while (all.size() < (std::size_t{32} << 20U)) all += send_text(count++);
  std::size_t at = 0;
  for (int idle = 0; idle < 20; bench_.step()) {
    const std::size_t sent = client->send(std::string_view(all).substr(at));
    idle = sent == 0 ? idle + 1 : 0;
    at += sent;
  }
  EXPECT_LT(at, all.size());
  EXPECT_TRUE(bench_.sent.empty());
  // The rest of the frame in which the window closed, so that all that was sent is whole.
  const std::size_t end = all.find('>', at) + 1;
  bench_.room = SIZE_MAX;
  ASSERT_TRUE(bench_.send(*client, std::string_view(all).substr(at, end - at)));
  client->send("< echo >");
  ASSERT_TRUE(bench_.expect(*client, "< echo >"));
  const auto whole = static_cast<unsigned>(
      std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(end), '>'));
  EXPECT_GT(whole, 1000U);
  expect_in_order(whole);
}

TEST_F(SocketcandClients, ClientsTakeTurns) {
  auto a = bench_.raw_client();
  auto b = bench_.raw_client();
  bench_.room = 0;
  for (unsigned i = 0; i < 50; ++i) {
    a->send("< send 00A 0 >");
    b->send("< send 00B 0 >");
  }
  for (int i = 0; i < 50; ++i) bench_.step();
  bench_.room = 50;
  ASSERT_TRUE(bench_.until([&] { return bench_.sent.size() == 50; }));
  const auto from_a = std::count_if(bench_.sent.begin(), bench_.sent.end(), [](const auto &sent) {
    return sent.message.frame.can_id == 0xA;
  });
  EXPECT_NEAR(static_cast<double>(from_a), 25, 1);
}

TEST_F(SocketcandClients, AClientThatDoesNotReadIsToldAndClosedOthersGetAll) {
  SocketcandTestClient slow(bench_.port(), 4096);
  ASSERT_TRUE(bench_.send(slow, "< open can0 >< rawmode >"));
  auto good = bench_.raw_client();
  constexpr unsigned kBurst = 100;
  unsigned count = 0;
  while (bench_.server().counts().too_slow == 0 && count < 1'000'000) {
    for (unsigned i = 0; i < kBurst; ++i) bench_.frame_from_bus(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
    count += kBurst;
    bench_.step();
    good->read();
  }
  EXPECT_EQ(bench_.server().counts().too_slow, 1U);
  // The last round's frames came in one go, after the slow client was given up.
  EXPECT_TRUE(bench_.until([&] {
    good->read();
    return frames_in(good->received()) == count;
  })) << frames_in(good->received())
      << " of " << count;
  EXPECT_TRUE(bench_.until([&] { return bench_.server().receiving() == 1; }));
  EXPECT_GT(bench_.server().counts().undelivered, 0U);
}

TEST_F(SocketcandClients, AClientThatReadsAgainLearnsWhyItWasClosed) {
  SocketcandTestClient slow(bench_.port(), 4096);
  ASSERT_TRUE(bench_.send(slow, "< open can0 >< rawmode >"));
  ASSERT_TRUE(bench_.until([&] { return bench_.server().receiving() == 1; }));
  std::size_t count = 0;
  for (; bench_.server().counts().too_slow == 0; ++count) {
    bench_.frame_from_bus(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
    if (count % 64 == 0) bench_.step();
  }
  EXPECT_TRUE(bench_.until([&] {
    slow.read();
    return slow.closed();
  }));
  EXPECT_EQ(frames_in(slow.received()), count - 1);
  EXPECT_THAT(slow.received(), HasSubstr("< error this client reads too slowly, "));
  EXPECT_TRUE(
      slow.received().ends_with("it is disconnected and what it has sent meanwhile is "
                                "ignored >"));
}

// Answers and statistics count as frames do.
TEST_F(SocketcandClients, AClientThatDoesNotReadItsAnswersIsClosedToo) {
  const std::string bad = "<><><><>", echo = "< echo >", good = "< rawmode >< bcmmode >";
  std::uint64_t slow = 0;
  for (const std::string &commands : {bad, echo, good}) {
    SocketcandTestClient client(bench_.port(), 4096);
    ASSERT_TRUE(bench_.send(client, "< open can0 >"));
    std::string many;
    for (unsigned i = 0; i < 1'000; ++i) many += commands;
    for (unsigned i = 0; bench_.server().counts().too_slow == slow && i < 10'000; ++i) {
      client.send(many);
      bench_.step();
    }
    EXPECT_EQ(bench_.server().counts().too_slow, ++slow) << commands;
    ASSERT_TRUE(bench_.until([&] {
      client.read();
      return client.closed();
    }));
    EXPECT_THAT(client.received(), HasSubstr("< error this client reads too slowly, "));
  }
}

TEST_F(SocketcandClients, AClientThatDoesNotReadItsStatisticsIsClosedToo) {
  SocketcandTestClient client(bench_.port(), 4096);
  ASSERT_TRUE(bench_.send(client, "< open can0 >< controlmode >< statistics 1 >"));
  bench_.wait_ms = 0;  // some 100,000 lines fill what the kernel keeps
  for (unsigned i = 0; bench_.server().counts().too_slow == 0 && i < 1'000'000; ++i) {
    bench_.now += kMillisecond;
    bench_.step();
  }
  EXPECT_EQ(bench_.server().counts().too_slow, 1U);
}

TEST_F(SocketcandClients, WhatAVanishedClientHasSentIsSent) {
  auto client = bench_.raw_client();
  bench_.room = 0;
  for (unsigned i = 0; i < 500; ++i) ASSERT_TRUE(bench_.send(*client, send_text(i)));
  client->vanish(false);
  for (int i = 0; i < 50; ++i) bench_.step();
  bench_.room = SIZE_MAX;
  EXPECT_TRUE(bench_.until([&] { return bench_.server().receiving() == 0; }));
  expect_in_order(500);
}

// poll() tells of a dead connection again and again: while its frames wait for the bus, the bridge
// must not spin.
TEST_F(SocketcandClients, AVanishedClientDoesNotKeepPollFromWaiting) {
  for (const bool reset : {false, true}) {
    auto client = bench_.raw_client();
    bench_.room = 0;
    ASSERT_TRUE(bench_.send(*client, "< send 001 0 >< send 002 0 >"));
    client->vanish(reset);
    EXPECT_TRUE(bench_.until([&] { return !bench_.busy(); }));
    EXPECT_EQ(bench_.server().receiving(), 1U);
    bench_.room = SIZE_MAX;
    ASSERT_TRUE(bench_.until([&] { return bench_.server().receiving() == 0; }));
  }
  EXPECT_EQ(bench_.sent.size(), 4U);
}

TEST_F(SocketcandClients, AResetInTheMiddleOfACommandHurtsNobody) {
  auto other = bench_.raw_client();
  for (int i = 0; i < 20; ++i) {
    auto client = bench_.raw_client();
    ASSERT_TRUE(bench_.send(*client, "< send 001 1 1 >< send 00"));
    bench_.frame_from_bus(0x123, {});
    if (i % 2 == 0) bench_.step();
    client->vanish(true);
    bench_.frame_from_bus(0x124, {});
    ASSERT_TRUE(bench_.until([&] { return bench_.server().receiving() == 1; }));
  }
  EXPECT_TRUE(bench_.until([&] {
    other->read();
    return frames_in(other->received()) == 40 + bench_.sent.size();
  }));
}

TEST_F(SocketcandClients, AHalfClosedClientIsAnsweredAndClosed) {
  auto client = bench_.raw_client();
  ASSERT_TRUE(bench_.send(*client, "< send 123 0 >< echo >< send 124"));
  client->half_close();
  EXPECT_TRUE(bench_.until([&] {
    client->read();
    return client->closed();
  }));
  EXPECT_EQ(client->received(), "< echo >< error the connection ended inside a command >");
  EXPECT_EQ(bench_.sent.size(), 1U);
}

TEST_F(SocketcandClients, JobsEndWithTheirClientThoughItsFramesStillWait) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.send(client, "< open can0 >< add 0 1000 001 0 >< echo >"));
  ASSERT_TRUE(bench_.expect(client, "< echo >"));
  bench_.room = 0;
  const auto before = bench_.sent.size();
  ASSERT_TRUE(bench_.send(client, "< send 002 0 >< send 003 0 >"));
  client.half_close();
  for (int i = 0; i < 20; ++i) bench_.step();
  bench_.now += 50 * kMillisecond;
  bench_.room = SIZE_MAX;
  ASSERT_TRUE(bench_.until([&] {
    client.read();
    return client.closed();
  }));
  ASSERT_EQ(bench_.sent.size(), before + 2);
  EXPECT_EQ(bench_.sent[before].message.frame.can_id, 2U);
  EXPECT_EQ(bench_.sent[before + 1].message.frame.can_id, 3U);
}

TEST_F(SocketcandClients, FramesThatAreNotSentAtTheEndAreCountedAndToldOf) {
  auto client = bench_.raw_client();
  auto other = bench_.raw_client();
  bench_.room = 0;
  for (unsigned i = 0; i < 2000; ++i) ASSERT_TRUE(bench_.send(*client, send_text(i)));
  ASSERT_TRUE(bench_.send(*client, "< echo >< send 800 0 >"));
  bench_.step();
  EXPECT_EQ(bench_.remaining(), 2000U);
  EXPECT_EQ(bench_.remaining(), 0U);
  bench_.server().finish(std::chrono::seconds(10));
  client->read();
  EXPECT_TRUE(client->received().ends_with(
      "< error the bus has ended; the last 2000 frames of this client were not sent >"));
  other->read();
  EXPECT_EQ(other->received(), "");
  EXPECT_TRUE(bench_.sent.empty());
}

TEST_F(SocketcandClients, FinishDeliversWhatIsQueued) {
  auto client = bench_.raw_client();
  for (int i = 0; i < 1000; ++i) bench_.frame_from_bus(0x123, {1, 2, 3});
  bench_.server().finish(std::chrono::seconds(10));
  ASSERT_TRUE(bench_.until([&] {
    client->read();
    return client->closed();
  }));
  EXPECT_EQ(frames_in(client->received()), 1000U);
  EXPECT_EQ(bench_.server().counts().undelivered, 0U);
}

TEST_F(SocketcandClients, FinishGivesUpOnAClientThatDoesNotReadAndCounts) {
  SocketcandTestClient slow(bench_.port(), 4096);
  ASSERT_TRUE(bench_.send(slow, "< open can0 >< rawmode >"));
  ASSERT_TRUE(bench_.until([&] { return bench_.server().receiving() == 1; }));
  for (int i = 0; bench_.server().counts().too_slow == 0; ++i) {
    bench_.frame_from_bus(0x123, {1, 2, 3, 4, 5, 6, 7, 8});
    if (i % 64 == 0) bench_.step();
  }
  bench_.server().finish(std::chrono::milliseconds(1));
  EXPECT_GT(bench_.server().counts().undelivered, 0U);
}

// python-can compares what one recv() gives with "< ok >".
TEST(SocketcandPause, TheAnswerToRawModeComesAlone) {
  SocketcandLimits limits;
  limits.raw_pause = std::chrono::hours(1);
  SocketcandBench bench({"can0"}, limits);
  auto client = bench.raw_client();
  bench.frame_from_bus(0x123, {});
  for (int i = 0; i < 50; ++i) bench.step();
  client->read();
  EXPECT_EQ(client->received(), "");
}

TEST(SocketcandPause, EndsByItself) {
  SocketcandLimits limits;
  limits.raw_pause = std::chrono::milliseconds(20);
  SocketcandBench bench({"can0"}, limits);
  auto client = bench.raw_client();
  bench.frame_from_bus(0x123, {});
  bench.frame_from_bus(0x124, {});
  EXPECT_TRUE(bench.until([&] {
    client->read();
    return client->received() == "\n< frame 123 0.000100  >\n< frame 124 0.000200  >";
  }));
}

class SocketcandFuzz : public testing::TestWithParam<unsigned> {};

std::string random_command(std::mt19937 &random) {
  static const std::vector<std::string> kWords = {
      "open",        "can0",        "rawmode",   "bcmmode",    "controlmode", "isotpmode",
      "send",        "sendrtr",     "add",       "update",     "delete",      "subscribe",
      "unsubscribe", "filter",      "muxfilter", "statistics", "echo",        "ownmessages",
      "0",           "1",           "8",         "123",        "7FF",         "800",
      "1FFFFFFF",    "99999999999", "-1",        "FF",         "<",           ">",
      "\xFF",        "\n",          ""};
  std::string text = random() % 16 == 0 ? "" : "< ";
  for (unsigned i = random() % 14; i > 0; --i) text += kWords[random() % kWords.size()] + " ";
  return text + (random() % 16 == 0 ? "" : ">");
}

// Nothing that a client sends, in whatever pieces, disturbs the server or another client.
TEST_P(SocketcandFuzz, NothingAClientSendsDisturbsAnother) {
  std::mt19937 random(GetParam());
  SocketcandBench bench({"can0"}, limits_of(8, 10'000'000));
  auto witness = bench.raw_client();
  std::unique_ptr<SocketcandTestClient> client;
  for (int i = 0; i < 1500; ++i) {
    if (!client || client->closed() || random() % 200 == 0) {
      client = std::make_unique<SocketcandTestClient>(bench.port());
      if (random() % 4 != 0) client->send("< open can0 >");
    }
    std::string bytes = random_command(random);
    if (random() % 8 == 0)
      for (unsigned j = random() % 64; j > 0; --j) bytes += static_cast<char>(random());
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t size = 1 + random() % 24;
      client->send(std::string_view(bytes).substr(at, size));
      at += size;
      if (random() % 8 == 0) bench.step();
    }
    client->read();
    if (random() % 10 == 0) bench.frame_from_bus(random() % 0x800, {1, 2, 3});
    if (random() % 10 == 0) bench.now += 3 * kMillisecond;
  }
  client.reset();
  const auto answered = bench.server().counts().bad_commands;
  EXPECT_GT(answered, 100U);
  ASSERT_TRUE(bench.until([&] { return bench.server().receiving() == 1; }));
  ASSERT_TRUE(bench.expect(*witness, ""));
  ASSERT_TRUE(bench.send(*witness, "< send 5A5 1 77 >< echo >"));
  ASSERT_TRUE(bench.expect(*witness, "< echo >"));
  EXPECT_EQ(bench.sent.back().message.frame.can_id, 0x5A5U);
  for (const auto &sent : bench.sent) {
    const can_frame &frame = sent.message.frame;
    ASSERT_LE(frame.len, 8);
    ASSERT_EQ(frame.can_id & CAN_ERR_FLAG, 0U);
    ASSERT_TRUE((frame.can_id & CAN_EFF_FLAG) != 0 || (frame.can_id & CAN_EFF_MASK) <= 0x7FF);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SocketcandFuzz, testing::Range(1U, 7U));

}  // namespace
}  // namespace vericansim
