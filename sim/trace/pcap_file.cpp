// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packet captures through libpcap's file functions.
#include "trace/pcap_file.hpp"

#include <pcap/pcap.h>

#include <fmt/format.h>
#include <array>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

// Layout of a packet (tcpdump.org, LINKTYPE_CAN_SOCKETCAN): identifier and flags, big-endian;
// length; FD flags; reserved; raw DLC; data.
constexpr std::size_t kHeader = 8;
constexpr std::uint32_t kExtended = 0x80000000;
constexpr std::uint32_t kRemote = 0x40000000;
constexpr std::uint32_t kError = 0x20000000;
constexpr std::uint8_t kFdFrame = 0x04;
constexpr std::uint8_t kFdFlags = 0x07;  // bit rate switch, error state indicator, FD frame
#ifndef DLT_CAN_SOCKETCAN
#define DLT_CAN_SOCKETCAN 227
#endif

struct CloseFile {
  void operator()(pcap_t *file) const { pcap_close(file); }
};
using PcapFile = std::unique_ptr<pcap_t, CloseFile>;

/// libpcap reads streams only: the bytes as one.
PcapFile open_bytes(std::string_view bytes, const std::string &path) {
  if (bytes.empty()) throw InputError(path, 0, "the file is empty");
  // The stream is for reading; its interface has no const.
  std::FILE *stream = ::fmemopen(const_cast<char *>(bytes.data()), bytes.size(), "rb");
  if (stream == nullptr) throw InputError(path, 0, "no memory to read it");
  std::array<char, PCAP_ERRBUF_SIZE> error{};
  PcapFile file{
      pcap_fopen_offline_with_tstamp_precision(stream, PCAP_TSTAMP_PRECISION_NANO, error.data())};
  if (file) return file;
  std::fclose(stream);
  throw InputError(path, 0, quoted(error.data()) + " (libpcap)");
}

/// Time of a packet, ns since the epoch; with nanosecond precision tv_usec holds nanoseconds.
std::int64_t nanoseconds(const pcap_pkthdr &header, const std::string &path, std::size_t number) {
  constexpr std::int64_t kBillion = 1'000'000'000;
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / kBillion - 1;
  if (header.ts.tv_sec < 0 || header.ts.tv_sec > kMost || header.ts.tv_usec < 0 ||
      header.ts.tv_usec >= kBillion)
    throw InputError(path, 0,
                     fmt::format("packet {}: time {} s {} ns is not allowed; allowed: 0 to {} s",
                                 number, header.ts.tv_sec, header.ts.tv_usec, kMost));
  return std::int64_t{header.ts.tv_sec} * kBillion + header.ts.tv_usec;
}

/// `ns` on the time scale of the log, ps after `start_ns`.
Time since(std::int64_t start_ns, std::int64_t ns, const std::string &path, std::size_t number) {
  constexpr std::int64_t kMost = std::numeric_limits<Time>::max() / kNanosecond;
  if (ns - start_ns > kMost || start_ns - ns > kMost)
    throw InputError(
        path, 0, fmt::format("packet {}: time is more than 106 days from the first one", number));
  return (ns - start_ns) * kNanosecond;
}

/// True if the packet is a classical frame; throws if it is cut short or contradicts itself.
bool decode_packet(const std::uint8_t *bytes, std::size_t size, Frame &frame,
                   const std::string &path, std::size_t number) {
  if (size < kHeader)
    throw InputError(path, 0,
                     fmt::format("packet {}: {} bytes; at least 8 are needed", number, size));
  const std::uint32_t id = std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
                           std::uint32_t{bytes[2]} << 8 | bytes[3];
  const std::uint8_t length = bytes[4];
  // Old captures have rubbish in the three bytes behind the length: believe them only if they make
  // sense.
  const bool clean = (bytes[5] & ~kFdFlags) == 0 && bytes[6] == 0;
  const bool fd_frame = clean && bytes[7] == 0 && (bytes[5] & kFdFrame) != 0;
  if ((id & kError) != 0 || fd_frame || length > 8) return false;
  frame = Frame{};
  frame.extended = (id & kExtended) != 0;
  frame.remote = (id & kRemote) != 0;
  frame.id = id & 0x1FFFFFFF;
  if (!frame.extended && frame.id > 0x7FF)
    throw InputError(path, 0,
                     fmt::format("packet {}: identifier {:X} is above 7FF and has no extended flag",
                                 number, frame.id));
  frame.dlc = (clean && length == 8 && bytes[7] >= 9 && bytes[7] <= 15) ? bytes[7] : length;
  if (frame.remote) return true;
  if (size < kHeader + length)
    throw InputError(path, 0,
                     fmt::format("packet {}: {} data bytes where the length says {}", number,
                                 size - kHeader, length));
  std::memcpy(frame.data.data(), bytes + kHeader, length);
  return true;
}

}  // namespace

