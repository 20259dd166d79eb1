// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// InjectionRig: one run of the error injection matrix: one engine, LT as a script, all judges, and
// what they found as text.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "faults/rule_bins.hpp"
#include "protocol/assertions.hpp"
#include "protocol/core_bench.hpp"
#include "protocol/lockstep.hpp"

namespace vericansim {

/// Error counters at the start of a run.
struct StartCounters {
  std::uint8_t tec = 0;
  std::uint8_t rec = 0;
};

/// The frame that ends every run: it must be received as on a bus that has seen no error.
inline const Frame kGoodFrame{.id = 0x2A5, .dlc = 3, .data = {0xC3, 0x00, 0x7E}};

/// A DUT, in idle after start(). Compared with the node model in every bit: level, place, TEC, REC,
/// state, deliveries, successes, failures; the always-on assertions watch it, too.
class InjectionRig {
 public:
  /// `bins`: functional coverage to count into, may be null; left alone in modes other than normal.
  InjectionRig(const StartCounters &counters, const CoreConfig &config, RuleBins *bins);
  InjectionRig(const InjectionRig &) = delete;
  InjectionRig &operator=(const InjectionRig &) = delete;

  /// Integrates, then stands at an idle bit.
  void start() { judge.start(); }
  /// Begins to integrate; the coming bit is the first that counts.
  void start_integrating() { bench.dut().start(); }

  /// One bit a character: '0' LT is dominant; '1' or '.' it is recessive; '!' LT is recessive and
  /// the DUT sees the opposite of the wire; 'R' LT is dominant and the DUT sees recessive.
  void play(std::string_view script);
  /// Plays until the coming bit is one of an error or overload flag; returns what is left.
  std::string_view play_to_flag(std::string_view script);
  void request(const Frame &frame, bool one_shot = false) { judge.request(0, frame, one_shot); }

  /// Lets bus and DUT come to rest and sends kGoodFrame, which must arrive. A DUT in bus-off is
  /// left there after 40 bits unless `recover`.
  void finish(bool recover);

  /// Place of the coming bit by the rules, and the DUT's role in it.
  [[nodiscard]] BitPlace place() { return judge.model().state(); }
  [[nodiscard]] Role role() { return judge.model().role(); }
  [[nodiscard]] bool at_flag();
  /// Adds a complaint of the run itself.
  void complain(const std::string &what) { complaints_.push_back(what); }
  /// All that is wrong; empty if nothing is.
  [[nodiscard]] std::string report() const;

  CoreBench bench;
  Lockstep judge;
  Assertions assertions;

 private:
  void watch(RuleBins &bins);
  void receive_good_frame();

  std::vector<std::string> complaints_;
};

}  // namespace vericansim
