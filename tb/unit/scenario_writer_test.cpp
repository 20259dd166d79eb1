// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// to_yaml(): a scenario as text is the same scenario again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "scenario/scenario.hpp"
#include "trace/log.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A scenario with every kind of fault as text is the same scenario again.
TEST(ScenarioWriter, FaultsAreWrittenAsTheyAreRead) {
  const std::string text = to_yaml(parse_scenario(
      "s.yaml", std::string("nodes: [{name: a}, {name: b}]\n") +
                    "faults:\n"
                    "  - {kind: flip, at: {node: a, frame: 2, field: ID, bits_left: 3}, hits: 1}\n"
                    "  - {kind: noise, per_bit: 0.1, name: \"it's\", hits: {min: 2, max: 9}}\n"
                    "  - {kind: cut, node: b, from: 1 ms, name: \"a: b\", hits: {max: 3}}\n"
                    "  - {kind: clock, node: b, from: 2 ms, ppm: 3}\n"));
  const Scenario read = parse_scenario("s.yaml", text);
  EXPECT_EQ(to_yaml(read), text);
  EXPECT_EQ(read.faults.at(1).name, "it's");
  EXPECT_EQ(read.faults.at(2).name, "a: b");
  EXPECT_EQ(read.faults.at(0).hits->least, 1);
  EXPECT_EQ(read.faults.at(1).hits->most, 9);
  EXPECT_FALSE(read.faults.at(3).hits);
}

constexpr const char *kEveryKind =
    "name: 'every: kind'\nduration: 3 s\npacing: fast\nend: done\n"
    "nodes:\n"
    "  - {name: board, firmware: f/app.elf, clocks_per_instruction: 3,\n"
    "     run_hard_fault_handler: true, clock: 16 MHz}\n"
    "  - {name: second, second_core_of: board}\n"
    "  - {name: 'boat, left', replay: boat.log, channel: can1, start: 5 ms, from: 1 s, to: 2500 "
    "ms,\n"
    "     rate: 0.5, loop: true, filter: [100:7F0, 00000123~1FFFFFFF], frames: 7, share: 2/3,\n"
    "     listen_only: false, filters: [{id: 1, mask: 2, match_format: false, remote: true}]}\n"
    "  - {name: whole, replay: /logs/b.log, rate: saturated}\n"
    "  - {name: pc, interface: vcan0, filter: 7E8:7FF, errors: state, restart: 0, echo: true,\n"
    "     queue: 9, end_when_down: true}\n"
    "  - {name: tcp, socketcand: '127.0.0.1:29536', errors: none, wait_for_clients: 2}\n"
    "  - {name: ear, monitor: true}\n"
    "  - {name: pfc, type: remote, profile: standard, number: 9, name_bits: 5, serial: 0x12,\n"
    "     memory: {0x40: 01 A5, 0xF02: 14}, config: {producers: [{send: 0, length: 1}]}}\n"
    "  - {name: '#1', monitor: vcan1}\n"
    "  - {monitor: vcan2}\n"
    "traffic:\n  - {node: ear, id: 1, name: \"null\"}\n";

std::string here(const std::string &path) {
  return (std::filesystem::current_path() / path).string();
}

// Every kind of node as text is the same scenario again, whatever folder the text is in.
TEST(ScenarioWriter, KindsOfNodesAreWrittenAsTheyAreRead) {
  const std::string text = to_yaml(parse_scenario("s.yaml", kEveryKind));
  const Scenario read = parse_scenario("elsewhere/t.yaml", text);
  EXPECT_EQ(to_yaml(read), text);
  EXPECT_EQ(read.name, "every: kind");
  ASSERT_EQ(read.nodes.size(), 8U);
  const auto &firmware = std::get<FirmwareRole>(read.nodes[0].role);
  EXPECT_EQ(firmware.file, here("f/app.elf"));
  EXPECT_EQ(firmware.clocks_per_instruction, 3U);
  EXPECT_TRUE(firmware.run_hard_fault_handler);
  EXPECT_EQ(std::get<SecondCoreRole>(read.nodes[1].role).board, "board");
  EXPECT_EQ(read.nodes[1].clock.frequency_hz, 16e6);
  EXPECT_TRUE(read.nodes[6].host.listen_only);
  const auto &remote = std::get<RemoteRole>(read.nodes[7].role);
  EXPECT_EQ(remote.number, 9U);
  EXPECT_EQ(remote.config.features(), 0x1F);
  EXPECT_EQ(remote.config.serial, 0x12U);
  EXPECT_THAT(remote.memory.at(0x40), ElementsAre(1, 0xA5));
  EXPECT_THAT(remote.memory.at(0xF02), ElementsAre(0x14));
  EXPECT_THAT(remote.memory.at(0xF41), ElementsAre(0x81));
  EXPECT_EQ(read.traffic[0].name, "null");
}

