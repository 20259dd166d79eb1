// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Remote nodes in scenario files: what their keys put where, and what is refused (RN-96).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/input_error_of.hpp"
#include "scenario/scenario_warnings.hpp"
#include "session/runner.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scenario with(const std::string &keys, const std::string &more = "") {
  return parse_scenario("remote.yaml", "nodes:\n  - {name: host}\n  - {name: pfc, type: remote" +
                                           keys + "}\n" + more);
}

/// Bytes of the node before it starts: of the model, which user logic fills in no time.
std::vector<unsigned> bytes(const std::string &keys, unsigned address, unsigned n) {
  const Scenario scenario = with(keys + ", made_of: model");
  Simulation simulation{scenario, 500e3};
  std::vector<unsigned> bytes;
  for (unsigned i = 0; i < n; ++i) bytes.push_back(simulation.remote(1)->peek(address + i));
  return bytes;
}

// RN-96.
TEST(ScenarioRemote, ParametersAndMemory) {
  const RemoteRole role = std::get<RemoteRole>(
      with(", number: 6, profile: standard, serial: 0x1234, memory_bytes: 2048, stage_bytes: 16")
          .nodes.at(1)
          .role);
  EXPECT_EQ(role.number, 6U);
  EXPECT_EQ(role.config.features(), 0x1F);
  EXPECT_EQ(role.config.serial, 0x1234U);
  EXPECT_EQ(role.config.mem_bytes, 2048U);
  EXPECT_EQ(role.config.stage_bytes, 16U);
  EXPECT_THAT(bytes(", memory: {0x40: 01 A5, 66: ff}", 0x3F, 5), ElementsAre(0, 1, 0xA5, 0xFF, 0));
  EXPECT_THAT(bytes(", number: 6", 0xF00, 8), ElementsAre(6, 5, 0, 0, 0x0A, 0x0A, 0x32, 8));
}

// Section 8, RN-60 to RN-66: each key is its bytes.
TEST(ScenarioRemote, ConfigurationIsMemory) {
  EXPECT_THAT(bytes(", config: {watchdog: 300 ms, back_off: 7 ms, life: 50 ms, retry: 3, "
                    "block_time_out: 1 s, label: pfc, tell_writes: true, tell_start: false, "
                    "auto_operate: true}",
                    0xF01, 7),
              ElementsAre(0x0B, 0x2C, 0x01, 7, 5, 100, 3));
  EXPECT_THAT(bytes(", config: {label: pfc}", 0xF18, 4), ElementsAre('p', 'f', 'c', 0));
  EXPECT_THAT(
      bytes(", config: {write_protect: [0x20-0x2F, 0x180-0x27F], read_protect: 0xD80-0xDFF}", 0xF08,
            13),
      ElementsAre(0x18, 0, 0, 0, 0x04, 0, 0, 0, 0, 0, 0, 0x08, 0));
  EXPECT_THAT(
      bytes(", config: {producers: [{send: 0x40, length: 2, period: 300 ms, on_change: true, "
            "gap: 5 ms}, {send: status, length: 8, triggers: 2}]}",
            0xF40, 13),
      ElementsAre(0x40, 0xB2, 0x2C, 0x01, 5, 0, 0, 0, 0x7E, 0xD8, 2, 0, 0));
  EXPECT_THAT(bytes(", config: {map: [{id: 0x580, mask: 0x780, to: 0x200, time_out: 50 ms}, {id: "
                    "0x123, to: 0x30, length: 3, trigger: true, safe_when_late: true, "
                    "time_out: 70 ms}]}",
                    0xF80, 16),
              ElementsAre(0x80, 0x85, 0x80, 0x07, 0x00, 0x02, 0, 5, 0x23, 0x81, 0xFF, 0x07, 0x30, 0,
                          0x63, 7));
}

