// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the library does with identifiers, length codes and timing that do not exist: it says so and
// cuts nothing off.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "model/buffer_model.hpp"
#include "model/bus_decoder.hpp"
#include "model/bus_monitor.hpp"
#include "model/frame_codec.hpp"
#include "model/node_model.hpp"
#include "model/registers.hpp"
#include "node/core_node.hpp"
#include "node/host.hpp"
#include "session/runner.hpp"
#include "session/session.hpp"
#include "simulation/station.hpp"
#include "simulation/traffic_source.hpp"
#include "simulation/wave_report.hpp"
#include "timing/bittime.hpp"
#include "trace/can_packet.hpp"
#include "trace/candump.hpp"
#include "trace/wave_decode.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;

/// `use` throws std::invalid_argument whose text has `what` in it.
void expect_refused(const std::function<void()> &use, const std::string &what) {
  try {
    use();
  } catch (const std::invalid_argument &error) {
    EXPECT_THAT(error.what(), HasSubstr(what));
    return;
  }
  ADD_FAILURE() << "not refused: " << what;
}

/// Everything that takes a frame.
void expect_frame_refused(const Frame &frame, const std::string &what) {
  const auto node = RtlNode::create("node", {}, 16);
  Host host{*node, {}};
  CoreNode core{"core"};
  NodeModel model;
  BufferModel buffers{{.num_mb = 16}};
  Bus bus;
  std::ostringstream log;
  const BufferConfig config;
  const std::function<void()> uses[] = {
      [&] { frame.validate(); },
      [&] { static_cast<void>(encode_frame(frame)); },
      [&] { host.send(frame); },
      [&] { static_cast<void>(host.send_and_wait(frame)); },
      [&] { core.request(frame); },
      [&] { model.request(frame); },
      [&] { static_cast<void>(candump_frame(frame)); },
      [&] { static_cast<void>(can_packet(frame)); },
      [&] { CandumpWriter{log}.write({.frame = frame}); },
      [&] { TrafficSource({.frame = frame}, bus, host, 1); },
      [&] { buffers.header(frame, {}, 0); },
      [&] { buffers.received(frame, 0); },
      [&] { buffers.sent(frame, 0); },
      [&] { static_cast<void>(mailbox_accepts(frame, 0, 0, 0, config)); },
      [&] { static_cast<void>(answer_fits(frame, 0, 0, config)); },
      [&] { static_cast<void>(fifo_accepts(frame, std::vector<std::uint32_t>(8), {}, config)); },
  };
  for (const auto &use : uses) expect_refused(use, what);
  EXPECT_EQ(host.pending(), 0U);
  EXPECT_EQ(log.str(), "");
}

TEST(ApiRanges, FramesThatDoNotExistAreRefusedEverywhere) {
  expect_frame_refused({.id = 0x800}, "frame: identifier must be 0 to 0x7FF (11 bits), got 0x800");
  expect_frame_refused({.id = 0x20000000, .extended = true},
                       "frame: identifier must be 0 to 0x1FFFFFFF (29 bits), got 0x20000000");
  expect_frame_refused({.id = 1, .dlc = 16}, "frame: DLC must be 0 to 15, got 16");
}

TEST(ApiRanges, TheLargestFramesAreFrames) {
  for (const Frame &frame :
       {Frame{.id = 0x7FF, .dlc = 15}, Frame{.id = 0x1FFFFFFF, .extended = true, .dlc = 15}}) {
    EXPECT_NO_THROW(frame.validate());
    EXPECT_EQ(encode_frame(frame).bits.front().field, Field::kSof);
  }
}