TEST(ScenarioWriter, ARecordingIsWrittenAsItIsRead) {
  const Scenario read =
      parse_scenario("elsewhere/t.yaml", to_yaml(parse_scenario("s.yaml", kEveryKind)));
  EXPECT_EQ(read.nodes[2].name, "boat, left");
  const auto &replay = std::get<ReplayRole>(read.nodes[2].role);
  EXPECT_EQ(replay.file, here("boat.log"));
  EXPECT_EQ(replay.channel, "can1");
  EXPECT_EQ(replay.start, 5 * kMillisecond);
  EXPECT_EQ(replay.from, kSecond);
  EXPECT_EQ(replay.to, 2500 * kMillisecond);
  EXPECT_EQ(replay.rate, 0.5);
  EXPECT_TRUE(replay.loop);
  EXPECT_THAT(replay.filters, ElementsAre(IdFilter{0x100, 0x7F0, false},
                                          IdFilter{0x123 | CAN_EFF_FLAG, 0x1FFFFFFF, true}));
  EXPECT_EQ(replay.frames, 7U);
  EXPECT_EQ(replay.share, 1U);
  EXPECT_EQ(replay.shares, 3U);
  ASSERT_EQ(read.nodes[2].host.filters.size(), 1U);
  EXPECT_FALSE(read.nodes[2].host.filters[0].match_format);
  EXPECT_TRUE(read.nodes[2].host.filters[0].match_remote);
  EXPECT_TRUE(read.nodes[2].host.filters[0].remote);
  EXPECT_EQ(std::get<ReplayRole>(read.nodes[3].role).file, "/logs/b.log");
  EXPECT_TRUE(std::get<ReplayRole>(read.nodes[3].role).saturated);
}

TEST(ScenarioWriter, ProgramsAndTheEndAreWrittenAsTheyAreRead) {
  const Scenario read =
      parse_scenario("elsewhere/t.yaml", to_yaml(parse_scenario("s.yaml", kEveryKind)));
  const auto &interface = std::get<InterfaceRole>(read.nodes[4].role);
  EXPECT_EQ(interface.interface, "vcan0");
  EXPECT_THAT(interface.programs.filters, ElementsAre(IdFilter{0x7E8, 0x7FF, false}));
  EXPECT_EQ(interface.programs.errors, "state");
  EXPECT_EQ(interface.programs.restart, 0);
  EXPECT_TRUE(interface.echo && interface.end_when_down);
  EXPECT_EQ(interface.queue, 9U);
  const auto &socketcand = std::get<SocketcandRole>(read.nodes[5].role);
  EXPECT_EQ(socketcand.address, "127.0.0.1:29536");
  EXPECT_EQ(socketcand.programs.errors, "none");
  EXPECT_EQ(socketcand.wait_for_clients, 2U);
  ASSERT_EQ(read.listeners.size(), 2U);
  EXPECT_EQ(read.listeners[0].name, "#1");
  EXPECT_EQ(std::get<MonitorRole>(read.listeners[0].role).interface, "vcan1");
  EXPECT_EQ(read.listeners[1].name, "vcan2");
  EXPECT_EQ(read.duration, 3 * kSecond);
  EXPECT_EQ(read.pacing, Pacing::kFast);
  EXPECT_TRUE(read.until_done);
}

constexpr const char *kRemote =
    "nodes:\n"
    "  - {name: host}\n"
    "  - {name: 'p f c', type: remote, profile: standard, number: 6,\n"
    "     memory: {0xF79: 81}}\n"
    "commands:\n"
    "  - {node: host, at: 1500 us, do: [operate, 'read 6 0x20 2 = 5A 00', trigger]}\n"
    "  - {node: host, period: 2 ms, count: 3, do: [write all 0x10 round FF]}\n"
    "user:\n"
    "  - {node: 'p f c', at: 1 ms, period: 3 ms, count: 4, write: {0x40: 01 A5, 0x203: 07}}\n"
    "  - {node: 'p f c', ramp: 0x50, from: 9, step: 3}\n"
    "  - {node: 'p f c', after: apply, delay: 10 us, count: 2,\n"
    "     plant: {set_point: 0x12, measured: 0x44}, event: 7}\n";