TEST(ScenarioRemote, MistakesAreToldWithTheirPlace) {
  const auto message = [](const std::string &keys) {
    return input_error_of([&] { return with(keys); });
  };
  EXPECT_THAT(message(", number: 8"),
              HasSubstr("remote.yaml:3: nodes[1].number: '8' is not allowed"));
  EXPECT_THAT(message(", profile: big"), HasSubstr("allowed: small, standard, full"));
  EXPECT_THAT(message(", name_bits: 4"), HasSubstr("NameBits 4 is not allowed; allowed: 3 5"));
  EXPECT_THAT(message(", memory: {0xE00: 01}"), HasSubstr("'0xE00' is no address"));
  EXPECT_THAT(message(", memory: {0xFC0: 01}"), HasSubstr("0xF00 to 0xF1F, 0xF40 to 0xFBF"));
  EXPECT_THAT(message(", memory: {0xF1F: 01 02}"), HasSubstr("1 to 1 bytes"));
  EXPECT_THAT(message(", profile: small, memory: {0xF40: 01}"),
              HasSubstr("'0xF40' is no address; allowed: 0x0 to 0xDFF, 0xF00 to 0xF1F"));
  EXPECT_THAT(message(", memory: {0xFBF: 01 02}"), HasSubstr("1 to 1 bytes"));
  EXPECT_THAT(message(", memory: {0xDFF: 01 02}"), HasSubstr("1 to 1 bytes"));
  EXPECT_THAT(message(", memory: {0x20: 123}"), HasSubstr("hexadecimal bytes"));
  EXPECT_THAT(message(", number: 6, memory: {0xEFF: 01}"), HasSubstr("is no address"));
  EXPECT_THAT(message(", number: 6, memory: {0xF00: 05 01}"),
              HasSubstr("nodes[1].number: 'memory' gives it, too, at 0xF00; allowed: one of them"));
  EXPECT_EQ(message(", memory: {0xF00: 05 01}"), "no error");
  EXPECT_THAT(message(", memory: {0xF01: 05 07 08}, config: {tell_writes: true}"),
              HasSubstr("nodes[1].config: byte 0xF01 is given already; allowed: each byte once"));
  EXPECT_THAT(message(", memory: {0xF00: 05 01}, config: {tell_writes: true}"),
              HasSubstr("config: byte 0xF01 is given already"));
  EXPECT_THAT(message(", config: {producers: [{send: status, length: 1, period: 0 ms}]}"),
              HasSubstr("producers[0].period: '0 ms' is not allowed; allowed: 1 ms or more"));
  EXPECT_THAT(message(", config: {watchdog: 1.5 ms}"), HasSubstr("a multiple of 1 ms"));
  EXPECT_THAT(message(", config: {watchdog: 66 s}"), HasSubstr("config.watchdog"));
  EXPECT_THAT(message(", config: {life: 15 ms}"), HasSubstr("a multiple of 10 ms"));
  EXPECT_THAT(message(", config: {label: too long a label}"),
              HasSubstr("16 bytes; allowed: 8 at most"));
  EXPECT_THAT(message(", config: {wachdog: 1 ms}"), HasSubstr("unknown key 'wachdog'"));
  EXPECT_THAT(message(", profile: small, config: {producers: [{send: 0, length: 1}]}"),
              HasSubstr("1 entries; allowed: 0"));
  EXPECT_THAT(message(", config: {producers: [{send: 0x7E, length: 1}]}"),
              HasSubstr("'0x7E' is not allowed; allowed: status, identity, or an address of 0 to "
                        "0x77"));
  EXPECT_THAT(message(", config: {producers: [{send: 0x77, length: 2}]}"),
              HasSubstr("beyond the window"));
  EXPECT_THAT(message(", config: {producers: [{send: all, length: 2}]}"), HasSubstr("status"));
  EXPECT_THAT(message(", config: {producers: [{send: 0, length: 1, period: 1 ms, triggers: 1}]}"),
              HasSubstr("one of them"));
  EXPECT_THAT(message(", config: {map: [{id: 0x800, to: 0}]}"), HasSubstr("0x7FF"));
  EXPECT_THAT(message(", config: {write_protect: 0x20-0x30}"), HasSubstr("whole pages"));
  EXPECT_THAT(message(", config: {write_protect: 0x40}"), HasSubstr("whole pages"));
  EXPECT_THAT(message(", profile: small, config: {write_protect: 0x20-0x2F}"),
              HasSubstr("no protection"));
  EXPECT_THAT(message(", memory_bytes: 1024, config: {write_protect: [0x200-0x27F]}"),
              HasSubstr("an area below 0x200 of whole pages"));
  EXPECT_THAT(message(", profile: standard, config: {block_time_out: 1 s}"),
              HasSubstr("no block transfers"));
  EXPECT_THAT(message(", made_of: wood"), HasSubstr("allowed: rtl, model"));
  EXPECT_THAT(message(", profile: small, stage_bytes: 0, made_of: rtl"),
              HasSubstr("no RTL is built with these parameters; allowed: profile small"));
  EXPECT_THAT(message(", mailboxes: 16"), HasSubstr("unknown key 'mailboxes'"));
  EXPECT_THAT(
      input_error_of([] { return parse_scenario("r.yaml", "nodes: [{name: a, type: b}]"); }),
      HasSubstr("allowed: remote"));
  EXPECT_THAT(input_error_of([] { return with("", "traffic: [{node: pfc, id: 1}]"); }),
              HasSubstr("type: remote"));
  EXPECT_THAT(input_error_of([] { return with("", "accesses: [{node: pfc, do: read MCR}]"); }),
              HasSubstr("pfc"));
  EXPECT_THAT(input_error_of([] { return with("", "judge: lockstep"); }), HasSubstr("pfc"));
}

