// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random section: two and more disturbances at random places of random frames in random states.
#include <random>
#include <utility>

#include "faults/injection_axes.hpp"
#include "faults/scenes.hpp"
#include "faults/section.hpp"
#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using model_bench::rep;

/// Numbers that are the same on every machine: the standard's distributions are not.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t run) : engine_{seed * 0x9E3779B97F4A7C15ULL + run} {}
  unsigned below(unsigned limit) { return static_cast<unsigned>(engine_() % limit); }
  bool one_in(unsigned n) { return below(n) == 0; }

 private:
  std::mt19937_64 engine_;
};

// Identifier and data with long runs, as often as with random bits: stuff bits everywhere.
Frame random_frame(Dice &dice) {
  Frame frame{.extended = dice.one_in(2), .remote = dice.one_in(5)};
  frame.id = dice.below(1u << 29);
  if (dice.one_in(2)) frame.id |= 0x0F8F0F00u;
  if (dice.one_in(2)) frame.id &= ~0x03C3C1E1u;
  if (!frame.extended) frame.id >>= 18;
  frame.dlc = static_cast<std::uint8_t>(dice.one_in(3) ? dice.below(16) : dice.below(3));
  for (unsigned i = 0; i < frame.payload_size(); ++i) {
    constexpr std::uint8_t kRuns[] = {0x00, 0xFF, 0xF8, 0x07, 0xE1, 0x1E};
    frame.data[i] =
        static_cast<std::uint8_t>(dice.one_in(2) ? kRuns[dice.below(6)] : dice.below(256));
  }
  return frame;
}

StartCounters random_counters(Dice &dice) {
  static constexpr std::uint8_t kLimits[] = {0, 95, 96, 119, 120, 127, 128, 247, 248, 255};
  const auto value = [&dice] {
    return static_cast<std::uint8_t>(dice.one_in(2) ? kLimits[dice.below(10)] : dice.below(256));
  };
  StartCounters counters;
  if (!dice.one_in(3)) counters.tec = value();
  if (!dice.one_in(3)) counters.rec = value();
  return counters;
}

/// Disturbs `script` at `at`: the DUT sees one bit inverted, or LT is dominant for a while.
void disturb(Dice &dice, std::string &script, std::size_t at) {
  if (!dice.one_in(3)) {
    script[at] = script[at] == '0' ? 'R' : '!';
    return;
  }
  const std::size_t length = 1 + dice.below(dice.one_in(3) ? 22 : 8);
  for (std::size_t i = at; i < at + length && i < script.size(); ++i) script[i] = '0';
}

class RandomSection : public Section {
 public:
  RandomSection(std::uint64_t seed, std::size_t count)
      : Section{grid_of(seed, count),
                "MX-31, MX-15 to MX-23: two to six random disturbances, random frames and states"},
        seed_{seed} {}

  Outcome run(const Grid::Digits &at, RuleBins *bins) const override {
    Dice dice{seed_, at[0]};
    const Frame frame = random_frame(dice);
    const bool transmitter = dice.one_in(2);
    const StartCounters counters = random_counters(dice);
    const unsigned faults = 2 + (dice.one_in(2) ? 0 : dice.below(5));
    const std::string wire = model_bench::whole(frame);
    std::string script = transmitter ? rep(static_cast<int>(wire.size()), ".") : wire;
    script += rep(45, ".");
    // The second one likely follows the first within the error frame that it brings.
    std::size_t place = dice.below(static_cast<unsigned>(wire.size()) + 13);
    for (unsigned i = 0; i < faults; ++i) {
      disturb(dice, script, place);
      const auto length = static_cast<unsigned>(script.size());
      place = dice.one_in(2) ? dice.below(length) : (place + 1 + dice.below(30)) % length;
    }
    return play(dice, frame, transmitter, counters, script, bins);
  }

 private:
  static Grid grid_of(std::uint64_t seed, std::size_t count) {
    Axis runs{"run", {}};
    for (std::size_t i = 0; i < count; ++i) runs.values.push_back(std::to_string(i));
    return {"random-" + std::to_string(seed), {std::move(runs)}};
  }

  static Outcome play(Dice &dice, const Frame &frame, bool transmitter,
                      const StartCounters &counters, const std::string &script, RuleBins *bins) {
    Outcome outcome{.role = transmitter ? "T" : "R",
                    .state = state_of(counters),
                    .position = "random",
                    .reaction = "random"};
    if (bins != nullptr) bins->begin();
    InjectionRig rig{counters, CoreBench::default_config(), bins};
    rig.start();
    rig.bench.lt_acknowledges(!dice.one_in(4));
    if (transmitter) {
      rig.request(frame);
      rig.play(".");
    } else if (dice.one_in(3)) {
      rig.play(script.substr(0, 1));
      rig.request(kQueuedFrame);
      rig.play(script.substr(1));
      rig.finish(dice.one_in(4));
      outcome.report = rig.report();
      return outcome;
    }
    rig.play(script);
    rig.finish(dice.one_in(4));
    outcome.report = rig.report();
    return outcome;
  }

  std::uint64_t seed_;
};

}  // namespace

std::unique_ptr<Section> random_section(std::uint64_t seed, std::size_t count) {
  return std::make_unique<RandomSection>(seed, count);
}

Sections all_sections(std::uint64_t seed) {
  constexpr std::size_t kRandomRuns = 200'000;
  Sections all = bit_sections();
  const auto append = [&all](Sections more) {
    for (auto &section : more) all.push_back(std::move(section));
  };
  append(state_sections());
  all.push_back(random_section(seed, kRandomRuns));
  append(clock_sections());
  return all;
}

}  // namespace vericansim
