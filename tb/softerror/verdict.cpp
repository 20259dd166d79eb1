// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What a flip has done: see verdict.hpp.
#include "softerror/verdict.hpp"

namespace vericansim {

const char *to_string(Verdict verdict) {
  static constexpr const char *kNames[kVerdicts] = {"no effect, gone",
                                                    "no effect, still there",
                                                    "status or interrupt",
                                                    "timing only",
                                                    "detected and retried",
                                                    "frame twice",
                                                    "bus-off and back",
                                                    "frame lost, told",
                                                    "frame lost silently",
                                                    "wrong frame accepted",
                                                    "wrong frame sent",
                                                    "configuration changed, harmless so far",
                                                    "configuration changed, harmful",
                                                    "stuck until buffers renewed",
                                                    "stuck until freeze and set-up",
                                                    "stuck until soft reset",
                                                    "bus blocked until software acts",
                                                    "hang",
                                                    "babbling"};
  return kNames[static_cast<unsigned>(verdict)];
}

Verdict judge(const Outcome &out, const Outcome &reference) {
  if (out.run_too_long) return Verdict::kBabble;
  if (out.ahb_hangs || out.cure >= Cure::kHardReset) return Verdict::kHang;
  if (out.vanished) return out.bus_differs || out.host_differs ? Verdict::kStatus : Verdict::kGone;
  const bool lost = out.lost_sent + out.lost_received + out.others > 0;
  const bool wrong = out.wrong_sent + out.wrong_received > 0;
  if (out.config_changed) {
    const bool bad = out.cure != Cure::kNone || lost || wrong || out.bus_blocked;
    return bad || out.bus_offs > reference.bus_offs ? Verdict::kConfigBad : Verdict::kConfig;
  }
  if (out.bus_blocked) return Verdict::kBlocked;
  switch (out.cure) {
    case Cure::kSoftReset: return Verdict::kStuckReset;
    case Cure::kReconfigure: return Verdict::kStuckFreeze;
    case Cure::kRenew: return Verdict::kStuckRenew;
    default: break;
  }
  if (out.wrong_sent > 0) return Verdict::kWrongSent;
  if (out.wrong_received > 0) return Verdict::kWrongReceived;
  if (lost) return out.told > reference.told ? Verdict::kLostTold : Verdict::kLost;
  if (out.bus_offs > reference.bus_offs) return Verdict::kBusOff;
  if (out.twice > reference.twice) return Verdict::kTwice;
  if (out.errors > reference.errors) return Verdict::kRetried;
  if (out.bus_differs) return Verdict::kTiming;
  return out.host_differs ? Verdict::kStatus : Verdict::kLatent;
}

std::string complaint(const Outcome &reference) {
  std::string text;
  const auto check = [&text](bool bad, const char *what) {
    if (bad) text += std::string{text.empty() ? "" : ", "} + what;
  };
  check(!reference.finished, "not finished");
  check(reference.wrong_sent + reference.wrong_received > 0, "wrong frame");
  check(reference.lost_sent + reference.lost_received + reference.others > 0, "frame lost");
  check(reference.told > 0, "overrun");
  check(reference.config_changed, "configuration changed");
  check(reference.ahb_hangs, "AHB hangs");
  check(reference.run_too_long, "dominant too long");
  check(reference.bus_blocked, "bus blocked");
  return text;
}

}  // namespace vericansim
