// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Random buses: what the CPUs do with registers and buffers, at any moment.
#include <algorithm>
#include <bit>

#include "model/buffer_match.hpp"
#include "model/registers.hpp"
#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

using Kind = AccessStep::Kind;
using Steps = std::vector<AccessStep>;

constexpr std::uint32_t kSoftRst = reg::kMcrSoftRst;
constexpr std::uint32_t kFrozen = reg::kMcrFrz | reg::kMcrHalt;
constexpr std::uint32_t kCode = reg::kCodeMask;
constexpr std::uint32_t kAen = 1U << 12;
constexpr std::uint32_t kBcc = 1U << 16;

void read(Steps &steps, std::uint32_t address) { steps.push_back({Kind::kRead, address}); }
void write(Steps &steps, std::uint32_t address, std::uint32_t value) {
  steps.push_back({Kind::kWrite, address, value});
}
void until(Steps &steps, std::uint32_t address, std::uint32_t mask, std::uint32_t value) {
  steps.push_back({Kind::kUntil, address, value, mask});
}

/// One node that is driven by accesses alone: its settings, and what its software may do.
class Script {
 public:
  Script(Dice &dice, Scenario &scenario, NodeId id)
      : dice_{dice}, scenario_{scenario}, id_{id}, num_mb_{scenario.nodes[id].num_mb} {
    const auto flag = [&](unsigned n, unsigned per_cent) {
      if (dice_.per_cent(per_cent)) mcr_ |= 1U << n;
    };
    mcr_ = reg::kMcrWrnEn | (num_mb_ - 1);
    flag(16, 65);  // BCC
    flag(17, 70);  // SRX_DIS
    flag(13, 30);  // LPRIO_EN
    flag(12, 35);  // AEN
    flag(29, 35);  // FEN
    mcr_ |= reg::mcr_idam(dice_.below(3));
    ctrl2_ = (dice_.below(8) << 16) | reg::ctrl2_rffn(num_mb_ > 16 ? dice_.below(3) : 0);
    ctrl1_ = scenario.nodes[id].timing->ctrl_fields() | (dice_.per_cent(30) ? reg::kCtrlLbuf : 0);
    xctrl_ = (dice_.per_cent(10) ? 2U : 0U) | (dice_.per_cent(25) ? 4U : 0U);
    const bool fen = (mcr_ & reg::kMcrFen) != 0;
    first_ = fen ? 8 + 2 * ((ctrl2_ >> 24) & 0xF) : 0;
  }

  void draw() {
    const Time bit = bit_time(scenario_);
    const Time apart = bit * 70 * dice_.in(1, 8);
    Time at = bit * dice_.in(1, 300);
    add(at, set_up(true));
    for (at += apart; at < scenario_.duration; at += apart * dice_.in(20, 180) / 100 + 1) {
      if (dice_.below(25) == 0) at = slow_reader(at, bit);
      add(at, dice_.below(400) == 0 ? interrupt() : something());
    }
  }

 private:
  /// What would begin behind the run's end is not done.
  void add(Time at, Steps steps) {
    if (at < scenario_.duration) scenario_.accesses.push_back({id_, at, std::move(steps)});
  }

  [[nodiscard]] unsigned mailbox() {
    const unsigned count = std::min(num_mb_ - first_, 12U);
    return dice_.per_cent(50) ? first_ + dice_.below(count) : num_mb_ - 1 - dice_.below(count);
  }

  /// The buffer that gets a frame when none is free.
  [[nodiscard]] unsigned busy_receiver() const {
    const bool last = (mcr_ & kBcc) != 0;
    return static_cast<unsigned>(last ? std::bit_width(receives_) - 1
                                      : std::countr_zero(receives_));
  }

  /// Keeps a buffer locked until a frame waits for it, does something else, and looks at the frame
  /// when it must have moved in. Returns the end.
  [[nodiscard]] Time slow_reader(Time at, Time bit) {
    if (receives_ == 0) return at;
    const unsigned mb = busy_receiver();
    Steps lock;
    read(lock, reg::mb(mb));
    add(at, lock);
    at += bit * dice_.in(60, 250);
    Steps unlock;
    const unsigned other = mailbox();
    if (other != mb) {
      receives_ &= ~(std::uint64_t{1} << other);
      write(unlock, reg::mb(other), reg::kCodeTxInactive);
    }
    write(unlock, mb < 32 ? reg::kIflag1 : reg::kIflag2, 1U << (mb % 32));
    read(unlock, reg::kTimer);
    add(at, unlock);
    at += bit * dice_.in(15, 25);
    Steps look_at;
    service(look_at, mb);
    add(at, look_at);
    return at + bit * 10;
  }

