// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Sections of states: integration, bus-off, and every start value of the counters.
#include <utility>

#include "faults/injection_axes.hpp"
#include "faults/scenes.hpp"
#include "faults/section.hpp"
#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using model_bench::rep;

constexpr std::size_t kRecoveryBits = 128 * 11;

std::vector<std::string> numbers(std::size_t count) {
  std::vector<std::string> all;
  for (std::size_t n = 0; n < count; ++n) all.push_back(std::to_string(n));
  return all;
}

std::vector<std::string> names(const std::vector<Reaction> &reactions) {
  std::vector<std::string> all;
  for (const Reaction &reaction : reactions) all.push_back(reaction.name);
  return all;
}

std::vector<std::string> names(const std::vector<StartCounters> &counters) {
  std::vector<std::string> all;
  for (const StartCounters &c : counters) all.push_back(name_of(c));
  return all;
}

/// MX-22: what disturbs a node that waits for eleven recessive bits.
std::vector<Reaction> waiting_reactions() {
  return join({plain_reactions(), starting_reactions()});
}

/// The n-th bit of integration inverted: dominant, or a dominant one of LT that is not seen.
class IntegrationSection : public Section {
 public:
  IntegrationSection()
      : Section{{"integration",
                 {{"bit", numbers(14)},
                  {"level", {"to-d", "to-r"}},
                  {"waiting", {"idle", "pending"}},
                  {"counters", names(main_counters())},
                  {"reaction", names(waiting_reactions())}}},
                "MX-22: any bit of integration"} {}

  Outcome run(const Grid::Digits &at, RuleBins *bins) const override {
    const StartCounters &counters = main_counters()[at[3]];
    const Reaction &reaction = reactions_[at[4]];
    Outcome outcome{.role = "-",
                    .state = state_of(counters),
                    .position = "INTEGRATING",
                    .reaction = reaction.name};
    if (bins != nullptr) bins->begin();
    InjectionRig rig{counters, CoreBench::default_config(), bins};
    if (at[2] == 1) rig.request(kOwnFrame);
    rig.start_integrating();
    rig.play(rep(static_cast<int>(at[0]), "."));
    rig.play(at[1] == 0 ? "!" : "R");
    rig.play(reaction.now);
    rig.finish(true);
    outcome.report = rig.report();
    return outcome;
  }

 private:
  std::vector<Reaction> reactions_ = waiting_reactions();
};

/// Any bit of the 1408 of a recovery inverted, with some reactions; until it is over and a frame
/// has passed.
class BusOffSection : public Section {
 public:
  BusOffSection()
      : Section{{"bus-off",
                 {{"bit", numbers(kRecoveryBits + 2)},
                  {"level", {"to-d", "to-r"}},
                  {"reaction", names(choice())}}},
                "MX-22, BO-02, BO-05 to BO-07: any bit of bus-off, until the DUT is back"} {}

  Outcome run(const Grid::Digits &at, RuleBins *bins) const override {
    const Reaction reaction = choice()[at[2]];
    Outcome outcome{
        .role = "-", .state = "P(tec)", .position = "BUS_OFF", .reaction = reaction.name};
    if (bins != nullptr) bins->begin();
    InjectionRig rig{{.tec = 248}, CoreBench::default_config(), bins};
    rig.start();
    rig.bench.lt_acknowledges(true);
    rig.request(kOwnFrame);
    rig.play(
        "."
        "!");  // its own SOF is not seen: TEC 256 (MX-26)
    if (!rig.bench.last().bus_off) rig.complain("is not in bus-off");
    rig.play(rep(static_cast<int>(at[0]), "."));
    rig.play(at[1] == 0 ? "!" : "R");
    rig.play(reaction.now);
    rig.finish(true);
    if (rig.bench.dut().sent().size() != 1) rig.complain("does not send its frame afterwards");
    outcome.report = rig.report();
    return outcome;
  }

 private:
  static std::vector<Reaction> choice() {
    return {{"L0", "", false, ""},
            {"L1", "000000", false, ""},
            {"Lk10", rep(10, "0"), false, ""},
            {"r10d", rep(10, "1") + "0" + rep(21, "1") + "0", false, ""}};  // PF-27, PF-38
  }
};

/// Each start value of the counters with each kind of step (19.4, TH-05: limits crossed from every
/// value).
class CounterSection : public Section {
 public:
  CounterSection()
      : Section{{"counters",
                 {{"value", numbers(256)}, {"of", {"tec", "rec", "both"}}, {"step", step_names()}}},
                "MX-26 to MX-30: every start value of TEC and REC, every kind of step"} {}

  Outcome run(const Grid::Digits &at, RuleBins *bins) const override {
    const auto value = static_cast<std::uint8_t>(at[0]);
    StartCounters counters;
    if (at[1] != 1) counters.tec = value;
    if (at[1] != 0) counters.rec = value;
    const Step &step = steps()[at[2]];
    Outcome outcome{.role = step.transmitter ? "T" : "R",
                    .state = state_of(counters),
                    .position = "counter step",
                    .reaction = step.name};
    if (bins != nullptr) bins->begin();
    InjectionRig rig{counters, CoreBench::default_config(), bins};
    rig.start();
    rig.bench.lt_acknowledges(step.acknowledge);
    if (step.transmitter) {
      rig.request(kOwnFrame);
      rig.play(".");
    }
    rig.play(step.script);
    rig.finish(true);
    outcome.report = rig.report();
    return outcome;
  }

 private:
  struct Step {
    const char *name;
    bool transmitter;
    std::string script;
    bool acknowledge = true;
  };

  static const std::vector<Step> &steps() {
    static const std::vector<Step> kSteps = {
        {"success", true, ""},
        {"bit-error", true, rep(22, ".") + "!"},
        {"bit-error-d8", true, rep(22, ".") + "!" + rep(14, "0")},
        {"flag-broken", true, rep(22, ".") + "!.!.!.!.!"},  // MX-29
        {"flag-broken-16", true, rep(22, ".") + rep(17, "!")},
        {"no-ack", true, rep(54, "."), false},
        {"no-ack-d", true, rep(45, ".") + "..0", false},
        {"sof-lost", true, rep(40, "!")},  // FC-20
        {"reception", false, model_bench::whole(kOwnFrame)},
        {"stuff-error", false, "000000"},
        {"stuff-error-d1", false, "000000" + rep(7, "0")},
        {"stuff-error-d16", false, "000000" + rep(22, "0")},
        {"stuck-d", false, rep(140, "0")},  // FC-19
        {"crc-error", false, "0001001000110000010101010101010001101100010101"},
        {"reception-broken", false, "0001001000110000010101010101010001101100011101110"},
        {"flag-broken-r", false, "000000" + rep(17, "!")}};
    return kSteps;
  }
  static std::vector<std::string> step_names() {
    std::vector<std::string> all;
    for (const Step &step : steps()) all.emplace_back(step.name);
    return all;
  }
};

}  // namespace

Sections state_sections() {
  Sections all;
  all.push_back(std::make_unique<IntegrationSection>());
  all.push_back(std::make_unique<BusOffSection>());
  all.push_back(std::make_unique<CounterSection>());
  return all;
}

}  // namespace vericansim
