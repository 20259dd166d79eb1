// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RuleBins: which bins there are. Each list follows from the rules alone; what the product of the
// axes also holds is named with the rule that keeps it from happening.
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "faults/rule_bins.hpp"

namespace vericansim {
namespace {

// Directions of an inversion that a place allows, as bits.
constexpr unsigned kToD = 1;  // recessive on the wire, seen dominant
constexpr unsigned kToR = 2;
constexpr unsigned kBoth = kToD | kToR;

enum Context : std::uint8_t { kNoContext, kActiveFlag, kPassiveFlag, kOverload };

const char *context_name(unsigned context) {
  constexpr const char *kNames[] = {"", " (active flag)", " (passive flag)", " (overload)"};
  return kNames[context];
}

/// Bits of one field, with the directions that each role allows.
struct BinPlace {
  Field field;
  unsigned count;
  unsigned transmitter;
  unsigned receiver;
  unsigned neither = 0;
  bool stuff = false;
  unsigned context = kNoContext;
  bool active_state = true;  // can the node be error active there?
};

// FF-01 to FF-04 (a transmitter sends r0 and r1 dominant, delimiters and EOF recessive), FF-05, ST,
// EF-02 to EF-08, OV-01, IF-08.
const BinPlace kPlaces[] = {{Field::kInteg, 1, 0, 0, kBoth},
                            {Field::kBusOff, 1, 0, 0, kBoth},
                            {Field::kIdle, 1, 0, 0, kBoth},
                            {Field::kInt, 3, kToD, kToD},
                            {Field::kSuspend, 8, kToD, 0, 0, false, kNoContext, false},
                            {Field::kSof, 1, kToR, 0},
                            {Field::kId, 11, kBoth, kBoth},
                            {Field::kRtr, 1, kBoth, kBoth},
                            {Field::kIde, 1, kBoth, kBoth},
                            {Field::kExId, 18, kBoth, kBoth},
                            {Field::kExRtr, 1, kBoth, kBoth},
                            {Field::kR1, 1, kToR, kBoth},
                            {Field::kR0, 1, kToR, kBoth},
                            {Field::kDlc, 4, kBoth, kBoth},
                            {Field::kData, 64, kBoth, kBoth},
                            {Field::kCrc, 15, kBoth, kBoth},
                            {Field::kCrcDel, 1, kToD, kToD},
                            {Field::kAck, 1, kBoth, kBoth},
                            {Field::kAckDel, 1, kToD, kToD},
                            {Field::kEof, 7, kToD, kToD},
                            {Field::kId, 1, kBoth, kBoth, 0, true},
                            {Field::kRtr, 1, kBoth, kBoth, 0, true},
                            {Field::kIde, 1, kBoth, kBoth, 0, true},
                            {Field::kExId, 1, kBoth, kBoth, 0, true},
                            {Field::kExRtr, 1, kBoth, kBoth, 0, true},
                            {Field::kR1, 1, kBoth, kBoth, 0, true},
                            {Field::kR0, 1, kToD, kBoth, 0, true},
                            {Field::kDlc, 1, kToD, kBoth, 0, true},
                            {Field::kData, 1, kBoth, kBoth, 0, true},
                            {Field::kCrc, 1, kBoth, kBoth, 0, true},
                            {Field::kCrcDel, 1, kBoth, kBoth, 0, true},
                            {Field::kErrFlag, 6, kToR, kToR, 0, false, kActiveFlag},
                            {Field::kErrFlag, 6, kBoth, kBoth, 0, false, kPassiveFlag, false},
                            {Field::kWait, 1, kBoth, kBoth, 0, false, kActiveFlag},
                            {Field::kWait, 1, kBoth, kBoth, 0, false, kPassiveFlag, false},
                            {Field::kWait, 1, kBoth, kBoth, 0, false, kOverload},
                            {Field::kDel, 7, kToD, kToD, 0, false, kActiveFlag},
                            {Field::kDel, 7, kToD, kToD, 0, false, kOverload},
                            {Field::kOvlFlag, 6, kToR, kToR, 0, false, kOverload}};

void add_place(BinGroup &group, const BinPlace &place, Role role, unsigned directions) {
  for (unsigned index = 0; index < place.count; ++index) {
    for (const bool passive : {false, true}) {
      if (!passive && !place.active_state) continue;
      if (passive && place.field == Field::kBusOff) continue;
      for (const Level seen : {Level::kDominant, Level::kRecessive}) {
        if ((directions & (seen == Level::kDominant ? kToD : kToR)) == 0) continue;
        const BitPlace at{place.field, static_cast<std::uint8_t>(index), place.stuff};
        group.add(bin_key::inversion(role, passive, at, place.context, seen),
                  std::string{role_name(role)} + (passive ? " P " : " A ") +
                      std::string{field_name(place.field)} + (place.stuff ? " stuff bit" : "") +
                      "[" + std::to_string(index) + "]" + context_name(place.context) +
                      (seen == Level::kDominant ? " r->d" : " d->r"));
      }
    }
  }
}

/// Own bits of a frame in arbitration, followed bit by bit with all runs that stuffing allows.
class Runs {
 public:
  explicit Runs(bool extended) : extended_{extended} {}
  [[nodiscard]] unsigned positions() const { return extended_ ? 32 : 12; }
  /// Relations to a stuff bit in which the next position can be lost; then goes on by one bit.
  std::set<unsigned> step() {
    std::set<unsigned> relations;
    std::set<Run> next;
    for (const auto &[level, length, stuffed] : now_) {
      const bool stuff_due = length == 5;
      if (stuff_due && level == 0) relations.insert(kLossAtStuff);  // AR-04: a recessive stuff bit
      const Run run = stuff_due ? Run{1 - level, 1, true} : Run{level, length, stuffed};
      const auto longer = [&run](int bit) {
        return Run{bit, std::get<0>(run) == bit ? std::get<1>(run) + 1 : 1, false};
      };
      const bool completes = std::get<1>(longer(0)) == 5;  // the lost bit is seen dominant
      if (std::get<2>(run)) {
        relations.insert(kLossAfterStuff);
      } else {
        relations.insert(completes ? kLossBeforeStuff : kLossPlain);
      }
      const bool recessive_only = extended_ && (position_ == 11 || position_ == 12);
      if (!recessive_only) next.insert(longer(0));
      next.insert(longer(1));
    }
    now_ = next;
    ++position_;
    return relations;
  }

