// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Packet captures through libpcap's file functions.
#include "trace/pcap_file.hpp"

#include <pcap/pcap.h>

#include <fmt/format.h>
#include <array>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <limits>
#include <memory>

#include "trace/can_packet.hpp"
#include "trace/input_error.hpp"
#include "trace/log_builder.hpp"
#include "trace/output_file.hpp"

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
  throw InputError(path, 0, in_quotes(error.data()) + " (libpcap)");
}

/// libpcap takes the seconds of a pcap file as 32 bits with a sign; in the format they have none.
std::int64_t seconds(const pcap_pkthdr &header) {
  const auto low = static_cast<std::int32_t>(header.ts.tv_sec);
  return low == header.ts.tv_sec ? static_cast<std::uint32_t>(low) : header.ts.tv_sec;
}

/// Time of a packet, ns since the epoch; with nanosecond precision tv_usec holds nanoseconds.
std::int64_t nanoseconds(const pcap_pkthdr &header, const text::Place &place) {
  constexpr std::int64_t kBillion = 1'000'000'000;
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max() / kBillion - 1;
  const std::int64_t s = seconds(header);
  if (s < 0 || s > kMost)
    text::fail(place, fmt::format("time {} s is not allowed; allowed: 0 to {} s", s, kMost));
  if (header.ts.tv_usec < 0 || header.ts.tv_usec >= kBillion)
    text::fail(place, fmt::format("{} ns of a second are not allowed; allowed: 0 to 999999999",
                                  header.ts.tv_usec));
  return s * kBillion + header.ts.tv_usec;
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

namespace {

/// What libpcap writes goes to the stream; false if that failed, which the stream remembers.
ssize_t write_to_stream(void *stream, const char *bytes, std::size_t size) {
  try {
    static_cast<std::ostream *>(stream)->write(bytes, static_cast<std::streamsize>(size));
    return static_cast<ssize_t>(size);
  } catch (const OutputError &error) {
    errno = error.code();
    return -1;
  }
}

}  // namespace

struct PcapWriter::Impl {
  Impl(const std::string &path, std::int64_t start) : file{path}, start_ns{start} {}
  OutputFile file;
  std::int64_t start_ns;
  PcapFile dead;
  pcap_dumper_t *out = nullptr;

  void check(bool well) const {
    if (!well) throw OutputError(file.path(), "cannot be written to its end", errno);
  }
};

PcapWriter::PcapWriter(const std::string &path, std::int64_t start_ns)
    : impl_{std::make_unique<Impl>(path, start_ns)} {
  constexpr int kLongestPacket = 16;
  impl_->dead.reset(pcap_open_dead_with_tstamp_precision(DLT_CAN_SOCKETCAN, kLongestPacket,
                                                         PCAP_TSTAMP_PRECISION_NANO));
  std::FILE *stream =
      ::fopencookie(&impl_->file.stream(), "wb", {nullptr, write_to_stream, nullptr, nullptr});
  if (stream != nullptr) impl_->out = pcap_dump_fopen(impl_->dead.get(), stream);
  if (impl_->out == nullptr) throw OutputError(path, "cannot be opened for writing", ENOMEM);
}

PcapWriter::~PcapWriter() {
  if (impl_->out != nullptr) pcap_dump_close(impl_->out);
}

void PcapWriter::commit() {
  errno = 0;
  impl_->check(pcap_dump_flush(impl_->out) == 0);
  pcap_dump_close(impl_->out);
  impl_->out = nullptr;
  impl_->file.commit();
}

void PcapWriter::write(const LogEntry &entry) {
  const std::string packet = can_packet(entry.frame);
  const std::int64_t ns = impl_->start_ns + entry.time / kNanosecond;
  pcap_pkthdr header{};
  header.ts.tv_sec = ns / 1'000'000'000;
  header.ts.tv_usec = ns % 1'000'000'000;
  header.caplen = header.len = static_cast<bpf_u_int32>(packet.size());
  pcap_dump(reinterpret_cast<u_char *>(impl_->out), &header,
            reinterpret_cast<const u_char *>(packet.data()));
  impl_->check(std::ferror(pcap_dump_file(impl_->out)) == 0);
  if (!impl_->file.direct()) return;
  impl_->check(pcap_dump_flush(impl_->out) == 0);
  impl_->file.stream().flush();
}

}  // namespace vericansim
