// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every frame at the engine's port: see port_every_frame.hpp.
#include "remote/port_every_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <random>

#include "remote/frame_texts.hpp"
#include "remote/port_lockstep.hpp"

namespace vericansim {
namespace {

constexpr unsigned kRead = 0x78, kWrite = 0x79, kSetup = 0x7C;

/// A node in lockstep with its model that is made anew when a frame has led it elsewhere.
class Subject {
 public:
  Subject(PortSetting setting, unsigned seed) : setting_{std::move(setting)}, dice_{seed} {}

  void show(Frame frame) {
    if (!pair_ || !as_set()) renew();
    for (unsigned i = 0; i < 8 && !frame.remote; ++i)
      if (i < frame.dlc && random_from_ <= i) frame.data[i] = static_cast<std::uint8_t>(dice_());
    pair_->receive(frame);
    while (pair_->turn()) ++run_.answers;
    ++run_.frames;
    if (!pair_->compare().empty())
      run_.difference = fmt::format("number {}, {}: {}\n{}", setting_.number,
                                    setting_.unlocked ? "unlocked" : "locked", pair_->difference(),
                                    pair_->history());
  }
  /// Bytes of frames to come are random from this one on.
  void random_from(unsigned first) { random_from_ = first; }
  [[nodiscard]] const PortRun &run() const { return run_; }
  [[nodiscard]] bool equal() const { return run_.difference.empty(); }

 private:
  [[nodiscard]] bool as_set() {
    const RemoteModel &model = pair_->model();
    return model.number() == setting_.number && model.status().unlocked == setting_.unlocked;
  }
  // A node without a number cannot be told to unlock: it is told as number 3.
  void renew() {
    const bool first = setting_.unlocked && setting_.number < 2;
    const unsigned number = first ? 3 : setting_.number;
    pair_ = std::make_unique<PortLockstep>(setting_.profile, 3, number);
    pair_->drain();
    if (setting_.unlocked) tell(frame_of(number << 7 | kSetup, {1, 0x34, 0x12, 0xFE, 0xCA}));
    if (!first) return;
    tell(frame_of(0x002, {0, 0, 0, 0, 0, 0, 0, 0}));
    tell(frame_of(0x003, {static_cast<std::uint8_t>(setting_.number)}));
  }
  void tell(const Frame &frame) {
    pair_->receive(frame);
    pair_->drain();
  }

  PortSetting setting_;
  std::mt19937 dice_;
  unsigned random_from_ = 0;
  std::unique_ptr<PortLockstep> pair_;
  PortRun run_;
};

}  // namespace

PortSetting port_setting(const std::string &profile, unsigned index) {
  return {profile, index / 2, index % 2 != 0};
}

PortRun run_every_frame(const PortSetting &setting, unsigned stride, unsigned first,
                        unsigned seed) {
  constexpr unsigned kFrames = 2048 * 2 * 16;
  Subject subject{setting, seed};
  for (unsigned n = first; n < kFrames && subject.equal(); n += stride) {
    Frame frame;
    frame.id = n >> 5;
    frame.remote = (n >> 4 & 1) != 0;
    frame.dlc = n & 15;
    subject.show(frame);
  }
  return subject.run();
}

PortRun run_every_access(const PortSetting &setting, unsigned stride, unsigned first,
                         unsigned seed) {
  constexpr unsigned kAccesses = 2 * 2 * 4096 * 8;  // port, bits above, address, length
  Subject subject{setting, seed};
  std::mt19937 dice{seed};
  for (unsigned n = first; n < kAccesses && subject.equal(); n += stride) {
    const bool write = (n & 1) != 0;
    const unsigned length = n >> 1 & 7;
    const unsigned high = (n >> 16 & 1) != 0 ? 1 + dice() % 15 : 0;
    Frame frame = frame_of(
        setting.number << 7 | (write ? kWrite : kRead),
        {static_cast<std::uint8_t>(n >> 4), static_cast<std::uint8_t>((n >> 12 & 15) | high << 4),
         static_cast<std::uint8_t>(length)});
    if (write) frame.dlc = static_cast<std::uint8_t>(2 + length);
    subject.random_from(write ? 2 : 3);
    subject.show(frame);
  }
  return subject.run();
}

}  // namespace vericansim
