// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Register names: see register_name.hpp.
#include "scenario/register_name.hpp"

#include <fmt/format.h>

#include <array>

#include "model/registers.hpp"
#include "trace/quantity.hpp"
#include "trace/text.hpp"

namespace vericansim {
namespace {

struct Named {
  std::string_view name;
  std::uint32_t address;
};

constexpr std::array kRegisters = {
    Named{"MCR", reg::kMcr},
    Named{"CTRL1", reg::kCtrl},
    Named{"TIMER", reg::kTimer},
    Named{"RXGMASK", reg::kRxgmask},
    Named{"RX14MASK", reg::kRx14mask},
    Named{"RX15MASK", reg::kRx15mask},
    Named{"ECR", reg::kEcr},
    Named{"ESR1", reg::kEsr},
    Named{"IMASK2", reg::kImask2},
    Named{"IMASK1", reg::kImask1},
    Named{"IFLAG2", reg::kIflag2},
    Named{"IFLAG1", reg::kIflag1},
    Named{"CTRL2", reg::kCtrl2},
    Named{"ESR2", VERICAN_ESR2_OFFSET},
    Named{"CRCR", VERICAN_CRCR_OFFSET},
    Named{"RXFGMASK", reg::kRxfgmask},
    Named{"RXFIR", reg::kRxfir},
    Named{"XCTRL", reg::kExtControl},
};

constexpr std::array<std::string_view, 4> kWords = {"CS", "ID", "DATA0", "DATA1"};
constexpr std::uint32_t kWindow = 0x2000;

/// The number after `prefix`, below `limit`.
std::optional<unsigned> index_after(std::string_view name, std::string_view prefix,
                                    unsigned limit) {
  if (!name.starts_with(prefix)) return std::nullopt;
  const auto number = text::parse_unsigned(name.substr(prefix.size()), 10);
  if (!number || *number >= limit) return std::nullopt;
  return static_cast<unsigned>(*number);
}

}  // namespace

std::optional<std::uint32_t> register_address(std::string_view name, unsigned buffers) {
  for (const Named &item : kRegisters)
    if (item.name == name) return item.address;
  if (const auto n = index_after(name, "RXIMR", buffers)) return reg::rximr(*n);
  if (const auto n = index_after(name, "FILTER", 128)) return reg::filter(*n);
  const std::size_t dot = name.find('.');
  if (dot != std::string_view::npos) {
    const auto n = index_after(name.substr(0, dot), "MB", buffers);
    for (unsigned word = 0; n && word < kWords.size(); ++word)
      if (kWords[word] == name.substr(dot + 1)) return reg::mb(*n, word);
  }
  const auto number = parse_integer(name);
  if (!number || *number >= kWindow || *number % 4 != 0) return std::nullopt;
  return static_cast<std::uint32_t>(*number);
}

std::string register_name(std::uint32_t address, unsigned buffers) {
  for (const Named &item : kRegisters)
    if (item.address == address) return std::string{item.name};
  if (address >= reg::rximr(0) && address < reg::rximr(buffers))
    return fmt::format("RXIMR{}", (address - reg::rximr(0)) / 4);
  if (address >= reg::mb(0) && address < reg::mb(buffers))
    return fmt::format("MB{}.{}", (address - reg::mb(0)) / 16, kWords[(address / 4) % 4]);
  return fmt::format("0x{:03X}", address);
}

}  // namespace vericansim