TEST(ApiRanges, FiltersAndBuffersOfAHost) {
  const auto node = RtlNode::create("node", {}, 16);
  const auto host = [&](const HostConfig &config) { return [&] { Host{*node, config}; }; };
  expect_refused(host({.filters = {{.id = 0x800}}}), "filter: identifier must be 0 to 0x7FF");
  expect_refused(host({.filters = {{.mask = 0x800}}}), "filter: mask must be 0 to 0x7FF");
  expect_refused(host({.filters = {{.id = 0x20000000, .extended = true}}}), "got 0x20000000");
  expect_refused(host({.tx_buffers = 0}), "transmit buffers must be 1 to 15, got 0");
  expect_refused(host({.tx_buffers = 16}), "transmit buffers must be 1 to 15, got 16");
  expect_refused(host({.tx_buffers = 4, .filters = std::vector<RxFilter>(13)}),
                 "at most 12 filters fit beside 4 transmit buffers");
  expect_refused([] { static_cast<void>(make_station("a", {}, {.tx_buffers = 65}, 64)); },
                 "transmit buffers must be 1 to 63, got 65");
}

TEST(ApiRanges, BitTimingThatTheRegistersDoNotHold) {
  const auto node = RtlNode::create("node", {}, 16);
  const struct {
    BitTiming timing;
    const char *what;
  } cases[] = {
      {{0, 3, 2, 2, 1}, "prescaler must be 1 to 256, got 0"},
      {{257, 3, 2, 2, 1}, "prescaler must be 1 to 256, got 257"},
      {{1, 9, 2, 2, 1}, "PROP_SEG must be 1 to 8, got 9"},
      {{1, 3, 0, 2, 1}, "PHASE_SEG1 must be 1 to 8, got 0"},
      {{1, 3, 2, 9, 1}, "PHASE_SEG2 must be 1 to 8, got 9"},
      {{1, 3, 2, 2, 5}, "SJW must be 1 to 4, got 5"},
  };
  for (const auto &[timing, what] : cases) {
    expect_refused([&, t = timing] { t.validate(); }, what);
    expect_refused([&, t = timing] { static_cast<void>(t.ctrl_fields()); }, what);
    expect_refused([&, t = timing] { Host(*node, {.timing = t}); }, what);
    expect_refused([&, t = timing] { CoreNode("core", {.timing = t}); }, what);
    expect_refused([&, t = timing] { static_cast<void>(make_bare_station("a", {}, t)); }, what);
    expect_refused([&, t = timing] { static_cast<void>(oscillator_tolerance(t)); }, what);
    expect_refused([&, t = timing] { static_cast<void>(rate_bit_timing(t, {})); }, what);
  }
}

TEST(ApiRanges, ClocksAndBitRatesOutOfRange) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double rate : {-500e3, 0.5, 999.0, 1'000'001.0, 1e300, not_a_number}) {
    expect_refused([&] { static_cast<void>(bit_timing_request(8e6, rate)); }, "allowed: 1000 to");
    Scenario scenario;
    scenario.nodes.resize(1);
    scenario.nodes[0].name = "a";
    scenario.nodes[0].timing = BitTiming{};
    expect_refused([&] { static_cast<void>(run_scenario(scenario, rate)); },
                   "bit rate must be 1000 to 1000000 bit/s");
  }
  for (const double clock : {0.0, 4.3e9, 1e10, not_a_number})
    expect_refused([&] { static_cast<void>(bit_timing_request(clock, 500e3)); }, "clock");
  for (const double metres : {-1.0, 2e6, not_a_number})
    expect_refused([&] { static_cast<void>(cable_delay(metres)); }, "0 to 1000000 m");
}

TEST(ApiRanges, DecodersAndMonitors) {
  const Bus bus;
  for (const double point : {0.0, 1.0, 80.0, std::nan("")})
    expect_refused([&] { BusMonitor(bus, kMicrosecond, point); }, "above 0 and below 1");
  expect_refused([] { BusDecoder({.bit_time = 2 * kSecond}, {}); }, "at most 1 s, got 2000000");
  expect_refused([] { BusDecoder({.bit_time = 0}, {}); }, "above 0 and at most 1 s, got 0");
  for (const int point : {0, 1000})
    expect_refused([&] { BusDecoder({.sample_point = point}, {}); },
                   "1..999 per mille, got " + std::to_string(point));
  for (const int jump : {-1, 501})
    expect_refused([&] { BusDecoder({.sync_jump = jump}, {}); },
                   "0..500 per mille, got " + std::to_string(jump));
}

