// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Target: inputs packed with gzip.
#include <zlib.h>

#include "fuzz/target.hpp"
#include "trace/input_error.hpp"
#include "trace/input_file.hpp"

namespace vericansim::fuzz {
namespace {

constexpr std::size_t kMost = std::size_t{1} << 20;

/// `text` packed by zlib itself, as gzip does.
std::string packed(std::string_view text) {
  constexpr int kGzip = 15 + 16, kMemory = 8;
  z_stream stream{};
  require(
      deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) == Z_OK,
      "zlib works");
  std::string bytes(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef *>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  require(deflate(&stream, Z_FINISH) == Z_STREAM_END, "zlib works");
  bytes.resize(bytes.size() - stream.avail_out);
  deflateEnd(&stream);
  return bytes;
}

/// False if the bytes are refused; else what comes of them goes to `text`.
bool unpacks(const std::string &bytes, std::string &text, std::size_t most = kMost) {
  try {
    text = unpacked(bytes, "input", most);
    return true;
  } catch (const InputError &) {
    return false;
  }
}

void as_it_is(Bytes input) {
  const std::string bytes{text_of(input)};
  std::string text;
  if (!unpacks(bytes, text)) return;
  require(text.size() <= kMost, "no more than allowed");
  require(bytes.starts_with("\x1f\x8b") || text == bytes, "what is not packed stays as it is");
}

/// In two members, and with something behind them.
void round_trip(Reader reader) {
  const std::string_view first = text_of(reader.take(reader.byte()));
  const std::string tail{text_of(reader.take(reader.byte() % 4))};
  const std::string_view second = text_of(reader.take(~std::size_t{0}));
  const std::string both = std::string(first) + std::string(second);
  std::string text;
  require(unpacks(packed(first) + packed(second), text) && text == both, "two members are read");
  require(unpacks(packed(both), text, both.size()) && text == both, "the limit is allowed");
  require(both.empty() || !unpacks(packed(both), text, both.size() - 1), "the limit is held");
  if (tail.starts_with("\x1f\x8b")) return;
  const bool zeros = tail.find_first_not_of('\0') == std::string::npos;
  require(unpacks(packed(both) + tail, text) == zeros, "only zeros may follow");
  require(!zeros || text == both, "zeros that follow are left out");
}

void damaged(Reader reader) {
  const std::size_t at = reader.number(2);
  const std::uint8_t flip = reader.byte();
  const std::string_view text = text_of(reader.take(~std::size_t{0}));
  std::string bytes = packed(text), result;
  const std::size_t cut = at % bytes.size();
  if (cut >= 2) require(!unpacks(bytes.substr(0, cut), result), "what is cut short is refused");
  bytes[cut] = static_cast<char>(bytes[cut] ^ flip);
  if (!unpacks(bytes, result)) return;
  require(result == text || (cut < 2 && result == bytes), "damage is refused, or does none");
}

}  // namespace

void fuzz_gzip(Bytes input) {
  Reader reader{input};
  switch (reader.byte() % 3) {
    case 0: return as_it_is(input.subspan(input.empty() ? 0 : 1));
    case 1: return round_trip(reader);
    default: return damaged(reader);
  }
}

}  // namespace vericansim::fuzz
