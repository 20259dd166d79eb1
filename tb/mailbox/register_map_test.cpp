// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Every bit of every register, by the table that is made from the register map: reset values, what
// a write changes in which mode, reserved bits and offsets, both resets, byte and half-word access.
// That the map is FlexCAN's is checked by hand-written values in can_registers_test.cpp.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bus/faults.hpp"
#include "mailbox/mailbox_rig.hpp"
#include "mailbox/register_table.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kFen = 1u << 29;
constexpr std::uint32_t kModeBits = reg::kMcrMdis | reg::kMcrFrz | reg::kMcrHalt;

/// All features in three sizes, and the profiles.
const std::vector<CoreBuild> kAllBuilds = [] {
  std::vector<CoreBuild> builds{{.name = "16", .num_mb = 16}, {.name = "32", .num_mb = 32}};
  builds.insert(builds.end(), std::begin(kCoreBuilds), std::end(kCoreBuilds));
  return builds;
}();
std::string build_name(const ::testing::TestParamInfo<CoreBuild> &test) { return test.param.name; }

/// The modes that make a difference to a write.
enum class Mode : std::uint8_t { kDisable, kFreeze, kFreezeWithWrnEn, kNormal };

const RegisterRow &row_of(const std::string &name) {
  for (const RegisterRow &row : kRegisterTable)
    if (name == row.name) return row;
  throw std::out_of_range(name);
}

class RegisterMap : public ::testing::TestWithParam<CoreBuild> {
 protected:
  RegisterMap() : rig_{1, build_} {
    rig_.run(300);  // until the buffer RAM is cleared
  }

