// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RuleBins: counting; the lists of bins are in rule_bin_lists.cpp.
#include "faults/rule_bins.hpp"

#include <algorithm>

namespace vericansim {
namespace {

unsigned code(Role role) { return static_cast<unsigned>(role); }
unsigned code(Field field) { return static_cast<unsigned>(field); }
unsigned code(Level level) { return static_cast<unsigned>(level); }

bool in_arbitration(Field field) { return field >= Field::kId && field <= Field::kExRtr; }

bool in_stuffed_part(const BitPlace &place) {
  return (place.field >= Field::kSof && place.field <= Field::kCrc) || place.is_stuff;
}

/// 0 = ID28 .. 31 = extended RTR (AR-12).
unsigned arbitration_position(const BitPlace &place) {
  switch (place.field) {
    case Field::kId: return place.index;
    case Field::kRtr: return 11;
    case Field::kIde: return 12;
    case Field::kExId: return 13u + place.index;
    default: return 31;
  }
}

/// Bits that are recessive by rule: that the node misses a dominant one there changes nothing.
bool only_dominant_counts(Field field) {
  return field == Field::kCrcDel || field == Field::kAckDel || field == Field::kEof ||
         field == Field::kInt || field == Field::kSuspend || field == Field::kDel;
}

}  // namespace

namespace bin_key {

std::uint32_t inversion(Role role, bool passive, const BitPlace &place, unsigned context,
                        Level seen) {
  return (((((code(role) * 2 + passive) * 32 + code(place.field)) * 64 + place.index) * 2 +
           place.is_stuff) *
              4 +
          context) *
             2 +
         code(seen);
}

std::uint32_t int3(bool pending, bool passive, unsigned story) {
  return (story * 2 + pending) * 2 + passive;
}

std::uint32_t late(Field field, unsigned context, Role role, bool passive, unsigned index) {
  return (((code(field) * 4 + context) * 4 + code(role)) * 2 + passive) * 8 + index;
}

std::uint32_t loss(bool extended, unsigned position, unsigned relation) {
  return (extended * 32u + position) * 4 + relation;
}

std::uint32_t sync(int e, unsigned sjw, bool transmitter, Level sent) {
  return ((static_cast<unsigned>(e + 8) * 8 + sjw) * 2 + transmitter) * 2 + code(sent);
}

std::uint32_t counter(unsigned kind, unsigned threshold, unsigned from) {
  return (kind * 512 + threshold) * 512 + from;
}

}  // namespace bin_key

void BinGroup::hit(std::uint32_t key, std::uint64_t times) {
  const auto bin = bins.find(key);
  if (bin == bins.end()) {
    unlisted[key] += times;
  } else {
    bin->second.hits += times;
  }
}

std::size_t BinGroup::reached() const {
  return static_cast<std::size_t>(
      std::count_if(bins.begin(), bins.end(), [](const auto &b) { return b.second.hits != 0; }));
}

RuleBins::RuleBins()
    : groups_{inversion_bins(), int3_bins(), late_dominant_bins(),
              loss_bins(),      sync_bins(), counter_bins()} {}

void RuleBins::begin() {
  place_ = {};
  after_stuff_ = false;
  context_ = Context::kNone;
  lost_ = error_ = overload_ = false;
}

// 0 was T, 1 was R, 2 lost arbitration; after an error as T, R: 3, 4; after overload as T, R: 5, 6.
unsigned RuleBins::story() const {
  const unsigned receiver = role_ == Role::kTransmitter ? 0 : 1;
  if (overload_) return 5 + receiver;
  if (error_) return 3 + receiver;
  return lost_ ? 2 : receiver;
}

void RuleBins::before(const NodeModel &model, Level wire, Level seen) {
  after_stuff_ = place_.is_stuff && in_arbitration(place_.field);
  place_ = model.state();
  role_ = model.role();
  passive_ = model.error_state() == ErrorState::kPassive;
  tec_ = model.tec();
  rec_ = model.rec();
  const bool as_sent = role_ == Role::kTransmitter && in_stuffed_part(place_) &&
                       seen == model.internal_level();  // it sees what it sent: no event for it
  if (wire != seen && !as_sent) count_inversion(wire, seen);
  if (seen == Level::kRecessive) return;
  const bool interframe = place_.field == Field::kInt && place_.index < 2;
  const bool last =
      (place_.field == Field::kEof || place_.field == Field::kDel) && place_.index == 6;
  if (interframe || last) {
    const bool overload = context_ == Context::kOverload;
    const unsigned context = place_.field == Field::kDel && overload ? 1 : 0;
    groups_[kLateDominant].hit(
        bin_key::late(place_.field, context, role_, passive_, interframe ? place_.index : 0));
  }
  if (place_.field == Field::kInt && place_.index == 2) {
    groups_[kInt3Sof].hit(bin_key::int3(model.pending(), passive_, story()));
  }
}

void RuleBins::count_inversion(Level wire, Level seen) {
  if (wire == Level::kDominant && only_dominant_counts(place_.field) && !place_.is_stuff) return;
  const bool delimiter = place_.field == Field::kDel;
  Context context = Context::kNone;
  if (place_.field >= Field::kErrFlag) context = context_;
  if (delimiter && context == Context::kPassive) context = Context::kActive;
  BitPlace place = place_;
  const bool counted = place.is_stuff || place.field == Field::kWait ||
                       place.field < Field::kInt;  // the index says nothing there
  if (counted) place.index = 0;
  groups_[kInversion].hit(
      bin_key::inversion(role_, passive_, place, static_cast<unsigned>(context), seen));
}

void RuleBins::after(const NodeModel &model) {
  count_loss(model);
  count_counters(model);
  follow_story(model);
}

void RuleBins::count_loss(const NodeModel &model) {
  const NodeEvents &events = model.events();
  const bool at_stuff = events.error == NodeError::kStuff && role_ == Role::kTransmitter &&
                        in_arbitration(place_.field);
  if (!events.lost_arbitration && !at_stuff) return;
  unsigned relation = kLossPlain;
  if (at_stuff) {
    relation = kLossAtStuff;
  } else if (after_stuff_) {
    relation = kLossAfterStuff;
  } else if (model.state().is_stuff) {
    relation = kLossBeforeStuff;
  }
  // The stuff bit behind a base RTR is judged like one of arbitration, but is not its bit (FC-05b).
  const unsigned position = arbitration_position(place_);
  if (!model.own_frame().extended && position > 11) return;
  groups_[kLoss].hit(bin_key::loss(model.own_frame().extended, position, relation));
}

void RuleBins::count_counters(const NodeModel &model) {
  BinGroup &group = groups_[kCounter];
  const int tec = model.tec();
  const int rec = model.rec();
  const auto from = [](int value) { return static_cast<unsigned>(value); };
  for (const int threshold : {96, 128, 256}) {
    const auto up = [&](int was, int is) { return was < threshold && is >= threshold; };
    const auto down = [&](int was, int is) { return was >= threshold && is < threshold; };
    if (up(tec_, tec)) group.hit(bin_key::counter(kTecUp8, from(threshold), from(tec_)));
    if (down(tec_, tec)) {
      const bool recovered = model.events().recovered;
      const unsigned start = recovered ? 256 : from(tec_);
      group.hit(bin_key::counter(recovered ? kTecRecovered : kTecDown1, from(threshold), start));
    }
    if (up(rec_, rec)) {
      group.hit(bin_key::counter(rec - rec_ == 1 ? kRecUp1 : kRecUp8, from(threshold), from(rec_)));
    }
    if (down(rec_, rec) && !model.events().recovered) {
      const bool set_back = threshold == 128;
      group.hit(bin_key::counter(set_back ? kRecSetBack : kRecDown1, from(threshold),
                                 set_back ? 128 : from(rec_)));
    }
  }
}

void RuleBins::follow_story(const NodeModel &model) {
  const NodeEvents &events = model.events();
  if (events.started) {
    lost_ = error_ = overload_ = false;
    context_ = Context::kNone;
  }
  lost_ = lost_ || events.lost_arbitration;
  if (events.error != NodeError::kNone) {
    error_ = true;
    overload_ = false;
    const bool active = model.internal_level() == Level::kDominant;
    context_ = active ? Context::kActive : Context::kPassive;
  }
  if (events.overload) {
    overload_ = true;
    context_ = Context::kOverload;
  }
}

void RuleBins::sync(int e, unsigned sjw, bool transmitter, Level sent) {
  groups_[kSync].hit(bin_key::sync(e, sjw, transmitter, sent));
}

std::size_t RuleBins::size() const {
  std::size_t sum = 0;
  for (const BinGroup &group : groups_) sum += group.bins.size();
  return sum;
}

std::size_t RuleBins::reached() const {
  std::size_t sum = 0;
  for (const BinGroup &group : groups_) sum += group.reached();
  return sum;
}

void RuleBins::add(std::size_t cross, std::uint32_t key, std::uint64_t hits) {
  groups_.at(cross).hit(key, hits);
}

void RuleBins::merge(const RuleBins &other) {
  for (std::size_t i = 0; i < groups_.size(); ++i) {
    for (const auto &[key, bin] : other.groups_[i].bins) groups_[i].bins[key].hits += bin.hits;
    for (const auto &[key, hits] : other.groups_[i].unlisted) groups_[i].unlisted[key] += hits;
  }
}

}  // namespace vericansim
