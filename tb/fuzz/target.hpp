// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What fuzz targets share. A target gives any bytes to one reader of foreign bytes and returns:
// what the reader refuses (InputError, or what its header says) is caught there; any other
// exception, a broken promise (require()), a sanitizer's report, a time-out or too much memory is a
// finding.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "model/frame.hpp"
#include "trace/log.hpp"

namespace vericansim::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// The bytes as text.
inline std::string_view text_of(Bytes bytes) {
  return {reinterpret_cast<const char *>(bytes.data()), bytes.size()};
}

/// Ends the program with a message if `condition` does not hold: a reader broke its promise.
inline void require(bool condition, const char *promise) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: broken promise: %s\n", promise);
  std::abort();
}

/// Takes numbers off the front of an input; zeros when it is used up.
class Reader {
 public:
  explicit Reader(Bytes bytes) : rest_{bytes} {}
  [[nodiscard]] bool empty() const { return rest_.empty(); }
  [[nodiscard]] Bytes take(std::size_t count) {
    const Bytes part = rest_.first(count < rest_.size() ? count : rest_.size());
    rest_ = rest_.subspan(part.size());
    return part;
  }
  /// `count` bytes, up to 8, least significant first.
  [[nodiscard]] std::uint64_t number(unsigned count) {
    std::uint64_t value = 0;
    unsigned shift = 0;
    for (const std::uint8_t byte : take(count)) {
      value |= std::uint64_t{byte} << shift;
      shift += 8;
    }
    return value;
  }
  [[nodiscard]] std::uint8_t byte() { return static_cast<std::uint8_t>(number(1)); }

 private:
  Bytes rest_;
};

/// The frame can travel on a bus: its identifier fits its format, its DLC four bits.
void require_valid(const Frame &frame);
/// Every frame is valid; absolute times, too.
void require_valid(const CanLog &log);

/// The targets, one for each reader; docs/fuzzing.md says what each promises.
void fuzz_candump(Bytes input);
void fuzz_gvret(Bytes input);
void fuzz_trc(Bytes input);
void fuzz_pcap(Bytes input);
void fuzz_pcapng(Bytes input);
void fuzz_log(Bytes input);
void fuzz_screen(Bytes input);
void fuzz_capture(Bytes input);
void fuzz_gzip(Bytes input);
void fuzz_vcd(Bytes input);
void fuzz_wave(Bytes input);
void fuzz_scenario(Bytes input);
void fuzz_options(Bytes input);
void fuzz_elf(Bytes input);
void fuzz_splitter(Bytes input);
void fuzz_words(Bytes input);
void fuzz_client(Bytes input);
void fuzz_can_frame(Bytes input);
void fuzz_board(Bytes input);
void fuzz_guest(Bytes input);

}  // namespace vericansim::fuzz