  [[nodiscard]] Steps set_up(bool from_reset) {
    Steps steps;
    receives_ = 0;
    if (from_reset) {
      write(steps, reg::kMcr, kFrozen | 0xF);
      until(steps, reg::kMcr, reg::kMcrLpmAck | reg::kMcrFrzAck, reg::kMcrFrzAck);
    }
    write(steps, reg::kMcr, kFrozen | mcr_);
    write(steps, reg::kCtrl, ctrl1_);
    write(steps, reg::kCtrl2, ctrl2_);
    write(steps, reg::kExtControl, xctrl_);
    const std::uint32_t wide = dice_.per_cent(50) ? 0x1FF80000 : 0;
    write(steps, reg::kRxgmask, wide);
    write(steps, reg::kRxfgmask, dice_.per_cent(50) ? 0 : 0xDFFFFFFF);
    for (unsigned n = 0; n < num_mb_; ++n)
      write(steps, reg::rximr(n), dice_.per_cent(40) ? 0 : dice_.per_cent(50) ? wide : 0xDFFFFFFF);
    if (first_ != 0)
      for (unsigned n = 0; n < 4 * (first_ - 6); ++n)
        write(steps, reg::filter(n), static_cast<std::uint32_t>(dice_.word()) & 0x3FFFFFFF);
    for (unsigned n = first_; n < num_mb_; ++n) {
      const bool receives = dice_.per_cent(30);
      if (receives) receives_ |= std::uint64_t{1} << n;
      write(steps, reg::mb(n, 1), draw_identifier(dice_, dice_.below(16), false) << 18);
      write(steps, reg::mb(n), receives ? reg::kCodeRxEmpty : 0);
    }
    write(steps, reg::kMcr, mcr_ | reg::kMcrFrz);
    return steps;
  }

  /// What software sees at once, so that what the specification leaves open does not stay open.
  void look(Steps &steps, unsigned mb) {
    read(steps, reg::kIflag1);
    if (num_mb_ > 32) read(steps, reg::kIflag2);
    if ((mcr_ & kAen) != 0) read(steps, reg::mb(mb));
  }

  /// With AEN=1 a buffer that is being sent does not let itself be deactivated: then hands off.
  void inactivate(Steps &steps, unsigned mb, std::uint32_t code) {
    write(steps, reg::mb(mb), code);
    look(steps, mb);
    steps.push_back({Kind::kIf, reg::mb(mb), code, kCode});
  }

  void receive_buffer(Steps &steps, unsigned mb) {
    inactivate(steps, mb, 0);
    receives_ |= std::uint64_t{1} << mb;
    const bool extended = dice_.per_cent(30);
    const std::uint32_t id = draw_identifier(dice_, dice_.below(16), extended);
    write(steps, reg::mb(mb, 1), extended ? id : id << 18);
    write(
        steps, reg::mb(mb),
        reg::kCodeRxEmpty | (extended ? reg::kCsIde : 0) | (dice_.per_cent(20) ? reg::kCsRtr : 0));
  }

  void send(Steps &steps, unsigned mb) {
    inactivate(steps, mb, reg::kCodeTxInactive);
    receives_ &= ~(std::uint64_t{1} << mb);
    const bool extended = dice_.per_cent(30);
    const bool remote = dice_.per_cent(15);
    const std::uint32_t id = draw_identifier(dice_, id_, extended);
    write(steps, reg::mb(mb, 2), static_cast<std::uint32_t>(dice_.word()));
    write(steps, reg::mb(mb, 3), dice_.per_cent(50) ? 0xFFFFFFFF : 0);
    write(steps, reg::mb(mb, 1), (extended ? id : id << 18) | (dice_.below(8) << 29));
    const std::uint32_t code = dice_.per_cent(85) ? reg::kCodeTxData : kTxAnswerWaits << 24;
    const std::uint32_t dlc = dice_.per_cent(70) ? dice_.below(3) : dice_.below(16);
    write(steps, reg::mb(mb),
          code | (dlc << 16) | (remote ? reg::kCsRtr : 0) |
              (extended ? reg::kCsIde | reg::kCsSrr : 0) | (dice_.per_cent(25) ? 1U << 28 : 0));
  }

  /// As drivers read a buffer.
  void service(Steps &steps, unsigned mb) {
    const std::uint32_t flags = mb < 32 ? reg::kIflag1 : reg::kIflag2;
    read(steps, flags);
    for (unsigned word = 0; word < 4; ++word) read(steps, reg::mb(mb, word));
    write(steps, flags, 1U << (mb % 32));
    read(steps, reg::kTimer);
  }

  void service_fifo(Steps &steps) {
    read(steps, reg::kIflag1);
    for (unsigned word = 0; word < 4; ++word) read(steps, reg::mb(0, word));
    read(steps, reg::kRxfir);
    write(steps, reg::kIflag1, reg::kIflagFifo << dice_.below(3));
  }