TEST(ApiRanges, RegistersThatDoNotExist) {
  expect_refused([] { static_cast<void>(reg::mb(65)); }, "message buffer must be 0 to 64, got 65");
  expect_refused([] { static_cast<void>(reg::mb(64, 1)); }, "message buffer must be 0 to 63");
  expect_refused([] { static_cast<void>(reg::mb(0, 4)); }, "word of a message buffer must be 0 to");
  expect_refused([] { static_cast<void>(reg::rximr(65)); }, "RXIMR must be 0 to 64, got 65");
  expect_refused([] { static_cast<void>(reg::filter(128)); }, "must be 0 to 127, got 128");
  expect_refused([] { static_cast<void>(reg::mcr_idam(4)); }, "MCR.IDAM must be 0 to 3, got 4");
  expect_refused([] { static_cast<void>(reg::ctrl2_rffn(16)); }, "RFFN must be 0 to 15, got 16");
  static_assert(reg::mb(63, 3) == 0x80 + 16 * 63 + 12);
}

TEST(ApiRanges, BuffersThatNoCoreHas) {
  const std::pair<BufferConfig, const char *> cases[] = {
      {{.num_mb = 15}, "message buffers must be 16 to 64, got 15"},
      {{.num_mb = 65}, "message buffers must be 16 to 64, got 65"},
      {{.maxmb = 128}, "MCR.MAXMB must be 0 to 127, got 128"},
      {{.idam = 4}, "MCR.IDAM must be 0 to 3, got 4"},
      {{.rffn = 16}, "CTRL2.RFFN must be 0 to 15, got 16"},
  };
  for (const auto &[config, what] : cases) {
    expect_refused([&, c = config] { BufferModel{c}; }, what);
    expect_refused([&, c = config] { BufferModel{{}}.configure(c, 0); }, what);
    expect_refused(
        [&, c = config] {
          static_cast<void>(fifo_accepts({}, std::vector<std::uint32_t>(128), {}, c));
        },
        what);
  }
  expect_refused([] { static_cast<void>(fifo_accepts({}, std::vector<std::uint32_t>(7), {}, {})); },
                 "words of the filter table must be 8 to 128, got 7");
}

TEST(ApiRanges, TrafficThatCannotBeTimed) {
  const auto node = RtlNode::create("node", {}, 16);
  Host host{*node, {}};
  Bus bus;
  expect_refused([&] { TrafficSource({.random_offset = true}, bus, host, 1); }, "needs a period");
  for (const TrafficSpec &spec :
       {TrafficSpec{.period = -1}, TrafficSpec{.offset = -1}, TrafficSpec{.jitter = -1}})
    expect_refused([&] { TrafficSource(spec, bus, host, 1); }, "no time may be negative");
}

TEST(ApiRanges, ASessionNeedsABusAndABitRate) {
  Scenario scenario;
  scenario.nodes.resize(1);
  expect_refused([] { Session{{}}; }, "a session needs a bus");
  for (const double bitrate : {1.0, 999.0, 1'000'001.0, -5e5, std::nan("")})
    expect_refused([&] { Session{{{scenario, bitrate}}}; }, "1000 to 1000000");
  scenario.bitrates = {};
  expect_refused(
      [&] {
        Session{{{scenario, 0}}};
      },
      "neither the session nor the scenario has a bit rate");
  scenario.bitrates = {2e6};
  expect_refused([&] { Session{{{scenario, 0}}}; }, "1000 to 1000000");
  EXPECT_NO_THROW((Session{{{scenario, 1e6}}}));
}

TEST(ApiRanges, ARecordedWaveNeedsABitRate) {
  for (const double bitrate : {0.0, -1.0, 1e7, std::nan("")}) {
    const Wave wave{"can", bitrate, kMillisecond, {{0, Level::kRecessive}}};
    expect_refused([&] { static_cast<void>(decode_wave(wave, 800)); }, "1000 to 1000000");
    expect_refused([&] { static_cast<void>(report_wave(wave, "wave", {})); }, "1000 to 1000000");
  }
}

}  // namespace
}  // namespace vericansim
