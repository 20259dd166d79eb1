// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Input files: see input_file.hpp.
#include "trace/input_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iostream>
#include <limits>
#include <utility>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// zlib's state, freed at the end.
class Inflater {
 public:
  explicit Inflater(std::string &bytes) {
    constexpr int kGzipOnly = 16 + MAX_WBITS;
    stream_.next_in = reinterpret_cast<Bytef *>(bytes.data());
    stream_.avail_in = static_cast<uInt>(bytes.size());
    good_ = inflateInit2(&stream_, kGzipOnly) == Z_OK;
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater &) = delete;
  Inflater &operator=(const Inflater &) = delete;

  /// Appends the next piece to `text`; false at the end. Several members follow each other, as cat
  /// writes them; zeros that fill the last block may follow the last one.
  bool next(std::string &text, const std::string &path, std::size_t most) {
    std::array<char, 65536> piece{};
    stream_.next_out = reinterpret_cast<Bytef *>(piece.data());
    stream_.avail_out = static_cast<uInt>(piece.size());
    const int status = good_ ? inflate(&stream_, Z_NO_FLUSH) : Z_MEM_ERROR;
    if (status != Z_OK && status != Z_STREAM_END)
      throw InputError(path, 0, status == Z_BUF_ERROR ? "cut short (gzip)" : "damaged (gzip)");
    text.append(piece.data(), piece.size() - stream_.avail_out);
    if (text.size() > most)
      throw InputError(path, 0, fmt::format("unpacks to more than {} MiB (gzip)", most >> 20));
    if (status == Z_OK) return true;
    const bool more =
        stream_.avail_in >= 2 && stream_.next_in[0] == 0x1F && stream_.next_in[1] == 0x8B;
    if (more) return inflateReset(&stream_) == Z_OK;
    if (std::any_of(stream_.next_in, stream_.next_in + stream_.avail_in,
                    [](Bytef byte) { return byte != 0; }))
      throw InputError(path, 0, "what follows the packed bytes is not packed (gzip)");
    return false;
  }

 private:
  z_stream stream_{};
  bool good_ = false;
};

std::string read_all(std::istream &in, const std::string &path, std::size_t most) {
  std::string text;
  std::array<char, 65536> piece{};
  while (in.read(piece.data(), piece.size()), in.gcount() > 0) {
    const auto count = static_cast<std::size_t>(in.gcount());
    if (count > most - text.size())
      throw InputError(path, 0, fmt::format("has more than {} bytes", most));
    text.append(piece.data(), count);
  }
  if (in.bad()) throw InputError(path, 0, "cannot be read to its end");
  return text;
}

/// What the system has just refused, with its reason.
std::string unreadable() {
  return fmt::format("cannot be opened for reading: {}", std::strerror(errno));
}

/// Once: it would be empty the second time.
std::string read_standard_input(std::size_t most) {
  static bool read = false;
  if (std::exchange(read, true))
    throw InputError("standard input", 0, "has been read already, as another file");
  return read_all(std::cin, "-", most);
}

}  // namespace

std::string unpacked(std::string bytes, const std::string &path, std::size_t most) {
  if (!bytes.starts_with("\x1f\x8b")) return bytes;
  if (bytes.size() > std::numeric_limits<uInt>::max())
    throw InputError(path, 0, "is larger than 4 GiB (gzip)");
  std::string text;
  Inflater inflater{bytes};
  while (inflater.next(text, path, most)) {
  }
  return text;
}

std::string read_bytes(const std::string &path, std::size_t most) {
  if (path == "-") return read_standard_input(most);
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    throw InputError(
        path, 0, errno == ENOENT || errno == ENOTDIR ? std::string{"no such file"} : unreadable());
  if (S_ISDIR(status.st_mode)) throw InputError(path, 0, "is a directory, not a file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, 0, unreadable());
  return read_all(file, path, most);
}

std::string read_text_file(const std::string &path, std::size_t most) {
  std::string text = unpacked(read_bytes(path, most), path, most);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

void refuse_utf16(std::string_view text, const std::string &path) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError(path, 0, "is text in UTF-16; allowed: UTF-8, as 'iconv -f UTF-16' makes it");
}

std::string_view without_gz(std::string_view path) {
  if (path.ends_with(".gz")) path.remove_suffix(3);
  return path;
}

}  // namespace vericansim
