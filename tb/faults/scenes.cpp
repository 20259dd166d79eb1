// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenes: frames, error handling, gaps, pairs; lost arbitration is in loss_scenes.cpp.
#include "faults/scenes.hpp"

#include <utility>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

using model_bench::rep;
using model_bench::whole;

const std::string kInterframe = rep(3, "1");
const std::string kSuspendAndIdle = rep(8 + 2, "1");  // suspend time, two bits of idle
const std::string kGap = kInterframe + kSuspendAndIdle;
const std::string kFlagAndDelimiter = rep(6 + 8, "1");

const std::string kOwnBits = "0001001000110000010101010101010001101100011";  // SOF..CRC
const std::string kBadCrc = "0001001000110000010101010101010001101100010";
const std::string kSentBits = rep(static_cast<int>(kOwnBits.size()), ".");

/// What leads to an error or overload flag, up to the bit before it.
struct Story {
  const char *name;
  bool transmitter;
  std::string before;
  Frame frame = kOwnFrame;
};

std::vector<Story> stories() {
  return {{"T-bit-error", true, rep(22, ".") + "!"},
          {"T-sof-lost", true, "!"},
          {"T-no-ack", true, kSentBits + ".."},
          {"T-form-error", true, kSentBits + "!"},
          {"T-eof7", true, kSentBits + ".0" + rep(7, ".") + "0"},
          {"T-stuff-error-in-arbitration", true, ".....0", {.id = 0x00F}},
          {"T-flag-broken", true, rep(22, ".") + "!...!"},
          {"R-stuff-error", false, "000000"},
          {"R-form-error", false, kOwnBits + "100"},
          {"R-crc-error", false, kBadCrc + "101"},
          {"R-ack-lost", false, kOwnBits + "1R"},
          {"R-flag-broken", false, "000000..!"},
          {"R-lost-arbitration", true, "000000"},
          {"R-overload-int1", false, kOwnBits + "101" + rep(7, "1") + "0"},
          {"R-overload-int2", false, kOwnBits + "101" + rep(7, "1") + "10"},
          {"R-overload-eof7", false, kOwnBits + "101" + rep(6, "1") + "0"},
          {"R-overload-del8", false, "000000" + rep(6 + 7, "1") + "0"},
          {"T-overload", true, kSentBits + ".0." + rep(7, ".") + "0"},
          {"T-overload-del8", true, rep(22, ".") + "!" + rep(6 + 7, ".") + "0"}};
}

Scene scene_of(const Story &story, std::string wire) {
  return {.name = story.name,
          .transmitter = story.transmitter,
          .frame = story.frame,
          .before = story.before,
          .wire = std::move(wire),
          .acknowledge = false};
}

Scene with(Scene scene, Scene::Extra extra, const char *suffix) {
  scene.extra = extra;
  scene.name += suffix;
  return scene;
}

/// A story as it is, with a frame that waits, or with the own frame withdrawn.
void add_variants(std::vector<Scene> &all, const Scene &scene) {
  all.push_back(scene);
  all.push_back(with(scene, Scene::Extra::kRequest, "-pending"));
  if (scene.transmitter) all.push_back(with(scene, Scene::Extra::kCancel, "-withdrawn"));
}

}  // namespace

std::vector<Scene> frame_scenes(const std::vector<Stream> &streams, bool transmitter) {
  std::vector<Scene> all;
  for (const Stream &stream : streams) {
    const std::string wire = whole(stream.frame, stream.options);
    const std::string own = rep(static_cast<int>(wire.size()), ".");
    all.push_back({.name = stream.name,
                   .transmitter = transmitter,
                   .frame = stream.frame,
                   .before = "",
                   .wire = (transmitter ? own : wire) + kGap});
  }
  return all;
}

