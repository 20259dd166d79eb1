// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusJudge: see bus_judge.hpp.
#include "judge/bus_judge.hpp"

#include <fmt/format.h>

namespace vericansim {

namespace {

/// A stop is seen at the next access of the CPU; what it does to a frame shows this much later.
constexpr Time kStopSpan = 40;  // bits

}  // namespace

BusJudge::BusJudge(Time bit_time)
    : bit_time_{bit_time}, wire_{bit_time, [this](const std::string &text) { finding(text); }} {}

BusJudge::~BusJudge() = default;

void BusJudge::add(RtlNode &node) {
  auto side = std::make_unique<Side>();
  side->name = node.name();
  Side *target = side.get();
  const auto report = [this, target](const std::string &text) {
    if (findings_.empty()) too_open_ = target->buffers->too_open();
    finding(fmt::format("{} at {:.3f} us: {}", target->name,
                        static_cast<double>(target->bit) / kMicrosecond, text));
  };
  side->buffers = std::make_unique<BufferJudge>(node, report);
  side->rules = std::make_unique<NodeJudge>(*side->buffers, report);
  side->buffers->on_stop = [this, &node] {
    const Time now = node.oscillator().next();
    disturbances().add(kAllNodes, {now - kStopSpan * bit_time_, now + kStopSpan * bit_time_});
  };
  wire_.add_node(node.name());
  sides_.push_back(std::move(side));
}

void BusJudge::on_node_tx(NodeId id, Time time, Level level) {
  sides_[id]->pin_time = time;
  sides_[id]->pin = level;
}

void BusJudge::on_bit(NodeId id, const BitRecord &record) {
  if (!findings_.empty()) return;  // what follows from a difference is none
  Side &side = *sides_[id];
  side.bit = record.time;
  // An edge at the sample point itself comes after it.
  const Level pin = side.pin_time < record.time ? side.pin : !side.pin;
  side.rules->bit(record, pin);
  if (!record.after.running) return;  // stopped before the bit was over
  const NodeBit bit = node_bit(record, pin);
  if (side.rules->restarted()) {
    ++counts_.stops;
    disturbances().add(kAllNodes, {record.time - bit_time_, record.time});
  }
  if (bit.errors != 0) judge_errors(side, bit);
  if (bit.bus_off && !side.bus_off) ++counts_.bus_offs;
  // Who comes back from bus-off may start where the others, and the decoder, expect no start: in
  // the delimiter of an error passive transmitter that nobody acknowledges (BO-03).
  if (!bit.bus_off && side.bus_off)
    disturbances().add(kAllNodes, {record.time - bit_time_, record.time});
  side.bus_off = bit.bus_off;
  const Frame &frame = side.rules->model().received();
  if (!side.rules->model().config().loop_back) wire_.bit(id, record.time, bit, frame);
  const bool received = bit.delivered && !bit.transmitter;
  if (received && side.accepts && side.accepts(frame)) side.to_software.push_back(frame);
}

void BusJudge::judge_errors(const Side &side, const NodeBit &bit) {
  ++counts_.errors;
  if (quiet_from_ < 0 || side.bit < quiet_from_) return;
  if (!disturbances().none_before(side.bit + bit_time_)) return;
  finding(fmt::format("{} at {:.3f} us: sees an error (kinds {:02X}) in {} on an undisturbed bus",
                      side.name, static_cast<double>(side.bit) / kMicrosecond, bit.errors,
                      field_name(bit.field)));
}

void BusJudge::expect_software(NodeId id, std::function<bool(const Frame &)> accepts) {
  sides_[id]->accepts = std::move(accepts);
}

void BusJudge::software_received(NodeId id, const Frame &frame, bool overrun) {
  Side &side = *sides_[id];
  if (!side.accepts || !findings_.empty()) return;
  if (overrun || side.rules->failed()) {  // the buffers' model judges what was lost
    side.accepts = nullptr;
    return;
  }
  ++counts_.software;
  if (side.to_software.empty()) {
    return finding(fmt::format("{}: software got {}, which was not received or is doubled",
                               side.name, frame_text(frame)));
  }
  if (side.to_software.front() != frame) {
    finding(fmt::format("{}: software got {}, the next one received was {}", side.name,
                        frame_text(frame), frame_text(side.to_software.front())));
    side.accepts = nullptr;
    return;
  }
  side.to_software.pop_front();
}

void BusJudge::on_wire(const BusFrame &frame) {
  if (findings_.empty()) wire_.on_wire(frame);
}

void BusJudge::finish(Time now) {
  if (!findings_.empty()) return;
  for (const auto &side : sides_) {
    side->buffers->finish();
    if (side->accepts && !side->rules->failed() && side->to_software.size() > 1) {
      finding(fmt::format("{}: {} frames were received, but software did not get them", side->name,
                          side->to_software.size()));
    }
  }
  wire_.finish(now);
}

JudgeCounts BusJudge::counts() const {
  JudgeCounts counts = counts_;
  for (const auto &side : sides_) {
    counts.node_bits += side->rules->bits();
    counts.accesses += side->buffers->accesses();
  }
  counts.wire = wire_.counts();
  return counts;
}

void BusJudge::finding(const std::string &text) { findings_.push_back(text); }

}  // namespace vericansim
