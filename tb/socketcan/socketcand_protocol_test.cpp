// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The protocol over TCP, mode by mode. Source: doc/protocol.md of socketcand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "socketcan/socketcand_bench.hpp"
#include "trace/input_error.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

SocketcandLimits no_pause() {
  SocketcandLimits limits;
  limits.raw_pause = std::chrono::milliseconds(0);
  // Nothing may depend on clients being thrown out after a while.
  limits.farewell = std::chrono::hours(1);
  return limits;
}

class SocketcandProtocol : public testing::Test {
 protected:
  // Sends commands, then an echo, and returns what came before its answer.
  std::string ask(SocketcandTestClient &client, const std::string &commands) {
    client.taken();
    EXPECT_TRUE(bench_.send(client, commands + "< echo >"));
    EXPECT_TRUE(bench_.until([&] {
      client.read();
      return client.received().ends_with("< echo >");
    })) << client.received();
    const std::string answer = client.taken();
    return answer.substr(0, answer.size() - std::string("< echo >").size());
  }

  SocketcandBench bench_{{"can0", "can1"}, no_pause()};
};

TEST_F(SocketcandProtocol, GreetsAndOpensAndSwitches) {
  SocketcandTestClient client(bench_.port());
  EXPECT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client, "< open can0 >< rawmode >< bcmmode >< controlmode >< rawmode >"),
            "< ok >< ok >< ok >< ok >< ok >");
}

TEST_F(SocketcandProtocol, AnUnknownBusIsNamedAndEndsTheConnection) {
  SocketcandTestClient client(bench_.port());
  EXPECT_TRUE(bench_.send(client, "< open can7 >< open can0 >"));
  EXPECT_TRUE(bench_.until([&] {
    client.read();
    return client.closed();
  }));
  EXPECT_EQ(client.received(), "< hi >< error open: there is no bus 'can7'; there is: can0 can1 >");
}

TEST_F(SocketcandProtocol, CommandsOutsideTheirModeAreRefused) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client, "< rawmode >"),
            "< error rawmode: only allowed in bcmmode or in rawmode or in controlmode >");
  EXPECT_EQ(ask(client, "< send 123 0 >"), "< error send: only allowed in bcmmode or in rawmode >");
  EXPECT_EQ(ask(client, "< open can0 >< open can1 >"),
            "< ok >< error open: only allowed before a bus is open >");
  EXPECT_EQ(ask(client, "< statistics 10 >"), "< error statistics: only allowed in controlmode >");
  EXPECT_EQ(ask(client, "< rawmode >< add 0 1000 1 0 >"),
            "< ok >< error add: only allowed in bcmmode >");
  EXPECT_EQ(ask(client, "< controlmode >< send 1 0 >"),
            "< ok >< error send: only allowed in bcmmode or in rawmode >");
  EXPECT_TRUE(bench_.sent.empty());
}

TEST_F(SocketcandProtocol, WhatIsNotOfferedIsSaid) {
  auto client = bench_.raw_client();
  EXPECT_THAT(ask(*client, "< isotpmode >"), HasSubstr("< error isotpmode: not offered"));
  EXPECT_THAT(ask(*client, "< can0 C 0 0 0 >"), HasSubstr("< error can0: bit timing and control"));
  EXPECT_EQ(ask(*client, "< frobnicate 1 >"), "< error there is no command 'frobnicate' >");
  EXPECT_EQ(ask(*client, "< >"), "< error a command is empty >");
  EXPECT_EQ(ask(*client, "< echo 1 >"), "< error echo: nothing may follow, got '1' >");
}