 private:
  using Run = std::tuple<int, int, bool>;  // level (0 = d), equal bits, the last one is a stuff bit
  bool extended_;
  unsigned position_ = 0;
  std::set<Run> now_{{0, 1, false}};  // SOF
};

void add_losses(BinGroup &group, bool extended) {
  constexpr const char *kRelations[] = {"no stuff bit near", "after a stuff bit", "at a stuff bit",
                                        "before a stuff bit"};
  const std::string format = extended ? "extended" : "base";
  std::string missing[4];
  Runs runs{extended};
  for (unsigned position = 0; position < runs.positions(); ++position) {
    const std::set<unsigned> reachable = runs.step();
    for (unsigned relation = 0; relation < 4; ++relation) {
      const std::string number = std::to_string(position);
      if (reachable.count(relation) != 0) {
        group.add(bin_key::loss(extended, position, relation),
                  format + " position " + number + ", " + kRelations[relation]);
      } else {
        missing[relation] += " " + number;
      }
    }
  }
  for (unsigned relation = 0; relation < 4; ++relation) {
    if (missing[relation].empty()) continue;
    group.unreachable.push_back(format + ", " + kRelations[relation] + ", positions" +
                                missing[relation] +
                                ": no own bits lead there (ST-01; SRR and IDE are recessive)");
  }
}

}  // namespace

const char *role_name(Role role) {
  if (role == Role::kNone) return "-";
  return role == Role::kTransmitter ? "T" : "R";
}

BinGroup inversion_bins() {
  BinGroup group;
  group.name = "role x A/P x position x inversion";
  for (const BinPlace &place : kPlaces) {
    add_place(group, place, Role::kTransmitter, place.transmitter);
    add_place(group, place, Role::kReceiver, place.receiver);
    add_place(group, place, Role::kNone, place.neither);
  }
  group.unreachable = {
      "d->r at delimiters, EOF, INT, suspend: recessive by rule; a dominant bit that the node does "
      "not see there is no event for it",
      "r->d at SOF, active flag, overload flag: the node itself drives dominant",
      "T, SOF to CRC, the level that it sends itself seen: the node sees what it sent",
      "T, r->d at r1 and r0: a transmitter sends them dominant (FF-04)",
      "T, stuff bit r0 or DLC d->r: five recessive bits before it would need a recessive r1 or r0",
      "R at SOF: a receiver sees SOF in idle, INT3 or suspend",
      "A in suspend or in a passive flag: only passive nodes come there, no counter falls there",
      "R in suspend: only transmitters wait (IF-09)"};
  return group;
}

BinGroup int3_bins() {
  constexpr const char *kStories[] = {"after an own frame",     "after a foreign frame",
                                      "after lost arbitration", "after an error as T",
                                      "after an error as R",    "after overload as T",
                                      "after overload as R"};
  BinGroup group;
  group.name = "INT3 SOF x pending x A/P x story";
  for (unsigned story = 0; story < 7; ++story) {
    for (const bool pending : {false, true}) {
      for (const bool passive : {false, true}) {
        group.add(bin_key::int3(pending, passive, story),
                  std::string{kStories[story]} + (pending ? ", pending, " : ", not pending, ") +
                      (passive ? "P" : "A"));
      }
    }
  }
  return group;
}

BinGroup late_dominant_bins() {
  struct Bit {
    Field field;
    unsigned context;
    unsigned index;
    const char *name;
  };
  constexpr Bit kBits[] = {{Field::kDel, 0, 0, "DEL8 of an error frame"},
                           {Field::kDel, 1, 0, "DEL8 of an overload frame"},
                           {Field::kEof, 0, 0, "EOF7"},
                           {Field::kInt, 0, 0, "INT1"},
                           {Field::kInt, 0, 1, "INT2"}};
  BinGroup group;
  group.name = "DEL8, EOF7, INT1, INT2 dominant x role x A/P";
  for (const Bit &bit : kBits) {
    for (const Role role : {Role::kTransmitter, Role::kReceiver}) {
      for (const bool passive : {false, true}) {
        group.add(bin_key::late(bit.field, bit.context, role, passive, bit.index),
                  std::string{bit.name} + " " + role_name(role) + (passive ? " P" : " A"));
      }
    }
  }
  return group;
}

BinGroup loss_bins() {
  BinGroup group;
  group.name = "arbitration lost at each position x stuff bit";
  add_losses(group, false);
  add_losses(group, true);
  return group;
}

BinGroup sync_bins() {
  BinGroup group;
  group.name = "e x SJW x role x sent level";
  for (int e = -8; e <= 16; ++e) {
    for (unsigned sjw = 1; sjw <= 4; ++sjw) {
      for (const bool transmitter : {false, true}) {
        for (const Level sent : {Level::kDominant, Level::kRecessive}) {
          group.add(bin_key::sync(e, sjw, transmitter, sent),
                    "e " + std::to_string(e) + " SJW " + std::to_string(sjw) +
                        (transmitter ? " T" : " R") +
                        (sent == Level::kDominant ? " sends d" : " sends r"));
        }
      }
    }
  }
  return group;
}

BinGroup counter_bins() {
  BinGroup group;
  group.name = "counters across 95/96, 127/128, 255/256 by each step";
  const auto add = [&group](CounterStep step, const char *name, unsigned threshold, unsigned from) {
    group.add(bin_key::counter(step, threshold, from), std::string{name} + " from " +
                                                           std::to_string(from) + " across " +
                                                           std::to_string(threshold));
  };
  for (const unsigned threshold : {96u, 128u, 256u}) {
    for (unsigned from = threshold - 8; from < threshold; ++from) {
      add(kTecUp8, "TEC +8", threshold, from);
      if (threshold != 256) add(kRecUp8, "REC +8", threshold, from);
    }
    add(kTecRecovered, "TEC to 0 by recovery", threshold, 256);
    if (threshold == 256) continue;
    add(kTecDown1, "TEC -1", threshold, threshold);
    add(kRecUp1, "REC +1", threshold, threshold - 1);
  }
  add(kRecDown1, "REC -1", 96, 96);
  add(kRecSetBack, "REC set back", 128, 128);
  group.unreachable = {"TEC -1 across 256: bus-off ends by recovery alone (FC-13, BO-05)",
                       "REC across 256: REC holds from 128 on (FC-14)",
                       "REC -1 across 128: from 128 on a reception sets back (FC-10)"};
  return group;
}

}  // namespace vericansim
