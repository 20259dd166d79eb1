// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Sections of whole bits: any bit of a scene inverted, then a reaction of LT (rule
// book 19.2, 19.3).
#include <algorithm>
#include <string_view>
#include <utility>

#include "faults/scenes.hpp"
#include "faults/section.hpp"

namespace vericansim {
namespace {

/// How the DUT is set up.
enum class Mode : std::uint8_t { kNormal, kListenOnly, kLoopBack, kOneShot, kFdTolerant };

CoreConfig config_of(Mode mode) {
  CoreConfig config = CoreBench::default_config();
  config.listen_only = mode == Mode::kListenOnly;
  config.loop_back = mode == Mode::kLoopBack;
  config.fd_tolerant = mode == Mode::kFdTolerant;
  return config;
}

struct Place {
  const Scene *scene;
  std::size_t position;
};

/// What the axes of a section are made of.
struct Axes {
  std::vector<Scene> scenes;
  std::vector<StartCounters> counters;
  std::vector<Reaction> reactions;
  Mode mode = Mode::kNormal;
};

class SceneSection : public Section {
 public:
  SceneSection(const std::string &name, std::string rules, Axes axes)
      : Section{grid_of(name, axes), std::move(rules)}, axes_{std::move(axes)} {
    for (const Scene &scene : axes_.scenes) {
      for (std::size_t n = 0; n < positions(scene); ++n) places_.push_back({&scene, n});
    }
  }
  Outcome run(const Grid::Digits &at, RuleBins *bins) const override;

 private:
  static std::size_t positions(const Scene &scene) {
    return scene.positions != 0 ? scene.positions : scene.wire.size();
  }
  static Grid grid_of(const std::string &name, const Axes &axes);
  void begin(InjectionRig &rig, const Scene &scene) const;
  void play(InjectionRig &rig, const Place &place, const Reaction &reaction,
            Outcome &outcome) const;
  void check_deliveries(InjectionRig &rig, const Scene &scene) const;
  void finish(InjectionRig &rig, const Reaction &reaction) const;

