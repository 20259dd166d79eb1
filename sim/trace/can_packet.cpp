// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packets with frames of SocketCAN: see can_packet.hpp.
#include "trace/can_packet.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/fd_lengths.hpp"
#include "trace/id_filter.hpp"

namespace vericansim {
namespace {

using Bytes = std::span<const std::uint8_t>;
using text::fail;
using text::Place;

// Layout of a packet (tcpdump.org, LINKTYPE_CAN_SOCKETCAN): identifier and flags, big-endian;
// length; FD flags; reserved; raw DLC; data.
constexpr std::size_t kHeader = 8;
constexpr std::size_t kFdPacket = 72;  // as the kernel hands CAN FD frames over, whatever they hold
constexpr std::uint32_t kExtended = 0x80000000;
constexpr std::uint32_t kRemote = 0x40000000;
constexpr std::uint32_t kError = 0x20000000;
constexpr std::uint8_t kFdFrame = 0x04;
constexpr std::uint8_t kFdFlags = 0x07;  // bit rate switch, error state indicator, FD frame

// Cooked packets (LINKTYPE_LINUX_SLL and _SLL2): protocol types, and "sent by us".
constexpr unsigned kProtocolCan = 0x000C, kProtocolCanFd = 0x000D;
constexpr unsigned kOutgoing = 4;

std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | bytes[at + i];
  return value;
}

/// What a cooked header says of the frame behind it.
struct Cooked {
  Bytes frame;
  unsigned protocol = 0;
  std::uint32_t interface = 0;  ///< its index; 0: unknown
  bool sent = false;
};

Cooked cooked_header(Bytes bytes, int link_type, const Place &place) {
  const bool second = link_type == kLinkCooked2;
  const std::size_t size = second ? 20 : 16;
  if (bytes.size() < size)
    fail(place, fmt::format("{} bytes; at least {} are needed", bytes.size(), size));
  Cooked header;
  header.frame = bytes.subspan(size);
  header.protocol = big_endian(bytes, second ? 0 : 14, 2);
  header.interface = second ? big_endian(bytes, 4, 4) : 0;
  header.sent = big_endian(bytes, second ? 10 : 0, second ? 1 : 2) == kOutgoing;
  return header;
}

std::string digits(Bytes bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) text += fmt::format("{:02X}", byte);
  return text;
}

/// A frame of SocketCAN: identifier in `id`, the rest in `bytes`. `fd`: said to be CAN FD outside
/// of the frame.
void add_frame(Bytes bytes, std::uint32_t id, bool fd, std::int64_t ns, LogEntry entry,
               LogBuilder &log, const Place &place) {
  const std::uint8_t length = bytes[4];
  // Old captures have rubbish in the three bytes behind the length: believe them only if they make
  // sense.
  const bool clean = (bytes[5] & ~kFdFlags) == 0 && bytes[6] == 0;
  // Older software does not write the flag of CAN FD; then the size of the packet tells it.
  fd = fd || (clean && bytes[7] == 0 && (bytes[5] & kFdFrame) != 0) || length > 8 ||
       bytes.size() == kFdPacket;
  const bool error = (id & kError) != 0, remote = !error && !fd && (id & kRemote) != 0;
  if (length > 64 || (fd && !error && !is_fd_length(length))) return log.skip();
  if (!remote && bytes.size() < kHeader + length)
    fail(place,
         fmt::format("{} data bytes where the length says {}", bytes.size() - kHeader, length));
  const Bytes data = bytes.subspan(kHeader, remote ? 0 : length);
  const bool extended = (id & kExtended) != 0;
  const std::uint32_t number = id & 0x1FFFFFFF;
  if (!extended && !error && number > 0x7FF)
    fail(place, fmt::format("identifier {:X} is above 7FF and has no extended flag", number));
  if (error || fd) {
    ForeignEntry other;
    other.channel = entry.channel;
    other.direction = entry.direction;
    other.kind = error ? ForeignEntry::Kind::kError : ForeignEntry::Kind::kFd;
    if (error)
      other.text = fmt::format("{:08X}#{}", number | kError,
                               digits(data.first(std::min<std::size_t>(data.size(), 8))));
    else
      other.text = fmt::format("{:0{}X}##{:X}{}", number, extended ? 8 : 3,
                               clean ? bytes[5] & 3U : 0U, digits(data));
    return log.add(ns, std::move(other), place);
  }
  entry.frame.id = number;
  entry.frame.extended = extended;
  entry.frame.remote = remote;
  entry.frame.dlc = (clean && length == 8 && bytes[7] >= 9 && bytes[7] <= 15) ? bytes[7] : length;
  std::copy(data.begin(), data.end(), entry.frame.data.begin());
  log.add(ns, std::move(entry), place);
}

