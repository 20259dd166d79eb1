// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// InjectionRig: see injection_rig.hpp.
#include "faults/injection_rig.hpp"

#include <stdexcept>
#include <utility>

#include "unit/model_bench.hpp"

namespace vericansim {
namespace {

constexpr unsigned kQuietBits = 40;        // 19.5 item 4: at least 40 bits after the disturbance
constexpr unsigned kRestLimit = 500;       // a few retries of the longest frame
constexpr unsigned kRecoveryLimit = 1500;  // BO-02: 128 x 11 bits, and what is left of a burst

bool normal_mode(const CoreConfig &config) {
  return !config.listen_only && !config.loop_back && !config.fd_tolerant;
}

}  // namespace

InjectionRig::InjectionRig(const StartCounters &counters, const CoreConfig &config, RuleBins *bins)
    : bench{1, config}, judge{bench}, assertions{bench} {
  judge.preset_counters(0, counters.tec, counters.rec);
  if (bins != nullptr && normal_mode(config)) watch(*bins);
}

void InjectionRig::watch(RuleBins &bins) {
  bench.on_bit = [this, &bins, then = std::move(bench.on_bit)](unsigned i, const DutBit &bit) {
    bins.before(judge.model(), bench.lt_level() & bit.tx, bit.rx);
    then(i, bit);
    bins.after(judge.model());
  };
}

void InjectionRig::play(std::string_view script) {
  for (const char c : script) {
    if (c == ' ') continue;
    const bool dominant = c == '0' || c == 'R';
    bench.lt(dominant ? Level::kDominant : Level::kRecessive);
    if (c == '!') bench.force_next(0, Effect::kFlip);
    if (c == 'R') bench.force_next(0, Effect::kRecessive);
    if (!dominant && c != '!' && c != '1' && c != '.') {
      throw std::invalid_argument("a script takes 0 1 . ! R");
    }
    bench.step();
  }
  bench.lt(Level::kRecessive);
}

bool InjectionRig::at_flag() {
  const Field field = bench.place().field();
  return field == Field::kErrFlag || field == Field::kOvlFlag;
}

std::string_view InjectionRig::play_to_flag(std::string_view script) {
  while (!script.empty() && !at_flag()) {
    play(script.substr(0, 1));
    script.remove_prefix(1);
  }
  return script;
}

void InjectionRig::finish(bool recover) {
  bench.lt_acknowledges(true);
  bench.run_bits(kQuietBits);
  if (bench.last().bus_off) {
    if (!recover) return;
    const auto on_again = [this] { return !bench.last().bus_off; };
    if (!bench.run_until(on_again, kRecoveryLimit)) return complain("does not leave bus-off");
  }
  const auto rests = [this] {
    const bool waits = bench.dut().pending() && !bench.dut().config().listen_only;
    return !waits && bench.place().field() == Field::kIdle;
  };
  if (!bench.run_until(rests, kRestLimit)) return complain("does not come to rest");
  receive_good_frame();
}

void InjectionRig::receive_good_frame() {
  static const std::string kWire = model_bench::whole(kGoodFrame) + "111";
  const std::size_t before = bench.dut().received().size();
  play(kWire);
  const std::vector<Frame> &received = bench.dut().received();
  if (received.size() != before + 1 || received.back() != kGoodFrame) {
    complain("does not receive the good frame that follows");
  }
}

std::string InjectionRig::report() const {
  std::string text = judge.report();
  if (!text.empty() && text.back() != '\n') text += "\n";
  text += assertions.report();
  for (const std::string &line : complaints_) text += line + "\n";
  return text;
}

}  // namespace vericansim
