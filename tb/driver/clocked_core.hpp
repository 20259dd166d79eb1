// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ClockedCore: registers of a core with the time unit, its clock on an oscillator, without RTL;
// slews are instantaneous. DomainBus: nodes with the driver and a time domain, on a bus of whole
// frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "driver/fake_core.hpp"
#include "timesync/clock_node.hpp"
#include "verican/timesync.h"

namespace vericansim {

inline constexpr std::uint32_t kStampRows = 0x1400;

/// FakeCore with a time unit whose clock is `clock`, read at `*now`.
class ClockedCore : public FakeCore {
 public:
  ClockedCore(ClockNode node, const Nanoseconds *now) : clock{std::move(node)}, now_{now} {
    word(VERICAN_XCONFIG_OFFSET) |= VERICAN_XCONFIG_TIME_MASK;
    word(VERICAN_TCAP_OFFSET) = VERICAN_TCAP_RESET;
    word(VERICAN_TCTRL_OFFSET) = VERICAN_TCTRL_RESET;
    on_read = [this](std::uint32_t offset) {
      if (offset == VERICAN_TIMELO_OFFSET) show(offset, clock.at(edge()));
    };
    on_write = [this](std::uint32_t offset, std::uint32_t) { command(offset); };
  }
  void show(std::uint32_t offset, std::uint64_t value) {
    word(offset) = static_cast<std::uint32_t>(value);
    word(offset + 4) = static_cast<std::uint32_t>(value >> 32);
  }
  std::int64_t edge() { return clock.oscillator.last_edge(*now_); }

  ClockNode clock;

 private:
  std::uint64_t pair(std::uint32_t low) { return std::uint64_t{word(low + 4)} << 32 | word(low); }
  void change(std::int64_t shift) { clock.apply(edge(), {shift, clock.increment(), false, 0}); }
  void command(std::uint32_t offset) {
    if (offset == VERICAN_TIMEHI_OFFSET)
      change(static_cast<std::int64_t>(pair(VERICAN_TIMELO_OFFSET) - clock.at(edge())));
    if (offset == VERICAN_TSHHI_OFFSET)
      change(static_cast<std::int64_t>(pair(VERICAN_TSHLO_OFFSET)));
    if (offset == VERICAN_TSLEW_OFFSET) change(static_cast<std::int32_t>(word(offset)));
    if (offset == VERICAN_TINCF_OFFSET) {
      const std::uint64_t whole = word(VERICAN_TINCN_OFFSET);
      clock.apply(edge(), {0, whole << 32 | word(offset), false, 0});
    }
  }

  const Nanoseconds *now_;
};

/// A node: core, driver and time domain.
struct DomainNode {
  DomainNode(ClockNode clock, const Nanoseconds *now) : core{std::move(clock), now} {
    verican_config_t config = core.config();
    config.abort = true;
    config.clock_hz =
        static_cast<std::uint32_t>(std::llround(1e9L / core.clock.oscillator.nominal()));
    config.callbacks.user = this;
    config.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
      verican_tsyn_on_sent(&static_cast<DomainNode *>(self)->tsyn, event);
    };
    verican_init(&dev, &config);
    verican_start(&dev);
  }
  void set_up(const verican_tsyn_config_t &config, bool master) {
    verican_tsyn_init(&tsyn, &dev, &config);
    if (master) {
      verican_tsyn_start_master(&tsyn);
    } else {
      verican_tsyn_start_follower(&tsyn);
    }
  }
  [[nodiscard]] verican_tsyn_status_t status() const {
    verican_tsyn_status_t status{};
    verican_tsyn_status(&tsyn, &status);
    return status;
  }
  /// The mailbox whose frame goes first, or 64: the lowest identifier.
  unsigned first_to_send() {
    unsigned first = 64;
    for (unsigned mb = dev.first_tx; mb < 64; ++mb)
      if (code(mb) == VERICAN_MB_CS_CODE_TX_DATA && (first == 64 || id(mb) < id(first))) first = mb;
    return first;
  }
  std::uint32_t code(unsigned mb) {
    return VERICAN_MB_CS_CODE_GET(core.word(VERICAN_MB_CS_OFFSET(mb)));
  }
  std::uint32_t id(unsigned mb) { return core.word(VERICAN_MB_ID_OFFSET(mb)); }

  ClockedCore core;
  verican_t dev{};
  verican_tsyn_t tsyn{};
  bool connected = true;
};

