// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The C client on models of nodes: what it sends, returns and repeats (RN-90, RN-91, RN-94).
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <utility>

#include "remote/frame_texts.hpp"
#include "remote/model_bus.hpp"
#include "remote/model_client.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class ClientCalls : public ModelClientTest {};

std::vector<std::uint8_t> counting(std::size_t n) {
  std::vector<std::uint8_t> bytes(n);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
  return bytes;
}

// Any length is split by itself: at the window, at eight bytes there and six beyond.
TEST_F(ClientCalls, LongAccessesAreSplit) {
  const auto bytes = counting(40);
  EXPECT_EQ(write(3, 0x60, bytes), VERICAN_REMOTE_OK);
  EXPECT_THAT(bus.take_sent(),
              ElementsAre("1E0#0102030405060708", "1E8#090A0B0C0D0E0F10", "1F0#1112131415161718",
                          "1F9#7800191A1B1C1D1E", "1F9#7E001F2021222324", "1F9#840025262728"));
  EXPECT_EQ(read(3, 0x60, 40), bytes);
  EXPECT_THAT(bus.take_sent(),
              ElementsAre("1E0#R8", "1E8#R8", "1F0#R8", "1F8#780006", "1F8#7E0006", "1F8#840004"));
  EXPECT_EQ(write(3, 0x74, counting(8)), VERICAN_REMOTE_OK);
  EXPECT_THAT(bus.take_sent(), ElementsAre("1F4#01020304", "1F9#780005060708"));
}

// RN-22: without remote frames everything goes by READ, rows too.
TEST_F(ClientCalls, WithoutRemoteFrames) {
  client.data_frames = true;
  EXPECT_EQ(write(3, 0x20, {1, 2}), VERICAN_REMOTE_OK);
  EXPECT_THAT(read(3, 0x20, 8), ElementsAre(1, 2, 0, 0, 0, 0, 0, 0));
  verican_remote_status_t status;
  EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  EXPECT_EQ(status.accepted, 1);
  verican_remote_identity_t identity;
  EXPECT_EQ(verican_remote_identity(&client, 3, &identity), VERICAN_REMOTE_OK);
  EXPECT_EQ(identity.serial, 0xCAFE1233U);
  EXPECT_EQ(confirmed(3, 0x20, {5}), VERICAN_REMOTE_OK);
  verican_remote_answers_t answers;
  EXPECT_EQ(verican_remote_poll(&client, 0x20, 6, 0x38, &answers), VERICAN_REMOTE_OK);
  EXPECT_EQ(answers.data[3][0], 5);
  EXPECT_EQ(verican_remote_poll(&client, 0x20, 7, 0x38, &answers), VERICAN_REMOTE_ARGUMENT);
  for (const std::string &frame : bus.take_sent())
    EXPECT_THAT(frame, ::testing::Not(HasSubstr("#R")));
}

