// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RegisterShadow: see register_shadow.hpp.
#include "judge/register_shadow.hpp"

#include "model/registers.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t bits(unsigned high, unsigned low) {
  return (0xFFFFFFFFU >> (31 - high)) & (0xFFFFFFFFU << low);
}
constexpr bool bit(std::uint32_t word, unsigned n) { return ((word >> n) & 1) != 0; }

// flexcan.md 1.1: MCR bits that are written in freeze mode alone, and those that do not stay.
constexpr std::uint32_t kMcrFrozen = bits(29, 29) | bits(23, 23) | bits(21, 21) | bits(19, 19) |
                                     bits(17, 16) | bits(13, 12) | bits(9, 8) | bits(6, 0);
constexpr std::uint32_t kMcrAfterSoftReset = 0x5980000F;
// 1.2: CTRL1 bits that may be written while the core runs.
constexpr std::uint32_t kCtrl1Always = bits(15, 14) | bits(11, 10) | bits(6, 6);

void put(std::uint32_t &word, std::uint32_t data, std::uint32_t mask) {
  word = (word & ~mask) | (data & mask);
}

}  // namespace

bool RegisterShadow::disabled() const { return (mcr_ & reg::kMcrMdis) != 0; }

RegisterShadow::Change RegisterShadow::write_mcr(std::uint32_t data, std::uint32_t lanes,
                                                 bool frozen) {
  if ((data & lanes & reg::kMcrSoftRst) != 0 && !disabled()) {
    mcr_ = kMcrAfterSoftReset;
    return {.configuration = true, .soft_reset = true, .stop = true};
  }
  put(mcr_, data, lanes & (frozen ? ~0U : ~kMcrFrozen));
  const bool freeze = (mcr_ & reg::kMcrFrz) != 0 && (mcr_ & reg::kMcrHalt) != 0;
  return {.configuration = true, .soft_reset = false, .stop = freeze || disabled()};
}

RegisterShadow::Change RegisterShadow::write(std::uint32_t address, std::uint32_t data,
                                             std::uint32_t lanes, bool running) {
  const bool frozen = !running && !disabled();
  if (address == reg::kMcr) return write_mcr(data, lanes, frozen);
  if (address == reg::kCtrl) {
    put(ctrl1_, data, lanes & (frozen ? ~0U : kCtrl1Always));
  } else if (address == reg::kCtrl2) {
    put(ctrl2_, data, frozen ? lanes : 0);
  } else if (address == reg::kExtControl) {
    put(xctrl_, data, lanes);
  } else {
    return {};
  }
  return {.configuration = true};
}

BufferConfig RegisterShadow::buffers() const {
  BufferConfig config;
  config.num_mb = num_mb_;
  config.maxmb = mcr_ & 0x7F;
  config.bcc = bit(mcr_, 16);
  config.srx_dis = bit(mcr_, 17);
  config.aen = bit(mcr_, 12);
  config.lprio_en = bit(mcr_, 13);
  config.fen = bit(mcr_, 29);
  config.idam = (mcr_ >> 8) & 3;
  config.lbuf = bit(ctrl1_, 4);
  config.eacen = bit(ctrl2_, 16);
  config.rrs = bit(ctrl2_, 17);
  config.mrp = bit(ctrl2_, 18);
  config.rffn = (ctrl2_ >> 24) & 0xF;
  config.one_shot = bit(xctrl_, 1);
  config.osmb = bit(xctrl_, 2);
  return config;
}

NodeConfig RegisterShadow::node() const {
  NodeConfig config;
  config.listen_only = bit(ctrl1_, 3);
  config.loop_back = bit(ctrl1_, 12);
  config.boff_rec = bit(ctrl1_, 6);
  config.fd_tolerant = bit(xctrl_, 0);
  return config;
}

}  // namespace vericansim
