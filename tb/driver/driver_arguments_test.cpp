// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What every function of the driver answers to bad arguments, wrong states and cores that do not
// answer or lack something (sw/driver/include/verican/verican.h).
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "driver/driver_node.hpp"
#include "driver/fake_core.hpp"

namespace vericansim {
namespace {

class DriverArguments : public ::testing::Test {
 protected:
  verican_result_t init() { return verican_init(&dev_, &config_); }
  void start() {
    ASSERT_EQ(init(), VERICAN_OK);
    ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  }

  FakeCore core_;
  verican_config_t config_ = core_.config();
  verican_t dev_{};
  verican_frame_t frame_ = driver_frame(0x123);
  verican_timing_t timing_{1, 2, 3, 2, 1, 0, 0, 0};
  verican_filter_t filter_{0, 0, VERICAN_SELECT_BOTH, VERICAN_SELECT_BOTH};
  verican_status_t status_{};
  std::uint64_t bits_ = 0;
  std::uint16_t count_ = 0;
  std::uint8_t number_ = 0;
};

TEST_F(DriverArguments, NoDeviceIsAMissingPointer) {
  verican_t *none = nullptr;
  EXPECT_EQ(verican_init(none, &config_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_deinit(none), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_start(none), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_stop(none), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_mode(none, VERICAN_MODE_NORMAL), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_timing(none, 8'000'000, &timing_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_filters(none, &filter_, 1), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_send(none, &frame_, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_send_in(none, &frame_, 60), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_abort(none, 60), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tx_waiting(none, &number_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_one_shot(none, true), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_receive(none, &frame_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_rx_waiting(none, &count_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_irq_handler(none), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_poll(none, 0), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_time(none, &bits_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_get_status(none, &status_), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_recover(none), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_self_test(none, nullptr), VERICAN_ERR_NULL);
}

TEST_F(DriverArguments, ADeviceThatWasNeverInitialisedIsTheWrongState) {
  EXPECT_EQ(verican_deinit(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_stop(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_mode(&dev_, VERICAN_MODE_NORMAL), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_timing(&dev_, 8'000'000, &timing_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_filters(&dev_, &filter_, 1), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_send(&dev_, &frame_, nullptr), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_send_in(&dev_, &frame_, 60), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_abort(&dev_, 60), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_tx_waiting(&dev_, &number_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_one_shot(&dev_, true), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_receive(&dev_, &frame_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_rx_waiting(&dev_, &count_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_poll(&dev_, 0), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_time(&dev_, &bits_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_get_status(&dev_, &status_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_recover(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_self_test(&dev_, nullptr), VERICAN_ERR_STATE);
  EXPECT_EQ(core_.reads + core_.writes, 0u);
}

TEST_F(DriverArguments, AStoppedDeviceDoesNotServe) {
  ASSERT_EQ(init(), VERICAN_OK);
  const unsigned accesses = core_.reads + core_.writes;
  EXPECT_EQ(verican_stop(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_send(&dev_, &frame_, nullptr), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_send_in(&dev_, &frame_, 60), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_abort(&dev_, 60), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_poll(&dev_, 0), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_time(&dev_, &bits_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_recover(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(core_.reads + core_.writes, accesses);
  EXPECT_EQ(verican_receive(&dev_, &frame_), VERICAN_ERR_EMPTY);
  EXPECT_EQ(verican_get_status(&dev_, &status_), VERICAN_OK);
  EXPECT_EQ(status_.state, VERICAN_STATE_STOPPED);
}

TEST_F(DriverArguments, AStartedDeviceIsNotConfigured) {
  start();
  const unsigned accesses = core_.reads + core_.writes;
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_mode(&dev_, VERICAN_MODE_NORMAL), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_timing(&dev_, 8'000'000, &timing_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_set_filters(&dev_, &filter_, 1), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_self_test(&dev_, nullptr), VERICAN_ERR_STATE);
  EXPECT_EQ(core_.reads + core_.writes, accesses);
}

TEST_F(DriverArguments, MissingPointersOfTheOtherArguments) {
  EXPECT_EQ(verican_config_default(nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_init(&dev_, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_timing_find(8'000'000, 500'000, 0, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_timing_check(8'000'000, nullptr), VERICAN_ERR_NULL);
  ASSERT_EQ(init(), VERICAN_OK);
  EXPECT_EQ(verican_set_timing(&dev_, 8'000'000, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_filters(&dev_, nullptr, 1), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_set_filters(&dev_, nullptr, 0), VERICAN_OK);
  EXPECT_EQ(verican_receive(&dev_, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_rx_waiting(&dev_, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_tx_waiting(&dev_, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_get_status(&dev_, nullptr), VERICAN_ERR_NULL);
  ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  EXPECT_EQ(verican_send(&dev_, nullptr, nullptr), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_send_in(&dev_, nullptr, 60), VERICAN_ERR_NULL);
  EXPECT_EQ(verican_time(&dev_, nullptr), VERICAN_ERR_NULL);
}

TEST_F(DriverArguments, ValuesOutsideTheirRange) {
  ASSERT_EQ(init(), VERICAN_OK);
  EXPECT_EQ(verican_set_mode(&dev_, static_cast<verican_mode_t>(3)), VERICAN_ERR_RANGE);
  timing_.sjw = 0;
  EXPECT_EQ(verican_set_timing(&dev_, 8'000'000, &timing_), VERICAN_ERR_RANGE);
  ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  EXPECT_EQ(verican_send_in(&dev_, &frame_, 55), VERICAN_ERR_RANGE) << "a mailbox that receives";
  EXPECT_EQ(verican_send_in(&dev_, &frame_, 64), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_abort(&dev_, 55), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_abort(&dev_, 64), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_abort(&dev_, 63), VERICAN_ERR_EMPTY);
}

struct BadFrame {
  const char *what;
  std::function<void(verican_frame_t &)> spoil;
};

class DriverFrames : public DriverArguments, public ::testing::WithParamInterface<BadFrame> {};

TEST_P(DriverFrames, ABadFrameIsRefused) {
  start();
  GetParam().spoil(frame_);
  const unsigned writes = core_.writes;
  EXPECT_EQ(verican_send(&dev_, &frame_, &number_), VERICAN_ERR_RANGE);
  EXPECT_EQ(verican_send_in(&dev_, &frame_, 63), VERICAN_ERR_RANGE);
  EXPECT_EQ(core_.writes, writes);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, DriverFrames,
    ::testing::Values(BadFrame{"StandardIdentifier", [](auto &frame) { frame.id = 0x800; }},
                      BadFrame{"ExtendedIdentifier",
                               [](auto &frame) {
                                 frame.flags = VERICAN_FRAME_EXTENDED;
                                 frame.id = 0x20000000;
                               }},
                      BadFrame{"Length", [](auto &frame) { frame.dlc = 16; }},
                      BadFrame{"Flags", [](auto &frame) { frame.flags = 0x10; }},
                      BadFrame{"Priority", [](auto &frame) { frame.priority = 8; }}),
    [](const auto &bad) { return bad.param.what; });

// All its buffers take part, with whatever lies in those that nobody clears.
TEST_F(DriverArguments, AFixedMaxmbIsThatOfTheConfiguration) {
  core_.mcr_never = VERICAN_MCR_MAXMB_MASK;
  core_.mcr_always = VERICAN_MCR_MAXMB_SET(31);
  for (const auto &[mailboxes, result] :
       {std::pair{16, VERICAN_ERR_DEVICE}, {32, VERICAN_OK}, {64, VERICAN_ERR_SPACE}}) {
    config_.mailboxes = static_cast<std::uint8_t>(mailboxes);
    EXPECT_EQ(init(), result) << mailboxes;
  }
}

struct BadFilter {
  const char *what;
  verican_filter_t filter;
};

class DriverFilterRange : public DriverArguments,
                          public ::testing::WithParamInterface<BadFilter> {};

TEST_P(DriverFilterRange, ABadFilterIsRefusedAndTheOldOnesStay) {
  ASSERT_EQ(init(), VERICAN_OK);
  const unsigned writes = core_.writes;
  const verican_filter_t filters[] = {filter_, GetParam().filter};
  EXPECT_EQ(verican_set_filters(&dev_, filters, 2), VERICAN_ERR_RANGE);
  EXPECT_EQ(core_.writes, writes);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, DriverFilterRange,
    ::testing::Values(
        BadFilter{"StandardId", {0x800, 0, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_BOTH}},
        BadFilter{"StandardMask", {0, 0x800, VERICAN_SELECT_ONLY_0, VERICAN_SELECT_BOTH}},
        BadFilter{"BothMask", {0, 0x800, VERICAN_SELECT_BOTH, VERICAN_SELECT_BOTH}},
        BadFilter{"ExtendedId", {0x20000000, 0, VERICAN_SELECT_ONLY_1, VERICAN_SELECT_BOTH}},
        BadFilter{"ExtendedMask", {0, 0x20000000, VERICAN_SELECT_ONLY_1, VERICAN_SELECT_BOTH}},
        BadFilter{"Ide", {0, 0, static_cast<verican_select_t>(3), VERICAN_SELECT_BOTH}},
        BadFilter{"Rtr", {0, 0, VERICAN_SELECT_BOTH, static_cast<verican_select_t>(3)}}),
    [](const auto &bad) { return bad.param.what; });

// ---- Configuration

struct BadConfig {
  const char *what;
  verican_result_t result;
  std::function<void(verican_config_t &)> spoil;
};

class DriverConfig : public DriverArguments, public ::testing::WithParamInterface<BadConfig> {};

TEST_P(DriverConfig, ABadConfigurationIsRefusedBeforeTheCoreIsTouched) {
  GetParam().spoil(config_);
  EXPECT_EQ(init(), GetParam().result);
  EXPECT_EQ(core_.reads + core_.writes, 0u);
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_STATE);
}

TEST_F(DriverArguments, AStartedDeviceOutlivesABadConfiguration) {
  start();
  config_.bitrate = 950'000;
  EXPECT_EQ(init(), VERICAN_ERR_TIMING);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY) << "its interrupts are served";
}

constexpr verican_timing_t kTooLong{1, 8, 8, 9, 1, 0, 0, 0};

INSTANTIATE_TEST_SUITE_P(
    Bad, DriverConfig,
    ::testing::Values(
        BadConfig{"NoRead", VERICAN_ERR_NULL, [](auto &c) { c.port.read32 = nullptr; }},
        BadConfig{"NoWrite", VERICAN_ERR_NULL, [](auto &c) { c.port.write32 = nullptr; }},
        BadConfig{"NoLock", VERICAN_ERR_NULL, [](auto &c) { c.port.lock = nullptr; }},
        BadConfig{"NoUnlock", VERICAN_ERR_NULL, [](auto &c) { c.port.unlock = nullptr; }},
        BadConfig{"NoRing", VERICAN_ERR_NULL, [](auto &c) { c.rx_ring = nullptr; }},
        BadConfig{"SmallRing", VERICAN_ERR_RANGE, [](auto &c) { c.rx_ring_size = 1; }},
        BadConfig{"NoTransmitter", VERICAN_ERR_RANGE, [](auto &c) { c.tx_mailboxes = 0; }},
        BadConfig{"SlowClock", VERICAN_ERR_RANGE, [](auto &c) { c.clock_hz = 999'999; }},
        BadConfig{"FastClock", VERICAN_ERR_RANGE, [](auto &c) { c.clock_hz = 400'000'001; }},
        BadConfig{"SlowBits", VERICAN_ERR_RANGE, [](auto &c) { c.bitrate = 999; }},
        BadConfig{"FastBits", VERICAN_ERR_RANGE, [](auto &c) { c.bitrate = 1'000'001; }},
        BadConfig{"EarlySample", VERICAN_ERR_RANGE, [](auto &c) { c.sample_point = 499; }},
        BadConfig{"LateSample", VERICAN_ERR_RANGE, [](auto &c) { c.sample_point = 901; }},
        BadConfig{"NoSuchRate", VERICAN_ERR_TIMING, [](auto &c) { c.bitrate = 950'000; }},
        BadConfig{"NoSuchSample", VERICAN_ERR_TIMING, [](auto &c) { c.sample_point = 875; }},
        BadConfig{"BadTiming", VERICAN_ERR_RANGE, [](auto &c) { c.timing = &kTooLong; }},
        BadConfig{"Mode", VERICAN_ERR_RANGE,
                  [](auto &c) { c.mode = static_cast<verican_mode_t>(3); }},
        BadConfig{"RxMode", VERICAN_ERR_RANGE,
                  [](auto &c) { c.rx_mode = static_cast<verican_rx_mode_t>(2); }},
        BadConfig{"Format", VERICAN_ERR_RANGE,
                  [](auto &c) { c.fifo_format = static_cast<verican_fifo_format_t>(3); }},
        BadConfig{"Order", VERICAN_ERR_RANGE,
                  [](auto &c) { c.tx_order = static_cast<verican_tx_order_t>(3); }},
        BadConfig{"Policy", VERICAN_ERR_RANGE,
                  [](auto &c) { c.bus_off = static_cast<verican_bus_off_policy_t>(3); }},
        BadConfig{"Mailboxes", VERICAN_ERR_RANGE, [](auto &c) { c.mailboxes = 48; }},
        BadConfig{"OneShotWithoutExtension", VERICAN_ERR_UNSUPPORTED,
                  [](auto &c) { c.mailboxes = 64, c.one_shot = true; }},
        BadConfig{"FdToleranceWithoutExtension", VERICAN_ERR_UNSUPPORTED,
                  [](auto &c) { c.mailboxes = 64, c.fd_tolerant = true; }}),
    [](const auto &bad) { return bad.param.what; });

struct BadCore {
  const char *what;
  verican_result_t result;
  std::function<void(FakeCore &, verican_config_t &)> spoil;
};

class DriverCores : public DriverArguments, public ::testing::WithParamInterface<BadCore> {};

TEST_P(DriverCores, ACoreThatDoesNotAnswerOrLacksSomethingIsFound) {
  GetParam().spoil(core_, config_);
  EXPECT_EQ(init(), GetParam().result);
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_STATE);
}

INSTANTIATE_TEST_SUITE_P(
    Bad, DriverCores,
    ::testing::Values(
        BadCore{"NotThere", VERICAN_ERR_DEVICE,
                [](auto &core, auto &) { core.word(VERICAN_XID_OFFSET) = 0; }},
        BadCore{"OddSize", VERICAN_ERR_DEVICE,
                [](auto &core, auto &) { core.word(VERICAN_XCONFIG_OFFSET) = 48; }},
        BadCore{"StaysDisabled", VERICAN_ERR_TIMEOUT,
                [](auto &core, auto &) { core.mcr_always = VERICAN_MCR_LPM_ACK_MASK; }},
        BadCore{"ResetsForEver", VERICAN_ERR_TIMEOUT,
                [](auto &core, auto &) { core.mcr_always = VERICAN_MCR_SOFT_RST_MASK; }},
        BadCore{"NeverFreezes", VERICAN_ERR_TIMEOUT,
                [](auto &core, auto &) { core.mcr_never = VERICAN_MCR_FRZ_ACK_MASK; }},
        BadCore{"NoWarnings", VERICAN_ERR_DEVICE,
                [](auto &core, auto &) { core.mcr_never = VERICAN_MCR_WRN_EN_MASK; }},
        BadCore{"NoTiming", VERICAN_ERR_DEVICE,
                [](auto &core, auto &) {
                  core.lossy = VERICAN_CTRL1_OFFSET;
                  core.lost_bits = VERICAN_CTRL1_PSEG1_MASK;
                }},
        BadCore{"NoFifo", VERICAN_ERR_UNSUPPORTED,
                [](auto &core, auto &config) {
                  config.rx_mode = VERICAN_RX_FIFO;
                  core.mcr_never = VERICAN_MCR_FEN_MASK;
                }},
        BadCore{"NoAbort", VERICAN_ERR_UNSUPPORTED,
                [](auto &core, auto &config) {
                  config.abort = true;
                  core.mcr_never = VERICAN_MCR_AEN_MASK;
                }},
        BadCore{"NoPriorities", VERICAN_ERR_UNSUPPORTED,
                [](auto &core, auto &config) {
                  config.tx_order = VERICAN_TX_BY_PRIORITY;
                  core.mcr_never = VERICAN_MCR_LPRIO_EN_MASK;
                }},
        BadCore{"NoOneShot", VERICAN_ERR_UNSUPPORTED,
                [](auto &core, auto &config) {
                  config.one_shot = true;
                  core.word(VERICAN_XCONFIG_OFFSET) = 64;
                }},
        BadCore{"NoFdTolerance", VERICAN_ERR_UNSUPPORTED,
                [](auto &core, auto &config) {
                  config.fd_tolerant = true;
                  core.word(VERICAN_XCONFIG_OFFSET) = 64;
                }},
        BadCore{"OnlyTransmitters", VERICAN_ERR_SPACE,
                [](auto &core, auto &config) {
                  config.tx_mailboxes = 16;
                  core.word(VERICAN_XCONFIG_OFFSET) = 16;
                }},
        BadCore{"NoRoomForTheFifo", VERICAN_ERR_SPACE,
                [](auto &core, auto &config) {
                  config.rx_mode = VERICAN_RX_FIFO;
                  config.tx_mailboxes = 9;
                  core.word(VERICAN_XCONFIG_OFFSET) = 16;
                }},
        BadCore{"FewerMailboxes", VERICAN_ERR_SPACE,
                [](auto &core, auto &config) {
                  config.mailboxes = 64;
                  core.lossy = VERICAN_MB_DATA1_OFFSET(63);
                  core.lost_bits = ~0u;
                }}),
    [](const auto &bad) { return bad.param.what; });

TEST_F(DriverArguments, ACoreThatStopsAnsweringIsATimeout) {
  ASSERT_EQ(init(), VERICAN_OK);
  core_.mcr_always = VERICAN_MCR_FRZ_ACK_MASK;
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_EQ(verican_send(&dev_, &frame_, nullptr), VERICAN_ERR_STATE) << "still stopped";
  EXPECT_EQ(verican_self_test(&dev_, nullptr), VERICAN_ERR_TIMEOUT);
  core_.mcr_always = 0;
  ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  core_.mcr_never = VERICAN_MCR_FRZ_ACK_MASK;
  EXPECT_EQ(verican_stop(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_EQ(core_.word(VERICAN_MCR_OFFSET) & VERICAN_MCR_HALT_MASK, 0u) << "or it stops later";
  EXPECT_EQ(verican_deinit(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_STATE) << "still started";
  core_.mcr_never = VERICAN_MCR_LPM_ACK_MASK;
  EXPECT_EQ(verican_deinit(&dev_), VERICAN_ERR_TIMEOUT);
}

TEST_F(DriverArguments, PollingEndsAfterTheLimit) {
  config_.port.poll_limit = 7;
  ASSERT_EQ(init(), VERICAN_OK);
  core_.mcr_always = VERICAN_MCR_FRZ_ACK_MASK;
  const unsigned reads = core_.reads;
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_EQ(core_.reads - reads, 7u);

  config_.port.poll_limit = 0;
  core_.mcr_always = 0;
  ASSERT_EQ(init(), VERICAN_OK);
  core_.mcr_always = VERICAN_MCR_FRZ_ACK_MASK;
  const unsigned more = core_.reads;
  EXPECT_EQ(verican_start(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_EQ(core_.reads - more, 100'000u);
}

// verican_stop() waits for the end of a frame, of which each read takes a clock of the core at
// least: up to 160 bits with stuff bits and intermission, and 20 of an error frame.
TEST_F(DriverArguments, WithoutALimitPollingOutlastsAFrame) {
  config_.port.poll_limit = 0;
  config_.bitrate = 2'000;
  ASSERT_EQ(init(), VERICAN_OK);
  ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  core_.mcr_never = VERICAN_MCR_FRZ_ACK_MASK;
  const unsigned reads = core_.reads;
  EXPECT_EQ(verican_stop(&dev_), VERICAN_ERR_TIMEOUT);
  EXPECT_GE(core_.reads - reads, 180u * config_.clock_hz / config_.bitrate);
}

TEST_F(DriverArguments, OneShotNeedsTheExtensionPage) {
  config_.mailboxes = 64;
  ASSERT_EQ(init(), VERICAN_OK);
  EXPECT_EQ(verican_set_one_shot(&dev_, true), VERICAN_ERR_UNSUPPORTED);
  ASSERT_EQ(verican_start(&dev_), VERICAN_OK);
  frame_.flags = VERICAN_FRAME_ONE_SHOT;
  EXPECT_EQ(verican_send(&dev_, &frame_, nullptr), VERICAN_ERR_UNSUPPORTED);
  for (const std::uint32_t offset : {VERICAN_XCTRL_OFFSET + 0u}) EXPECT_EQ(core_.word(offset), 0u);

  config_.mailboxes = 0;
  core_.word(VERICAN_XCONFIG_OFFSET) = 64;
  ASSERT_EQ(init(), VERICAN_OK);
  EXPECT_EQ(verican_set_one_shot(&dev_, true), VERICAN_ERR_UNSUPPORTED);
}

TEST_F(DriverArguments, AConfiguredSizeNeverTouchesTheExtensionPage) {
  config_.mailboxes = 32;
  bool touched = false;
  core_.on_read = [&](std::uint32_t offset) { touched |= offset >= 0x1000; };
  core_.on_write = [&](std::uint32_t offset, std::uint32_t) { touched |= offset >= 0x1000; };
  start();
  EXPECT_EQ(verican_send(&dev_, &frame_, nullptr), VERICAN_OK);
  EXPECT_EQ(verican_irq_handler(&dev_), VERICAN_ERR_EMPTY);
  EXPECT_EQ(verican_deinit(&dev_), VERICAN_OK);
  EXPECT_FALSE(touched);
}

TEST_F(DriverArguments, LocksAreGivenBack) {
  start();
  EXPECT_EQ(verican_send(&dev_, &frame_, &number_), VERICAN_OK);
  EXPECT_EQ(verican_send_in(&dev_, &frame_, number_), VERICAN_ERR_BUSY);
  EXPECT_EQ(verican_abort(&dev_, number_), VERICAN_OK);
  EXPECT_EQ(verican_set_one_shot(&dev_, true), VERICAN_OK);
  EXPECT_EQ(verican_time(&dev_, &bits_), VERICAN_OK);
  EXPECT_EQ(verican_poll(&dev_, 0), VERICAN_OK);
  EXPECT_EQ(verican_get_status(&dev_, &status_), VERICAN_OK);
  EXPECT_EQ(verican_recover(&dev_), VERICAN_ERR_STATE);
  EXPECT_EQ(verican_stop(&dev_), VERICAN_OK);
  EXPECT_GT(core_.locks, 6u);
  EXPECT_EQ(core_.depth, 0u);
  EXPECT_FALSE(core_.bad_unlock);
}

// The same words by pointer as by functions.
TEST_F(DriverArguments, APointerReachesTheSameRegisters) {
  start();
  std::vector<std::uint32_t> window(0x2000 / 4);
  verican_t by_pointer = dev_;
  by_pointer.port.base = window.data();
  verican_frame_t frame = driver_frame(0x1ABCDEF, 6, VERICAN_FRAME_EXTENDED, 0x1122334455667788);
  ASSERT_EQ(verican_send(&dev_, &frame, &number_), VERICAN_OK);
  EXPECT_EQ(number_, 56);
  ASSERT_EQ(verican_send(&by_pointer, &frame, &number_), VERICAN_OK);
  // flexcan.md 3.1
  EXPECT_EQ(window[0x400 / 4], 0x0C660000u);
  EXPECT_EQ(window[0x404 / 4], 0x01ABCDEFu);
  EXPECT_EQ(window[0x408 / 4], 0x11223344u);
  EXPECT_EQ(window[0x40C / 4], 0x55667788u);
  for (std::uint32_t offset = 0x400; offset < 0x410; offset += 4)
    EXPECT_EQ(core_.word(offset), window[offset / 4]) << offset;
  window[VERICAN_TIMER_OFFSET / 4] = 0x1234;
  EXPECT_EQ(verican_time(&by_pointer, &bits_), VERICAN_OK);
  EXPECT_EQ(bits_, 0x1234u);
}

TEST(DriverResults, EachHasAName) {
  for (int result = 0; result >= VERICAN_ERR_SELF_TEST; --result)
    EXPECT_STRNE(verican_result_name(static_cast<verican_result_t>(result)), "unknown") << result;
  EXPECT_STREQ(verican_result_name(VERICAN_OK), "ok");
  EXPECT_STREQ(verican_result_name(VERICAN_ERR_SELF_TEST), "self-test failed");
  EXPECT_STREQ(verican_result_name(static_cast<verican_result_t>(1)), "unknown");
  EXPECT_STREQ(verican_result_name(static_cast<verican_result_t>(-12)), "unknown");
}

}  // namespace
}  // namespace vericansim