TEST_F(SocketcandProtocol, RawFramesGoToTheBus) {
  auto client = bench_.raw_client();
  EXPECT_EQ(ask(*client, "< send 123 2 1 F1 >< send 1AAAAAAA 0 >< sendrtr 7FF 8 >"), "");
  ASSERT_EQ(bench_.sent.size(), 3U);
  EXPECT_EQ(bench_.sent[0].bus, "can0");
  EXPECT_EQ(bench_.sent[0].message.frame.can_id, 0x123U);
  EXPECT_EQ(bench_.sent[0].message.frame.data[1], 0xF1);
  EXPECT_EQ(bench_.sent[1].message.frame.can_id, 0x1AAAAAAA | CAN_EFF_FLAG);
  EXPECT_EQ(bench_.sent[2].message.frame.can_id, 0x7FF | CAN_RTR_FLAG);
  EXPECT_EQ(bench_.sent[2].message.frame.len, 8);
}

TEST_F(SocketcandProtocol, ABadCommandDoesNotStopTheNextOne) {
  auto client = bench_.raw_client();
  EXPECT_EQ(ask(*client, "< send 800 0 >< send 1 9 >xx< send 2 0 >"),
            "< error send: identifier '800' is not allowed; allowed: 000 to 7FF, or 8 digits, "
            "00000000 to 1FFFFFFF >"
            "< error send: DLC '9' is not allowed; allowed: a hexadecimal number, 0 to 8 >"
            "< error text outside of a command: 'x'; allowed: commands, each in angle brackets >");
  ASSERT_EQ(bench_.sent.size(), 1U);
  EXPECT_EQ(bench_.sent[0].message.frame.can_id, 2U);
  EXPECT_EQ(bench_.server().counts().bad_commands, 3U);
}

TEST_F(SocketcandProtocol, FramesOfTheBusAreShownInRawMode) {
  auto client = bench_.raw_client();
  bench_.now = 23 * kSecond;
  bench_.frame_from_bus(0x123, {0x11, 0x22});
  bench_.frame_from_bus(0x123 | CAN_EFF_FLAG, {});
  bench_.frame_from_bus(0x7FF | CAN_RTR_FLAG, {0, 0});
  bench_.frame_from_bus(CAN_ERR_FLAG | 0x40, {0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(ask(*client, ""),
            "\n< frame 123 23.000100 1122 >\n< frame 00000123 23.000200  >"
            "\n< rtr 7FF 23.000300 2 >\n< error 20000040 23.000400 0000000000000000 >");
}

TEST_F(SocketcandProtocol, EchoesGoToTheOthersOfTheBus) {
  auto sender = bench_.raw_client();
  auto other = bench_.raw_client();
  EXPECT_EQ(ask(*sender, "< send 123 1 55 >"), "");
  EXPECT_EQ(ask(*other, ""), "\n< frame 123 0.000100 55 >");
  EXPECT_EQ(ask(*other, "< send 124 0 >"), "");
  EXPECT_EQ(ask(*sender, ""), "\n< frame 124 0.000200  >");
}

TEST_F(SocketcandProtocol, OwnMessagesComeOnRequest) {
  auto client = bench_.raw_client();
  EXPECT_EQ(ask(*client, "< ownmessages 1 >"), "< ok >");
  EXPECT_EQ(ask(*client, "< send 123 0 >< echo >"), "\n< frame 123 0.000100  >< echo >");
  EXPECT_EQ(ask(*client, "< ownmessages 0 >< send 123 0 >"), "< ok >");
  EXPECT_THAT(ask(*client, "< ownmessages 2 >"), HasSubstr("< error ownmessages: switch '2'"));
}

TEST_F(SocketcandProtocol, TwoBusesAreTwoNodes) {
  auto first = bench_.raw_client("can0");
  auto second = bench_.raw_client("can1");
  EXPECT_EQ(ask(*first, "< send 1 0 >"), "");
  EXPECT_EQ(ask(*second, "< send 2 0 >"), "\n< frame 001 0.000100  >");
  EXPECT_EQ(ask(*first, ""), "\n< frame 002 0.000200  >");
  EXPECT_EQ(bench_.sent[0].bus, "can0");
  EXPECT_EQ(bench_.sent[1].bus, "can1");
}

TEST_F(SocketcandProtocol, OpeningPutsAClientIntoBcmMode) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client, "< open can0 >< subscribe 0 0 123 >< send 7 1 1 >"), "< ok >");
  EXPECT_EQ(bench_.sent.size(), 1U);
  bench_.frame_from_bus(0x124, {1});
  bench_.frame_from_bus(0x123, {2});
  EXPECT_EQ(ask(client, ""), "\n< frame 123 0.000300 02 >");
  EXPECT_EQ(ask(client, "< unsubscribe 123 >< filter 0 0 124 1 FF >"), "");
  bench_.frame_from_bus(0x123, {2});
  bench_.frame_from_bus(0x124, {3});
  bench_.frame_from_bus(0x124, {3});
  EXPECT_EQ(ask(client, ""), "\n< frame 124 0.000500 03 >");
}

