// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_map.hpp.
#include "cli/memory_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/remote_config.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

constexpr std::size_t kEntryBytes = 8;
constexpr unsigned kPublished = 2;  // the host's own name (section 1)

RemoteConfig config_of(unsigned name_bits) {
  RemoteConfig config;
  config.name_bits = name_bits;
  return config;
}

/// Entries that are on, but name what no statement has, are off (RN-63).
bool is_statement(const ProducerEntry &entry, const RemoteConfig &config) {
  const unsigned status = config.first_port() + static_cast<unsigned>(RemotePort::kStatus);
  const bool row = entry.a == status || entry.a == status + 1;
  const unsigned n = entry.length();
  return n >= 1 && n <= 8 && (row || entry.a + n <= config.first_port());
}

bool sends(const NodeTables &node, const RemoteMapEntry &entry, const RemoteConfig &config) {
  return std::any_of(node.producers.begin(), node.producers.end(), [&](const ProducerEntry &one) {
    return is_statement(one, config) &&
           ((config.id(1, node.number, one.a) ^ entry.id) & entry.mask & 0x7FF) == 0;
  });
}

/// Whether somebody sends what the entry waits for. Requests, and statements of the host, are the
/// host's, of which nothing is known.
bool anybody_sends(const std::vector<NodeTables> &nodes, const RemoteMapEntry &entry,
                   const RemoteConfig &config) {
  const unsigned statement = 0x400;
  const bool any_direction = (entry.mask & statement) == 0;
  const unsigned name = entry.id >> config.address_bits() & config.highest_number();
  if (any_direction || (entry.id & statement) == 0 || name <= kPublished) return true;
  return std::any_of(nodes.begin(), nodes.end(),
                     [&](const NodeTables &node) { return sends(node, entry, config); });
}

void complain_of_overlaps(const NodeTables &node, std::vector<std::string> &all) {
  for (std::size_t i = 0; i < node.maps.size(); ++i)
    for (std::size_t j = i + 1; j < node.maps.size(); ++j) {
      const RemoteMapEntry &a = node.maps[i], &b = node.maps[j];
      if (a.address < b.address + b.span() && b.address < a.address + a.span())
        all.push_back(fmt::format("node {}: entries for {:03X} and {:03X} overlap at {:03X}",
                                  node.number, a.id, b.id, std::max(a.address, b.address)));
    }
}

void complain_of_vain_entries(const NodeTables &node, std::vector<std::string> &all) {
  for (const RemoteMapEntry &entry : node.maps)
    if (const std::string why = why_never(entry, node.config, node.number); !why.empty())
      all.push_back(fmt::format("node {}: entry for {:03X}: {}", node.number, entry.id, why));
}

void complain_of_vain_producers(const NodeTables &node, const RemoteConfig &config,
                                std::vector<std::string> &all) {
  const unsigned ports = config.first_port();
  const unsigned status = ports + static_cast<unsigned>(RemotePort::kStatus);
  for (const ProducerEntry &entry : node.producers)
    if (!is_statement(entry, config))
      all.push_back(fmt::format(
          "node {}: producer of {:02X}: {} are never sent; allowed: 1 to 8 bytes of 00 to {:02X}, "
          "of {:02X} or {:02X}",
          node.number, entry.a, text::counted(entry.length(), "byte", "bytes"), ports - 1, status,
          status + 1));
}

std::string producer_text(const ProducerEntry &p, unsigned number, const RemoteConfig &config) {
  std::string when;
  if ((p.mode & 0x10) != 0 && p.period != 0)
    when += fmt::format(", every {}{}", p.period, (p.mode & 0x40) != 0 ? " TRIGGERs" : " ms");
  if ((p.mode & 0x20) != 0) when += ", on change";
  if (p.gap != 0) when += fmt::format(", {} ms apart at least", p.gap);
  if (when.empty()) when = ", by event";
  return fmt::format("  sends {:03X}: {} bytes of {:02X}{}\n", config.id(1, number, p.a),
                     p.length(), p.a, when);
}

std::string entry_text(const RemoteMapEntry &e) {
  std::string text = fmt::format("  takes {:03X} under {:03X} to {:03X}", e.id, e.mask, e.address);
  if ((e.flags & 0x20) != 0) text += ", as TRIGGER";
  if (e.time_out != 0) text += fmt::format(", late after {} ms", 10 * e.time_out);
  if ((e.flags & 0x40) != 0) text += ", then SAFE";
  return text + "\n";
}

}  // namespace

NodeTables read_tables(unsigned number, const std::vector<std::uint8_t> &bytes) {
  NodeTables node;
  node.number = number;
  const auto word = [&](std::size_t at) -> unsigned { return bytes[at] | bytes[at + 1] << 8U; };
  const std::size_t maps = remote_map::kMaps - remote_map::kProducers;
  for (std::size_t at = 0; at + kEntryBytes <= bytes.size(); at += kEntryBytes) {
    if (at < maps && (bytes[at + 1] & 0x80) != 0)
      node.producers.push_back({bytes[at], bytes[at + 1], word(at + 2), bytes[at + 4]});
    if (at >= maps && (word(at) & 0x8000) != 0)
      node.maps.push_back(
          {word(at) & 0x7FF, word(at + 2) & 0x7FF, word(at + 4), bytes[at + 6], bytes[at + 7]});
  }
  return node;
}

std::vector<std::string> complaints(const std::vector<NodeTables> &nodes, unsigned name_bits) {
  const RemoteConfig config = config_of(name_bits);
  std::vector<std::string> all;
  for (const NodeTables &node : nodes) {
    if (node.heard_own)
      all.push_back(
          fmt::format("node {0}: has heard its number from another node since CLEAR; 'clear {0}' "
                      "forgets that",
                      node.number));
    complain_of_overlaps(node, all);
    complain_of_vain_producers(node, config, all);
    complain_of_vain_entries(node, all);
    for (const RemoteMapEntry &entry : node.maps)
      if (!anybody_sends(nodes, entry, config))
        all.push_back(fmt::format("node {}: waits for {:03X} under {:03X}, which nobody sends",
                                  node.number, entry.id, entry.mask));
  }
  return all;
}

std::string to_text(const std::vector<NodeTables> &nodes, unsigned name_bits) {
  const RemoteConfig config = config_of(name_bits);
  std::string text;
  for (const NodeTables &node : nodes) {
    text += fmt::format("node {}\n", node.number);
    for (const ProducerEntry &one : node.producers) text += producer_text(one, node.number, config);
    for (const RemoteMapEntry &one : node.maps) text += entry_text(one);
  }
  return text;
}

Json to_json(const std::vector<NodeTables> &nodes) {
  Json list = Json::array();
  for (const NodeTables &node : nodes) {
    Json producers = Json::array(), maps = Json::array();
    for (const ProducerEntry &p : node.producers)
      producers.push_back({{"a", p.a},
                           {"length", p.length()},
                           {"mode", p.mode & 0xF0},
                           {"period", p.period},
                           {"gap_ms", p.gap}});
    for (const RemoteMapEntry &e : node.maps)
      maps.push_back({{"id", e.id},
                      {"mask", e.mask},
                      {"address", e.address},
                      {"length", e.flags & 0x0F},
                      {"trigger", (e.flags & 0x20) != 0},
                      {"safe_when_late", (e.flags & 0x40) != 0},
                      {"time_out_ms", 10 * e.time_out}});
    list.push_back({{"number", node.number},
                    {"doubled", node.heard_own},
                    {"producers", producers},
                    {"map", maps}});
  }
  return list;
}

}  // namespace vericansim::cli