// RN-96.
TEST(ScenarioWriter, CommandsAreWrittenAsTheyAreRead) {
  const std::string text = to_yaml(parse_scenario("s.yaml", kRemote));
  const Scenario read = parse_scenario("s.yaml", text);
  EXPECT_EQ(to_yaml(read), text);
  ASSERT_EQ(read.commands.size(), 2U);
  EXPECT_EQ(read.commands[0].node, 0U);
  EXPECT_EQ(read.commands[0].at, 1500 * kMicrosecond);
  EXPECT_EQ(read.commands[0].period, 0);
  ASSERT_EQ(read.commands[0].steps.size(), 3U);
  EXPECT_EQ(read.commands[0].steps[1].frame.id, 0x320U);
  ASSERT_TRUE(read.commands[0].steps[1].wanted);
  EXPECT_THAT(*read.commands[0].steps[1].wanted, ElementsAre(0x5A, 0));
  EXPECT_TRUE(read.commands[0].steps[2].counts);
  EXPECT_EQ(read.commands[1].period, 2 * kMillisecond);
  EXPECT_EQ(read.commands[1].count, 3U);
  EXPECT_THAT(read.commands[1].steps.at(0).rounds, ElementsAre(0U));
}

// RN-96.
TEST(ScenarioWriter, UserLogicIsWrittenAsItIsRead) {
  const Scenario read = parse_scenario("t.yaml", to_yaml(parse_scenario("s.yaml", kRemote)));
  ASSERT_EQ(read.user.size(), 3U);
  for (const UserSpec &user : read.user) EXPECT_EQ(user.node, 1U);
  EXPECT_EQ(read.user[0].at, kMillisecond);
  EXPECT_EQ(read.user[0].period, 3 * kMillisecond);
  EXPECT_EQ(read.user[0].count, 4U);
  EXPECT_THAT(read.user[0].write.at(0x40), ElementsAre(1, 0xA5));
  EXPECT_THAT(read.user[0].write.at(0x203), ElementsAre(7));
  EXPECT_FALSE(read.user[0].ramp || read.user[0].plant || read.user[0].event);
  EXPECT_EQ(read.user[1].ramp, 0x50U);
  EXPECT_EQ(read.user[1].from, 9U);
  EXPECT_EQ(read.user[1].step, 3U);
  EXPECT_TRUE(read.user[2].after_apply);
  EXPECT_EQ(read.user[2].at, 10 * kMicrosecond);
  EXPECT_EQ(read.user[2].count, 2U);
  ASSERT_TRUE(read.user[2].plant);
  EXPECT_EQ(read.user[2].plant->set_point, 0x12U);
  EXPECT_EQ(read.user[2].plant->measured, 0x44U);
  EXPECT_EQ(read.user[2].event, 7U);
}

// What ends by itself, or not at all, still does.
TEST(ScenarioWriter, EndsThatAreNotWrittenAreTheSame) {
  for (const char *nodes : {"  - {name: r, replay: a.log}\n", "  - {name: t, socketcand: 29536}\n",
                            "  - {name: t, socketcand: 29536}\n  - {name: r, replay: a.log}\n"}) {
    const std::string list = std::string("nodes:\n") + nodes;
    for (const std::string &text : {list, list + "pacing: fast\n", list + "duration: 7 ms\n"}) {
      const Scenario first = parse_scenario("s.yaml", text);
      const Scenario again = parse_scenario("s.yaml", to_yaml(first));
      EXPECT_EQ(again.endless, first.endless) << text;
      EXPECT_EQ(again.until_done, first.until_done) << text;
      EXPECT_EQ(again.pacing, first.pacing) << text;
      EXPECT_EQ(again.duration, first.duration) << text;
    }
  }
}

std::string refusal_of(const NodeRole &role) {
  Scenario scenario = parse_scenario("s.yaml", "nodes:\n  - name: n\n");
  scenario.nodes[0].role = role;
  try {
    return to_yaml(scenario);
  } catch (const std::invalid_argument &error) {
    return error.what();
  }
}

TEST(ScenarioWriter, WhatNoFileCanSayIsRefusedWithTheReason) {
  EXPECT_EQ(refusal_of(OwnRole{}),
            "node 'n' cannot be written as text: a program works it by itself");
  ReplayRole replay;
  replay.log = std::make_shared<const CanLog>();
  EXPECT_EQ(refusal_of(replay),
            "node 'n' cannot be written as text: its recording is in memory, not in a file");
  FirmwareRole firmware;
  firmware.endless = false;
  EXPECT_THAT(refusal_of(firmware), HasSubstr("its firmware must end"));
  RemoteRole remote;
  remote.config.block = true;
  EXPECT_THAT(refusal_of(remote), HasSubstr("of no profile"));
  Scenario scenario = parse_scenario("s.yaml", "name: x\nnodes:\n  - name: n\n");
  scenario.endless = true;
  EXPECT_THROW((void)to_yaml(scenario), std::invalid_argument);
}

}  // namespace
}  // namespace vericansim
