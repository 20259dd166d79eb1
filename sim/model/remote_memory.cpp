// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The bytes of a node.
#include "model/remote_memory.hpp"

namespace vericansim {

using namespace remote_map;  // NOLINT(google-build-using-namespace): names of addresses

RemoteMemory::RemoteMemory(const RemoteConfig &config, const RemoteStatus &status, unsigned node)
    : config_{config}, status_{status}, bytes_(kSize), shadow_(config.stage_bytes) {
  bytes_[kNode] = static_cast<std::uint8_t>(node);
  bytes_[kFlags] = remote_flags::kErrors | remote_flags::kBoot;
  bytes_[kBackOff] = 0x0A;
  bytes_[kLife] = 0x0A;
  bytes_[kBlockTimeout] = 0x32;
  bytes_[kRetry] = 0x08;
}

std::uint8_t RemoteMemory::operator[](unsigned address) const {
  if (area(address) == Area::kRow) {
    if (address >= kIdent) return remote_ident(config_)[address - kIdent];
    if (address >= kStatus) return status_.row()[address - kStatus];
    if (address >= kCounters) return status_.counters[address - kCounters];
    return status_.clock[address - kClock];
  }
  return address < kSize ? bytes_[address] : 0;
}

RemoteMemory::Area RemoteMemory::area(unsigned address) const {
  const auto within = [&](unsigned from, unsigned size) {
    return address >= from && address < from + size;
  };
  if (within(0, config_.mem_bytes - 512)) return Area::kMemory;
  if (within(kNode, kConfigEnd - kNode) || within(kProducers, 8 * config_.num_prod) ||
      within(kMaps, 8 * config_.num_map))
    return Area::kConfig;
  if (within(kStatus, 16) || (config_.counters && within(kCounters, 8)) ||
      (config_.time_sync && within(kClock, 16)))
    return Area::kRow;
  return Area::kNone;
}

bool RemoteMemory::denied(unsigned table, unsigned address) const {
  if (!config_.protect || area(address) != Area::kMemory) return false;
  // Page 0 has its own bits, one for 16 bytes, in the fifth byte.
  const unsigned page = address / 128;
  if (page == 0) return (bytes_[table + 4] >> (address / 16) & 1) != 0;
  return (bytes_[table + page / 8] >> (page % 8) & 1) != 0;
}

// Nor does an access reach from the map entries into the row of the clock (TM-108).
bool RemoteMemory::nowhere(unsigned first, unsigned last) const {
  return area(first) == Area::kNone || area(last) == Area::kNone ||
         (first < kClock && last >= kClock);
}

// First and last byte are looked at; no area that is closed is as small as what lies between.
RemoteCode RemoteMemory::check_read(unsigned address, unsigned n) const {
  const unsigned last = address + n - 1;
  if (nowhere(address, last)) return RemoteCode::kAddress;
  if (denied(kReadProtect, address) || denied(kReadProtect, last)) return RemoteCode::kProtected;
  return RemoteCode::kAccepted;
}

RemoteCode RemoteMemory::check_write(unsigned address, unsigned n, bool open) const {
  const unsigned last = address + n - 1;
  const Area first_area = area(address);
  const Area last_area = area(last);
  if (nowhere(address, last)) return RemoteCode::kAddress;
  if (!open && (first_area == Area::kConfig || last_area == Area::kConfig))
    return RemoteCode::kLocked;
  if (first_area == Area::kRow || last_area == Area::kRow || denied(kWriteProtect, address) ||
      denied(kWriteProtect, last))
    return RemoteCode::kProtected;
  return RemoteCode::kAccepted;
}

void RemoteMemory::bus_write(unsigned address, std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) {
    if (address >= kStage && address - kStage < shadow_.size())
      shadow_[address - kStage] = byte;
    else
      bytes_[address] = byte;
    ++address;
  }
}

void RemoteMemory::apply_stage() {
  for (std::size_t i = 0; i < shadow_.size(); ++i) bytes_[kStage + i] = shadow_[i];
}

void RemoteMemory::user_write(unsigned address, std::uint8_t byte) {
  const bool absent = address >= config_.mem_bytes - 512 && address < kNode;  // and E00..EFF
  if (!absent && address < 0xFE0) bytes_[address] = byte;
}

}  // namespace vericansim