TEST_F(SocketcandProtocol, MuxFilterOfTheExample) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client,
                "< open can0 >< muxfilter 0 0 123 2 FF 00 00 00 00 00 00 00 33 FF FF FF FF FF FF "
                "FF >"),
            "< ok >");
  bench_.frame_from_bus(0x123, {0x33, 1});
  bench_.frame_from_bus(0x123, {0x33, 1});
  bench_.frame_from_bus(0x123, {0x34, 1});
  EXPECT_EQ(ask(client, ""), "\n< frame 123 0.000100 33 01 >");
  EXPECT_THAT(ask(client, "< muxfilter 0 0 123 1 0 0 0 0 0 0 0 0 >"), HasSubstr("2 to 257 tuples"));
  EXPECT_THAT(ask(client, "< muxfilter 0 0 123 2 0 >"), HasSubstr("byte of a tuple is missing"));
}

TEST_F(SocketcandProtocol, JobsRunInSimulatedTime) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client, "< open can0 >< add 0 20000 123 4 42 42 42 42 >"), "< ok >");
  EXPECT_EQ(bench_.sent.size(), 1U);
  bench_.now = 19 * kMillisecond;
  EXPECT_EQ(ask(client, ""), "");
  EXPECT_EQ(bench_.sent.size(), 1U);
  bench_.now = 20 * kMillisecond;
  EXPECT_EQ(ask(client, "< update 123 3 11 22 33 >"), "");
  bench_.now = 40 * kMillisecond;
  EXPECT_EQ(ask(client, ""), "");
  ASSERT_EQ(bench_.sent.size(), 3U);
  EXPECT_EQ(bench_.sent[2].message.frame.len, 3);
  EXPECT_EQ(ask(client, "< delete 123 >"), "");
  bench_.now = kSecond;
  EXPECT_EQ(ask(client, ""), "");
  EXPECT_EQ(bench_.sent.size(), 3U);
}

TEST_F(SocketcandProtocol, JobsEndWithTheModeAndWithTheConnection) {
  auto client = std::make_unique<SocketcandTestClient>(bench_.port());
  ASSERT_TRUE(bench_.expect(*client, "< hi >"));
  EXPECT_EQ(ask(*client, "< open can0 >< add 0 1000 1 0 >< rawmode >"), "< ok >< ok >");
  const auto count = bench_.sent.size();
  bench_.now += kSecond;
  EXPECT_EQ(ask(*client, "< bcmmode >"), "< ok >");
  EXPECT_EQ(bench_.sent.size(), count);
  EXPECT_EQ(ask(*client, "< add 10 0 1 0 >"), "");
  EXPECT_EQ(bench_.sent.size(), count + 1);
  client.reset();
  bench_.now += 100 * kSecond;
  auto other = bench_.raw_client();
  EXPECT_EQ(ask(*other, ""), "");
  EXPECT_EQ(bench_.sent.size(), count + 1);
}