// RN-65: an entry of the map that no frame can make do anything.
TEST(ScenarioRemote, EntriesThatNeverWork) {
  const auto message = [](const std::string &entry, const std::string &keys = "") {
    return input_error_of(
        [&] { return with(", number: 6" + keys + ", config: {map: [{" + entry + "}]}"); });
  };
  const auto no_room = [](const std::string &what) {
    return HasSubstr("config.map[0]: no memory for " + what + "; allowed: 0x0 to 0xDFF, 0xF00");
  };
  EXPECT_THAT(message("id: 0x123, to: 0xE00"), no_room("1 byte at E00"));
  EXPECT_THAT(message("id: 0x123, to: 0xDFE, length: 4"), no_room("4 bytes at DFE"));
  EXPECT_THAT(message("id: 0x123, to: 0xFC0"), no_room("1 byte at FC0"));
  EXPECT_THAT(message("id: 0x123, to: 0xFBF, length: 2"), no_room("2 bytes at FBF"));
  EXPECT_THAT(message("id: 0x123, to: 0x300", ", memory_bytes: 1024"),
              HasSubstr("no memory for 1 byte at 300; allowed: 0x0 to 0x1FF, 0xF00"));
  for (const char *id : {"0x320", "0x310, mask: 0x780", "0x000", "0x0C0"})
    EXPECT_THAT(message("id: " + std::string{id} + ", to: 0"), HasSubstr("is a request"));
  EXPECT_THAT(message("id: 0x5FE, mask: 0x7FE, to: 0"), HasSubstr("a port's frame is taken only"));
  EXPECT_THAT(message("id: 0x123, to: 0, safe_when_late: true"), HasSubstr("it is never late"));
}

