// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Targets: recorded traffic, each format on its own and by what the first bytes look like.
#include <sys/mman.h>
#include <unistd.h>

#include <sstream>

#include "fuzz/target.hpp"
#include "trace/candump.hpp"
#include "trace/gvret.hpp"
#include "trace/input_error.hpp"
#include "trace/pcap_file.hpp"
#include "trace/pcapng_file.hpp"
#include "trace/trc.hpp"

namespace vericansim::fuzz {
namespace {

const std::string kFile = "input";

void require_same_frames(const CanLog &written, const CanLog &read) {
  require(read.entries.size() == written.entries.size(), "as many frames as were written");
  for (std::size_t i = 0; i < written.entries.size(); ++i)
    require(read.entries[i].frame == written.entries[i].frame, "the frame that was written");
}

/// What `read` makes of our own writer's bytes. To refuse them is a finding, unlike with the input.
template <typename Read>
CanLog read_back(const Read &read) {
  try {
    return read();
  } catch (const InputError &error) {
    require(false, error.what());
    throw;
  }
}

/// What has been read, written and read again is the same; times as far as candump has them.
void candump_round_trip(const CanLog &log) {
  std::ostringstream out;
  CandumpWriter writer{out, log.start_ns};
  bool whole = log.start_ns % 1000 == 0;
  for (const LogEntry &entry : log.entries) {
    writer.write(entry);
    whole = whole && entry.time % kMicrosecond == 0;
  }
  const CanLog again = read_back([&] { return parse_candump(out.str(), kFile); });
  require_same_frames(log, again);
  for (std::size_t i = 0; i < log.entries.size(); ++i) {
    require(again.entries[i].channel == log.entries[i].channel, "the channel that was written");
    require(!whole || again.entries[i].time == log.entries[i].time, "the time that was written");
  }
}

void require_same_others(const CanLog &written, const CanLog &read) {
  require(read.others.size() == written.others.size(), "as many other entries as were written");
  for (std::size_t i = 0; i < written.others.size(); ++i)
    require(read.others[i].text == written.others[i].text, "the other entry that was written");
}

/// The same through a capture; of the first frames, because each needs a file in memory.
void pcap_round_trip(const CanLog &log) {
  constexpr std::int64_t kEnd = (std::int64_t{1} << 32U) * 1'000'000'000;  // 32 bits of seconds
  CanLog written;
  for (const LogEntry &entry : log.entries) {
    const std::int64_t ns = log.start_ns + entry.time / kNanosecond;
    if (written.entries.size() < 8 && ns >= 0 && ns < kEnd) written.entries.push_back(entry);
  }
  if (written.entries.empty()) return;
  static const int file = ::memfd_create("capture", 0);
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  {
    PcapWriter writer{path, log.start_ns};
    for (const LogEntry &entry : written.entries) writer.write(entry);
    writer.commit();
  }
  std::string bytes(4096, '\0');
  const ssize_t size = ::pread(file, bytes.data(), bytes.size(), 0);
  bytes.resize(static_cast<std::size_t>(size));
  const CanLog again = read_back([&] { return parse_pcap(bytes, kFile); });
  require_same_frames(written, again);
  for (std::size_t i = 0; i < written.entries.size(); ++i)
    require(again.entries[i].time - again.entries[0].time ==
                written.entries[i].time - written.entries[0].time,
            "the time that was written");
}

}  // namespace

void require_valid(const Frame &frame) {
  require(frame.id <= (frame.extended ? 0x1FFFFFFFU : 0x7FFU), "an identifier of 11 or 29 bits");
  require(frame.dlc <= 15, "a DLC of four bits");
}

void require_valid(const CanLog &log) {
  for (const LogEntry &entry : log.entries) require_valid(entry.frame);
}

void fuzz_candump(Bytes input) {
  try {
    const CanLog log = parse_candump(text_of(input), kFile);
    require_valid(log);
    candump_round_trip(log);
  } catch (const InputError &) {
  }
}

void fuzz_gvret(Bytes input) {
  try {
    require_valid(parse_gvret(text_of(input), kFile));
  } catch (const InputError &) {
  }
}

void fuzz_trc(Bytes input) {
  try {
    require_valid(parse_trc(text_of(input), kFile));
  } catch (const InputError &) {
  }
}

void fuzz_pcap(Bytes input) {
  try {
    const CanLog log = parse_pcap(text_of(input), kFile);
    require_valid(log);
    pcap_round_trip(log);
  } catch (const InputError &) {
  }
}

void fuzz_pcapng(Bytes input) {
  try {
    const CanLog log = parse_pcapng(text_of(input), kFile);
    require_valid(log);
    if (log.start_ns < 0) return;  // the writer's stamps have no sign
    for (const LogEntry &entry : log.entries)
      if (log.start_ns + entry.time / kNanosecond < 0) return;
    for (const ForeignEntry &entry : log.others)
      if (log.start_ns + entry.time / kNanosecond < 0) return;
    const CanLog again = read_back([&] { return parse_pcapng(pcapng_bytes(log), kFile); });
    require_same_frames(log, again);
    require_same_others(log, again);
  } catch (const InputError &) {
  }
}

void fuzz_log(Bytes input) {
  try {
    // python-can is a process of its own, and not ours to fuzz.
    if (traits_of(detect_log_format(text_of(input), kFile)).python) return;
    require_valid(parse_log(text_of(input), kFile));
  } catch (const InputError &) {
  }
}

}  // namespace vericansim::fuzz