// EF, OV, FC-04, FC-08: quiet, and with an LT whose flag outlasts the DUT's, so that the wait for
// the delimiter has bits to disturb.
std::vector<Scene> handling_scenes() {
  std::vector<Scene> all;
  for (const Story &story : stories()) {
    all.push_back(scene_of(story, kFlagAndDelimiter + kGap));
  }
  for (const Story &story : stories()) {
    Scene waiting = scene_of(story, rep(9, "0") + rep(8, "1"));
    waiting.before += rep(6, "0");
    waiting.name += "-wait";
    all.push_back(std::move(waiting));
  }
  return all;
}

std::vector<Scene> gap_scenes() {
  std::vector<Scene> all;
  const std::string wire = "1" + kGap;  // from EOF7 or DEL8
  add_variants(all, {.name = "after-own",
                     .transmitter = true,
                     .frame = kOwnFrame,
                     .before = kSentBits + ".0." + rep(6, "."),
                     .wire = wire});
  add_variants(all, {.name = "after-foreign",
                     .transmitter = false,
                     .frame = kOwnFrame,
                     .before = kOwnBits + "101" + rep(6, "1"),
                     .wire = wire});
  const Frame winner{.id = 0x023};
  const std::string won = whole(winner);
  add_variants(all, {.name = "after-loss",
                     .transmitter = true,
                     .frame = kOwnFrame,
                     .before = won.substr(0, won.size() - 1),
                     .wire = wire,
                     .delivered = {winner}});
  for (const Story &story : stories()) {
    Scene scene = scene_of(story, wire);
    scene.before += rep(6, ".") + rep(7, ".");
    add_variants(all, scene);
  }
  return all;
}

// MX-31, in its order; pairs with a bit of an error frame are part of handling_scenes().
std::vector<Scene> pair_scenes() {
  const std::string rest = rep(6 + 8, "1") + kInterframe + rep(2, "1");
  const std::string next = whole(kGoodFrame);
  const Frame extended{.id = 0x123 << 18 | 0x3FFFF, .extended = true};
  const std::string base_winner = whole({.id = 0x123, .dlc = 1});
  EncodeOptions srr;
  srr.srr = Level::kDominant;
  const std::string extended_winner = whole({.id = 0x123 << 18, .extended = true, .dlc = 1}, srr);
  std::vector<Scene> all;
  all.push_back(
      {.name = "crc-error-then", .frame = kOwnFrame, .before = kBadCrc, .wire = "1011" + rest});
  all.push_back({.name = "no-ack-then",
                 .transmitter = true,
                 .frame = kOwnFrame,
                 .before = kSentBits + "..",
                 .wire = rest,
                 .acknowledge = false});
  all.push_back({.name = "id-stuff-error-then",
                 .transmitter = true,
                 .frame = {.id = 0x00F},
                 .before = ".....0",
                 .wire = rest});
  all.push_back({.name = "eof7-then",
                 .frame = kOwnFrame,
                 .before = kOwnBits + "101" + rep(6, "1") + "0",
                 .wire = rest});
  all.push_back({.name = "two-del8-then",
                 .frame = kOwnFrame,
                 .before = "000000" + rep(13, "1") + "0" + rep(13, "1") + "0",
                 .wire = rest});
  all.push_back({.name = "int3-sof-then",
                 .frame = kOwnFrame,
                 .before = kOwnBits + "101" + rep(7, "1") + "11",
                 .wire = next + kGap,
                 .delivered = {kGoodFrame}});
  all.push_back({.name = "loss-at-srr-base-then",
                 .transmitter = true,
                 .frame = extended,
                 .before = base_winner.substr(0, 13),
                 .wire = base_winner.substr(13) + kGap,
                 .delivered = {{.id = 0x123, .dlc = 1}}});
  all.push_back({.name = "loss-at-srr-ext-then",
                 .transmitter = true,
                 .frame = extended,
                 .before = extended_winner.substr(0, 13),
                 .wire = extended_winner.substr(13) + kGap,
                 .delivered = {{.id = 0x123 << 18, .extended = true, .dlc = 1}}});
  return all;
}

}  // namespace vericansim