  void enter(Mode mode) {
    mode_ = mode;
    if (mode == Mode::kDisable) return;
    // Listen-only: buffers that happen to get a transmit code send nothing.
    rig_.configure(0, {.ctrl = kTiming8 | reg::kCtrlLom});
    if (mode == Mode::kFreeze) rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) & ~reg::kMcrWrnEn);
    if (mode == Mode::kNormal) rig_.go(0);
  }

  [[nodiscard]] unsigned count(const RegisterRow &row) const {
    return row.count == 0 ? num_mb_ : row.count;
  }
  [[nodiscard]] bool exists(const RegisterRow &row) const {
    return num_mb_ >= row.min_num_mb && row.missing(build_.features) != 0xFFFFFFFF;
  }
  /// The bits that the core has, of a register with a bit for each buffer.
  [[nodiscard]] std::uint32_t present(const RegisterRow &row) const {
    if (!exists(row)) return 0;
    if (row.first_buffer < 0 || num_mb_ >= 32u + static_cast<unsigned>(row.first_buffer))
      return ~row.missing(build_.features);
    return (1u << (num_mb_ - static_cast<unsigned>(row.first_buffer))) - 1;
  }
  /// What the bits read that the core lacks.
  [[nodiscard]] std::uint32_t fixed(const RegisterRow &row) const {
    const std::uint32_t value = row.without + (row.without_adds_last_mb ? num_mb_ - 1 : 0);
    return value & row.missing(build_.features);
  }
  [[nodiscard]] std::uint32_t reset_value(const RegisterRow &row) const {
    return ((row.reset + (row.adds_num_mb ? num_mb_ : 0)) & present(row)) | fixed(row);
  }
  /// Whether a hard reset brings it to its reset value.
  [[nodiscard]] bool is_reset(const RegisterRow &row) const {
    return !row.in_ram || build_.features.clear_ram;
  }
  /// The bits that a write changes in the present mode.
  [[nodiscard]] std::uint32_t writable(const RegisterRow &row) const {
    std::uint32_t bits = row.any;
    if (mode_ == Mode::kDisable) bits |= row.disable;
    if (mode_ == Mode::kFreeze || mode_ == Mode::kFreezeWithWrnEn) bits |= row.freeze;
    if (mode_ == Mode::kFreezeWithWrnEn || mode_ == Mode::kNormal) bits |= row.wrn_en;
    return bits & present(row);
  }
  /// The bits whose value is known: on the bus, states change by themselves.
  [[nodiscard]] std::uint32_t steady(const RegisterRow &row) const {
    return mode_ == Mode::kNormal ? ~row.live : 0xFFFFFFFF;
  }
  /// `value` for a write that does not change the mode.
  static std::uint32_t same_mode(const RegisterRow &row, std::uint32_t value, std::uint32_t old) {
    if (row.offset != reg::kMcr) return value;
    return (value & ~(kModeBits | reg::kMcrSoftRst)) | (old & kModeBits);
  }

  void for_each_row(const std::function<void(const RegisterRow &)> &check) {
    for (const RegisterRow &row : kRegisterTable) {
      SCOPED_TRACE(row.name);
      check(row);
    }
  }
  /// Calls `check` with the offset of every register, or of the first and last of each array.
  void for_each_register(bool all,
                         const std::function<void(const RegisterRow &, std::uint32_t)> &check) {
    for_each_row([&](const RegisterRow &row) {
      const unsigned last = count(row) - 1;
      for (unsigned i = 0; i <= last; ++i) {
        if (!all && i != 0 && i != last) continue;
        check(row, row.offset + i * row.stride);
      }
    });
  }
  std::set<std::uint32_t> implemented() {
    std::set<std::uint32_t> offsets;
    for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
      if (exists(row)) offsets.insert(offset);
    });
    return offsets;
  }

  /// Writes and expects what the table says; puts the old value back.
  void check_write(const RegisterRow &row, std::uint32_t offset, std::uint32_t pattern) {
    const std::uint32_t old = rig_.read(0, offset);
    rig_.write(0, offset, same_mode(row, pattern, old));
    const std::uint32_t bits = writable(row);
    const std::uint32_t expected =
        (old & ~bits & ~(pattern & row.w1c)) | (same_mode(row, pattern, old) & bits);
    EXPECT_EQ(rig_.read(0, offset) & steady(row), expected & steady(row))
        << "offset " << std::hex << offset << " was " << old << ", written " << pattern;
    rig_.write(0, offset, old);
  }

  void check_writes_of_every_bit() {
    for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
      for (std::uint32_t pattern : {0xFFFFFFFFu, 0u, 0xAAAAAAAAu, 0x55555555u})
        check_write(row, offset, pattern);
    });
    for_each_register(false, [&](const RegisterRow &row, std::uint32_t offset) {
      for (unsigned bit = 0; bit < 32; ++bit) {
        check_write(row, offset, 1u << bit);
        check_write(row, offset, ~(1u << bit));
      }
    });
  }

  /// Gives every bit that can be written in freeze mode another value than that of reset, as far as
  /// the node can still go to the bus after it. The values, read before MCR.FEN is set, which
  /// makes filter words of buffers.
  std::map<std::uint32_t, std::uint32_t> fill() {
    std::map<std::uint32_t, std::uint32_t> values;
    for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
      std::uint32_t value = same_mode(row, ~row.reset, rig_.read(0, offset));
      if (offset == reg::kMcr) value = (value & ~kFen) | reg::kMcrWrnEn;
      if (offset == reg::kCtrl) value = 0x01DBCCEF;  // listen-only, 1 + 8 + 4 + 4 quanta
      rig_.write(0, offset, value);
    });
    for_each_register(true, [&](const RegisterRow &, std::uint32_t offset) {
      values[offset] = rig_.read(0, offset);
    });
    rig_.write(0, reg::kMcr, values.at(reg::kMcr) | kFen);
    return values;
  }

  /// `full` with what this core has instead of bits that it lacks.
  [[nodiscard]] std::uint32_t mcr(std::uint32_t full) const {
    const RegisterRow &row = row_of("MCR");
    return (full & ~row.missing(build_.features)) | fixed(row);
  }
  void soft_reset() {
    rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
    ASSERT_TRUE(
        rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrSoftRst) == 0; }, 2000));
    mode_ = Mode::kFreeze;
  }
  void check_after_soft_reset(const std::map<std::uint32_t, std::uint32_t> &before) {
    EXPECT_EQ(rig_.read(0, reg::kMcr), mcr(0x5980000F));
    for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
      const std::uint32_t kept = row.kept & ~row.wrn_en;  // those are hidden: WRN_EN is 0
      const std::uint32_t compared = ~(row.live & row.ro) & ~(offset == reg::kMcr ? kModeBits : 0);
      const std::uint32_t expected = (before.at(offset) & kept) |
                                     (row.after_soft_reset & ~row.kept & present(row)) |
                                     (fixed(row) & ~row.kept);
      EXPECT_EQ(rig_.read(0, offset) & compared, expected & compared)
          << "offset " << std::hex << offset << " was " << before.at(offset);
    });
  }

  CoreBuild build_ = build_of_test(GetParam());
  unsigned num_mb_ = build_.num_mb;
  MailboxRig rig_;
  Mode mode_ = Mode::kDisable;
};

