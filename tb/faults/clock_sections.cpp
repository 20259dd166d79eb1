// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Sections at clock resolution: a level forced for some clocks at any clock of any bit; and the
// sweep SY-19.
#include <algorithm>
#include <utility>

#include "faults/clock_rig.hpp"
#include "faults/section.hpp"
#include "protocol/sync_sweep.hpp"

namespace vericansim {
namespace {

/// What goes on when the level is forced, counted in bits of the DUT from the bit before SOF.
struct Act {
  const char *name;
  bool transmitter;
  bool error;      // a bit of the frame has been broken before
  unsigned first;  // positions that are disturbed
  unsigned count;
};

// The base frame of 53 bits with its gap and idle, and the error frame after a broken bit.
constexpr Act kActs[] = {{"receive", false, false, 0, 68},
                         {"send", true, false, 0, 68},
                         {"receive-error", false, true, 9, 34},
                         {"send-error", true, true, 9, 34}};
constexpr unsigned kBrokenBit = 8;  // the fourth bit of the identifier and a stuff bit's place

const Frame kFrame{.id = 0x078, .dlc = 1, .data = {0x55}};
constexpr unsigned kLengths[] = {1, 2, 3, 4, 6, 8, 12, 20};

struct Setting {
  const char *name;
  BitTiming timing;
};

// 8 and 10 clocks a bit, both edges of the SJW range, quanta of one and two clocks.
constexpr Setting kSettings[] = {{"8clk", {1, 3, 2, 2, 1}},
                                 {"10clk-sjw2", {1, 4, 3, 2, 2}},
                                 {"10clk-sjw4", {1, 1, 4, 4, 4}},
                                 {"16clk", {2, 2, 2, 3, 2}}};

const std::vector<StartCounters> kStates = {{0, 0}, {128, 0}, {0, 128}};

struct ClockPlace {
  const Act *act;
  unsigned position;
};

std::vector<ClockPlace> places() {
  std::vector<ClockPlace> all;
  for (const Act &act : kActs) {
    for (unsigned n = 0; n < act.count; ++n) all.push_back({&act, act.first + n});
  }
  return all;
}

Grid grid_of(const Setting &setting) {
  Axis where{"place", {}};
  for (const ClockPlace &place : places()) {
    where.values.push_back(std::string{place.act->name} + "." + std::to_string(place.position));
  }
  Axis offsets{"clock", {}};
  for (unsigned n = 0; n < setting.timing.clocks_per_bit(); ++n) {
    offsets.values.push_back(std::to_string(n));
  }
  Axis lengths{"length", {}};
  for (const unsigned n : kLengths) lengths.values.push_back(std::to_string(n));
  Axis counters{"counters", {}};
  for (const StartCounters &c : kStates) counters.values.push_back(name_of(c));
  return {std::string{"clock-"} + setting.name,
          {std::move(where),
           std::move(offsets),
           std::move(lengths),
           {"level", {"d", "r"}},
           std::move(counters)}};
}

class ClockSection : public Section {
 public:
  explicit ClockSection(const Setting &setting)
      : Section{grid_of(setting),
                "TH-03, SY-01 to SY-15: a level forced for some clocks at any clock of any bit"},
        timing_{setting.timing} {}

  Outcome run(const Grid::Digits &at, RuleBins *) const override {
    const ClockPlace &place = places_[at[0]];
    const StartCounters &counters = kStates[at[4]];
    ClockRig rig{timing_, counters};
    rig.request(kFrame, place.act->transmitter);
    if (place.act->error) {
      rig.run_bits(kBrokenBit);
      const bool dominant = rig.reference().tx() == Level::kDominant;
      rig.force(0, timing_.clocks_per_bit(), dominant ? Level::kRecessive : Level::kDominant);
      rig.run_bits(place.position - kBrokenBit);
    } else {
      rig.run_bits(place.position);
    }
    const NodeModel &model = rig.reference().model();
    Outcome outcome{.role = role_name(model.role()),
                    .state = state_of(counters),
                    .position = std::string{field_name(model.state().field)},
                    .reaction = grid().axes()[3].values[at[3]] + " for some clocks"};
    rig.force(static_cast<unsigned>(at[1]), kLengths[at[2]],
              at[3] == 0 ? Level::kDominant : Level::kRecessive);
    rig.finish();
    outcome.report = rig.report();
    return outcome;
  }

 private:
  BitTiming timing_;
  std::vector<ClockPlace> places_ = places();
};

// Shortest, longest and ordinary segments; each with every SJW that BT-03 allows.
constexpr BitTiming kSweepTimings[] = {{4, 5, 2, 2, 1}, {5, 1, 4, 4, 1}, {4, 8, 8, 8, 1},
                                       {4, 1, 2, 2, 1}, {4, 3, 4, 8, 1}, {4, 8, 1, 2, 1},
                                       {6, 4, 3, 2, 1}, {4, 2, 8, 4, 1}, {7, 7, 3, 3, 1}};

class SyncSection : public Section {
 public:
  SyncSection()
      : Section{{"sync", {{"edge", names()}}},
                "SY-19: every phase error in every kind of bit, SJW 1 to what the segments allow"} {
  }

  Outcome run(const Grid::Digits &at, RuleBins *bins) const override {
    const Edge &edge = edges_[at[0]];
    Outcome outcome{
        .role = role_name(edge.place->role), .state = "A", .position = "edge", .reaction = "edge"};
    outcome.report = check_edge(*edge.place, edge.timing, edge.e);
    if (bins != nullptr && edge.place->role != Role::kNone) {
      const bool transmitter = edge.place->role == Role::kTransmitter;
      bins->sync(edge.e, edge.timing.sjw, transmitter, edge.place->sent);
    }
    return outcome;
  }

 private:
  struct Edge {
    const SweepPlace *place;
    BitTiming timing;
    int e;
  };

  static void add_edges(std::vector<Edge> &all, const SweepPlace &place, const BitTiming &timing) {
    const int first = place.early_edges ? -static_cast<int>(timing.ps2) : 0;
    for (int e = first; e <= static_cast<int>(timing.prop + timing.ps1); ++e) {
      all.push_back({&place, timing, e});
    }
  }
  static std::vector<Edge> edges() {
    std::vector<Edge> all;
    for (const SweepPlace &place : sweep_places()) {
      for (BitTiming timing : kSweepTimings) {
        const unsigned longest = std::min({4u, timing.ps1, timing.ps2});
        for (timing.sjw = 1; timing.sjw <= longest; ++timing.sjw) add_edges(all, place, timing);
      }
    }
    return all;
  }
  static std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const Edge &edge : edges()) {
      const BitTiming &t = edge.timing;
      std::string name = edge.place->name;
      for (const unsigned n : {t.prescaler, t.prop, t.ps1, t.ps2, t.sjw}) {
        name += "-" + std::to_string(n);
      }
      all.push_back(name + ".e" + std::to_string(edge.e));
    }
    return all;
  }

  std::vector<Edge> edges_ = edges();
};

}  // namespace

Sections clock_sections() {
  Sections all;
  for (const Setting &setting : kSettings) all.push_back(std::make_unique<ClockSection>(setting));
  all.push_back(std::make_unique<SyncSection>());
  return all;
}

}  // namespace vericansim