// RN-91: three tries for a read, then TIMEOUT; the second answer is as good as the first.
TEST_F(ClientCalls, ReadsAreTriedThreeTimes) {
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 2, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_THAT(bus.take_sent(), ElementsAre("120#R1", "120#R1", "120#R1"));
  int lost = 2;
  bus.filter = [&](const RemoteModel *to, const Frame &) { return to != nullptr || lost-- <= 0; };
  EXPECT_THAT(read(3, 0x20, 1), ElementsAre(0));
  EXPECT_THAT(bus.take_sent(), SizeIs(3));
  const std::uint32_t start = bus.now();
  client.timeout_us = 20'000;
  EXPECT_EQ(verican_remote_read(&client, 2, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  EXPECT_GE(bus.now() - start, 60'000U);
  EXPECT_LT(bus.now() - start, 70'000U);
}

// RN-91: no tries are one try, of every call that counts them.
TEST_F(ClientCalls, NothingIsSentLessThanOnce) {
  client.tries = 0;
  EXPECT_EQ(confirmed(3, 0x20, {7}), VERICAN_REMOTE_OK);
  bus.take_sent();
  EXPECT_THAT(read(3, 0x20, 1), ElementsAre(7));
  EXPECT_THAT(bus.take_sent(), ElementsAre("1A0#R1"));
  EXPECT_EQ(verican_remote_clear(&client, 3), VERICAN_REMOTE_OK);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233U, 0), VERICAN_REMOTE_OK);
  EXPECT_EQ(verican_remote_assign(&client, 0xCAFE1233U, 3), VERICAN_REMOTE_OK);
}

// RN-91: an answer that comes too late answers no later question.
TEST_F(ClientCalls, ALateAnswerIsNotTakenForAnother) {
  client.tries = 1;
  bus.filter = [](const RemoteModel *to, const Frame &) { return to == nullptr; };
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
  bus.filter = [](const RemoteModel *, const Frame &) { return true; };
  bus.send({.id = 0x1A0, .remote = true, .dlc = 1});  // its answer is still to come
  EXPECT_EQ(write(3, 0x20, {7}), VERICAN_REMOTE_OK);
  EXPECT_THAT(read(3, 0x20, 1), ElementsAre(7));
}

// RN-91: what the node refuses is REFUSED with its code.
TEST_F(ClientCalls, RefusalsHaveTheirCode) {
  std::uint8_t bytes[8] = {};
  EXPECT_EQ(verican_remote_read(&client, 3, 0xE00, bytes, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
  EXPECT_EQ(confirmed(3, 0xF02, {1, 0}), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_LOCKED);
  EXPECT_EQ(confirmed(3, 0xFF0, {1}), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_PROTECTED);
  EXPECT_EQ(verican_remote_read(&client, 3, 0xE00, bytes, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
}

// A refusal is told at once; that of the first request that the client sees, too.
TEST_F(ClientCalls, ARefusalIsKnownByTheCount) {
  verican_remote_status_t status;
  EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  const std::uint32_t start = bus.now();
  std::uint8_t byte = 0;
  EXPECT_EQ(verican_remote_read(&client, 3, 0xE00, &byte, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_LT(bus.now() - start, 1000U);
}

// A heartbeat repeats the last code for ever: that refuses nothing, known or not, whole or in part.
TEST_F(ClientCalls, AHeartbeatRefusesNothing) {
  for (const std::uint32_t entry : {0x0001987EU, 0x0001957EU}) {  // STATUS [8] or [5] every ms
    for (const bool known : {true, false}) {
      bus.node(0).user_write(0xF40 / 4, entry, 0xF);
      bus.send({.id = 0x1A0});  // refused: code 3 at A = 20
      verican_remote_status_t status;
      EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
      EXPECT_EQ(status.a, 0x20);
      if (!known) client.refusals_known = 0;
      // The heartbeat leaves between the request and its answer.
      bus.filter = [&](const RemoteModel *to, const Frame &frame) {
        if (to == &bus.node(0) && frame.id == 0x1A0) bus.node(0).tick();
        return true;
      };
      (void)bus.take_said();
      EXPECT_THAT(read(3, 0x20, 1), ElementsAre(0));
      const auto said = bus.take_said();
      EXPECT_THAT(said.front(), HasSubstr("5FE#0200000320"));
      EXPECT_EQ(said.back(), "5A0#00");
      if (!known) continue;
      // Nor does it if there is no answer.
      bus.filter = [&](const RemoteModel *to, const Frame &frame) {
        return to != nullptr || frame.id != 0x5A0;
      };
      std::uint8_t byte = 0;
      EXPECT_EQ(verican_remote_read(&client, 3, 0x20, &byte, 1), VERICAN_REMOTE_TIMEOUT);
    }
  }
}

// What was refused before, or at another A, does not refuse what is asked now.
TEST_F(ClientCalls, AnOlderRefusalRefusesNothing) {
  verican_remote_status_t status;
  EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  bus.node(0).user_write(0xF40 / 4, 0x0001987E, 0xF);
  bus.send({.id = 0x1A0});
  EXPECT_THAT(read(4, 0x20, 1), ElementsAre(0));  // meanwhile node 3 tells its refusal
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    if (to == &bus.node(0) && frame.id == 0x1A0) bus.node(0).tick();
    return true;
  };
  EXPECT_THAT(read(3, 0x20, 1), ElementsAre(0));
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    if (to == &bus.node(0) && frame.id == 0x1B0) {
      bus.node(0).receive({.id = 0x1A0});  // somebody's, at another A
      (void)bus.node(0).wants();
    }
    return true;
  };
  EXPECT_THAT(read(3, 0x30, 1), ElementsAre(0));
}

// RN-91: a busy node is asked again, three times in all, and then is told to be busy.
TEST_F(ClientCalls, ABusyNodeIsAskedAgain) {
  (void)write(4, 0x20, {8, 9});
  verican_remote_status_t status;
  EXPECT_EQ(verican_remote_status(&client, 4, &status), VERICAN_REMOTE_OK);
  (void)bus.take_sent();
  int full = 1;  // so often others' requests, for another place, have just filled its queue
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    if (to == &bus.node(1) && frame.id == 0x220 && full-- > 0)
      for (int i = 0; i < 4; ++i) bus.node(1).receive({.id = 0x230, .remote = true, .dlc = 1});
    return true;
  };
  EXPECT_THAT(read(4, 0x20, 2), ElementsAre(8, 9));
  EXPECT_THAT(bus.take_sent(), ElementsAre("220#R2", "220#R2"));
  full = 3;
  std::uint8_t bytes[2];
  EXPECT_EQ(verican_remote_read(&client, 4, 0x20, bytes, 2), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_BUSY);
  EXPECT_THAT(bus.take_sent(), ElementsAre("220#R2", "220#R2", "220#R2"));
}

// RN-31: a series is confirmed by the counts; a repetition may raise them further.
TEST_F(ClientCalls, WritesAreConfirmedByTheCounts) {
  EXPECT_EQ(confirmed(3, 0x100, counting(1000)), VERICAN_REMOTE_OK);
  const auto sent = bus.take_sent();
  EXPECT_THAT(sent, SizeIs(167 + 4));  // in two parts, STATUS before and after each
  EXPECT_EQ(read(3, 0x100, 1000), counting(1000));
  bus.repeat = 2;
  EXPECT_EQ(confirmed(3, 0x100, counting(100)), VERICAN_REMOTE_OK);
}

// RN-31: writes that do not arrive are sent again; if they never do that is TIMEOUT.
TEST_F(ClientCalls, LostWritesAreSentAgain) {
  int lost = 1;
  bus.filter = [&](const RemoteModel *, const Frame &frame) {
    return frame.remote || frame.id != 0x1A8 || lost-- <= 0;
  };
  EXPECT_EQ(confirmed(3, 0x20, counting(24)), VERICAN_REMOTE_OK);
  EXPECT_EQ(read(3, 0x20, 24), counting(24));
  lost = 1000;
  EXPECT_EQ(confirmed(3, 0x20, counting(24)), VERICAN_REMOTE_TIMEOUT);
}

// RN-31: without the counts nothing is confirmed.
TEST_F(ClientCalls, NothingIsConfirmedWithoutTheCounts) {
  for (const unsigned from : {0U, 1U}) {
    unsigned answers = 0;
    bus.filter = [&](const RemoteModel *to, const Frame &) {
      return to != nullptr || answers++ < from;
    };
    EXPECT_EQ(confirmed(3, 0x20, {1}), VERICAN_REMOTE_TIMEOUT) << from;
  }
}

/// A bus whose host needs a while for a frame, and a small node that sends STATUS by itself.
class ClientLatency : public ClientCalls, public ::testing::WithParamInterface<std::uint32_t> {
 protected:
  /// Node 6 with these FLAGS, which it reads when it starts again.
  RemoteModel &add_node(std::uint8_t flags) {
    RemoteModel &node = bus.add(RemoteConfig::profile("small"), 6);
    node.user_write(0xF00 / 4, std::uint32_t{flags} << 8, 0x2);
    bus.send({.id = 0, .dlc = 2, .data = {VERICAN_REMOTE_RESTART, 6}});
    node.stopped();
    bus.latency_us = GetParam();
    return node;
  }
};

// RN-30, RN-31: a STATUS of the node's own, which ACKW asks for, is not taken for the counts: each
// write that has been carried out is confirmed, and none makes the node busy.
TEST_P(ClientLatency, AcknowledgedWritesAreConfirmed) {
  const RemoteModel &node = add_node(0x07);  // ERRS, ACKW, BOOT
  for (unsigned i = 1; i <= 200; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    ASSERT_EQ(confirmed(6, 0x20, {byte}), VERICAN_REMOTE_OK) << i << ", code " << +client.code;
    ASSERT_EQ(node.memory()[0x20], byte);
    bus.wait(i * 37 % 1000);
  }
  EXPECT_EQ(node.status().refused, 0);
}

INSTANTIATE_TEST_SUITE_P(Microseconds, ClientLatency, ::testing::Values(1, 20, 40, 100, 200));

// RN-31: a reading of the counts that the node refuses is no refusal of the write; one refusal more
// is, though the reading's hides its code.
TEST_F(ClientCalls, ABusyNodeIsNoRefusalOfAWrite) {
  RemoteModel &node = bus.add(RemoteConfig::profile("small"), 6);
  bool written = false;
  bus.filter = [&](const RemoteModel *to, const Frame &frame) {
    const bool reads = to == &node && frame.id == 0x378;
    if (reads && std::exchange(written, false))
      node.receive({.id = 0x340, .remote = true, .dlc = 1});
    written = written || (to == &node && frame.id != 0x378);
    return true;
  };
  EXPECT_EQ(confirmed(6, 0x20, {7}), VERICAN_REMOTE_OK);
  EXPECT_EQ(node.status().refused, 1);
  EXPECT_EQ(confirmed(6, 0xE00, {7}), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(node.status().refused, 3);
}

// All of the address range may be named; what is not there the node refuses.
TEST_F(ClientCalls, TheWholeAddressRange) {
  std::vector<std::uint8_t> all(0x1000);
  EXPECT_EQ(verican_remote_read(&client, 3, 0, all.data(), all.size()), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.code, VERICAN_REMOTE_CODE_ADDRESS);
  EXPECT_THAT(bus.take_sent(), SizeIs(15 + 577 + 1));  // up to the first byte that is hidden
  EXPECT_THAT(read(3, 0xFFF, 1), ElementsAre(0xCA));
}

// RN-24: each field of STATUS.
TEST_F(ClientCalls, StatusHasItsFields) {
  RemoteModel &node = bus.node(0);
  node.set_errors(200, 7);
  verican_remote_status_t status;
  EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  EXPECT_EQ(status.tec, 200);
  EXPECT_EQ(status.rec, 7);
  EXPECT_TRUE(status.error_passive);
  EXPECT_EQ(status.state, 2);
  EXPECT_FALSE(status.duplicate || status.stale || status.watchdog || status.bus_off);
  node.set_errors(0, 0);
  node.user_write(0xF00 / 4, 0x00030000, 0xC);  // watchdog: 3 ms
  node.user_write(0xF80 / 4, 0x07FF86A0, 0xF);  // an entry that waits for 6A0
  node.user_write(0xF84 / 4, 0x01000300, 0xF);  // for 10 ms
  EXPECT_EQ(verican_remote_state(&client, 3, VERICAN_REMOTE_OPERATE), VERICAN_REMOTE_OK);
  bus.wait(12'000);
  bus.send({.id = 0x5A0});
  EXPECT_EQ(verican_remote_status(&client, 3, &status), VERICAN_REMOTE_OK);
  EXPECT_TRUE(status.duplicate && status.stale && status.watchdog);
  EXPECT_FALSE(status.error_passive || status.bus_off || status.unlocked);
}

// RN-21: all nodes at one moment.
TEST_F(ClientCalls, Polls) {
  for (const std::uint8_t number : {3, 4, 5})
    (void)write(number, 0x40, {number, static_cast<std::uint8_t>(number + 1)});
  verican_remote_answers_t answers;
  std::uint32_t start = bus.now();
  EXPECT_EQ(verican_remote_poll(&client, 0x40, 2, 0x38, &answers), VERICAN_REMOTE_OK);
  EXPECT_LT(bus.now() - start, 1000U);
  EXPECT_EQ(answers.answered, 0x38U);
  for (const unsigned number : {3U, 4U, 5U}) {
    EXPECT_EQ(answers.data[number][0], number);
    EXPECT_EQ(answers.data[number][1], number + 1);
  }
  start = bus.now();
  EXPECT_EQ(verican_remote_poll(&client, 0x40, 2, 0, &answers), VERICAN_REMOTE_OK);
  EXPECT_EQ(answers.answered, 0x38U);
  EXPECT_GE(bus.now() - start, 150'000U);
  EXPECT_EQ(verican_remote_poll(&client, 0x40, 2, 0x78, &answers), VERICAN_REMOTE_TIMEOUT);
  EXPECT_EQ(verican_remote_poll(&client, 0x200, 6, 0x38, &answers), VERICAN_REMOTE_OK);
}

// RN-03, RN-07: 0 and 1 are numbers of no node; a frame that looks like the answer of one is
// somebody's statement.
TEST_F(ClientCalls, NumbersOfNoNodeAnswerNothing) {
  unsigned passed_on = 0;
  client.user = &passed_on;
  client.on_statement = [](void *user, const verican_remote_frame_t *) {
    ++*static_cast<unsigned *>(user);
  };
  for (const unsigned number : {0U, 1U}) {
    bus.heard = [number](Frame frame) {
      if (frame.id >> 7 == (8U | 5U)) frame.id = (8U | number) << 7 | (frame.id & 0x7F);
      return frame;
    };
    verican_remote_answers_t answers;
    EXPECT_EQ(verican_remote_poll(&client, 0x40, 2, 0, &answers), VERICAN_REMOTE_OK);
    EXPECT_EQ(answers.answered, 0x18U) << number;
    EXPECT_EQ(passed_on, number + 1);
  }
}

// Statements that nobody waits for are passed on, in their order.
TEST_F(ClientCalls, StatementsArePassedOn) {
  std::vector<unsigned> heard;
  client.user = &heard;
  client.on_statement = [](void *user, const verican_remote_frame_t *frame) {
    static_cast<std::vector<unsigned> *>(user)->push_back(frame->id);
  };
  (void)bus.take_said();
  for (const std::size_t i : {0U, 1U})
    bus.node(i).user_write(0xF40 / 4, 0x0001917E, 0xF);  // STATUS [1] of nodes 3 and 4 every ms
  bus.wait(10'000);
  for (int i = 0; i < 5; ++i) {
    EXPECT_THAT(read(3, 0x20, 1), SizeIs(1));
    bus.wait(1000);
  }
  std::vector<unsigned> said;
  for (const std::string &text : bus.take_said())
    if (frame_of(text).id != 0x5A0) said.push_back(frame_of(text).id);  // not asked for
  ASSERT_GT(heard.size(), 10U);
  ASSERT_LE(heard.size(), said.size());
  said.resize(heard.size());
  EXPECT_EQ(heard, said);
  EXPECT_THAT(heard, ::testing::IsSupersetOf({0x5FEU, 0x67EU}));
}

// RN-94: calls leave in their order.
TEST_F(ClientCalls, OrderOfCalls) {
  (void)write(1, 0x10, counting(8));
  EXPECT_EQ(verican_remote_trigger(&client, 1), VERICAN_REMOTE_OK);
  EXPECT_EQ(verican_remote_state(&client, 0, VERICAN_REMOTE_OPERATE), VERICAN_REMOTE_OK);
  EXPECT_EQ(verican_remote_state(&client, 4, VERICAN_REMOTE_RESTART), VERICAN_REMOTE_OK);
  EXPECT_THAT(bus.take_sent(),
              ElementsAre("090#0102030405060708", "001#01", "000#0100", "000#8104"));
}

// RN-91: nothing is sent for an argument that is wrong.
TEST_F(ClientCalls, WrongArguments) {
  std::uint8_t bytes[8] = {};
  verican_remote_answers_t answers;
  std::size_t count = 1;
  const verican_remote_setting_t setting = {0xF02, 9, {0}};
  const auto expect = [](verican_remote_result_t result) {
    EXPECT_EQ(result, VERICAN_REMOTE_ARGUMENT);
  };
  for (const std::uint8_t number : {0, 1, 8, 255}) {
    expect(verican_remote_read(&client, number, 0x20, bytes, 1));
    expect(verican_remote_write_confirmed(&client, number, 0x20, bytes, 1));
    expect(verican_remote_block_read(&client, number, 0x20, bytes, 1));
    expect(verican_remote_block_write(&client, number, 0x20, bytes, 1));
    expect(verican_remote_configure(&client, number, 0, nullptr, 0));
  }
  verican_remote_status_t status;
  verican_remote_identity_t identity;
  expect(verican_remote_status(&client, 8, &status));
  expect(verican_remote_identity(&client, 1, &identity));
  expect(verican_remote_status(nullptr, 3, &status));
  expect(verican_remote_write(&client, 0, 0x20, bytes, 1));
  expect(verican_remote_write(&client, 8, 0x20, bytes, 1));
  expect(verican_remote_read(&client, 3, 0x20, bytes, 0));
  expect(verican_remote_read(&client, 3, 0xFFF, bytes, 2));
  expect(verican_remote_read(&client, 3, 0x20, nullptr, 1));
  expect(verican_remote_read(nullptr, 3, 0x20, bytes, 1));
  expect(verican_remote_block_write(&client, 3, 0x20, nullptr, 1));
  expect(verican_remote_block_read(&client, 3, 0xFFF, bytes, 2));
  expect(verican_remote_poll(&client, 0x74, 5, 0, &answers));  // not in one frame
  expect(verican_remote_poll(&client, 0x20, 9, 0, &answers));
  expect(verican_remote_poll(&client, 0x20, 0, 0, &answers));
  expect(verican_remote_poll(&client, 0x20, 1, 0x100, &answers));
  expect(verican_remote_poll(&client, 0x20, 1, 0x2, &answers));
  expect(verican_remote_poll(&client, 0x20, 1, 0x1, &answers));
  expect(verican_remote_poll(&client, 0x20, 1, 0, nullptr));
  expect(verican_remote_state(&client, 8, VERICAN_REMOTE_SAFE));
  expect(verican_remote_state(&client, 3, 3));
  expect(verican_remote_status(&client, 3, nullptr));
  expect(verican_remote_identity(&client, 3, nullptr));
  expect(verican_remote_assign(&client, 0, 1));
  expect(verican_remote_clear(&client, VERICAN_REMOTE_ALL));
  expect(verican_remote_scan(&client, nullptr, &count));
  expect(verican_remote_configure(&client, 3, 0, &setting, 1));
  expect(verican_remote_configure(&client, 3, 0, nullptr, 1));
  verican_remote_t other;
  const verican_remote_port_t port = bus.port();
  const verican_remote_port_t none{};
  expect(verican_remote_init(&other, &port, 4));
  expect(verican_remote_init(&other, &none, 3));
  expect(verican_remote_init(nullptr, &port, 3));
  EXPECT_THAT(bus.take_sent(), IsEmpty());
}

// RN-91: a transfer of several frames tells which of them had no success.
TEST_F(ClientCalls, WhereATransferEnds) {
  Bytes bytes(32);
  EXPECT_EQ(verican_remote_read(&client, 3, 0xDF2, bytes.data(), bytes.size()),
            VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.address, 0xDFE);
  EXPECT_EQ(confirmed(3, 0xC00, Bytes(700)), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.address, 0xC00);  // a part is 100 frames, here of six bytes
  EXPECT_EQ(confirmed(3, 0xA00, Bytes(1100)), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.address, 0xC58);
  const verican_remote_setting_t setting{.address = 0xF30, .length = 1, .data = {}};
  EXPECT_EQ(verican_remote_configure(&client, 3, 0xCAFE1233, &setting, 1), VERICAN_REMOTE_REFUSED);
  EXPECT_EQ(client.address, 0xF30);
}

// RN-91: off the bus every call says so.
TEST_F(ClientCalls, BusOff) {
  bus.bus_off = true;
  std::uint8_t bytes[8] = {};
  verican_remote_status_t status;
  verican_remote_answers_t answers;
  verican_remote_identity_t node;
  std::size_t count = 1;
  bool here = false;
  for (const auto result :
       {verican_remote_read(&client, 3, 0x20, bytes, 1), write(3, 0x20, {1}),
        confirmed(3, 0x20, {1}), verican_remote_status(&client, 3, &status),
        verican_remote_poll(&client, 0x20, 1, 0, &answers), verican_remote_trigger(&client, 1),
        verican_remote_state(&client, 0, VERICAN_REMOTE_SAFE),
        verican_remote_select(&client, 0, 0, false, &here),
        verican_remote_scan(&client, &node, &count), verican_remote_assign(&client, 0, 3),
        verican_remote_clear(&client, 3), verican_remote_block_read(&client, 3, 0x20, bytes, 1),
        verican_remote_block_write(&client, 3, 0x20, bytes, 1),
        verican_remote_configure(&client, 3, 0, nullptr, 0)})
    EXPECT_EQ(result, VERICAN_REMOTE_BUS_OFF);
}

}  // namespace
}  // namespace vericansim
