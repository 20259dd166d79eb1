// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The axes of the matrix: see injection_axes.hpp.
#include "faults/injection_axes.hpp"

#include <cstdint>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using model_bench::rep;

constexpr std::uint8_t kValues[] = {0, 1, 95, 96, 119, 120, 126, 127, 128, 247, 248, 255};

std::vector<StartCounters> make_counters() {
  std::vector<StartCounters> all;
  for (const std::uint8_t tec : kValues) all.push_back({tec, 0});
  for (const std::uint8_t rec : kValues) {
    if (rec != 0) all.push_back({0, rec});
  }
  for (const StartCounters &both : {StartCounters{1, 1},
                                    {95, 96},
                                    {96, 95},
                                    {119, 120},
                                    {127, 126},
                                    {128, 128},
                                    {247, 127},
                                    {255, 255}}) {
    all.push_back(both);
  }
  return all;
}

}  // namespace

const std::vector<StartCounters> &all_counters() {
  static const std::vector<StartCounters> kAll = make_counters();
  return kAll;
}

const std::vector<StartCounters> &main_counters() {
  static const std::vector<StartCounters> kMain = {
      {0, 0}, {95, 95}, {120, 0}, {127, 127}, {128, 0}, {0, 128}, {128, 128}, {247, 0}, {248, 0}};
  return kMain;
}

std::string name_of(const StartCounters &counters) {
  return "tec" + std::to_string(counters.tec) + "rec" + std::to_string(counters.rec);
}

std::string state_of(const StartCounters &counters) {
  const bool tec = counters.tec >= 128;
  const bool rec = counters.rec >= 128;
  if (tec && rec) return "P(both)";
  if (tec || rec) return tec ? "P(tec)" : "P(rec)";
  return "A";
}

const std::vector<Stream> &all_streams() {
  static const std::vector<Stream> kStreams = {
      {"base-1byte", {.id = 0x123, .dlc = 1, .data = {0x55}}, {}},
      {"base-runs-of-5",
       {.id = 0x078, .dlc = 8, .data = {0x01, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1, 0xE1}},
       {}},
      {"base-last-stuff-r", {.id = 0x009}, {}},
      {"base-last-stuff-d", {.id = 0x017}, {}},
      {"base-remote-dlc15", {.id = 0x7E0, .remote = true, .dlc = 15}, {}},
      {"base-remote-dlc8", {.id = 0x017, .remote = true, .dlc = 8}, {}},
      {"base-dlc15",
       {.id = 0x2AA, .dlc = 15, .data = {0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08}},
       {}},
      {"ext-remote", {.id = 0x00000000, .extended = true, .remote = true}, {}},
      {"ext-remote-runs-of-5", {.id = 0x0000000F, .extended = true, .remote = true}, {}},
      {"ext-dlc15",
       {.id = 0x1F07C1F0, .extended = true, .dlc = 15, .data = {0xFF, 0, 0xFF, 0, 15, 131, 224}},
       {}},
      {"ext-1byte", {.id = 0x1FFFFFFF, .extended = true, .dlc = 1, .data = {0xF8}}, {}}};
  return kStreams;
}

const std::vector<Stream> &odd_streams() {
  constexpr Level kR = Level::kRecessive;
  static const std::vector<Stream> kStreams = {
      {"base-r0", {.id = 0x16B, .dlc = 7, .data = {0x9C, 0x6D}}, {.r0 = kR}},
      {"ext-srr-d", {.id = 0x0AB5E21B, .extended = true, .dlc = 1}, {.srr = Level::kDominant}},
      {"ext-r1-r0",
       {.id = 0x0123456F, .extended = true, .remote = true, .dlc = 14},
       {.r0 = kR, .r1 = kR}},
      {"ext-r1", {.id = 0x1555557, .extended = true, .remote = true, .dlc = 8}, {.r1 = kR}}};
  return kStreams;
}

std::vector<Reaction> plain_reactions() {
  std::vector<Reaction> all = {
      {"L0", "", false, ""}, {"L1", rep(6, "0"), false, ""}, {"L2", "1" + rep(6, "0"), false, ""}};
  for (int k = 1; k <= 16; ++k)
    all.push_back({"Lk" + std::to_string(k), rep(6 + k, "0"), false, ""});
  return all;
}

std::vector<Reaction> going_reactions() {
  return {{"go", "", true, ""},
          {"go-L1", "", true, rep(6, "0")},
          {"go-L2", "", true, "1" + rep(6, "0")},
          {"go-Lk1", "", true, rep(7, "0")},
          {"go-Lk8", "", true, rep(14, "0")},
          {"go-Lk16", "", true, rep(22, "0")}};
}

std::vector<Reaction> starting_reactions() {
  return {{"sof-low", model_bench::whole(kLowFrame).substr(1), false, ""},
          {"sof-high", model_bench::whole(kHighFrame).substr(1), false, ""}};
}

std::vector<Reaction> join(std::vector<std::vector<Reaction>> lists) {
  std::vector<Reaction> all;
  for (std::vector<Reaction> &list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace vericansim