  Axes axes_;
  std::vector<Place> places_;
};

Grid SceneSection::grid_of(const std::string &name, const Axes &axes) {
  Axis places{"place", {}};
  for (const Scene &scene : axes.scenes) {
    for (std::size_t n = 0; n < positions(scene); ++n) {
      places.values.push_back(scene.name + "." + std::to_string(n));
    }
  }
  Axis counters{"counters", {}};
  for (const StartCounters &c : axes.counters) counters.values.push_back(name_of(c));
  Axis reactions{"reaction", {}};
  for (const Reaction &r : axes.reactions) reactions.values.push_back(r.name);
  return {name, {std::move(places), std::move(counters), std::move(reactions)}};
}

/// Class of a place: its field, whether it is a stuff bit, and what kind of flag it belongs to.
std::string class_of(InjectionRig &rig) {
  const BitPlace place = rig.place();
  std::string name{field_name(place.field)};
  if (place.is_stuff) return "stuff bit";
  if (place.field == Field::kErrFlag) {
    return rig.judge.model().internal_level() == Level::kDominant ? "ACTIVE_FLAG" : "PASSIVE_FLAG";
  }
  const bool counted = place.field == Field::kInt || place.field == Field::kEof;
  if (counted) name += std::to_string(place.index + 1);
  if (place.field == Field::kDel) name = place.index == 6 ? "DEL8" : "DEL2..7";
  return name;
}

void SceneSection::begin(InjectionRig &rig, const Scene &scene) const {
  rig.start();
  rig.bench.lt_acknowledges(scene.acknowledge);
  if (scene.transmitter) {
    rig.request(scene.frame, axes_.mode == Mode::kOneShot);
    rig.play(".");
  }
  rig.play(scene.before);
  if (scene.extra == Scene::Extra::kRequest) rig.request(kQueuedFrame);
  if (scene.extra == Scene::Extra::kCancel) rig.judge.cancel(0);
}

void SceneSection::play(InjectionRig &rig, const Place &place, const Reaction &reaction,
                        Outcome &outcome) const {
  const std::string_view wire = place.scene->wire;
  rig.play(wire.substr(0, place.position));
  outcome.position = class_of(rig);
  outcome.role = role_name(rig.role());
  rig.play(wire[place.position] == '0' ? "R" : "!");
  rig.play(reaction.now);
  if (!reaction.go) return;
  const std::string_view rest = wire.substr(place.position + 1);
  if (reaction.flag.empty()) return rig.play(rest);
  rig.play_to_flag(rest);
  if (rig.at_flag()) rig.play(reaction.flag);
}

// MX-06, MX-08: nothing but what has been sent is ever delivered.
void SceneSection::check_deliveries(InjectionRig &rig, const Scene &scene) const {
  for (const Frame &frame : rig.bench.dut().received()) {
    const bool own = frame == scene.frame && (!scene.transmitter || axes_.mode == Mode::kLoopBack);
    const bool known = frame == kGoodFrame || frame == kLowFrame || frame == kHighFrame || own;
    const auto &more = scene.delivered;
    if (!known && std::find(more.begin(), more.end(), frame) == more.end()) {
      rig.complain("delivers a frame that nobody sent");
    }
  }
}

// Loop-back: the node hears itself alone, so its frame succeeds whatever is on the pin (MO-04).
void SceneSection::finish(InjectionRig &rig, const Reaction &reaction) const {
  if (axes_.mode != Mode::kLoopBack) {
    const bool recover = reaction.name == "L0" || reaction.name == "L2" || reaction.name == "Lk9";
    return rig.finish(recover);
  }
  const auto sent = [&rig] { return !rig.bench.dut().pending(); };
  if (!rig.bench.run_until(sent, 200)) rig.complain("does not send its frame in loop-back");
  rig.bench.run_bits(20);
  if (rig.bench.dut().events().failed != 0) rig.complain("fails in loop-back");
}

Outcome SceneSection::run(const Grid::Digits &at, RuleBins *bins) const {
  const Place &place = places_[at[0]];
  const StartCounters &counters = axes_.counters[at[1]];
  const Reaction &reaction = axes_.reactions[at[2]];
  Outcome outcome{.state = state_of(counters), .reaction = reaction.name};
  if (bins != nullptr) bins->begin();
  InjectionRig rig{counters, config_of(axes_.mode), bins};
  begin(rig, *place.scene);
  play(rig, place, reaction, outcome);
  finish(rig, reaction);
  check_deliveries(rig, *place.scene);
  outcome.report = rig.report();
  return outcome;
}

template <typename T>
std::vector<T> both(std::vector<T> a, const std::vector<T> &b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void add(Sections &all, const std::string &name, std::string rules, Axes axes) {
  all.push_back(std::make_unique<SceneSection>(name, std::move(rules), std::move(axes)));
}

const std::vector<StartCounters> &frozen() {
  static const std::vector<StartCounters> kFrozen = {{0, 0}, {127, 127}, {128, 0}, {0, 128}};
  return kFrozen;
}

void add_modes(Sections &all) {
  const std::vector<Scene> received = frame_scenes(all_streams(), false);
  const std::vector<Scene> sent = frame_scenes(all_streams(), true);
  const std::vector<Reaction> going = join({plain_reactions(), going_reactions()});
  const std::vector<Reaction> few = {{"L0", "", false, ""},
                                     {"L1", "000000", false, ""},
                                     {"L2", "1000000", false, ""},
                                     {"Lk8", "00000000000000", false, ""},
                                     {"go", "", true, ""}};
  add(all, "listen", "MX-24: any bit of a received frame, listen-only: nothing sent or counted",
      {received, frozen(), going, Mode::kListenOnly});
  add(all, "one-shot", "MX-25: any bit of a frame sent once",
      {sent, main_counters(), join({plain_reactions()}), Mode::kOneShot});
  add(all, "loop-back", "MO-04: the pin of a node in loop-back disturbed in any bit",
      {sent, frozen(), few, Mode::kLoopBack});
  add(all, "fd-tolerant", "FF-06: any bit of a frame, FD-tolerant: FDF leads to integration",
      {both(frame_scenes(odd_streams(), false), received), frozen(), few, Mode::kFdTolerant});
}

}  // namespace

Sections bit_sections() {
  const std::vector<Reaction> plain = plain_reactions();
  const std::vector<Reaction> going = join({plain_reactions(), going_reactions()});
  const std::vector<Reaction> starting = join({plain_reactions(), starting_reactions()});
  const std::vector<Scene> received =
      both(frame_scenes(all_streams(), false), frame_scenes(odd_streams(), false));
  Sections all;
  add(all, "send", "MX-01 to MX-05: any bit of a frame that the DUT sends, and of the gap behind",
      {frame_scenes(all_streams(), true), all_counters(), plain});
  add(all, "receive", "MX-06 to MX-12: any bit of a frame that the DUT receives, and of the gap",
      {received, all_counters(), going});
  add(all, "handling",
      "MX-17 to MX-21, MX-23: flags, delimiter wait, delimiters and the gap behind",
      {handling_scenes(), all_counters(), plain});
  add(all, "gap", "MX-11, MX-13 to MX-16: EOF7 or DEL8 to idle behind every story, pending or not",
      {gap_scenes(), main_counters(), starting});
  add(all, "loss", "MX-02, MX-03: arbitration lost at each position, stuff bits around it",
      {loss_scenes(), all_counters(), going});
  add(all, "pairs", "MX-31: two disturbances, the mandatory pairs with any bit that follows",
      {pair_scenes(), all_counters(), join({plain, {going_reactions()[0]}})});
  add_modes(all);
  return all;
}

}  // namespace vericansim