CanLog parse_pcap(std::string_view bytes, const std::string &path) {
  const PcapFile file = open_bytes(bytes, path);
  if (pcap_datalink(file.get()) != DLT_CAN_SOCKETCAN)
    throw InputError(path, 0,
                     fmt::format("link type {} is not CAN; allowed: 227 (SocketCAN)",
                                 pcap_datalink(file.get())));
  CanLog log;
  pcap_pkthdr *header = nullptr;
  const std::uint8_t *packet = nullptr;
  int status = 0;
  for (std::size_t number = 1; (status = pcap_next_ex(file.get(), &header, &packet)) == 1;
       ++number) {
    LogEntry entry;
    if (!decode_packet(packet, header->caplen, entry.frame, path, number)) {
      ++log.skipped;
      continue;
    }
    const std::int64_t ns = nanoseconds(*header, path, number);
    if (log.entries.empty()) log.start_ns = ns;
    entry.time = since(log.start_ns, ns, path, number);
    log.entries.push_back(std::move(entry));
  }
  if (status != PCAP_ERROR_BREAK)
    throw InputError(path, 0,
                     fmt::format("after {} packets: {} (libpcap)", log.entries.size() + log.skipped,
                                 pcap_geterr(file.get())));
  return log;
}

CanLog read_pcap(const std::string &path) { return parse_pcap(read_text_file(path), path); }

struct PcapWriter::Impl {
  std::string path;
  std::int64_t start_ns = 0;
  PcapFile dead;
  pcap_dumper_t *out = nullptr;
};

PcapWriter::PcapWriter(const std::string &path, std::int64_t start_ns)
    : impl_{std::make_unique<Impl>()} {
  constexpr int kLongestPacket = 16;
  impl_->path = path;
  impl_->start_ns = start_ns;
  impl_->dead.reset(pcap_open_dead_with_tstamp_precision(DLT_CAN_SOCKETCAN, kLongestPacket,
                                                         PCAP_TSTAMP_PRECISION_NANO));
  impl_->out = pcap_dump_open(impl_->dead.get(), path.c_str());
  if (impl_->out == nullptr) throw InputError(path, 0, "cannot be opened for writing");
}

PcapWriter::~PcapWriter() { pcap_dump_close(impl_->out); }

void PcapWriter::write(const LogEntry &entry) {
  const Frame &frame = entry.frame;
  const std::uint32_t id =
      frame.id | (frame.extended ? kExtended : 0) | (frame.remote ? kRemote : 0);
  std::array<std::uint8_t, kHeader + 8> packet{};
  for (unsigned i = 0; i < 4; ++i) packet[i] = static_cast<std::uint8_t>(id >> (24 - 8 * i));
  packet[4] = frame.dlc > 8 ? 8 : frame.dlc;
  packet[7] = frame.dlc > 8 ? frame.dlc : 0;
  std::memcpy(packet.data() + kHeader, frame.data.data(), frame.payload_size());
  const std::int64_t ns = impl_->start_ns + entry.time / kNanosecond;
  pcap_pkthdr header{};
  header.ts.tv_sec = ns / 1'000'000'000;
  header.ts.tv_usec = ns % 1'000'000'000;
  header.caplen = header.len = static_cast<bpf_u_int32>(kHeader + frame.payload_size());
  pcap_dump(reinterpret_cast<u_char *>(impl_->out), &header, packet.data());
}

}  // namespace vericansim