// Rows of flexcan.md section 1 that speak of what these tests check, of access and resets:
// FX-MAP.MCR FX-MAP.CTRL1 FX-MAP.TIMER FX-MAP.TCR FX-MAP.RXGMASK FX-MAP.RX14MASK FX-MAP.RX15MASK
// FX-MAP.ECR FX-MAP.ESR1 FX-MAP.IMASK2 FX-MAP.IMASK1 FX-MAP.IFLAG2 FX-MAP.IFLAG1 FX-MAP.CTRL2
// FX-MAP.ESR2 FX-MAP.IMEUR FX-MAP.CRCR FX-MAP.RXFGMASK FX-MAP.RXFIR FX-MAP.CBT FX-MAP.DBG FX-MAP.MB
// FX-MAP.RXIMR FX-MAP.GFWR FX-MAP.MECR FX-MAP.FD
// FX-MCR.FEN FX-MCR.DOZE FX-MCR.SRX_DIS FX-MCR.BCC FX-MCR.LPRIO_EN FX-MCR.AEN FX-MCR.IDAM
// FX-MCR.MAXMB FX-MCR.RAZ
// FX-CTRL1.PRESDIV FX-CTRL1.RJW FX-CTRL1.PSEG1 FX-CTRL1.PSEG2 FX-CTRL1.BOFF_MSK FX-CTRL1.ERR_MSK
// FX-CTRL1.CLK_SRC FX-CTRL1.LPB FX-CTRL1.TWRN_MSK FX-CTRL1.RWRN_MSK FX-CTRL1.SMP FX-CTRL1.BOFF_REC
// FX-CTRL1.TSYN FX-CTRL1.LBUF FX-CTRL1.LOM FX-CTRL1.PROPSEG FX-CTRL1.RAZ
// FX-ECR.TEC FX-ECR.REC FX-ESR1.RAZ FX-CTRL2.RAZ FX-CTRL2.ECRWRE FX-CTRL2.WRMFRZ FX-CTRL2.TASD
// FX-2.1.c FX-2.3.b FX-2.3.c FX-3.1.a FX-3.2.k
INSTANTIATE_TEST_SUITE_P(Build, RegisterMap, ::testing::ValuesIn(kAllBuilds), build_name);

TEST_P(RegisterMap, EveryRegisterHasItsResetValue) {
  for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
    if (!is_reset(row)) return;
    EXPECT_EQ(rig_.read(0, offset), reset_value(row)) << std::hex << offset;
  });
}

TEST_P(RegisterMap, EveryBitInDisableMode) {
  enter(Mode::kDisable);
  check_writes_of_every_bit();
}

TEST_P(RegisterMap, EveryBitInFreezeMode) {
  enter(Mode::kFreeze);
  check_writes_of_every_bit();
}

TEST_P(RegisterMap, EveryBitInFreezeModeWithWrnEn) {
  enter(Mode::kFreezeWithWrnEn);
  check_writes_of_every_bit();
}

TEST_P(RegisterMap, EveryBitOnTheBus) {
  enter(Mode::kNormal);
  check_writes_of_every_bit();
}

TEST_P(RegisterMap, BytesAndHalfWordsReachTheirLanesOnly) {
  enter(Mode::kFreezeWithWrnEn);
  for_each_register(false, [&](const RegisterRow &row, std::uint32_t offset) {
    for (AhbSize size : {AhbSize::kByte, AhbSize::kHalf}) {
      const unsigned bits = size == AhbSize::kByte ? 8 : 16;
      const std::uint32_t ones = (1u << bits) - 1;
      for (unsigned low = 0; low < 32; low += bits) {
        for (std::uint32_t pattern : {0xFFFFFFFFu, 0u, 0xA5C3965Au}) {
          const std::uint32_t old = rig_.read(0, offset), at = offset + low / 8;
          const std::uint32_t value = same_mode(row, pattern, old);
          const std::uint32_t changed = writable(row) & (ones << low);
          rig_.access(0,
                      {.address = at, .write = true, .size = size, .data = (value >> low) & ones});
          const std::uint32_t cleared = value & row.w1c & (ones << low);
          const std::uint32_t expected = (old & ~changed & ~cleared) | (value & changed);
          EXPECT_EQ(rig_.access(0, {.address = at, .size = size}).data, (expected >> low) & ones);
          EXPECT_EQ(rig_.read(0, offset), expected) << std::hex << at << " written " << pattern;
          rig_.write(0, offset, old);
        }
      }
    }
  });
}

