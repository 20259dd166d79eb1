// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// OutputFile: see output_file.hpp.
#include "trace/output_file.hpp"

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <streambuf>

#include "trace/output_place.hpp"

namespace vericansim {
namespace {

constexpr const char *kCannotWrite = "cannot be written to its end";

/// zlib writes both kinds of files: compressed, or as it is ("T").
class ZlibBuffer : public std::streambuf {
 public:
  ZlibBuffer(const OutputPlace &place, const std::string &path, bool compressed)
      : path_{path}, by_lines_{place.direct()} {
    constexpr unsigned kBuffer = 1 << 16;
    file_ = ::gzdopen(place.descriptor(), compressed ? "wb" : "wbT");
    if (file_ == nullptr) {
      ::close(place.descriptor());
      throw OutputError(path, "cannot be opened for writing", ENOMEM);
    }
    ::gzbuffer(file_, kBuffer);
  }
  ~ZlibBuffer() override {
    if (file_ != nullptr) ::gzclose(file_);
  }
  ZlibBuffer(const ZlibBuffer &) = delete;
  ZlibBuffer &operator=(const ZlibBuffer &) = delete;

  /// Who caught a failure learns of it again, also where the disk has room by then: bytes are lost.
  void remember() const {
    if (failed_) throw OutputError(path_, kCannotWrite, *failed_);
  }
  void close() {
    remember();
    errno = 0;
    const gzFile file = file_;
    file_ = nullptr;
    if (::gzclose(file) != Z_OK) fail();
  }

 protected:
  std::streamsize xsputn(const char *text, std::streamsize size) override {
    write(text, size);
    if (by_lines_ && size > 0 && text[size - 1] == '\n') sync();
    return size;
  }
  int_type overflow(int_type c) override {
    const char letter = traits_type::to_char_type(c);
    if (!traits_type::eq_int_type(c, traits_type::eof())) xsputn(&letter, 1);
    return traits_type::not_eof(c);
  }
  int sync() override {
    errno = 0;
    if (::gzflush(file_, Z_SYNC_FLUSH) != Z_OK) fail();
    return 0;
  }

 private:
  void write(const char *text, std::streamsize size) {
    constexpr std::streamsize kPart = 1 << 30;  // zlib counts in unsigned int
    for (std::streamsize done = 0; done < size;) {
      const auto part = static_cast<unsigned>(std::min(size - done, kPart));
      errno = 0;
      if (::gzwrite(file_, text + done, part) <= 0) fail();
      done += part;
    }
  }
  [[noreturn]] void fail() {
    failed_ = errno != 0 ? errno : EIO;
    throw OutputError(path_, kCannotWrite, *failed_);
  }

  std::string path_;
  bool by_lines_;
  gzFile file_ = nullptr;
  std::optional<int> failed_;
};

}  // namespace

struct OutputFile::Impl {
  explicit Impl(const std::string &name)
      : path{name},
        compressed{name.ends_with(".gz")},
        place{name},
        buffer{place, name, compressed} {
    stream.exceptions(std::ios::badbit);
  }
  std::string path;
  bool compressed;
  OutputPlace place;
  ZlibBuffer buffer;
  std::ostream stream{&buffer};
};

OutputFile::OutputFile(std::string path) : impl_{std::make_unique<Impl>(std::move(path))} {}

OutputFile::~OutputFile() = default;

std::ostream &OutputFile::stream() {
  impl_->buffer.remember();
  return impl_->stream;
}

void OutputFile::commit() {
  impl_->buffer.close();
  impl_->place.rename();
}

void OutputFile::commit(const std::string &scratch) {
  if (impl_->place.direct() || impl_->compressed) {
    std::ifstream content{scratch, std::ios::binary};
    if (content.peek() != std::ifstream::traits_type::eof()) impl_->stream << content.rdbuf();
    ::unlink(scratch.c_str());
  } else {
    impl_->place.replace(scratch);
  }
  commit();
}

bool OutputFile::direct() const { return impl_->place.direct(); }

const std::string &OutputFile::path() const { return impl_->path; }

std::string OutputFile::make_scratch() const { return impl_->place.make_scratch(); }

}  // namespace vericansim
