// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DomainRig: a time domain on a FakeCore whose time stands still until it is told. What it wants to
// send can be looked at, and is sent or not as the test says. 16 MHz; the own stamps are late by
// 3 half clocks, 93 ns in whole ns, those of sent frames by 7, 218 ns.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "driver/fake_core.hpp"
#include "verican/timesync.h"

namespace vericansim {

using FrameData = std::array<std::uint8_t, 8>;
inline constexpr std::uint64_t kRigSecond = 1'000'000'000, kRigLate = 93, kRigSentLate = 218;

/// SYNC and FUP without CRC, as the rules say (TM-50, docs/time-spec.md 7.1).
inline FrameData message(std::uint8_t type, unsigned domain, unsigned sc, unsigned byte3,
                         std::uint32_t word) {
  const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value); };
  return {type,
          0,
          byte(domain * 16 + sc),
          byte(byte3),
          byte(word >> 24),
          byte(word >> 16),
          byte(word >> 8),
          byte(word)};
}
inline FrameData sync_of(unsigned sc, std::uint64_t second, unsigned domain = 0) {
  return message(0x10, domain, sc, 0, static_cast<std::uint32_t>(second));
}
/// `t4`: from the second that SYNC told, ns.
inline FrameData fup_of(unsigned sc, std::uint64_t t4, unsigned domain = 0) {
  return message(0x18, domain, sc, static_cast<unsigned>(t4 / kRigSecond),
                 static_cast<std::uint32_t>(t4 % kRigSecond));
}

class DomainRig {
 public:
  /// The identifiers of masters are 0x010 and up, R is 200 ms, the bus is looked at by rank 0.
  static verican_tsyn_config_t config_of(std::uint8_t masters = 1, std::uint8_t rank = 0) {
    verican_tsyn_config_t config{};
    verican_tsyn_config_default(&config);
    config.servo.interval_us = 200'000;
    for (std::uint8_t n = 0; n < masters; ++n) config.masters[n] = 0x010u + n;
    config.master_count = masters;
    config.rank = rank;
    return config;
  }

  DomainRig(const verican_tsyn_config_t &config, bool master,
            std::uint64_t start = 50 * kRigSecond) {
    core.word(VERICAN_XCONFIG_OFFSET) |= VERICAN_XCONFIG_TIME_MASK;
    core.word(VERICAN_TCAP_OFFSET) = 0x00020703;
    core.word(VERICAN_TCTRL_OFFSET) = VERICAN_TCTRL_RESET;
    set_time(start);
    start_device();
    verican_tsyn_init(&tsyn, &dev, &config);
    result = master ? verican_tsyn_start_master(&tsyn) : verican_tsyn_start_follower(&tsyn);
    core.on_write = [this](std::uint32_t offset, std::uint32_t value) {
      if (offset >= VERICAN_TCAP_OFFSET && offset < 0x1200)
        clock_writes.emplace_back(offset, value);
    };
  }
  DomainRig(const DomainRig &) = delete;
  DomainRig &operator=(const DomainRig &) = delete;

  /// Anew, too: what waits to be sent is gone, and nobody hears of it.
  void start_device() {
    verican_config_t device = core.config();
    device.clock_hz = 16'000'000;
    device.abort = true;
    device.callbacks.user = this;
    device.callbacks.on_sent = [](void *self, verican_t *, const verican_tx_event_t *event) {
      auto &rig = *static_cast<DomainRig *>(self);
      if (rig.on_sent) rig.on_sent();
      rig.last_told = verican_tsyn_on_sent(&rig.tsyn, event);
    };
    verican_init(&dev, &device);
    verican_start(&dev);
  }

