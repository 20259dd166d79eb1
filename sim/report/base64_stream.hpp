// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Base64Stream: bytes to a stream, compressed (zlib, RFC 1950) and as base64 (RFC 4648), piece by
// piece.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <vector>

struct z_stream_s;  // zlib's state

namespace vericansim {

class Base64Stream {
 public:
  explicit Base64Stream(std::ostream &out);
  ~Base64Stream();
  Base64Stream(const Base64Stream &) = delete;
  Base64Stream &operator=(const Base64Stream &) = delete;

  void write(const void *data, std::size_t size);
  /// Ends the compressed stream; nothing may follow.
  void finish();

 private:
  void deflate_all(int flush);
  void encode(const std::uint8_t *data, std::size_t size);
  void encode_rest();

  std::ostream &out_;
  std::unique_ptr<z_stream_s> zlib_;
  std::vector<std::uint8_t> buffer_;
  std::uint8_t rest_[3] = {};  // bytes that make no group of three yet
  std::size_t rest_size_ = 0;
};

}  // namespace vericansim