TEST_F(SocketcandProtocol, StatisticsCountDataBytesAndFrames) {
  SocketcandTestClient client(bench_.port());
  ASSERT_TRUE(bench_.expect(client, "< hi >"));
  EXPECT_EQ(ask(client, "< open can0 >< send 1 2 1 2 >< controlmode >< statistics 100 >"),
            "< ok >< ok >");
  bench_.frame_from_bus(0x123, {1, 2, 3});
  bench_.frame_from_bus(0x124 | CAN_RTR_FLAG, {0, 0, 0, 0});
  EXPECT_EQ(ask(client, ""), "");
  bench_.now = 150 * kMillisecond;
  EXPECT_EQ(ask(client, ""), "\n< stat 3 2 2 1 >");
  bench_.now = 200 * kMillisecond;
  EXPECT_EQ(ask(client, ""), "");
  EXPECT_EQ(ask(client, "< statistics 0 >"), "");
  bench_.now = kSecond;
  EXPECT_EQ(ask(client, ""), "");
}

// In another mode nobody could turn them off.
TEST_F(SocketcandProtocol, StatisticsEndWithTheirMode) {
  for (const char *const mode : {"< rawmode >", "< bcmmode >"}) {
    SocketcandTestClient client(bench_.port());
    ASSERT_TRUE(bench_.expect(client, "< hi >"));
    EXPECT_EQ(ask(client, "< open can0 >< controlmode >< statistics 100 >"), "< ok >< ok >");
    EXPECT_EQ(ask(client, mode), "< ok >");
    bench_.now += kSecond;
    EXPECT_EQ(ask(client, ""), "") << mode;
  }
}

TEST(SocketcandServerNames, BadNamesAreNamed) {
  const auto failure = [](std::vector<std::string> names) -> std::string {
    try {
      SocketcandServer server({"127.0.0.1", 0}, std::move(names));
    } catch (const InputError &error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(failure({"can0", "can1"}), "no error");
  EXPECT_EQ(failure({"can0", "can0"}), "--bus-name: 'can0' is named twice");
  for (const char *name : {"", "a b", "a<", "12345678901234567", "k\xC3\xA4n"})
    EXPECT_THAT(failure({name}), HasSubstr("is not allowed; allowed: 1 to 16 printable"));
}

struct AddressCase {
  const char *text;
  const char *host;
  unsigned port;
};

TEST(SocketcandAddress, FormsThatAreAllowed) {
  for (const auto &[text, host, port] : {AddressCase{"29536", "127.0.0.1", 29536},
                                         {"0", "127.0.0.1", 0},
                                         {"0.0.0.0:65535", "0.0.0.0", 65535},
                                         {"localhost:1", "localhost", 1},
                                         {"[::1]:29536", "::1", 29536}}) {
    const auto address = SocketcandAddress::parse("--socketcand", text);
    EXPECT_EQ(address.host, host);
    EXPECT_EQ(address.port, port);
  }
}

TEST(SocketcandAddress, OthersAreNamed) {
  for (const char *text : {"", ":", "65536", "-1", "x", "127.0.0.1:", ":29536", "::1:29536",
                           "127.0.0.1:29536x", "127.0.0.1", "[::1]", "1 "}) {
    try {
      const auto address = SocketcandAddress::parse("--socketcand", text);
      ADD_FAILURE() << text << " is " << address.text();
    } catch (const InputError &error) {
      EXPECT_THAT(error.what(), HasSubstr("is not allowed; allowed: [ADDRESS:]PORT"));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST(SocketcandAddress, APortInUseIsNamed) {
  const SocketcandListener first("--socketcand", {"127.0.0.1", 0});
  EXPECT_NE(first.address().port, 0);
  try {
    const SocketcandListener second("--socketcand", first.address());
    ADD_FAILURE() << "two servers on one port";
  } catch (const InputError &error) {
    EXPECT_EQ(error.what(), "--socketcand: cannot listen on " + first.address().text() +
                                ": Address already in use");
  }
}

TEST(SocketcandAddress, AnAddressOfAnotherMachineIsNamed) {
  // TEST-NET-1 of RFC 5737: no machine has it.
  EXPECT_THROW(SocketcandListener("--socketcand", {"192.0.2.1", 0}), InputError);
  EXPECT_THROW(SocketcandListener("--socketcand", {"no such host", 0}), InputError);
}

}  // namespace
}  // namespace vericansim
