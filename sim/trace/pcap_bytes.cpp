// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A whole capture at once, by libpcap to memory.
#include <pcap/pcap.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "trace/can_packet.hpp"
#include "trace/log_walk.hpp"
#include "trace/pcap_file.hpp"

namespace vericansim {

std::string pcap_bytes(const CanLog &log) {
  constexpr int kLongestPacket = 72;  // CAN FD
  char *buffer = nullptr;
  std::size_t size = 0;
  std::FILE *stream = ::open_memstream(&buffer, &size);
  const std::unique_ptr<pcap_t, decltype(&pcap_close)> dead{
      pcap_open_dead_with_tstamp_precision(kLinkSocketCan, kLongestPacket,
                                           PCAP_TSTAMP_PRECISION_NANO),
      pcap_close};
  pcap_dumper_t *out = stream == nullptr ? nullptr : pcap_dump_fopen(dead.get(), stream);
  if (out == nullptr) throw std::runtime_error("pcap: no memory");
  const auto write = [&](Time time, const std::string &packet) {
    const std::int64_t ns = log.start_ns + time / kNanosecond;
    pcap_pkthdr header{};
    header.ts.tv_sec = ns / 1'000'000'000;
    header.ts.tv_usec = ns % 1'000'000'000;
    header.caplen = header.len = static_cast<bpf_u_int32>(packet.size());
    pcap_dump(reinterpret_cast<u_char *>(out), &header,
              reinterpret_cast<const u_char *>(packet.data()));
  };
  walk(
      log, [&](const LogEntry &entry) { write(entry.time, can_packet(entry.frame)); },
      [&](const ForeignEntry &entry) { write(entry.time, can_packet(entry)); });
  pcap_dump_close(out);
  std::string bytes(buffer, size);
  std::free(buffer);
  return bytes;
}

}  // namespace vericansim
