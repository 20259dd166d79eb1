// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// One flip and what came of it: see experiment.hpp.
#include "softerror/experiment.hpp"

#include <algorithm>

namespace vericansim {
namespace {

// Bits until everything that was to be sent has left: a recovery from bus-off and many frames.
constexpr std::uint64_t kDrainBits = 9'000;
// A probe is some 30 frames; twice bus-off must not spoil it.
constexpr std::uint64_t kProbeBits = 9'000;
constexpr unsigned kProbeFrames = 10;

void apply(World &world, const Flip &flip) {
  switch (flip.kind) {
    case Flip::Kind::kNothing: break;
    case Flip::Kind::kFlop: world.dut().flip(flip.index); break;
    case Flip::Kind::kRam: world.dut().flip_ram(flip.index); break;
    case Flip::Kind::kStuckAt0: world.dut().stick(flip.index, false); break;
    case Flip::Kind::kStuckAt1: world.dut().stick(flip.index, true); break;
  }
}

/// Judges the ledger from a mark on: frames numbered before it have been judged.
struct Mark {
  std::array<std::size_t, kParties> first{};
  explicit Mark(const Ledger &ledger) {
    for (unsigned s = 0; s < kParties; ++s) first[s] = ledger.fates(s).size();
  }
};

void judge_own(const Fate &fate, Outcome &out) {
  const unsigned least = std::min(fate.received[1], fate.received[2]);
  const unsigned most = std::max(fate.received[1], fate.received[2]);
  if (fate.sent && least == 0) ++out.lost_sent;
  if (most > 1) ++out.twice;
}

void judge_foreign(const Fate &fate, unsigned neighbour, Outcome &out) {
  if (!fate.sent) return;
  if (fate.received[neighbour] == 0) ++out.others;
  if (fate.received[0] == 0 && !fate.excused) ++out.lost_received;
  if (fate.received[neighbour] > 1 || fate.received[0] > 1) ++out.twice;
}

void judge(const World &world, Outcome &out) {
  const Ledger &ledger = world.ledger();
  for (const Fate &fate : ledger.fates(0)) judge_own(fate, out);
  for (const Fate &fate : ledger.fates(1)) judge_foreign(fate, 2, out);
  for (const Fate &fate : ledger.fates(2)) judge_foreign(fate, 1, out);
  out.wrong_received = ledger.wrong(0);
  out.wrong_sent = ledger.wrong(1) + ledger.wrong(2);
}

/// Everybody sends some frames; true if all of them arrive everywhere.
bool probe(World &world) {
  const Mark mark(world.ledger());
  world.send(kProbeFrames);
  if (!world.run_until([&world] { return world.quiet(); }, kProbeBits * world.bit_clocks()))
    return false;
  world.run(200ULL * world.bit_clocks());  // the last frame's way to the driver
  for (unsigned source = 0; source < kParties; ++source) {
    const auto &fates = world.ledger().fates(source);
    for (std::size_t n = mark.first[source]; n < fates.size(); ++n) {
      const Fate &fate = fates[n];
      if (!fate.sent && !fate.aborted) return false;
      for (unsigned by = 0; by < kParties; ++by) {
        if (by != source && fate.received[by] == 0 && !fate.aborted) return false;
      }
    }
  }
  return true;
}

/// Does what is asked, lets everybody send what still waits, and probes.
template <typename Action>
bool cures(World &world, const Action &action) {
  world.traffic(false);
  if (!action()) return false;
  world.run_until([&world] { return world.quiet(); }, kDrainBits * world.bit_clocks());
  world.run(200ULL * world.bit_clocks());
  return probe(world);
}

Cure cure(World &world, bool drained) {
  if (drained && probe(world)) return Cure::kNone;
  if (!world.ahb_hangs()) {
    if (cures(world, [&] { return world.order(Order::kRenew); })) return Cure::kRenew;
    if (cures(world, [&] { return world.order(Order::kReconfigure); })) return Cure::kReconfigure;
    if (cures(world, [&] { return world.order(Order::kSoftReset); })) return Cure::kSoftReset;
  }
  return cures(world, [&] { return world.hard_reset(); }) ? Cure::kHardReset : Cure::kNever;
}

/// The traffic after the flip; true if the flip has left no trace in the core.
bool aftermath(World &world, bool golden, Reference &reference, Outcome &out) {
  FlopNode &dut = world.dut();
  for (unsigned check = 0; check < Reference::kChecks; ++check) {
    world.run(Reference::kCheckClocks);
    if (golden) {
      reference.state[check] = dut.state();
      reference.bus[check] = dut.seen_on_bus();
      reference.host[check] = dut.seen_by_host();
      continue;
    }
    if (world.ahb_hangs()) return false;
    out.bus_differs = dut.seen_on_bus() != reference.bus[check];
    out.host_differs = dut.seen_by_host() != reference.host[check];
    if (!out.bus_differs && !out.host_differs && dut.state() == reference.state[check]) return true;
  }
  return false;
}

void compare_end(World &world, bool golden, Reference &reference, Outcome &out) {
  FlopNode &dut = world.dut();
  world.driver().inspect();
  world.run_until([&world] { return world.driver().inspected(); }, 10'000);
  out.config_changed = world.driver().config_wrong() != 0;
  if (golden) {
    reference.end_bus = dut.seen_on_bus();
    reference.end_host = dut.seen_by_host();
  }
  out.bus_differs = dut.seen_on_bus() != reference.end_bus;
  out.host_differs = dut.seen_by_host() != reference.end_host;
}

}  // namespace

Outcome experiment(World &world, const Flip &flip, Reference &reference) {
  Outcome out;
  out.flip = flip;
  out.time = world.clock();
  const bool golden = flip.kind == Flip::Kind::kNothing;
  const unsigned bit = world.bit_clocks();
  const Sight before = world.sight();
  apply(world, flip);
  out.vanished = aftermath(world, golden, reference, out);
  out.finished = true;
  if (out.vanished) return out;
  world.traffic(false);
  const bool drained = world.run_until([&world] { return world.quiet(); }, kDrainBits * bit);
  if (drained) world.run(200ULL * bit);
  compare_end(world, golden, reference, out);
  judge(world, out);
  const Sight &after = world.sight();
  out.errors = after.errors - before.errors;
  out.bus_offs = after.bus_offs - before.bus_offs;
  out.told = world.driver().overruns();
  const bool touched = after.last_error > out.time;
  out.recovery = static_cast<std::uint32_t>(touched ? (after.last_error - out.time) / bit : 0);
  if (!golden) {
    out.cure = cure(world, drained);
    if (out.cure != Cure::kNone)
      out.recovery = static_cast<std::uint32_t>((world.clock() - out.time) / bit);
  }
  out.bus_blocked = after.longest_gap > kDrainBits * bit - kAftermath;
  out.ahb_hangs = world.ahb_hangs();
  out.run_too_long = after.run_too_long;
  out.longest_run = after.longest_run;
  out.longest_gap = static_cast<std::uint32_t>(after.longest_gap / bit);
  return out;
}

}  // namespace vericansim
