// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ElfImage: see elf_image.hpp. The layout is that of the ELF specification (32-bit) and of "ELF for
// the ARM Architecture".
#include "firmware/elf_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "firmware/memory_map.hpp"
#include "trace/input_error.hpp"

namespace vericansim::firmware {
namespace {

constexpr std::size_t kHeaderSize = 52, kProgramSize = 32, kSectionSize = 40, kSymbolSize = 16;

class Parser {
 public:
  Parser(const std::string &path, const std::vector<std::uint8_t> &bytes) : bytes_{bytes} {
    image_.file = path;
  }

  ElfImage parse() {
    check_ident();
    check_header();
    read_segments();
    check_overlap();
    copy_segments();
    check_vectors();
    read_symbols();
    return std::move(image_);
  }

 private:
  struct Section {
    std::uint32_t type, offset, size, link;
  };
  struct Load {
    std::uint32_t address, offset, size;
  };

  [[noreturn]] void fail(const std::string &what) const { throw InputError(image_.file, 0, what); }

  [[nodiscard]] std::uint32_t u16(std::size_t at) const {
    return static_cast<std::uint32_t>(bytes_[at] | bytes_[at + 1] << 8);
  }
  [[nodiscard]] std::uint32_t u32(std::size_t at) const { return u16(at) | u16(at + 2) << 16; }
  [[nodiscard]] bool inside(std::uint64_t offset, std::uint64_t size) const {
    return offset + size <= bytes_.size();
  }

  void check_ident() const;
  void check_header();
  void read_segments();
  void read_segment(unsigned number, std::size_t at);
  void check_overlap() const;
  void copy_segments();
  void check_vectors() const;
  void read_symbols();
  void read_symbol_table(const Section &symbols, const Section &names);
  [[nodiscard]] std::optional<Section> section(std::uint32_t number) const;

  const std::vector<std::uint8_t> &bytes_;
  ElfImage image_;
  std::vector<Load> loads_;
  std::uint32_t program_headers_ = 0, program_count_ = 0;
};

void Parser::check_ident() const {
  if (bytes_.empty()) fail("the file is empty");
  const std::array<std::uint8_t, 4> magic{0x7F, 'E', 'L', 'F'};
  if (bytes_.size() < 4 || !std::equal(magic.begin(), magic.end(), bytes_.begin()))
    fail("is not an ELF file (it must begin with 7F 45 4C 46)");
  if (bytes_.size() < kHeaderSize)
    fail(fmt::format("ends after {} bytes, within the ELF header of {}", bytes_.size(),
                     kHeaderSize));
  if (bytes_[4] != 1)
    fail(fmt::format("ELF class {} is not allowed; allowed: 1 (32 bits)", bytes_[4]));
  if (bytes_[5] != 1)
    fail(fmt::format("ELF data encoding {} is not allowed; allowed: 1 (little-endian)", bytes_[5]));
}

void Parser::check_header() {
  constexpr std::uint32_t kExecutable = 2, kArm = 40;
  const auto want = [&](const char *name, std::uint32_t value, std::uint32_t allowed,
                        const char *meaning) {
    if (value != allowed)
      fail(fmt::format("{} {} is not allowed; allowed: {} ({})", name, value, allowed, meaning));
  };
  want("e_type", u16(16), kExecutable, "executable; link it first");
  want("e_machine", u16(18), kArm, "ARM");
  want("e_version", u32(20), 1, "the only one");
  image_.entry = u32(24);
  program_headers_ = u32(28);
  program_count_ = u16(44);
  if (program_count_ == 0) fail("has no program header; nothing can be loaded");
  want("e_phentsize", u16(42), kProgramSize, "size of a program header");
  if (!inside(program_headers_, std::uint64_t{program_count_} * kProgramSize))
    fail(
        fmt::format("the {} program headers at offset {} reach beyond the end of the file ({} "
                    "bytes)",
                    program_count_, program_headers_, bytes_.size()));
}

void Parser::read_segments() {
  constexpr std::uint32_t kLoad = 1;
  for (unsigned i = 0; i < program_count_; ++i) {
    const std::size_t at = program_headers_ + i * kProgramSize;
    if (u32(at) == kLoad) read_segment(i, at);
  }
  if (loads_.empty()) fail("has no segment with bytes to load");
}

void Parser::read_segment(unsigned number, std::size_t at) {
  const std::uint32_t offset = u32(at + 4), run = u32(at + 8), load = u32(at + 12),
                      file_size = u32(at + 16), memory_size = u32(at + 20);
  const std::string name = fmt::format("segment {}", number);
  if (file_size > memory_size)
    fail(fmt::format("{} has {} bytes in the file but only {} in memory", name, file_size,
                     memory_size));
  if (!inside(offset, file_size))
    fail(fmt::format("{} ({} bytes at offset {}) reaches beyond the end of the file ({} bytes)",
                     name, file_size, offset, bytes_.size()));
  if (memory_size == 0) return;
  const auto fits = [&](std::uint32_t address, std::uint32_t size) {
    return kFlash.contains(address, size) || kSram.contains(address, size);
  };
  const auto place = [&](const char *what, std::uint32_t address, std::uint32_t size) {
    if (!fits(address, size))
      fail(fmt::format("{} ({} bytes at {} {}) is outside the memory; allowed: {}-{}, {}-{}", name,
                       size, what, hex32(address), hex32(kFlash.base),
                       hex32(kFlash.base + kFlash.size - 1), hex32(kSram.base),
                       hex32(kSram.base + kSram.size - 1)));
  };
  place("address", run, memory_size);
  if (file_size == 0) return;
  place("load address", load, file_size);
  loads_.push_back({load, offset, file_size});
}

// Only what is in order is copied: many headers may name the same bytes of a small file.
void Parser::copy_segments() {
  for (const Load &segment : loads_) {
    const auto begin = bytes_.begin() + segment.offset;
    image_.segments.push_back({segment.address, {begin, begin + segment.size}});
  }
}

void Parser::check_overlap() const {
  auto sorted = loads_;
  std::sort(sorted.begin(), sorted.end(),
            [](const auto &a, const auto &b) { return a.address < b.address; });
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].address - sorted[i - 1].address < sorted[i - 1].size)
      fail(fmt::format("segments overlap at load address {}", hex32(sorted[i].address)));
}

