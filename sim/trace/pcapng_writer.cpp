// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// pcapng: the writer, little-endian.
#include <map>

#include "trace/can_packet.hpp"
#include "trace/log_walk.hpp"
#include "trace/pcapng_file.hpp"
#include "trace/pcapng_layout.hpp"

namespace vericansim {
namespace {

using namespace pcapng;

void append(std::string &bytes, std::uint64_t value, unsigned count) {
  for (unsigned i = 0; i < count; ++i) bytes += static_cast<char>(value >> 8 * i);
}

void append_padded(std::string &bytes, std::string_view value) {
  bytes += value;
  bytes.append(padded(value.size()) - value.size(), '\0');
}

void append_option(std::string &bytes, std::uint16_t code, std::string_view value) {
  append(bytes, code, 2);
  append(bytes, value.size(), 2);
  append_padded(bytes, value);
}

void append_block(std::string &bytes, std::uint32_t type, const std::string &body) {
  append(bytes, type, 4);
  append(bytes, body.size() + 12, 4);
  bytes += body;
  append(bytes, body.size() + 12, 4);
}

std::string section_header() {
  std::string body;
  append(body, kLittleEndian, 4);
  append(body, 1, 2);  // version 1.0
  append(body, 0, 2);
  append(body, ~std::uint64_t{0}, 8);  // length of the section: not told
  return body;
}

std::string interface_description(const std::string &name) {
  std::string body;
  append(body, kLinkSocketCan, 2);
  append(body, 0, 2);
  append(body, 0, 4);  // no limit of length
  append_option(body, kName, name);
  append_option(body, kResolution, std::string(1, 9));
  append(body, kEndOfOptions, 4);
  return body;
}

std::string packet_block(std::size_t interface, std::int64_t ns, const std::string &packet,
                         Direction direction) {
  std::string body;
  const auto ticks = static_cast<std::uint64_t>(ns);
  append(body, interface, 4);
  append(body, ticks >> 32, 4);
  append(body, ticks, 4);
  append(body, packet.size(), 4);
  append(body, packet.size(), 4);
  append_padded(body, packet);
  if (direction == Direction::kUnknown) return body;
  std::string flags;
  append(flags, direction == Direction::kSent ? kOutbound : kInbound, 4);
  append_option(body, kFlags, flags);
  append(body, kEndOfOptions, 4);
  return body;
}

}  // namespace

std::string pcapng_bytes(const CanLog &log) {
  std::map<std::string, std::size_t> interfaces;
  std::string descriptions, packets;
  const auto add = [&](const auto &entry, const std::string &packet) {
    const std::string name = entry.channel.empty() ? "can0" : entry.channel;
    const auto [place, fresh] = interfaces.try_emplace(name, interfaces.size());
    if (fresh) append_block(descriptions, kInterface, interface_description(name));
    append_block(packets, kPacket,
                 packet_block(place->second, log.start_ns + entry.time / kNanosecond, packet,
                              entry.direction));
  };
  walk(
      log, [&](const LogEntry &entry) { add(entry, can_packet(entry.frame)); },
      [&](const ForeignEntry &entry) { add(entry, can_packet(entry)); });
  std::string bytes;
  append_block(bytes, kSection, section_header());
  return bytes + descriptions + packets;
}

}  // namespace vericansim