TEST_P(RegisterMap, ReservedOffsetsReadZeroAndWriteNothing) {
  enter(Mode::kFreeze);
  const std::set<std::uint32_t> used = implemented();
  std::map<std::uint32_t, std::uint32_t> before;
  for (std::uint32_t offset : used) before[offset] = rig_.read(0, offset);
  for (std::uint32_t offset = 0; offset < 0x2000; offset += 4) {
    if (used.count(offset) != 0) continue;
    for (std::uint32_t value : {0xFFFFFFFFu, 0u}) {
      const auto results =
          rig_.burst(0, {{.address = offset, .write = true, .data = value}, {.address = offset}});
      EXPECT_FALSE(results[0].error || results[1].error) << std::hex << offset;
      EXPECT_EQ(results[1].data, 0u) << std::hex << offset;
    }
  }
  for (const auto &[offset, value] : before)
    EXPECT_EQ(rig_.read(0, offset), value) << std::hex << offset;
}

TEST_P(RegisterMap, WindowEndsAt8KiB) {
  EXPECT_FALSE(rig_.access(0, {.address = 0x1FFC}).error);
  EXPECT_TRUE(rig_.access(0, {.address = 0x2000}).error);
}

// FX-MAP.ECR: drivers read the counters of an interface that is down.
TEST_P(RegisterMap, EcrCanBeReadInDisableMode) {
  enter(Mode::kFreeze);
  rig_.write(0, reg::kEcr, 0x1234);
  rig_.write(0, reg::kMcr, rig_.read(0, reg::kMcr) | reg::kMcrMdis);
  ASSERT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrLpmAck) != 0; }, 100));
  const AhbResult ecr = rig_.access(0, {.address = reg::kEcr});
  EXPECT_FALSE(ecr.error);
  EXPECT_EQ(ecr.data, 0x1234u);
}

TEST_P(RegisterMap, SoftResetInFreezeModeResetsAndKeepsWhatItShould) {
  enter(Mode::kFreezeWithWrnEn);
  const auto before = fill();
  soft_reset();
  check_after_soft_reset(before);
}

TEST_P(RegisterMap, SoftResetOnTheBusResetsAndKeepsWhatItShould) {
  enter(Mode::kFreezeWithWrnEn);
  const auto before = fill();
  rig_.go(0);
  soft_reset();
  check_after_soft_reset(before);
}

// FX-MCR.MDIS: what is written along with SOFT_RST is kept, and disable mode follows the reset.
TEST_P(RegisterMap, SoftResetKeepsMdis) {
  enter(Mode::kFreeze);
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst | reg::kMcrMdis);
  ASSERT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrLpmAck) != 0; }, 2000));
  EXPECT_EQ(rig_.read(0, reg::kMcr), mcr(0xD890000F));
}

// FX-MCR.FRZ_ACK FX-MCR.NOT_RDY FX-MCR.LPM_ACK: the states of section 2.
TEST_P(RegisterMap, AcknowledgesTellTheMode) {
  constexpr std::uint32_t kAcks = reg::kMcrFrzAck | reg::kMcrLpmAck | (1u << 27);
  EXPECT_EQ(rig_.read(0, reg::kMcr) & kAcks, reg::kMcrLpmAck | (1u << 27));
  enter(Mode::kFreeze);
  EXPECT_EQ(rig_.read(0, reg::kMcr) & kAcks, reg::kMcrFrzAck | (1u << 27));
  rig_.go(0);
  EXPECT_EQ(rig_.read(0, reg::kMcr) & kAcks, 0u);
}

TEST_P(RegisterMap, HardResetResetsEverything) {
  enter(Mode::kFreezeWithWrnEn);
  fill();
  rig_.node(0).reset();
  rig_.run(300);
  mode_ = Mode::kDisable;
  for_each_register(true, [&](const RegisterRow &row, std::uint32_t offset) {
    if (!is_reset(row)) return;
    EXPECT_EQ(rig_.read(0, offset), reset_value(row)) << std::hex << offset;
  });
}