/// The packet of link type 227 from its parts.
std::string packet(std::uint32_t id, std::size_t length, std::uint8_t fd_flags, std::uint8_t dlc,
                   Bytes data) {
  std::string bytes;
  for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes += static_cast<char>(id >> shift);
  bytes += {static_cast<char>(length), static_cast<char>(fd_flags), '\0', static_cast<char>(dlc)};
  return bytes.append(data.begin(), data.end());
}

}  // namespace

const char *const kCanLinks = "227 (SocketCAN), 113 (Linux cooked), 276 (Linux cooked, version 2)";

bool is_can_link(int link_type) {
  return link_type == kLinkSocketCan || link_type == kLinkCooked || link_type == kLinkCooked2;
}

void add_can_packet(Bytes bytes, const PacketSource &source, std::int64_t ns, LogBuilder &log,
                    const Place &place) {
  LogEntry entry{0, source.interface, {}, source.direction};
  bool fd = false, big = true;
  if (source.link_type != kLinkSocketCan) {
    const Cooked header = cooked_header(bytes, source.link_type, place);
    if (header.protocol != kProtocolCan && header.protocol != kProtocolCanFd) return log.skip();
    bytes = header.frame;
    fd = header.protocol == kProtocolCanFd;
    big = source.big_endian;
    entry.direction = header.sent ? Direction::kSent : Direction::kReceived;
    if (header.interface != 0) entry.channel = fmt::format("if{}", header.interface);
  }
  if (bytes.size() < kHeader)
    fail(place, fmt::format("{} bytes; at least 8 are needed", bytes.size()));
  const std::uint32_t id = big_endian(bytes, 0, 4);
  add_frame(bytes, big ? id : __builtin_bswap32(id), fd, ns, std::move(entry), log, place);
}

std::string can_packet(const Frame &frame) {
  frame.validate();
  return packet(can_id_of(frame), frame.dlc > 8 ? 8 : frame.dlc, 0, frame.dlc > 8 ? frame.dlc : 0,
                Bytes{frame.data}.first(frame.payload_size()));
}

std::string can_packet(const ForeignEntry &entry) {
  const bool fd = entry.kind == ForeignEntry::Kind::kFd;
  const std::size_t hash = entry.text.find('#');
  const std::string_view all{entry.text};
  const std::string_view tail = all.substr(hash + (fd ? 3 : 1));
  std::vector<std::uint8_t> data;
  for (std::size_t i = 0; i + 1 < tail.size(); i += 2)
    data.push_back(static_cast<std::uint8_t>(*text::parse_unsigned(tail.substr(i, 2), 16)));
  std::uint32_t id = static_cast<std::uint32_t>(*text::parse_unsigned(all.substr(0, hash), 16));
  if (fd && hash == 8) id |= kExtended;
  const auto flags =
      fd ? static_cast<std::uint8_t>(*text::parse_unsigned(all.substr(hash + 2, 1), 16) & 3U) : 0;
  return packet(id, data.size(), fd ? static_cast<std::uint8_t>(flags | kFdFrame) : 0, 0, data);
}

}  // namespace vericansim
