// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RandomRemotes: see random_remotes.hpp.
#include "remote/random_remotes.hpp"

#include "trace/candump.hpp"

namespace vericansim {
namespace {

constexpr Time kBit = kMicrosecond;
constexpr unsigned kHoldLimit = 40;  // clocks: less than RN-52's 64

ClockConfig clock_of(RandomHost &dice, double hz) {
  ClockConfig clock;
  clock.frequency_hz = hz;
  clock.error_ppm = static_cast<double>(dice.upto(2001)) - 1000;
  clock.phase = dice.upto(1000 * 1000);
  return clock;
}

}  // namespace

const std::vector<RemoteClock> &remote_clocks() {
  static const std::vector<RemoteClock> clocks = {
      {8e6, {.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2}},
      {12e6, {.prescaler = 1, .prop = 5, .ps1 = 3, .ps2 = 3, .sjw = 3}},
      {16e6, {.prescaler = 1, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 4}},
      {20e6, {.prescaler = 1, .prop = 8, .ps1 = 6, .ps2 = 5, .sjw = 4}},
      {24e6, {.prescaler = 2, .prop = 5, .ps1 = 3, .ps2 = 3, .sjw = 3}},
      {32e6, {.prescaler = 2, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 4}},
      {40e6, {.prescaler = 2, .prop = 8, .ps1 = 6, .ps2 = 5, .sjw = 4}},
      {48e6, {.prescaler = 3, .prop = 7, .ps1 = 4, .ps2 = 4, .sjw = 4}},
  };
  return clocks;
}

RandomRemotes::RandomRemotes(const std::string &profile, unsigned seed)
    : dice_{seed, {0, 0, 0, 1, 1, 2, 3, 3, 4, 5, 6, 7}} {
  const RemoteClock &clock = remote_clocks()[dice_.upto(4)];
  CoreConfig config;
  config.timing = clock.timing;
  host_ = std::make_unique<CoreNode>("host", config, clock_of(dice_, clock.hz));
  bus_.add(*host_);
  const unsigned count = 2 + dice_.upto(7);
  for (unsigned i = 0; i < count; ++i) add_node(profile, i < 5 ? 3 + i : 7 - i);
  bus_.add(flips_);
  if (dice_.once_in(3)) {
    NoiseConfig noise;
    noise.per_bit = 1.0 / (200 + dice_.upto(2000));
    noise.seed = seed;
    faults_.push_back(std::make_unique<NoiseFault>(noise));
    bus_.add(*faults_.back());
  }
  host_->start();
  for (auto &shadow : shadows_) shadow->start();
  bus_.run_for(30 * kBit);
}

RandomRemotes::~RandomRemotes() {
  for (auto &shadow : shadows_) bus_.remove(*shadow);
}

void RandomRemotes::add_node(const std::string &profile, unsigned number) {
  const RemoteClock &clock = remote_clocks()[dice_.upto(4)];
  RemoteConfig config = RemoteConfig::profile(profile);
  config.serial = 0xCAFE1234 ^ (number == 3 || dice_.once_in(3) ? 0 : 1U << dice_.upto(32));
  nodes_.push_back(RemoteNode::create("node" + std::to_string(number), config, number, clock.timing,
                                      clock_of(dice_, clock.hz)));
  Link link;
  link.cable = dice_.upto(20) * kNanosecond;
  const NodeId id = bus_.add(*nodes_.back(), link);
  shadows_.push_back(std::make_unique<RemoteShadow>(*nodes_.back(), id, config, number));
  bus_.add(*shadows_.back());
}

bool RandomRemotes::step() {
  ++count_;
  const Frame frame = dice_.frame();
  steps_.push_back(candump_frame(frame));
  if (steps_.size() > 30) steps_.erase(steps_.begin());
  host_->request(frame);
  if (dice_.once_in(4)) host_->request(dice_.frame());
  if (dice_.once_in(4)) disturb();
  if (dice_.once_in(3)) user();
  if (!settle()) return false;
  compare();
  return difference_.empty();
}

// One bit or less of one node or of all, anywhere in the request or its answer.
void RandomRemotes::disturb() {
  const Time from = bus_.now() + dice_.upto(300) * kBit + dice_.upto(1000) * kNanosecond;
  const Time length = dice_.once_in(3) ? (50 + dice_.upto(500)) * kNanosecond : kBit;
  const NodeId victim = dice_.once_in(3) ? kAllNodes : dice_.upto(bus_.size());
  flips_.add(victim, Effect::kFlip, {from, from + length});
  steps_.back() += " disturbed at node " + std::to_string(static_cast<int>(victim));
  ++disturbed_;
}

// A write of user logic, or a short hold, during the command.
void RandomRemotes::user() {
  const unsigned at = dice_.upto(nodes());
  const Time when = bus_.now() + dice_.upto(150) * kBit + dice_.upto(1000) * kNanosecond;
  if (dice_.once_in(2)) {
    const UserAccess access{true, dice_.upto(16), dice_.upto(dice_.once_in(2) ? 1024 : 0x20),
                            dice_.upto(~0U)};
    bus_.at(when, [this, at, access] {
      if (shadows_[at]->may_write(access.word)) nodes_[at]->access(access);
    });
    return;
  }
  const double hz = nodes_[at]->oscillator().nominal_hz();
  const Time length = static_cast<Time>((1 + dice_.upto(kHoldLimit)) * 1e12 / hz);
  bus_.at(when, [this, at] { shadows_[at]->hold(true); });
  bus_.at(when + length, [this, at] { shadows_[at]->hold(false); });
}

// Bus-off of a node or of the host ends within 2^7 BOFF or 128 sequences.
bool RandomRemotes::settle() {
  constexpr unsigned kQuiet = 15, kLimit = 4'000'000;
  unsigned quiet = 0;
  for (unsigned bits = 0; quiet < kQuiet; ++bits) {
    if (bits == kLimit) {
      difference_ = "the bus does not come to rest";
      return false;
    }
    bus_.run_for(kBit);
    bool busy = host_->pending() || !host_->idle() || bus_.has_actions();
    for (const auto &node : nodes_) busy = busy || !node->idle();
    quiet = busy ? 0 : quiet + 1;
  }
  return true;
}

void RandomRemotes::compare() {
  for (auto &shadow : shadows_)
    if (difference_.empty()) difference_ = shadow->compare(count_ % 16 == 0);
}

unsigned RandomRemotes::answers() const {
  unsigned sum = 0;
  for (const auto &shadow : shadows_) sum += shadow->sent();
  return sum;
}

std::string RandomRemotes::history() const {
  std::string text;
  for (const std::string &step : steps_) text += step + "\n";
  return text;
}

}  // namespace vericansim
