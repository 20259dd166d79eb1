// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packet captures (pcap and pcapng, link type 227 = SocketCAN) for Wireshark and tcpdump, in and
// out.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "trace/log.hpp"

namespace vericansim {

/// Reads a capture of either byte order, micro- or nanoseconds. CAN FD frames and error messages
/// are counted as skipped. Throws InputError (with the number of the packet) on a broken file or
/// another link type.
[[nodiscard]] CanLog read_pcap(const std::string &path);
/// Reads `bytes` as if they were the file `path`.
[[nodiscard]] CanLog parse_pcap(std::string_view bytes, const std::string &path);

/// A capture of all that `log` holds, but for interfaces and directions; nanoseconds. The format
/// has times from 1970 to 2106 (32 bits of seconds) alone.
[[nodiscard]] std::string pcap_bytes(const CanLog &log);

/// Writes captures with nanosecond stamps to an OutputFile.
class PcapWriter {
 public:
  /// Throws OutputError, its methods too. `start_ns` is added to each time.
  explicit PcapWriter(const std::string &path, std::int64_t start_ns = kLogOriginNs);
  ~PcapWriter();
  PcapWriter(const PcapWriter &) = delete;
  PcapWriter &operator=(const PcapWriter &) = delete;
  /// Appends one frame; times are cut to nanoseconds. Throws as Frame::validate().
  void write(const LogEntry &entry);
  /// Puts the file in its place, where it is not before; nothing may follow.
  void commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vericansim
