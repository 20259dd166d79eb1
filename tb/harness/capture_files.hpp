// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Captures put together byte by byte, after the published formats.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vericansim {

/// `value` in `count` bytes of the byte order.
inline std::string number(std::uint64_t value, unsigned count, bool big) {
  std::string bytes;
  for (unsigned i = 0; i < count; ++i)
    bytes += static_cast<char>(value >> 8 * (big ? count - 1 - i : i));
  return bytes;
}

/// A pcap file of microseconds; its packets are of 1000.000007 s.
inline std::string capture(unsigned link_type, bool big, const std::vector<std::string> &packets) {
  std::string bytes = number(0xA1B2C3D4, 4, big) + number(2, 2, big) + number(4, 2, big) +
                      std::string(8, '\0') + number(65535, 4, big) + number(link_type, 4, big);
  for (const std::string &packet : packets)
    bytes += number(1000, 4, big) + number(7, 4, big) + number(packet.size(), 4, big) +
             number(packet.size(), 4, big) + packet;
  return bytes;
}

/// Puts a pcapng file together.
class Blocks {
 public:
  explicit Blocks(bool big) : big_{big} {}
  [[nodiscard]] std::string number(std::uint64_t value, unsigned count) const {
    return vericansim::number(value, count, big_);
  }
  [[nodiscard]] std::string option(unsigned code, std::string value) const {
    const std::string head = number(code, 2) + number(value.size(), 2);
    value.resize((value.size() + 3) / 4 * 4, '\0');
    return head + value;
  }
  Blocks &block(std::uint32_t type, std::string body) {
    body.resize((body.size() + 3) / 4 * 4, '\0');
    bytes += number(type, 4) + number(body.size() + 12, 4) + body + number(body.size() + 12, 4);
    return *this;
  }
  Blocks &section() {
    return block(0x0A0D0D0A,
                 number(0x1A2B3C4D, 4) + number(1, 2) + number(0, 2) + number(~0ULL, 8));
  }
  Blocks &interface(unsigned link_type, const std::string &options = {}) {
    return block(1, number(link_type, 2) + number(0, 2) + number(0, 4) + options);
  }
  Blocks &packet(unsigned interface, std::uint64_t ticks, std::string data,
                 const std::string &options = {}) {
    const std::string head = number(interface, 4) + number(ticks >> 32, 4) + number(ticks, 4) +
                             number(data.size(), 4) + number(data.size(), 4);
    if (!options.empty()) data.resize((data.size() + 3) / 4 * 4, '\0');
    return block(6, head + data + options);
  }
  std::string bytes;

 private:
  bool big_;
};

}  // namespace vericansim
