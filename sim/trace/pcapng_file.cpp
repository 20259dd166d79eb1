// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// pcapng (IETF draft-ietf-opsawg-pcapng): the reader. Blocks of type, length, body, length; those
// of other types are passed over.
#include "trace/pcapng_file.hpp"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <vector>

#include "trace/can_packet.hpp"
#include "trace/input_error.hpp"
#include "trace/pcapng_layout.hpp"

namespace vericansim {
namespace {

using namespace pcapng;
using text::fail;
using text::Place;

/// An interface of the section. A tick is 10^-exponent or, `binary`, 2^-exponent seconds.
struct Interface {
  PacketSource source;
  unsigned exponent = 6;
  bool binary = false;
  std::int64_t offset_s = 0;
};

/// A piece of the file, read in the byte order of its section.
class Body {
 public:
  Body(std::string_view bytes, bool big, Place place)
      : bytes_{bytes}, big_{big}, place_{std::move(place)} {}
  [[nodiscard]] std::uint64_t number(std::size_t at, std::size_t count) const {
    const std::string_view field = part(at, count);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
      value = value << 8 | static_cast<std::uint8_t>(field[big_ ? i : count - 1 - i]);
    return value;
  }
  [[nodiscard]] std::string_view part(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at) fail(place_, "cut short");
    return bytes_.substr(at, count);
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] bool big() const { return big_; }
  [[nodiscard]] const Place &place() const { return place_; }

  /// Calls use(code, value) for each option from `at` on.
  template <typename Use>
  void options(std::size_t at, Use use) const {
    while (at + 4 <= size()) {
      const auto code = number(at, 2);
      const auto length = static_cast<std::size_t>(number(at + 2, 2));
      if (code == kEndOfOptions) return;
      use(code, Body{part(at + 4, length), big_, place_});
      at += 4 + padded(length);
    }
  }

 private:
  std::string_view bytes_;
  bool big_;
  Place place_;
};

Interface parse_interface(const Body &body) {
  Interface result;
  result.source.link_type = static_cast<int>(body.number(0, 2));
  result.source.big_endian = body.big();
  body.options(8, [&](std::uint64_t code, const Body &value) {
    if (code == kName) result.source.interface = std::string(value.part(0, value.size()));
    if (code == kOffset) result.offset_s = static_cast<std::int64_t>(value.number(0, 8));
    if (code != kResolution) return;
    const auto resolution = static_cast<unsigned>(value.number(0, 1));
    result.binary = (resolution & 0x80) != 0;
    result.exponent = resolution & 0x7F;
  });
  if (result.exponent > (result.binary ? 63 : 18))
    fail(body.place(), fmt::format("time resolution {} is not allowed; allowed: up to 10^-18 or "
                                   "2^-63 s",
                                   result.exponent));
  // A name is a field of a candump log: no blanks, no control characters.
  for (char &c : result.source.interface)
    if (static_cast<unsigned char>(c) <= ' ' || c == 0x7F) c = '_';
  return result;
}

/// A stamp in nanoseconds since the epoch.
std::int64_t nanoseconds(std::uint64_t ticks, const Interface &from, const Place &place) {
  constexpr std::int64_t kBillion = 1'000'000'000;
  unsigned __int128 per_second = 1;
  for (unsigned i = 0; i < from.exponent; ++i) per_second *= from.binary ? 2 : 10;
  const auto ns = static_cast<unsigned __int128>(ticks) * kBillion / per_second;
  std::int64_t offset = 0, result = 0;
  if (ns > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) ||
      __builtin_mul_overflow(from.offset_s, kBillion, &offset) ||
      __builtin_add_overflow(static_cast<std::int64_t>(ns), offset, &result))
    fail(place, "time is out of range; allowed: up to the year 2262");
  return result;
}

/// Reads block after block.
class PcapngReader {
 public:
  PcapngReader(std::string_view bytes, const std::string &path) : bytes_{bytes}, path_{path} {}
  CanLog read() {
    for (std::size_t number = 1; at_ < bytes_.size(); ++number) next(number);
    return log_.finish(true);
  }

 private:
  void next(std::size_t number) {
    const Place place{fmt::format("{}: block {}", path_, number), 0};
    std::string_view rest = bytes_.substr(at_);
    const Body header{rest, big_, place};
    if (header.number(0, 4) == kSection) begin_section(Body{rest, false, place});
    const Body head{rest, big_, place};
    const auto length = static_cast<std::size_t>(head.number(4, 4));
    if (length < 12 || length % 4 != 0)
      fail(place, fmt::format("length {} is not allowed; allowed: 12 and more, by four", length));
    use(head.number(0, 4), Body{head.part(8, length - 12), big_, place});
    if (head.number(length - 4, 4) != length) fail(place, "its two lengths differ");
    at_ += length;
  }

  void begin_section(const Body &little) {
    const auto magic = little.number(8, 4);
    if (magic != kLittleEndian && magic != kBigEndian)
      fail(little.place(), "the section has no byte-order mark");
    big_ = magic == kBigEndian;
    interfaces_.clear();
  }

  void use(std::uint64_t type, const Body &body) {
    if (type == kInterface) interfaces_.push_back(parse_interface(body));
    if (type == kPacket) packet(body, body.number(0, 4), 20);
    if (type == kOldPacket) packet(body, body.number(0, 2), 20);
    // Neither time nor interface: those of the packet before, the first interface.
    if (type == kSimplePacket)
      add(body.part(4, std::min(static_cast<std::size_t>(body.number(0, 4)), body.size() - 4)),
          interface(0, body.place()), last_ns_, Direction::kUnknown, body.place());
  }

  void packet(const Body &body, std::uint64_t index, std::size_t data) {
    const Interface &from = interface(index, body.place());
    const auto captured = static_cast<std::size_t>(body.number(12, 4));
    last_ns_ = nanoseconds(body.number(4, 4) << 32 | body.number(8, 4), from, body.place());
    Direction direction = Direction::kUnknown;
    const std::string_view bytes = body.part(data, captured);
    body.options(data + padded(captured), [&](std::uint64_t code, const Body &value) {
      if (code != kFlags) return;
      const auto way = value.number(0, 4) & 3;
      if (way == kInbound) direction = Direction::kReceived;
      if (way == kOutbound) direction = Direction::kSent;
    });
    add(bytes, from, last_ns_, direction, body.place());
  }

  const Interface &interface(std::uint64_t index, const Place &place) {
    if (index >= interfaces_.size()) fail(place, fmt::format("there is no interface {}", index));
    return interfaces_[static_cast<std::size_t>(index)];
  }

  void add(std::string_view bytes, const Interface &from, std::int64_t ns, Direction direction,
           const Place &place) {
    if (!is_can_link(from.source.link_type)) return log_.skip();
    PacketSource source = from.source;
    source.direction = direction;
    add_can_packet({reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size()}, source, ns,
                   log_, place);
  }

  std::string_view bytes_;
  const std::string &path_;
  std::size_t at_ = 0;
  bool big_ = false;
  std::vector<Interface> interfaces_;
  std::int64_t last_ns_ = 0;
  LogBuilder log_;
};

}  // namespace

CanLog parse_pcapng(std::string_view bytes, const std::string &path) {
  return PcapngReader{bytes, path}.read();
}

}  // namespace vericansim
