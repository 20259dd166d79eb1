// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See remote_tables.hpp.
#include "scenario/remote_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/text.hpp"

namespace vericansim {
namespace {

constexpr unsigned kEntryBytes = 8;
constexpr unsigned kIds = 0x800;
constexpr unsigned kStatement = 0x400;
constexpr unsigned kSafeWhenLate = 0x40;

using Areas = std::vector<RemoteArea>;

/// A request of names 0, 1 and the own one is carried out, and looked up in no map.
bool is_request(unsigned id, const RemoteConfig &config, unsigned number) {
  const unsigned name = id >> config.address_bits();
  return (id & kStatement) == 0 && (name < 2 || name == number);
}

/// A port's frame matches only an entry that compares all of A.
bool is_free_port(unsigned id, const RemoteMapEntry &entry, const RemoteConfig &config) {
  const unsigned all_of_a = (1U << config.address_bits()) - 1;
  return (id & all_of_a) >= config.first_port() && (entry.mask & all_of_a) != all_of_a;
}

/// Whether the bytes of a frame have a place. A frame without a fixed length may have one byte.
bool has_place(unsigned id, const RemoteMapEntry &entry, const Areas &areas) {
  const unsigned first = entry.address | (id & ~entry.mask & 0x7F);
  const unsigned last = first + std::max(entry.length(), 1U) - 1;
  return area_of(areas, first).end != 0 && area_of(areas, last).end != 0;
}

}  // namespace

std::vector<RemoteArea> remote_areas(const RemoteConfig &config) {
  const unsigned producers_end = remote_map::kProducers + kEntryBytes * config.num_prod;
  const unsigned maps_end = remote_map::kMaps + kEntryBytes * config.num_map;
  Areas areas{{0, config.mem_bytes - 512}, {remote_map::kNode, remote_map::kConfigEnd}};
  if (config.num_prod != 0) areas.push_back({remote_map::kProducers, producers_end});
  if (config.num_map == 0) return areas;
  if (areas.back().end == remote_map::kMaps)
    areas.back().end = maps_end;
  else
    areas.push_back({remote_map::kMaps, maps_end});
  return areas;
}

std::string to_text(const std::vector<RemoteArea> &areas) {
  std::string text;
  for (const RemoteArea &area : areas)
    text += fmt::format("{}0x{:X} to 0x{:X}", text.empty() ? "" : ", ", area.first, area.end - 1);
  return text;
}

RemoteArea area_of(const std::vector<RemoteArea> &areas, std::uint64_t address) {
  const auto found = std::find_if(areas.begin(), areas.end(), [&](const RemoteArea &area) {
    return address >= area.first && address < area.end;
  });
  return found == areas.end() ? RemoteArea{} : *found;
}

unsigned RemoteMapEntry::span() const { return (length() == 0 ? 8 : length()) + (~mask & 0x7F); }

std::string why_never(const RemoteMapEntry &entry, const RemoteConfig &config, unsigned number) {
  const Areas areas = remote_areas(config);
  bool others = false, matched = false, placed = false;
  for (unsigned id = 0; id < kIds; ++id) {
    if (((id ^ entry.id) & entry.mask) != 0 || is_request(id, config, number)) continue;
    others = true;
    if (is_free_port(id, entry, config)) continue;
    matched = true;
    placed = placed || has_place(id, entry, areas);
  }
  if (!others) return fmt::format("{:03X} is a request, which no entry takes", entry.id);
  if (!matched) return "a port's frame is taken only where the mask compares all of the address";
  if (!placed)
    return fmt::format("no memory for {} at {:03X}; allowed: {}",
                       text::counted(std::max(entry.length(), 1U), "byte", "bytes"), entry.address,
                       to_text(areas));
  if ((entry.flags & kSafeWhenLate) != 0 && entry.time_out == 0)
    return "late leads to SAFE, but without a time-out it is never late";
  return "";
}

}  // namespace vericansim