class DomainBus {
 public:
  explicit DomainBus(std::uint64_t seed, double frequency_hz = 16e6)
      : dice_{seed}, frequency_hz_{frequency_hz} {}

  DomainNode &add() {
    const double error = std::uniform_real_distribution<double>{-100e-6, 100e-6}(dice_);
    const Oscillator oscillator{frequency_hz_, {.constant = error}, dice_()};
    nodes.push_back(std::make_unique<DomainNode>(ClockNode{oscillator, dice_() >> 3}, &now));
    return *nodes.back();
  }
  /// Time passes; every node polls once a ms, and what waits is sent.
  void run(double seconds, const std::function<void()> &every_ms = {}) {
    for (double n = 0; n < seconds * 1000; ++n) {
      now += 1e6;
      for (const auto &node : nodes) verican_tsyn_poll(&node->tsyn);
      for (const auto &node : nodes) end_aborted(*node);
      deliver();
      if (every_ms) every_ms();
    }
  }
  Nanoseconds error(unsigned of, unsigned to) {
    return nodes[of]->core.clock.ahead_of(nodes[to]->core.clock, now);
  }

  std::vector<std::unique_ptr<DomainNode>> nodes;
  Nanoseconds now = 1e6, delay = 0;            ///< delay of the bus between any two
  std::function<bool(std::uint32_t id)> lost;  ///< a frame that nobody gets

 private:
  // What is not on the bus is aborted at once.
  static void end_aborted(DomainNode &node) {
    for (unsigned mb = node.dev.first_tx; mb < 64; ++mb)
      if (node.code(mb) == VERICAN_MB_CS_CODE_TX_ABORT) end(node, mb, VERICAN_MB_CS_CODE_TX_ABORT);
  }
  void deliver() {
    for (int n = 0; n < 3; ++n) {
      DomainNode *sender = nullptr;
      for (const auto &node : nodes) {
        if (!node->connected || node->first_to_send() == 64) continue;
        if (sender == nullptr ||
            node->id(node->first_to_send()) < sender->id(sender->first_to_send()))
          sender = node.get();
      }
      if (sender == nullptr) return;
      now += std::uniform_real_distribution<double>{200e3, 300e3}(dice_);
      send(*sender, sender->first_to_send());
    }
  }
  void send(DomainNode &sender, unsigned mb) {
    const std::int64_t sent = sender.core.clock.oscillator.edge_after(now);
    const Nanoseconds edge = sender.core.clock.oscillator.time_of(sent, now);
    const std::uint32_t id = sender.id(mb);
    now += 100e3;  // the rest of the frame
    if (lost && lost(id >> VERICAN_MB_ID_STD_SHIFT)) return;
    for (const auto &node : nodes)
      if (node->connected && node.get() != &sender) receive(*node, sender, mb, edge + delay);
    sender.core.show(kStampRows + 8 * mb, sender.core.clock.at(sent));
    end(sender, mb, VERICAN_MB_CS_CODE_TX_INACTIVE);
  }
  static void receive(DomainNode &node, DomainNode &sender, unsigned from, Nanoseconds edge) {
    const ClockNode &clock = node.core.clock;
    node.core.show(kStampRows, clock.at(node.core.clock.oscillator.edge_after(edge) + 1));
    for (const std::uint32_t offset : {0u, 4u, 8u, 12u})
      node.core.word(VERICAN_MB_CS_OFFSET(0) + offset) =
          sender.core.word(VERICAN_MB_CS_OFFSET(from) + offset);
    end(node, 0, VERICAN_MB_CS_CODE_RX_FULL);
    verican_frame_t frame{};
    while (verican_receive(&node.dev, &frame) == VERICAN_OK)
      verican_tsyn_on_frame(&node.tsyn, &frame);
  }
  static void end(DomainNode &node, unsigned mb, std::uint32_t code) {
    std::uint32_t &cs = node.core.word(VERICAN_MB_CS_OFFSET(mb));
    cs = (cs & ~VERICAN_MB_CS_CODE_MASK) | VERICAN_MB_CS_CODE_SET(code);
    node.core.word(mb < 32 ? VERICAN_IFLAG1_OFFSET : VERICAN_IFLAG2_OFFSET) |= 1u << mb % 32;
    verican_irq_handler(&node.dev);
  }

  std::mt19937_64 dice_;
  double frequency_hz_;
};

}  // namespace vericansim
