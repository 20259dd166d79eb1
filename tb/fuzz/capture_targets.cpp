// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Target: packets of each link type in a pcap and in a pcapng file. libpcap takes the one apart,
// our own reader the other; both must say the same.
#include <optional>

#include "fuzz/target.hpp"
#include "harness/capture_files.hpp"
#include "trace/can_packet.hpp"
#include "trace/input_error.hpp"
#include "trace/pcap_file.hpp"
#include "trace/pcapng_file.hpp"

namespace vericansim::fuzz {
namespace {

/// What the reader makes of the file; nothing if it is refused.
template <typename Parse>
std::optional<CanLog> read(Parse parse, const std::string &bytes) {
  try {
    return parse(bytes, "input");
  } catch (const InputError &) {
    return std::nullopt;
  }
}

void require_same(const CanLog &pcap, const CanLog &pcapng) {
  require(pcap.start_ns == pcapng.start_ns, "the same time in both");
  require(pcap.skipped == pcapng.skipped, "as much left out in both");
  require(pcap.entries.size() == pcapng.entries.size(), "as many frames in both");
  for (std::size_t i = 0; i < pcap.entries.size(); ++i) {
    require(pcap.entries[i].frame == pcapng.entries[i].frame, "the same frame in both");
    require(pcap.entries[i].direction == pcapng.entries[i].direction, "the same direction in both");
    require(pcap.entries[i].time == 0 && pcapng.entries[i].time == 0, "one time for all");
  }
  require(pcap.others.size() == pcapng.others.size(), "as many other entries in both");
  for (std::size_t i = 0; i < pcap.others.size(); ++i)
    require(pcap.others[i].text == pcapng.others[i].text, "the same other entry in both");
}

}  // namespace

void fuzz_capture(Bytes input) {
  constexpr int kLinks[] = {kLinkCooked, kLinkCooked2, kLinkSocketCan};
  constexpr std::uint64_t kTime = 1'000'000'007;  // of all packets, us
  Reader reader{input};
  const unsigned form = reader.byte();
  const int link = kLinks[form % 3];
  const bool big = (form & 0x80) != 0;
  std::vector<std::string> packets;
  while (!reader.empty()) packets.emplace_back(text_of(reader.take(reader.byte())));
  Blocks blocks{big};
  blocks.section().interface(static_cast<unsigned>(link));
  for (const std::string &packet : packets) blocks.packet(0, kTime, packet);
  const auto pcap = read(parse_pcap, capture(static_cast<unsigned>(link), big, packets));
  const auto pcapng = read(parse_pcapng, blocks.bytes);
  require(pcap.has_value() == pcapng.has_value(), "both read, or both refused");
  if (!pcap) return;
  require_valid(*pcap);
  require_same(*pcap, *pcapng);
}

}  // namespace vericansim::fuzz