/// Loop-back, own frames received: every buffer of the core sends a frame and gets its flag.
class RegisterFlags : public RegisterMap {
 protected:
  void set_all_flags() {
    rig_.configure(0, {.mcr = reg::kMcrBcc, .ctrl = kTiming8 | reg::kCtrlLpb});
    rig_.go(0);
    for (unsigned mb = 0; mb < num_mb_; ++mb) rig_.put_tx(0, mb, {.id = mb});
    ASSERT_TRUE(rig_.wait_flag(0, num_mb_ - 1, 64 * 80 * 8));
    rig_.run(2000);
  }
};

INSTANTIATE_TEST_SUITE_P(Build, RegisterFlags, ::testing::ValuesIn(kAllBuilds), build_name);

// FX-1.5.b
TEST_P(RegisterFlags, WritingOneClearsThatFlagAndNoOther) {
  set_all_flags();
  for (const char *name : {"IFLAG1", "IFLAG2"}) {
    const RegisterRow &row = row_of(name);
    std::uint32_t flags = present(row);
    ASSERT_EQ(rig_.read(0, row.offset), flags);
    rig_.write(0, row.offset, 0);
    EXPECT_EQ(rig_.read(0, row.offset), flags);
    rig_.access(0, {.address = row.offset + 1, .write = true, .size = AhbSize::kByte, .data = 1});
    flags &= ~0x100u;
    EXPECT_EQ(rig_.read(0, row.offset), flags);
    for (unsigned bit = 0; bit < 32; bit += 3) {
      rig_.write(0, row.offset, 1u << bit);
      flags &= ~(1u << bit);
      EXPECT_EQ(rig_.read(0, row.offset), flags);
    }
    rig_.write(0, row.offset, 0xFFFFFFFF);
    EXPECT_EQ(rig_.read(0, row.offset), 0u);
  }
}

TEST_P(RegisterFlags, SoftResetClearsTheFlags) {
  set_all_flags();
  soft_reset();
  EXPECT_EQ(rig_.read(0, reg::kIflag1), 0u);
  EXPECT_EQ(rig_.read(0, reg::kIflag2), 0u);
}

// A node that hears nothing of itself: its counters run up to bus-off, and every event of ESR1 that
// a bus can cause there is set.
class RegisterEvents : public ::testing::Test {
 protected:
  RegisterEvents() : rig_{1}, deaf_{0, Effect::kRecessive, {}} {
    rig_.configure(0, {.ctrl = kTiming8 | reg::kCtrlBoffRec});
    rig_.write(0, reg::kEcr, 0x6000);  // REC at its warning limit
    rig_.go(0);
    rig_.bus().add(deaf_);
    rig_.put_tx(0, 3, {.id = 0x123});
    if (!rig_.run_until([&] { return off(); }, 20000)) throw std::runtime_error("no bus-off");
  }
  bool off() { return (rig_.read(0, reg::kEsr) & 0x20) != 0; }
  std::uint32_t esr() { return rig_.read(0, reg::kEsr); }
  MailboxRig rig_;
  LevelFault deaf_;
};

constexpr std::uint32_t kSet = 0x00030006;  // TWRN, RWRN, BOFF, ERR

// FX-1.4.a
TEST_F(RegisterEvents, ReadsAndZerosLeaveTheW1cBits) {
  EXPECT_EQ(esr() & row_of("ESR1").w1c, kSet);
  rig_.write(0, reg::kEsr, 0);
  EXPECT_EQ(esr() & row_of("ESR1").w1c, kSet);
  rig_.write(0, reg::kEsr, ~kSet);
  EXPECT_EQ(esr() & row_of("ESR1").w1c, kSet);
}

// FX-ESR1.TWRN_INT FX-ESR1.RWRN_INT FX-ESR1.BOFF_INT FX-ESR1.ERR_INT
TEST_F(RegisterEvents, EachW1cBitIsClearedByItsOneAlone) {
  std::uint32_t left = kSet;
  for (std::uint32_t bit : {1u << 17, 1u << 16, 1u << 2, 1u << 1}) {
    rig_.write(0, reg::kEsr, bit);
    left &= ~bit;
    EXPECT_EQ(esr() & row_of("ESR1").w1c, left);
  }
}

TEST_F(RegisterEvents, SoftResetClearsThemAll) {
  rig_.write(0, reg::kMcr, reg::kMcrSoftRst);
  ASSERT_TRUE(
      rig_.run_until([&] { return (rig_.read(0, reg::kMcr) & reg::kMcrSoftRst) == 0; }, 2000));
  EXPECT_EQ(esr() & (row_of("ESR1").w1c | row_of("ESR1").rc), 0u);
}

}  // namespace
}  // namespace vericansim
