// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Semihosting calls, against "Semihosting for AArch32 and AArch64" (Arm).
#include "firmware/semihosting.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace {

using namespace vericansim::firmware;

class NoDevices : public DeviceSpace {
 public:
  DeviceReply access(unsigned, const DeviceAccess &) override { return {}; }
};

constexpr std::uint32_t kBlock = 0x2000'0100, kText = 0x2000'0200;

struct SemihostingCall : ::testing::Test {
  SemihostingCall() {
    host.on_output = [this](std::string_view text) { printed += text; };
    host.microseconds = [this] { return now; };
  }
  void put_text(const std::string &text) {
    for (std::size_t i = 0; i <= text.size(); ++i)
      engine.write(kText + static_cast<std::uint32_t>(i), 1,
                   i < text.size() ? static_cast<unsigned char>(text[i]) : 0);
  }
  std::uint32_t call(std::uint32_t operation, std::uint32_t parameter) {
    engine.set_reg(0, operation);
    engine.set_reg(1, parameter);
    complaint = host.serve(engine);
    return engine.reg(0);
  }
  std::uint32_t call_block(std::uint32_t operation, std::initializer_list<std::uint32_t> words) {
    std::uint32_t at = kBlock;
    for (const std::uint32_t word : words) {
      engine.write(at, 4, word);
      at += 4;
    }
    return call(operation, kBlock);
  }

  NoDevices devices;
  Engine engine{devices, {}};
  Semihosting host;
  std::string printed;
  std::optional<std::string> complaint;
  std::uint64_t now = 0;
};

TEST_F(SemihostingCall, Output) {
  put_text("hello\n");
  call(0x04, kText);                               // SYS_WRITE0
  call(0x03, kText + 1);                           // SYS_WRITEC
  EXPECT_EQ(call_block(0x05, {1, kText, 3}), 0U);  // SYS_WRITE
  EXPECT_EQ(printed, "hello\nehel");
  EXPECT_EQ(call_block(0x05, {0, kText, 3}), 3U);  // not to standard input
  EXPECT_FALSE(complaint);
}

TEST_F(SemihostingCall, ConsoleFiles) {
  put_text(":tt");
  EXPECT_EQ(call_block(0x01, {kText, 4, 3}), 1U);
  EXPECT_EQ(call_block(0x09, {1}), 1U);
  EXPECT_EQ(call_block(0x02, {1}), 0U);
  EXPECT_EQ(call_block(0x06, {0, kText, 10}), 10U);  // SYS_READ: at the end
  put_text("secret.txt");
  EXPECT_EQ(call_block(0x01, {kText, 0, 10}), 0xFFFF'FFFFU);  // no files
  EXPECT_EQ(call(0x07, 0), 0xFFFF'FFFFU);
}

// newlib's exit() uses SYS_EXIT_EXTENDED where this file tells of it, and SYS_EXIT, which has no
// exit code, elsewhere.
TEST_F(SemihostingCall, FeaturesTellOfTheExitCode) {
  put_text(":semihosting-features");
  EXPECT_EQ(call_block(0x01, {kText, 4, 21}), 0xFFFF'FFFFU);  // only for reading
  const std::uint32_t file = call_block(0x01, {kText, 0, 21});
  ASSERT_NE(file, 0xFFFF'FFFFU);
  EXPECT_EQ(call_block(0x0C, {file}), 5U);  // SYS_FLEN
  EXPECT_EQ(call_block(0x09, {file}), 0U);  // SYS_ISTTY
  put_text("????????");
  EXPECT_EQ(call_block(0x06, {file, kText, 4}), 0U);
  EXPECT_EQ(engine.read(kText, 4), 0x4246'4853U);  // "SHFB"
  EXPECT_EQ(call_block(0x06, {file, kText + 4, 4}), 3U);
  EXPECT_EQ(engine.read(kText + 4, 4), 0x3F3F'3F03U);  // SH_EXT_EXIT_EXTENDED, SH_EXT_STDOUT_STDERR
  EXPECT_EQ(call_block(0x06, {file, kText, 1}), 1U);   // the end
  EXPECT_EQ(call_block(0x0A, {file, 4}), 0U);          // SYS_SEEK
  EXPECT_EQ(call_block(0x06, {file, kText, 1}), 0U);
  EXPECT_EQ(engine.read(kText, 1), 3U);
  EXPECT_EQ(call_block(0x0A, {file, 6}), 0xFFFF'FFFFU);
  EXPECT_EQ(call_block(0x05, {file, kText, 3}), 3U);  // not written
  EXPECT_EQ(call_block(0x02, {file}), 0U);
  EXPECT_EQ(call_block(0x0C, {1}), 0xFFFF'FFFFU);    // the console has no length
  EXPECT_EQ(call_block(0x06, {file, 0x10, 1}), 1U);  // at the end: nothing is written
  EXPECT_FALSE(complaint);
  ASSERT_EQ(call_block(0x0A, {file, 0}), 0U);
  call_block(0x06, {file, 0x10, 1});  // flash
  ASSERT_TRUE(complaint);
  EXPECT_EQ(printed, "");
}

TEST_F(SemihostingCall, Time) {
  now = 12'345'678'901;
  EXPECT_EQ(call(0x10, 0), 1'234'567U);  // SYS_CLOCK: hundredths of a second
  EXPECT_EQ(call(0x11, 0), 12'345U);
  EXPECT_EQ(call(0x31, 0), 1'000'000U);
  EXPECT_EQ(call(0x30, kBlock), 0U);
  EXPECT_EQ(engine.read(kBlock, 4), 12'345'678'901U & 0xFFFF'FFFF);
  EXPECT_EQ(engine.read(kBlock + 4, 4), 2U);
}

TEST_F(SemihostingCall, Exit) {
  EXPECT_FALSE(host.exit_code());
  call(0x18, 0x2'0026);
  EXPECT_EQ(host.exit_code(), 0);
  call(0x18, 0x2'0023);  // a run-time error
  EXPECT_EQ(host.exit_code(), 1);
  call_block(0x20, {0x2'0026, 7});
  EXPECT_EQ(host.exit_code(), 7);
}

TEST_F(SemihostingCall, BadPointersAndUnknownCalls) {
  call(0x04, 0x9000'0000);
  ASSERT_TRUE(complaint);
  EXPECT_EQ(*complaint, "text at 0x90000000 reaches beyond the memory");
  call(0x05, 0x4005'0000);
  ASSERT_TRUE(complaint);
  EXPECT_EQ(*complaint, "no parameter block at 0x40050000");
  call(0x30, 0x10);  // flash
  ASSERT_TRUE(complaint);
  EXPECT_EQ(call(0x99, 0), 0xFFFF'FFFFU);
  EXPECT_FALSE(complaint);
}

}  // namespace