  [[nodiscard]] Steps something() {
    Steps steps;
    for (unsigned n = dice_.in(1, 3); n > 0; --n) {
      const unsigned mb = mailbox();
      const std::uint64_t kind = dice_.below(13);
      switch (kind) {
        case 0: receive_buffer(steps, mb); break;
        case 1:
        case 2:
        case 3: send(steps, mb); return steps;  // its `if` ends the list
        case 4:
        case 5:
          receives_ &= ~(std::uint64_t{1} << mb);
          write(steps, reg::mb(mb), (kind == 4 ? kTxInactive : kTxAbort) << 24);
          break;
        case 6: read(steps, reg::mb(mb)); break;
        case 7: read(steps, reg::kTimer); break;
        case 8: write(steps, mb < 32 ? reg::kIflag1 : reg::kIflag2, 1U << (mb % 32)); break;
        case 9: read(steps, dice_.per_cent(50) ? reg::kEcr : reg::kEsr); break;
        case 10: service(steps, first_ + dice_.below(num_mb_ - first_)); break;
        case 11:
          if (dice_.per_cent(3)) write(steps, reg::kTimer, dice_.below(0x10000));
          break;
        default:
          if (first_ != 0) {
            service_fifo(steps);
          } else {
            read(steps, reg::kRxfir);  // of no meaning, and of no effect
          }
          break;
      }
      look(steps, mb);
    }
    return steps;
  }

  /// Off the bus and back: freeze, disable, or a soft reset with a new set-up.
  [[nodiscard]] Steps interrupt() {
    Steps steps;
    switch (dice_.below(3)) {
      case 0:
        write(steps, reg::kMcr, kFrozen | mcr_);
        until(steps, reg::kMcr, reg::kMcrFrzAck, reg::kMcrFrzAck);
        for (unsigned n = dice_.below(20); n > 0; --n)
          read(steps, reg::mb(mailbox(), dice_.below(4)));
        write(steps, reg::kMcr, mcr_ | reg::kMcrFrz);
        until(steps, reg::kMcr, reg::kMcrFrzAck, 0);
        break;
      case 1:
        write(steps, reg::kMcr, mcr_ | reg::kMcrMdis);
        until(steps, reg::kMcr, reg::kMcrLpmAck, reg::kMcrLpmAck);
        write(steps, reg::kMcr, mcr_);
        until(steps, reg::kMcr, reg::kMcrLpmAck, 0);
        break;
      default:
        write(steps, reg::kMcr, kSoftRst);
        until(steps, reg::kMcr, kSoftRst | reg::kMcrFrzAck, reg::kMcrFrzAck);
        const Steps again = set_up(false);
        steps.insert(steps.end(), again.begin(), again.end());
        break;
    }
    return steps;
  }

  Dice &dice_;
  Scenario &scenario_;
  NodeId id_;
  unsigned num_mb_;
  unsigned first_ = 0;          // mailbox
  std::uint64_t receives_ = 0;  // buffers that have been made ready to receive
  std::uint32_t mcr_ = 0, ctrl1_ = 0, ctrl2_ = 0, xctrl_ = 0;
};

/// Beside software that serves its buffers: reads of anything that do no harm to it.
void draw_reads(Dice &dice, Scenario &scenario, NodeId id) {
  const Time bit = bit_time(scenario);
  const unsigned num_mb = scenario.nodes[id].num_mb;
  for (Time at = bit * dice.in(1, 2000); at < scenario.duration; at += bit * dice.in(1, 2000)) {
    Steps steps;
    for (unsigned n = dice.in(1, 4); n > 0; --n) {
      constexpr std::uint32_t kPlain[] = {reg::kMcr,           reg::kCtrl,          reg::kTimer,
                                          reg::kEcr,           reg::kEsr,           reg::kImask1,
                                          reg::kIflag1,        reg::kIflag2,        reg::kCtrl2,
                                          VERICAN_ESR2_OFFSET, VERICAN_CRCR_OFFSET, reg::kRxfir};
      const unsigned kind = dice.below(3);
      if (kind == 0) read(steps, kPlain[dice.below(std::size(kPlain))]);
      if (kind == 1) read(steps, reg::mb(dice.below(num_mb), dice.below(4)));
      if (kind == 2) read(steps, reg::rximr(dice.below(num_mb)));
    }
    scenario.accesses.push_back({id, at, steps});
  }
}

}  // namespace

void draw_accesses(Dice &dice, Scenario &scenario) {
  for (NodeId id = 0; id < scenario.nodes.size(); ++id) {
    if (!scenario.nodes[id].software) {
      Script{dice, scenario, id}.draw();
    } else if (dice.per_cent(30)) {
      draw_reads(dice, scenario, id);
    }
  }
}

}  // namespace vericansim
