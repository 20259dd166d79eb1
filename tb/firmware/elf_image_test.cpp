// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The ELF reader: a file built here field by field (ELF specification, 32-bit), then broken in one
// field after the other.
#include "firmware/elf_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "firmware/tool_run.hpp"
#include "trace/input_error.hpp"

namespace {

using namespace vericansim;
using namespace vericansim::firmware;
using ::testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

void put16(Bytes &file, std::size_t at, unsigned value) {
  file[at] = static_cast<std::uint8_t>(value);
  file[at + 1] = static_cast<std::uint8_t>(value >> 8);
}
void put32(Bytes &file, std::size_t at, std::uint32_t value) {
  put16(file, at, value & 0xFFFF);
  put16(file, at + 2, value >> 16);
}

constexpr std::size_t kHeader = 52, kProgram = 32, kFirst = kHeader, kSecond = kHeader + kProgram;
constexpr std::uint32_t kCode = kHeader + 2 * kProgram, kCodeSize = 16, kData = kCode + kCodeSize;

void put_segment(Bytes &file, std::size_t at, std::uint32_t offset, std::uint32_t run,
                 std::uint32_t load, std::uint32_t size, std::uint32_t memory) {
  put32(file, at, 1);  // PT_LOAD
  put32(file, at + 4, offset);
  put32(file, at + 8, run);
  put32(file, at + 12, load);
  put32(file, at + 16, size);
  put32(file, at + 20, memory);
}

/// Vectors and code at 0, four bytes of data that are copied to SRAM.
Bytes good_file() {
  Bytes file(kData + 4);
  const Bytes ident{0x7F, 'E', 'L', 'F', 1, 1, 1};
  std::copy(ident.begin(), ident.end(), file.begin());
  put16(file, 16, 2);   // ET_EXEC
  put16(file, 18, 40);  // EM_ARM
  put32(file, 20, 1);
  put32(file, 24, 9);
  put32(file, 28, kHeader);
  put16(file, 42, kProgram);
  put16(file, 44, 2);
  put_segment(file, kFirst, kCode, 0, 0, kCodeSize, kCodeSize);
  put_segment(file, kSecond, kData, 0x2000'0000, kCodeSize, 4, 64);
  put32(file, kCode, 0x2001'0000);
  put32(file, kCode + 4, 9);
  put32(file, kData, 0x1234'5678);
  return file;
}

TEST(ElfImage, GoodFile) {
  const ElfImage image = parse_elf("good.elf", good_file());
  ASSERT_EQ(image.segments.size(), 2U);
  EXPECT_EQ(image.segments[0].address, 0U);
  EXPECT_EQ(image.segments[0].bytes.size(), kCodeSize);
  EXPECT_EQ(image.segments[1].address, kCodeSize);  // the load address, not that of the run
  EXPECT_EQ(image.segments[1].bytes, (Bytes{0x78, 0x56, 0x34, 0x12}));
  EXPECT_EQ(image.entry, 9U);
  EXPECT_TRUE(image.functions.empty());
}

TEST(ElfImage, EachBrokenFieldIsNamed) {
  struct Case {
    std::function<void(Bytes &)> damage;
    const char *what;
  };
  const std::vector<Case> cases = {
      {[](Bytes &f) { f.clear(); }, "the file is empty"},
      {[](Bytes &f) { f[0] = 'M'; }, "is not an ELF file"},
      {[](Bytes &f) { f.resize(3); }, "is not an ELF file"},
      {[](Bytes &f) { f.resize(51); }, "ends after 51 bytes, within the ELF header"},
      {[](Bytes &f) { f[4] = 2; }, "ELF class 2 is not allowed; allowed: 1 (32 bits)"},
      {[](Bytes &f) { f[5] = 2; }, "data encoding 2 is not allowed; allowed: 1 (little-endian)"},
      {[](Bytes &f) { put16(f, 16, 1); }, "e_type 1 is not allowed; allowed: 2 (executable"},
      {[](Bytes &f) { put16(f, 18, 62); }, "e_machine 62 is not allowed; allowed: 40 (ARM)"},
      {[](Bytes &f) { put32(f, 20, 0); }, "e_version 0"},
      {[](Bytes &f) { put16(f, 42, 56); }, "e_phentsize 56"},
      {[](Bytes &f) { put16(f, 44, 0); }, "no program header"},
      {[](Bytes &f) { put16(f, 44, 40); }, "40 program headers at offset 52 reach beyond"},
      {[](Bytes &f) { put32(f, 28, 0xFFFF'FFF0); }, "reach beyond the end of the file"},
      {[](Bytes &f) { put32(f, kFirst, 2), put32(f, kSecond, 2); }, "no segment with bytes"},
      {[](Bytes &f) { put32(f, kFirst + 4, 0xFFFF'FFFF); }, "segment 0 (16 bytes at offset"},
      {[](Bytes &f) {
         put32(f, kSecond + 16, 5);
         put32(f, kSecond + 20, 5);
       },
       "segment 1 (5 bytes at offset 132) reaches beyond the end of the file (136 bytes)"},
      {[](Bytes &f) { put32(f, kSecond + 20, 3); },
       "segment 1 has 4 bytes in the file but only 3 in memory"},
      {[](Bytes &f) { put32(f, kSecond + 8, 0x3000'0000); },
       "segment 1 (64 bytes at address 0x30000000) is outside the memory; allowed: 0x00000000-"},
      {[](Bytes &f) { put32(f, kSecond + 20, 65537); }, "segment 1 (65537 bytes at address"},
      {[](Bytes &f) { put32(f, kSecond + 12, 0x0007'FFFE); },
       "segment 1 (4 bytes at load address 0x0007FFFE) is outside the memory"},
      {[](Bytes &f) { put32(f, kSecond + 12, 12); }, "segments overlap at load address 0x0000000C"},
      {[](Bytes &f) { put32(f, kCode, 0); }, "initial stack pointer 0x00000000 (word at 0)"},
      {[](Bytes &f) { put32(f, kCode, 0x2000'1002); }, "initial stack pointer 0x20001002"},
      {[](Bytes &f) { put32(f, kCode, 0x2001'0004); }, "initial stack pointer 0x20010004"},
      {[](Bytes &f) { put32(f, kCode + 4, 8); }, "reset vector 0x00000008 (word at 4)"},
      {[](Bytes &f) { put32(f, kCode + 4, 0x4005'0001); }, "reset vector 0x40050001"},
      {[](Bytes &f) {
         put32(f, kFirst + 8, 0x100);
         put32(f, kFirst + 12, 0x100);
       },
       "no vector table"},
  };
  for (const Case &c : cases) {
    Bytes file = good_file();
    c.damage(file);
    try {
      (void)parse_elf("bad.elf", file);
      ADD_FAILURE() << "not refused: " << c.what;
    } catch (const InputError &error) {
      EXPECT_THAT(error.what(), HasSubstr(c.what));
      EXPECT_THAT(error.what(), ::testing::StartsWith("bad.elf: "));
    }
  }
}

// No damage, however odd, leads to anything but a file or an InputError (run with the sanitizers).
TEST(ElfImage, RandomDamage) {
  const std::string text = tb::slurp(tb::test_elf("cpu"));
  const Bytes original(text.begin(), text.end());
  std::mt19937 random(3);
  unsigned refused = 0;
  for (int i = 0; i < 3000; ++i) {
    Bytes file = original;
    for (int n = 0; n < 4; ++n) {
      // Headers more often than the rest.
      const std::size_t range = n < 3 ? 200 : file.size();
      file[random() % range] = static_cast<std::uint8_t>(random());
    }
    if (i % 5 == 0) file.resize(random() % file.size());
    try {
      (void)parse_elf("damaged.elf", file).place(random());
    } catch (const InputError &) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000U);
}

TEST(ElfImage, FunctionsGivePlaces) {
  const ElfImage image = read_elf(tb::test_elf("faulty"));
  std::uint32_t reader = 0;
  for (const ElfSymbol &symbol : image.functions)
    if (symbol.name == "reader") reader = symbol.address;
  ASSERT_NE(reader, 0U);
  EXPECT_EQ(image.place(reader), "reader");
  EXPECT_EQ(image.place(reader + 2), "reader+0x2");
  EXPECT_EQ(image.place(0x2000'0000), "");
}

TEST(ElfImage, FilesThatAreNone) {
  EXPECT_THROW((void)read_elf("/no/such.elf"), InputError);
  EXPECT_THROW((void)read_elf(::testing::TempDir()), InputError);
}

}  // namespace