// RN-65: what some frames can reach is allowed, and what a host may unlock.
TEST(ScenarioRemote, EntriesThatSomeFramesCanWorkFor) {
  const auto entry = [](const std::string &map, const std::string &keys = "") {
    const Scenario scenario = with(", number: 6" + keys + ", config: {map: [{" + map + "}]}");
    return std::get<RemoteRole>(scenario.nodes.at(1).role).memory.at(0xF80).at(0);
  };
  EXPECT_EQ(entry("id: 0x123, to: 0xDFC, length: 4"), 0x23);
  EXPECT_EQ(entry("id: 0x123, to: 0xDFF"), 0x23);
  EXPECT_EQ(entry("id: 0x123, to: 0xF00, length: 1"), 0x23);
  EXPECT_EQ(entry("id: 0x123, to: 0xDF0, mask: 0x780, length: 8"), 0x23);
  EXPECT_EQ(entry("id: 0x320, to: 0, mask: 0x3FF"), 0x20);
  EXPECT_EQ(entry("id: 0x2A0, to: 0"), 0xA0);
  EXPECT_EQ(entry("id: 0x5FE, to: 0"), 0xFE);
  EXPECT_EQ(entry("id: 0x580, to: 0x200, mask: 0x780"), 0x80);
  EXPECT_EQ(entry("id: 0x240, to: 0x1FF", ", name_bits: 5, memory_bytes: 1024"), 0x40);
}

/// A host and a node whose keys are `keys` for 20 ms.
RunReport run_with(const std::string &keys, const std::string &expected) {
  Scenario scenario = parse_scenario("remote.yaml", R"(
duration: 20 ms
nodes:
  - {name: host}
  - {name: pfc, type: remote, number: 6, clock: 12 MHz, ppm: 100, memory: {0x40: 01 02},)" +
                                                        keys + R"(}
traffic:
  - {node: host, id: 0x320, data: 5A, offset: 1 ms}
  - {node: host, id: 0x000, data: 01, offset: 2 ms}
  - {node: host, id: 0x320, remote: true, dlc: 2, offset: 3 ms, name: read}
expect: )" + expected);
  return run_scenario(scenario, 500e3);
}

/// As many checks as were asked for, and all of them hold.
void expect_ok(const RunReport &report, std::size_t checks) {
  EXPECT_EQ(report.checks.size(), checks);
  for (const CheckResult &check : report.checks) EXPECT_TRUE(check.ok) << check.what;
}

// A host's frames reach the node, its answers and statements the bus.
TEST(ScenarioRemote, TakesPartInARun) {
  const RunReport report =
      run_with("config: {producers: [{send: 0x40, length: 2, period: 5 ms}]}",
               "{frames: 8, error_frames: 0, nodes: {pfc: {sent: 5, received: 3}}}");
  expect_ok(report, 4);
}

// The same answers from the RTL and from its model; the configuration is there at the start.
TEST(ScenarioRemote, RtlAndModelTakePartAlike) {
  for (const std::string profile : {"small", "full"}) {
    for (const char *body : {"", ", made_of: rtl", ", made_of: model"}) {
      SCOPED_TRACE(profile + body);
      const RunReport report =
          run_with("profile: " + profile + ", config: {tell_writes: true}" + body,
                   "{frames: 6, error_frames: 0, nodes: {pfc: {sent: 3, received: 3}}}");
      expect_ok(report, 4);
    }
  }
}

// RN-11: two nodes with one number, or one serial number.
TEST(ScenarioRemote, WarningsOfSharedNumbers) {
  const auto warnings = [](const std::string &more) {
    return warnings_of(with(", number: 6", "  - {name: dab, type: remote" + more + "}\n"));
  };
  EXPECT_THAT(warnings(", number: 7, serial: 1"), ElementsAre());
  EXPECT_THAT(warnings(", serial: 1"), ElementsAre());
  EXPECT_THAT(
      warnings(", number: 6"),
      ElementsAre("number 6 is that of 'pfc', 'dab': their answers destroy each other",
                  "serial number 0x00000000 is that of 'pfc', 'dab': ASSIGN means all of them"));
  EXPECT_THAT(warnings_of(with(", serial: 1", "  - {name: dab, type: remote}\n")), ElementsAre());
}

}  // namespace
}  // namespace vericansim
