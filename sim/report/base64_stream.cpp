// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Base64Stream: see base64_stream.hpp.
#include "report/base64_stream.hpp"

#include <zlib.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace vericansim {
namespace {

constexpr std::size_t kBuffer = 1 << 16;
constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void append_group(std::string &text, const std::uint8_t *bytes, std::size_t size) {
  const std::uint32_t word = static_cast<std::uint32_t>(bytes[0]) << 16 |
                             (size > 1 ? static_cast<std::uint32_t>(bytes[1]) << 8 : 0U) |
                             (size > 2 ? bytes[2] : 0U);
  for (unsigned i = 0; i < 4; ++i)
    text += i <= size ? kAlphabet[(word >> (18 - 6 * i)) & 0x3F] : '=';
}

}  // namespace

Base64Stream::Base64Stream(std::ostream &out)
    : out_{out}, zlib_{std::make_unique<z_stream_s>()}, buffer_(kBuffer) {
  if (deflateInit(zlib_.get(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("zlib failed");
}

Base64Stream::~Base64Stream() { deflateEnd(zlib_.get()); }

void Base64Stream::write(const void *data, std::size_t size) {
  constexpr std::size_t kPart = std::size_t{1} << 30;  // zlib counts in unsigned int
  const auto *bytes = static_cast<const std::uint8_t *>(data);
  for (std::size_t done = 0; done < size;) {
    const std::size_t part = std::min(size - done, kPart);
    zlib_->next_in = const_cast<std::uint8_t *>(bytes + done);
    zlib_->avail_in = static_cast<unsigned>(part);
    deflate_all(Z_NO_FLUSH);
    done += part;
  }
}

void Base64Stream::finish() {
  zlib_->avail_in = 0;
  deflate_all(Z_FINISH);
  encode_rest();
}

void Base64Stream::deflate_all(int flush) {
  do {
    zlib_->next_out = buffer_.data();
    zlib_->avail_out = kBuffer;
    deflate(zlib_.get(), flush);
    encode(buffer_.data(), kBuffer - zlib_->avail_out);
  } while (zlib_->avail_out == 0);
}

void Base64Stream::encode(const std::uint8_t *data, std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) {
    rest_[rest_size_++] = data[i];
    if (rest_size_ < sizeof rest_) continue;
    append_group(text, rest_, rest_size_);
    rest_size_ = 0;
  }
  out_ << text;
}

void Base64Stream::encode_rest() {
  std::string text;
  if (rest_size_ != 0) append_group(text, rest_, rest_size_);
  out_ << text;
  rest_size_ = 0;
}

}  // namespace vericansim