  void set_time(std::uint64_t now) {
    time = now;
    core.word(VERICAN_TIMELO_OFFSET) = static_cast<std::uint32_t>(now);
    core.word(VERICAN_TIMEHI_OFFSET) = static_cast<std::uint32_t>(now >> 32);
  }
  void poll_at(std::uint64_t now) {
    set_time(now);
    verican_tsyn_poll(&tsyn);
  }
  /// A frame that was received with this stamp, as the core has it.
  verican_result_t hear(std::uint32_t id, const FrameData &data, std::uint64_t stamp,
                        std::uint8_t dlc = 8, std::uint8_t flags = 0) {
    verican_frame_t frame{};
    frame.id = id;
    frame.flags = flags;
    frame.dlc = dlc;
    frame.time_ns = stamp - kRigLate;
    std::copy(data.begin(), data.end(), frame.data);
    return verican_tsyn_on_frame(&tsyn, &frame);
  }

  /// A frame that waits to be sent.
  struct Waiting {
    unsigned mailbox;
    std::uint32_t id;  ///< with VERICAN_TSYN_EXTENDED
    unsigned dlc;
    FrameData data;
  };
  std::vector<Waiting> waiting() {
    std::vector<Waiting> all;
    for (unsigned mb = dev.first_tx; mb < 64; ++mb)
      if (code_of(mb) == VERICAN_MB_CS_CODE_TX_DATA) all.push_back(frame_in(mb));
    return all;
  }
  /// The end of a frame: sent with this stamp, as the core has it, or failed.
  void sent(unsigned mb, std::uint64_t stamp) {
    core.word(0x1400 + 8 * mb) = static_cast<std::uint32_t>(stamp);
    core.word(0x1404 + 8 * mb) = static_cast<std::uint32_t>(stamp >> 32);
    end(mb, VERICAN_MB_CS_CODE_TX_INACTIVE);
  }
  void failed(unsigned mb) { end(mb, VERICAN_MB_CS_CODE_TX_ABORT); }

  [[nodiscard]] verican_tsyn_status_t status() const {
    verican_tsyn_status_t status{};
    verican_tsyn_status(&tsyn, &status);
    return status;
  }
  [[nodiscard]] unsigned refused(verican_tsyn_cause_t cause) const {
    return status().refused[cause];
  }
  /// Frames of others take all mailboxes; the first of them.
  unsigned fill() {
    verican_frame_t frame{};
    frame.id = 0x700;
    std::uint8_t mailbox = 0, first = 64;
    while (verican_send(&dev, &frame, &mailbox) == VERICAN_OK) first = std::min(first, mailbox);
    return first;
  }

  FakeCore core;
  verican_t dev{};
  verican_tsyn_t tsyn{};
  verican_result_t result{}, last_told{};
  std::uint64_t time = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> clock_writes;
  std::function<void()> on_sent;  ///< the application's own part of that callback

 private:
  std::uint32_t code_of(unsigned mb) {
    return VERICAN_MB_CS_CODE_GET(core.word(VERICAN_MB_CS_OFFSET(mb)));
  }
  Waiting frame_in(unsigned mb) {
    const std::uint32_t cs = core.word(VERICAN_MB_CS_OFFSET(mb));
    const std::uint32_t id = core.word(VERICAN_MB_ID_OFFSET(mb));
    const bool extended = (cs & VERICAN_MB_CS_IDE_MASK) != 0;
    Waiting frame{mb,
                  extended ? id | VERICAN_TSYN_EXTENDED : id >> VERICAN_MB_ID_STD_SHIFT,
                  VERICAN_MB_CS_DLC_GET(cs),
                  {}};
    for (unsigned i = 0; i < 8; ++i)
      frame.data.at(i) = static_cast<std::uint8_t>(
          core.word(VERICAN_MB_CS_OFFSET(mb) + 8 + i / 4 * 4) >> (24 - i % 4 * 8));
    return frame;
  }
  void end(unsigned mb, std::uint32_t code) {
    std::uint32_t &cs = core.word(VERICAN_MB_CS_OFFSET(mb));
    cs = (cs & ~VERICAN_MB_CS_CODE_MASK) | VERICAN_MB_CS_CODE_SET(code);
    core.word(mb < 32 ? VERICAN_IFLAG1_OFFSET : VERICAN_IFLAG2_OFFSET) |= 1u << mb % 32;
    verican_irq_handler(&dev);
  }
};

}  // namespace vericansim