// The CPU starts with the two words at 0: stack pointer and reset vector.
void Parser::check_vectors() const {
  for (const ElfSegment &segment : image_.segments) {
    if (segment.address != 0 || segment.bytes.size() < 8) continue;
    const auto word = [&](std::size_t at) {
      return static_cast<std::uint32_t>(segment.bytes[at] | segment.bytes[at + 1] << 8 |
                                        segment.bytes[at + 2] << 16) |
             static_cast<std::uint32_t>(segment.bytes[at + 3]) << 24;
    };
    const std::uint32_t stack = word(0), reset = word(4);
    if (stack % 4 != 0 || stack <= kSram.base || stack > kSram.base + kSram.size)
      fail(
          fmt::format("initial stack pointer {} (word at 0) is not allowed; allowed: a multiple "
                      "of 4 above {}, up to {}",
                      hex32(stack), hex32(kSram.base), hex32(kSram.base + kSram.size)));
    const bool code = kFlash.contains(reset & ~1U, 2) || kSram.contains(reset & ~1U, 2);
    if (reset % 2 == 0 || !code)
      fail(
          fmt::format("reset vector {} (word at 4) is not allowed; allowed: an odd address (Thumb "
                      "code) in flash or SRAM",
                      hex32(reset)));
    return;
  }
  fail("has no vector table: no segment holds the words at 0x00000000 and 0x00000004");
}

std::optional<Parser::Section> Parser::section(std::uint32_t number) const {
  const std::uint64_t at = u32(32) + std::uint64_t{number} * kSectionSize;
  if (number >= u16(48) || u16(46) != kSectionSize || !inside(at, kSectionSize)) return {};
  const auto p = static_cast<std::size_t>(at);
  return Section{u32(p + 4), u32(p + 16), u32(p + 20), u32(p + 24)};
}

// Names are for reports only: a table that cannot be read is left out, not refused.
void Parser::read_symbols() {
  constexpr std::uint32_t kSymbolTable = 2;
  for (std::uint32_t i = 0; i < u16(48); ++i) {
    const auto symbols = section(i);
    if (!symbols || symbols->type != kSymbolTable) continue;
    const auto names = section(symbols->link);
    if (names && inside(symbols->offset, symbols->size) && inside(names->offset, names->size))
      read_symbol_table(*symbols, *names);
    break;  // the specification allows one
  }
  std::stable_sort(image_.functions.begin(), image_.functions.end(),
                   [](const auto &a, const auto &b) { return a.address < b.address; });
}

void Parser::read_symbol_table(const Section &symbols, const Section &names) {
  constexpr unsigned kFunction = 2;
  constexpr std::uint32_t kLongestName = 1024;  // longer ones are cut
  // Many symbols may have one name: where the names together would be larger than the file, they
  // are cut, the last ones to nothing.
  std::size_t room = bytes_.size();
  for (std::uint32_t at = 0; at + kSymbolSize <= symbols.size; at += kSymbolSize) {
    const std::size_t p = symbols.offset + at;
    if ((bytes_[p + 12] & 0xF) != kFunction || u32(p) >= names.size) continue;
    const auto begin = bytes_.begin() + names.offset + u32(p);
    const auto most = bytes_.begin() + names.offset + std::min(names.size, u32(p) + kLongestName);
    auto end = std::find(begin, most, std::uint8_t{0});
    if (static_cast<std::size_t>(end - begin) > room)
      end = begin + static_cast<std::ptrdiff_t>(room);
    room -= static_cast<std::size_t>(end - begin);
    image_.functions.push_back({u32(p + 4) & ~1U, u32(p + 8), {begin, end}});
  }
}

}  // namespace

std::string ElfImage::place(std::uint32_t address) const {
  const auto after =
      std::upper_bound(functions.begin(), functions.end(), address,
                       [](std::uint32_t a, const ElfSymbol &s) { return a < s.address; });
  if (after == functions.begin()) return "";
  const ElfSymbol &symbol = *std::prev(after);
  const std::uint32_t offset = address - symbol.address;
  if (offset >= std::max(symbol.size, 2U)) return "";
  return offset == 0 ? symbol.name : fmt::format("{}+0x{:X}", symbol.name, offset);
}

ElfImage parse_elf(const std::string &path, const std::vector<std::uint8_t> &bytes) {
  return Parser{path, bytes}.parse();
}

ElfImage read_elf(const std::string &path) {
  if (std::error_code none; std::filesystem::is_directory(path, none))
    throw InputError(path, 0, "is a directory");
  constexpr std::uintmax_t kLargest = 64 << 20;  // with debug information
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kLargest)
    throw InputError(path, 0, fmt::format("has {} bytes; allowed: up to {}", size, kLargest));
  std::ifstream file(path, std::ios::binary);
  if (error || !file) throw InputError(path, 0, "no such file, or it cannot be read");
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  return parse_elf(path, bytes);
}

}  // namespace vericansim::firmware
