// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RuleFollower: see rule_follower.hpp. The tolerated differences are in rule_tolerance.hpp.
#include "judge/rule_follower.hpp"

#include "judge/rule_tolerance.hpp"

namespace vericansim {
namespace {

/// The bit of the trace that stands for an error.
std::uint8_t trace_bit(NodeError error) {
  switch (error) {
    case NodeError::kBit0: return kErrBit0;
    case NodeError::kBit1: return kErrBit1;
    case NodeError::kAck: return kErrAck;
    case NodeError::kCrc: return kErrCrc;
    case NodeError::kForm: return kErrForm;
    case NodeError::kStuff: return kErrStuff;
    default: return 0;
  }
}

/// Adds a sentence if the two are not the same.
void expect(std::vector<std::string> &found, const char *what, unsigned node, unsigned model) {
  if (node == model) return;
  found.push_back(std::string{what} + " " + std::to_string(node) + ", the rules say " +
                  std::to_string(model));
}

std::string name_of(Field field, bool stuff) {
  return std::string{field_name(field)} + (stuff ? " (stuff bit)" : "");
}

}  // namespace

std::vector<std::string> RuleFollower::follow(const NodeBit &bit) {
  Differences found;
  const int last_rec = model_.rec();
  expect(found, "sends", static_cast<unsigned>(bit.sent_level),
         static_cast<unsigned>(model_.internal_level()));
  compare_place(bit, found);
  model_.sample(bit.rx);
  compare_events(bit, found);
  compare_counters(bit, last_rec, found);
  return found;
}

void RuleFollower::compare_place(const NodeBit &bit, Differences &found) const {
  const BitPlace place = model_.state();
  if (place.field != bit.field || place.is_stuff != bit.stuff) {
    found.push_back("is at " + name_of(bit.field, bit.stuff) + ", the rules say " +
                    name_of(place.field, place.is_stuff));
    return;
  }
  const bool in_frame = bit.field >= Field::kSof && bit.field <= Field::kEof;
  if (in_frame) expect(found, "transmitter", bit.transmitter, model_.role() == Role::kTransmitter);
  const bool counted = in_frame || bit.field == Field::kInt || bit.field == Field::kSuspend ||
                       bit.field == Field::kDel || bit.field == Field::kOvlFlag;
  if (counted) expect(found, "bits left", bit.left, model_.left());
}

void RuleFollower::compare_events(const NodeBit &bit, Differences &found) const {
  const NodeEvents &events = model_.events();
  expect(found, "success", bit.sent, events.sent_ok);
  expect(found, "failure", bit.failed, events.tx_fail);
  expect(found, "error kinds", bit.errors, trace_bit(events.error));
  expect(found, "delivery", bit.delivered && !bit.transmitter,
         events.delivered && model_.role() != Role::kTransmitter);
}

void RuleFollower::compare_counters(const NodeBit &bit, int last_rec, Differences &found) {
  const bool off = model_.error_state() == ErrorState::kBusOff;
  expect(found, "bus-off", bit.bus_off, off);
  if (bit.bus_off && off && bit.field == Field::kBusOff)
    expect(found, "recovery sequences", bit.tec,
           static_cast<unsigned>(model_.recovery_sequences()));
  if (bit.bus_off || off) return;
  if (static_cast<int>(bit.tec) != model_.tec() && !settle_tec(model_, bit))
    expect(found, "TEC", bit.tec, static_cast<unsigned>(model_.tec()));
  const bool rec_equal = static_cast<int>(bit.rec) == model_.rec();
  if (!rec_equal && !settle_rec(model_, last_rec, crc_step_, bit))
    expect(found, "REC", bit.rec, static_cast<unsigned>(model_.rec()));
  if (rec_equal) crc_step_ = false;
  const bool passive = model_.error_state() == ErrorState::kPassive;
  if (!crc_step_) expect(found, "error passive", bit.passive, passive);
}

}  // namespace vericansim
