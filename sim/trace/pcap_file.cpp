// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packet captures through libpcap's file functions.
#include "trace/pcap_file.hpp"

#include <pcap/pcap.h>

#include <fmt/format.h>
#include <array>
#include <bit>
#include <cstdio>
#include <limits>
#include <memory>

#include "trace/can_packet.hpp"
#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"

namespace vericansim {
namespace {

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
std::int64_t nanoseconds(const pcap_pkthdr &header, const text::Place &place) {
  constexpr std::int64_t kBillion = 1'000'000'000;
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / kBillion - 1;
  if (header.ts.tv_sec < 0 || header.ts.tv_sec > kMost || header.ts.tv_usec < 0 ||
      header.ts.tv_usec >= kBillion)
    text::fail(place, fmt::format("time {} s {} ns is not allowed; allowed: 0 to {} s",
                                  header.ts.tv_sec, header.ts.tv_usec, kMost));
  return std::int64_t{header.ts.tv_sec} * kBillion + header.ts.tv_usec;
}

}  // namespace

CanLog parse_pcap(std::string_view bytes, const std::string &path) {
  const PcapFile file = open_bytes(bytes, path);
  PacketSource source;
  source.link_type = pcap_datalink(file.get());
  if (!is_can_link(source.link_type))
    throw InputError(
        path, 0, fmt::format("link type {} is not CAN; allowed: {}", source.link_type, kCanLinks));
  // libpcap turns the identifiers of cooked packets into this computer's byte order.
  source.big_endian = std::endian::native == std::endian::big;
  LogBuilder log;
  pcap_pkthdr *header = nullptr;
  const std::uint8_t *packet = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(file.get(), &header, &packet)) == 1) {
    const text::Place place{fmt::format("{}: packet {}", path, log.size() + 1), 0};
    add_can_packet({packet, header->caplen}, source, nanoseconds(*header, place), log, place);
  }
  if (status != PCAP_ERROR_BREAK)
    throw InputError(
        path, 0,
        fmt::format("after {} packets: {} (libpcap)", log.size(), pcap_geterr(file.get())));
  return log.finish(true);
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
  const std::string packet = can_packet(entry.frame);
  const std::int64_t ns = impl_->start_ns + entry.time / kNanosecond;
  pcap_pkthdr header{};
  header.ts.tv_sec = ns / 1'000'000'000;
  header.ts.tv_usec = ns % 1'000'000'000;
  header.caplen = header.len = static_cast<bpf_u_int32>(packet.size());
  pcap_dump(reinterpret_cast<u_char *>(impl_->out), &header,
            reinterpret_cast<const u_char *>(packet.data()));
}

}  // namespace vericansim
