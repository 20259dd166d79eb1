// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RegisterBench: clocks, judges and cases. Set-up and recovery are in register_recovery.cpp.
#include "fuzz/register_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "model/registers.hpp"

namespace vericansim::fuzz {
namespace {

// PROP 2, PS1 3, PS2 2 tq, SJW 1: 8 clocks a bit.
constexpr BitTiming kTiming{.prescaler = 1, .prop = 2, .ps1 = 3, .ps2 = 2, .sjw = 1};
constexpr unsigned kClocksPerBit = 8;
constexpr std::uint32_t kTimingFields = 0xFFFF0007 | reg::kCtrlSmp;
// HREADYOUT may be low in one clock (docs/integration.md), and in the first one of an ERROR.
constexpr unsigned kMostWaits = 1;
constexpr unsigned kHang = 64;  // clocks without the end of a transfer

}  // namespace

std::string to_string(CoreMode mode) {
  constexpr std::array<const char *, kModes> kNames = {
      "run", "freeze", "disable", "stop", "listen-only", "loop-back", "bus-off", "wrong timing"};
  return kNames[static_cast<std::size_t>(mode)];
}

RegisterBench::RegisterBench(FuzzedCore::Kind kind, std::uint64_t seed)
    : random_{seed}, core_{FuzzedCore::create(kind)}, judge_{kMicrosecond, kClocksPerBit} {
  core_->seed_idle_pins(random_());
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    CoreConfig config;
    config.timing = kTiming;
    peers_[i] = std::make_unique<CoreNode>(i == 0 ? "a" : "b", config);
    peers_[i]->start();
  }
  core_->ahb().watch([this](const AhbRequest &request, const AhbResponse &response) {
    if (!response.hready) return;
    if (mcr_write_ && (request.hwdata & reg::kMcrSoftRst) != 0) reset_asked_ = clocks_;
    mcr_write_ = request.htrans >= AhbTrans::kNonseq && request.hwrite &&
                 (request.haddr & 0xFFFC) == reg::kMcr;
  });
}

void RegisterBench::break_rule(const std::string &what) {
  if (fault_.empty()) fault_ = fmt::format("clock {}: {}", clocks_, what);
}

std::string RegisterBench::fault() const {
  if (!fault_.empty()) return fault_;
  if (!judge_.clean()) return judge_.fault();
  const auto &violations = core_->ahb().report().violations;
  if (!violations.empty()) return violations.front();
  if (max_waits() > kMostWaits) return fmt::format("{} wait states in one transfer", max_waits());
  return "";
}

// The peers talk with pauses, so that the bus is at rest at times.
void RegisterBench::talk() {
  for (std::size_t i = 0; i < peers_.size(); ++i) {
    if (peers_[i]->pending()) continue;
    if (pauses_[i] != 0) {
      --pauses_[i];
      continue;
    }
    pauses_[i] = static_cast<unsigned>(draw(random_, 600));
    peers_[i]->request(draw_frame(i == 0 ? 0x200 : 0x300));
  }
}

Frame RegisterBench::draw_frame(std::uint32_t base) {
  Frame frame;
  frame.id = base + static_cast<std::uint32_t>(draw(random_, 16));
  frame.extended = chance(random_, 40);
  if (frame.extended) frame.id = frame.id << 18U | static_cast<std::uint32_t>(draw(random_, 16));
  frame.dlc = static_cast<std::uint8_t>(draw(random_, 9));
  for (unsigned i = 0; i < frame.dlc; ++i) frame.data[i] = static_cast<std::uint8_t>(random_());
  return frame;
}

void RegisterBench::clock() {
  if (talking_) talk();
  const Level wire = core_->tx() & peers_[0]->tx() & peers_[1]->tx();
  const std::uint64_t before = core_->trace();
  core_->clock(deaf_ ? Level::kRecessive : wire);
  for (const auto &peer : peers_) peer->clock(wire);
  ++clocks_;
  watch(before);
  judge_.clock({core_->trace(), core_->tx(), wire, {peers_[0]->trace(), peers_[1]->trace()}});
}

// The core goes on the bus, or leaves it.
void RegisterBench::watch(std::uint64_t before) {
  const bool was = decode_trace(before).running, is = decode_trace(core_->trace()).running;
  if (was == is) return;
  if (!is) {
    // A soft reset waits for the end of a bit.
    const bool reset = reset_asked_ != 0 && clocks_ - reset_asked_ <= 2 * clocks_per_bit() + 8;
    judge_.left(reset);
    return;
  }
  const std::uint32_t ctrl = core_->peek(reg::kCtrl);
  setup_.listen_only = (ctrl & reg::kCtrlLom) != 0;
  setup_.loop_back = (ctrl & reg::kCtrlLpb) != 0;
  setup_.sane_timing = (ctrl & kTimingFields) == kTiming.ctrl_fields();
  judge_.joined(setup_);
}

unsigned RegisterBench::clocks_per_bit() {
  const std::uint32_t ctrl = core_->peek(reg::kCtrl);
  const unsigned quanta = 4 + (ctrl & 7U) + (ctrl >> 19U & 7U) + (ctrl >> 16U & 7U);
  return ((ctrl >> 24U) + 1) * quanta;
}

CoreMode RegisterBench::mode() {
  const Trace at = decode_trace(core_->trace());
  if (at.running) {
    if (at.bus_off) return CoreMode::kBusOff;
    if (setup_.loop_back) return CoreMode::kLoopBack;
    if (setup_.listen_only) return CoreMode::kListenOnly;
    return setup_.sane_timing ? CoreMode::kRun : CoreMode::kWrongTiming;
  }
  const std::uint32_t mcr = core_->peek(reg::kMcr);
  if ((mcr & reg::kMcrLpmAck) == 0) return CoreMode::kFreeze;
  return (mcr & reg::kMcrMdis) != 0 ? CoreMode::kDisable : CoreMode::kStop;
}

void RegisterBench::run(const RegisterCase &sequence) {
  std::vector<AhbMaster::Ticket> tickets;
  AhbMaster &ahb = core_->ahb();
  std::size_t submitted = 0, finished = 0;
  unsigned since = 0, limit = kHang;
  while (finished < sequence.size() && fault_.empty()) {
    // A few at a time: results are kept for a while only.
    for (; submitted < sequence.size() && submitted < finished + 8; ++submitted)
      tickets.push_back(ahb.submit(sequence[submitted]));
    clock();
    limit = kHang + sequence[finished].pause;
    if (++since > limit) break_rule("HREADYOUT is low: " + to_text(sequence[finished]));
    while (finished < submitted && ahb.done(tickets[finished])) {
      const bool error = ahb.result(tickets[finished]).error;
      if (error != expects_error(sequence[finished]))
        break_rule((error ? "ERROR where none is due: " : "no ERROR where one is due: ") +
                   to_text(sequence[finished]));
      ++finished;
      since = 0;
    }
  }
}

}  // namespace vericansim::fuzz
