// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Board: accesses, interrupt lines and time. Commands are in board_commands.cpp.
#include "linux/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "model/registers.hpp"
#include "node/lean_core.hpp"

namespace vericansim {
namespace {

constexpr unsigned kTimeLine = 8;  // line of the first time unit
constexpr std::uint32_t kAllOnes = 0xFFFFFFFF;
constexpr int kLineDelay = 2;
// How long the bus is clocked at a time before it is asked whether it may rest.
constexpr Time kSlice = 100 * kMicrosecond;

AhbSize ahb_size(unsigned bytes) {
  if (bytes == 1) return AhbSize::kByte;
  return bytes == 2 ? AhbSize::kHalf : AhbSize::kWord;
}

bool is_data_word(std::uint32_t offset) {
  return offset >= reg::mb(0) && offset < reg::mb(64) && (offset & 8) != 0;
}

// The frame in the buffer of a data word; a driver reads words of remote frames too.
bool is_remote(RtlNode &core, std::uint32_t offset) {
  constexpr std::uint32_t kRtr = 1u << 20;
  return (core.read32(offset & ~0xFu) & kRtr) != 0;
}

}  // namespace

Board::Board(const BoardConfig &config) : config_{config} {
  if (config.controllers < 1 || config.controllers > 8)
    throw std::invalid_argument(
        fmt::format("a board has 1 to 8 controllers, not {}", config.controllers));
  if (config.lean && config.time_unit)
    throw std::invalid_argument("a board has lean cores or cores with time units");
  add_controllers();
  watch_bus();
  if (!config.access_logs || config.directory.empty()) return;
  for (unsigned n = 0; n < config.controllers; ++n)
    access_logs_.push_back(
        std::make_unique<OutputFile>(fmt::format("{}/access-{}.txt", config.directory, n)));
}

void Board::add_controllers() {
  for (unsigned n = 0; n < config_.controllers; ++n) {
    ClockConfig clock;
    clock.frequency_hz = config_.clock_hz;
    if (n < config_.clock_ppm.size()) clock.error_ppm = config_.clock_ppm[n];
    const std::string name = fmt::format("can{}", n);
    if (config_.time_unit) {
      auto node = std::make_unique<TimeNode>(name, clock);
      node->let_rest(true);
      node->on_interrupt = [this] { bus_.stop(); };
      time_units_.push_back(node.get());
      cores_.push_back(std::move(node));
    } else {
      cores_.push_back(config_.lean ? create_lean_core(name, clock)
                                    : RtlNode::create(name, clock, 64));
    }
    bus_.add(*cores_.back());
  }
}

// ---- Time

std::uint32_t Board::lines() const {
  std::uint32_t mask = 0;
  for (std::size_t n = 0; n < cores_.size(); ++n)
    mask |= static_cast<std::uint32_t>(cores_[n]->irq()) << n;
  for (std::size_t n = 0; n < time_units_.size(); ++n)
    mask |= static_cast<std::uint32_t>(time_units_[n]->irq_time()) << (kTimeLine + n);
  return sabotage_.deaf ? 0 : mask;
}

std::uint32_t Board::levels() {
  told_ = lines();
  return told_;
}

// Engines that have stopped change nothing; the clocks since the last access are for what it
// started.
bool Board::idle() const {
  constexpr Time kSettle = 100 * kMicrosecond;
  if (!time_units_.empty() || now_ - touched_ < kSettle || (peer_ && peer_->pending()))
    return false;
  return std::none_of(cores_.begin(), cores_.end(),
                      [](const auto &core) { return decode_trace(core->trace()).running; });
}

bool Board::run_until(std::uint64_t when) {
  const Time end = static_cast<Time>(when) * kNanosecond - skipped_;
  const auto rose = [this] { return (lines() & ~told_) != 0; };
  while (!rose()) {
    if (now_ >= end) return false;
    if (idle()) {
      monitor_->settle_all(now_);  // what it has seen was before the time that is skipped
      skipped_ += end - now_;
      return false;
    }
    if (!time_units_.empty()) {
      bus_.run_until(end);  // a line that rises stops it
      now_ = std::max(now_, bus_.now());
      continue;
    }
    const Time slice = std::min(end, now_ + kSlice);
    const bool stopped = bus_.run_until(rose, slice - bus_.now());
    now_ = stopped ? std::max(now_, bus_.now()) : slice;
  }
  return true;
}

// ---- Accesses

std::uint32_t Board::access(const BoardAccess &access) {
  const std::uint32_t n = access.address / window();
  const std::uint32_t offset = access.address % window();
  if (n >= cores_.size()) {
    ++bus_errors_;
    return kAllOnes;
  }
  const std::uint32_t value = transfer(*cores_[n], access, offset);
  now_ = std::max(now_, bus_.now());
  touched_ = now_;
  if (!access_logs_.empty()) log_access(n, offset, access, value);
  return value;
}

std::uint32_t Board::transfer(RtlNode &core, const BoardAccess &access, std::uint32_t offset) {
  const bool flags = offset == reg::kIflag1 || offset == reg::kIflag2;
  if (sabotage_.lose_frame && flags && !access.write) lose_frame(core, offset);
  const AhbResult result = core.access({.address = offset,
                                        .write = access.write,
                                        .size = ahb_size(access.size),
                                        .data = access.value});
  if (result.error) {
    ++bus_errors_;
    return kAllOnes;
  }
  if (access.write) {
    // The interrupt line follows a clock later than the flag; no CPU is back that soon.
    for (int clock = 0; clock < kLineDelay; ++clock) bus_.step();
    return access.value;
  }
  if (sabotage_.frozen_errors && offset == reg::kEcr) return 0;
  if (sabotage_.corrupt_data && is_data_word(offset) && !is_remote(core, offset)) {
    sabotage_.corrupt_data = false;
    return result.data ^ (1u << 24);
  }
  return result.data;
}

// Clears the flag of one received frame before the driver sees it. MB63 sends.
void Board::lose_frame(RtlNode &core, std::uint32_t offset) {
  std::uint32_t flags = core.read32(offset);
  if (offset == reg::kIflag2) flags &= ~(1u << 31);
  if (flags == 0) return;
  core.write32(offset, 1u << std::countr_zero(flags));
  sabotage_.lose_frame = false;
}

// The format of recorded driver accesses: time in us, direction, offset, value, interrupt level.
void Board::log_access(unsigned n, std::uint32_t offset, const BoardAccess &access,
                       std::uint32_t value) {
  access_logs_[n]->stream() << fmt::format(
      "{:.3f} {} {:03x} {:08x} {:d}\n", static_cast<double>(now()) / 1e3, access.write ? 'W' : 'R',
      offset, value, cores_[n]->irq());
}

void Board::close_logs() {
  close_frame_log();
  for (const auto &log : access_logs_) log->commit();
  access_logs_.clear();
}

}  // namespace vericansim
