// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReferenceNode: see reference_node.hpp.
#include "faults/reference_node.hpp"

#include <utility>

namespace vericansim {
namespace {

/// SY-05.
bool takes_hard_edges(const BitPlace &place) {
  switch (place.field) {
    case Field::kIdle:
    case Field::kSuspend:
    case Field::kInteg:
    case Field::kBusOff: return true;
    case Field::kInt: return place.index >= 1;
    default: return false;
  }
}

}  // namespace

ReferenceNode::ReferenceNode(const BitTiming &timing)
    : timing_{timing}, prescaler_{timing.prescaler} {
  model_.preset_idle();
}

void ReferenceNode::take(Level bit) {
  model_.sample(bit);
  if (model_.events().delivered) received_.push_back(model_.received());
  if (model_.events().sent_ok) ++sent_frames_;
}

bool ReferenceNode::clock(Level pin) {
  const Level seen = std::exchange(before_that_, std::exchange(before_, pin));
  ended_ = false;
  if (++phase_ < prescaler_) return false;
  phase_ = 0;
  const TimingReference::Quantum quantum = timing_.step(seen, sent_, hard_);
  if (quantum.sample) take(quantum.bit);
  if (quantum.last) {
    ended_ = true;
    sent_ = model_.drive();
    hard_ = takes_hard_edges(model_.state());
  }
  return quantum.sample;
}

}  // namespace vericansim
