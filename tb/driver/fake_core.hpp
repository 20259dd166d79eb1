// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FakeCore: registers that do what the driver asks for and nothing else, or refuse to. For what
// needs no bus: arguments, timeouts, cores that lack a feature, the exact words written.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "verican/verican.h"
#include "verican/verican_regs.h"

namespace vericansim {

class FakeCore {
 public:
  FakeCore() {
    word(VERICAN_XID_OFFSET) = VERICAN_XID_RESET;
    word(VERICAN_XCONFIG_OFFSET) = 64 | VERICAN_XCONFIG_FDTOL_MASK | VERICAN_XCONFIG_ONESHOT_MASK |
                                   VERICAN_XCONFIG_OSMB_MASK | VERICAN_XCONFIG_RXFIFO_MASK;
    word(VERICAN_MCR_OFFSET) = VERICAN_MCR_RESET;
  }
  FakeCore(const FakeCore &) = delete;
  FakeCore &operator=(const FakeCore &) = delete;

  /// A configuration for this core.
  verican_config_t config() {
    verican_config_t config;
    verican_config_default(&config);
    config.port.read32 = [](void *self, std::uint32_t offset) {
      return static_cast<FakeCore *>(self)->read(offset);
    };
    config.port.write32 = [](void *self, std::uint32_t offset, std::uint32_t value) {
      static_cast<FakeCore *>(self)->write(offset, value);
    };
    config.port.lock = [](void *self) {
      FakeCore &core = *static_cast<FakeCore *>(self);
      core.open();
      ++core.locks;
      return ++core.depth;
    };
    config.port.unlock = [](void *self, std::uint32_t token) {
      FakeCore &core = *static_cast<FakeCore *>(self);
      core.bad_unlock |= token != core.depth;
      --core.depth;
      core.open();
    };
    config.port.context = this;
    config.port.poll_limit = 10;
    config.clock_hz = 8'000'000;
    config.bitrate = 1'000'000;
    config.rx_ring = ring.data();
    config.rx_ring_size = static_cast<std::uint16_t>(ring.size());
    return config;
  }

  std::uint32_t &word(std::uint32_t offset) { return words_[offset / 4]; }

  std::uint32_t read(std::uint32_t offset) {
    ++reads;
    if (on_read) on_read(offset);
    if (offset == VERICAN_MCR_OFFSET) return (mcr() & ~mcr_never) | mcr_always;
    const std::uint32_t value = word(offset);
    if (offset == VERICAN_ESR1_OFFSET) word(offset) &= ~0xFC00u;
    return value;
  }

  void write(std::uint32_t offset, std::uint32_t value) {
    ++writes;
    const bool clears = offset == VERICAN_IFLAG1_OFFSET || offset == VERICAN_IFLAG2_OFFSET;
    if (clears || offset == VERICAN_ESR1_OFFSET) {
      word(offset) &= ~value;
    } else if (offset == VERICAN_MCR_OFFSET && (value & VERICAN_MCR_SOFT_RST_MASK) != 0) {
      word(offset) = VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK | 0xF;
      word(VERICAN_IMASK1_OFFSET) = word(VERICAN_IMASK2_OFFSET) = 0;
    } else if (offset != VERICAN_XID_OFFSET && offset != VERICAN_XCONFIG_OFFSET) {
      word(offset) = value & ~(offset == lossy ? lost_bits : 0);
    }
    if (on_write) on_write(offset, value);
  }

  std::vector<verican_frame_t> ring = std::vector<verican_frame_t>(16);
  std::uint32_t mcr_never = 0;   ///< bits of MCR that read 0
  std::uint32_t mcr_always = 0;  ///< and 1
  std::uint32_t lossy = ~0u;     ///< register that does not keep these bits
  std::uint32_t lost_bits = 0;
  unsigned reads = 0, writes = 0, locks = 0;
  std::uint32_t depth = 0;  ///< lock() without unlock()
  bool bad_unlock = false;
  std::function<void(std::uint32_t offset)> on_read;
  std::function<void(std::uint32_t offset, std::uint32_t value)> on_write;
  /// An interrupt that the lock holds back: before lock() and after unlock().
  std::function<void()> on_open;

 private:
  void open() {
    const auto interrupt = on_open;  // which may end itself
    if (depth == 0 && interrupt) interrupt();
  }

  // Requests are acknowledged at once.
  std::uint32_t mcr() {
    const std::uint32_t requests = word(VERICAN_MCR_OFFSET);
    const std::uint32_t frozen = VERICAN_MCR_FRZ_MASK | VERICAN_MCR_HALT_MASK;
    if ((requests & VERICAN_MCR_MDIS_MASK) != 0)
      return requests | VERICAN_MCR_LPM_ACK_MASK | VERICAN_MCR_NOT_RDY_MASK;
    if ((requests & frozen) == frozen)
      return requests | VERICAN_MCR_FRZ_ACK_MASK | VERICAN_MCR_NOT_RDY_MASK;
    return requests;
  }

  std::vector<std::uint32_t> words_ = std::vector<std::uint32_t>(0x2000 / 4);
};

}  // namespace vericansim
