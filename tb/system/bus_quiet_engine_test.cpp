// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// An engine whose counting edges are made good or done lightly (QuietEngine) has, whenever it has
// caught up, the same bits in every member of the model as one that is evaluated at each edge; so
// has its time unit, whose counting edges are put off (TimedEngine).
#include "node/quiet_engine.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "Vcan_core.h"
#include "Vcan_core___024root.h"
#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "bus/trace.hpp"
#include "harness/model_members.hpp"
#include "node/core_node.hpp"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/timed_engine.hpp"

namespace vericansim {
namespace {

struct EngineCase {
  const char *name;
  BitTiming timing;
  bool triple_sampling = false;
  bool loop_back = false;
  bool listen_only = false;
  double noise = 0;
  bool glitches = false;  // clocks in which the engine hears the other level
};
void PrintTo(const EngineCase &each, std::ostream *out) { *out << each.name; }

// Random commands to the time unit, and what they are given with (can_time.sv); nothing for an
// engine without.
template <typename Engine>
bool command_time(Engine &engine, std::uint64_t dice, bool first) {
  if constexpr (kHasTimeUnit<Engine>) {
    constexpr std::uint32_t kCompare = 1U << 13;
    if (!first) {
      engine.time_cmd_i = 0;
      return true;
    }
    engine.time_cmd_i = static_cast<std::uint16_t>(1U << dice % 9);
    const std::uint64_t fraction = dice * 0x9E3779B97F4A7C15 >> 32;
    const std::uint32_t soon =
        static_cast<std::uint32_t>(engine.time()) + static_cast<std::uint32_t>(dice >> 8 & 0xFFFF);
    switch (dice % 9) {
      case 2: engine.time_data_i = fraction << 32 | (dice >> 4 & 0x7F); break;  // rate
      case 3: engine.time_data_i = (dice >> 8 & 0x1F) << 32; break;             // slew
      case 4: engine.time_data_i = std::uint64_t{soon} << 32; break;            // compare
      default: engine.time_data_i = fraction << 32 | (0xFFFF'FF00U + (dice & 0xFF)); break;
    }
    engine.time_ttx_i = soon;
    engine.time_tcmph_i = dice >> 40 & 1 ? 100'000 : 0;
    engine.time_tctrl_i = kCompare | static_cast<std::uint32_t>(dice >> 20 & 0x37);
    engine.time_wait_i = dice >> 50 & 1;
    return true;
  } else {
    return false;
  }
}

// Two engines on the same pins: one does what it must, as a node of a bus would, the other all.
template <typename Engine, typename Root>
class EngineTwins : public Node {
 public:
  EngineTwins(const EngineCase &setting, const ClockConfig &clock)
      : Node{"twins", clock}, glitches_{setting.glitches} {
    for (Engine *engine : {&short_, &full_}) {
      set(*engine, setting);
      engine->can_rx_i = 1;
      engine->rst_ni = 0;
      rising_edge(*engine, engine->clk_i);
      engine->rst_ni = 1;
      rising_edge(*engine, engine->clk_i);
    }
    members_.emplace(*short_.rootp, *full_.rootp);
    if constexpr (kTimed) {
      full_.let_time_rest(false);
      unit_members_.emplace(*short_.settled_unit().rootp, *full_.settled_unit().rootp);
    }
  }
  ~EngineTwins() override { Verilated::threadContextp(&context_); }

  void clock(Level rx) override {
    if (random_() % 3000 == 0) change_inputs();
    if (commanded_ || random_() % 700 == 0) command();
    const std::uint64_t before = full_.trace_o;
    rx = static_cast<Level>(static_cast<unsigned>(rx) ^ static_cast<unsigned>(glitch()));
    full_.can_rx_i = static_cast<std::uint8_t>(rx);
    rising_edge(full_, full_.clk_i);
    shortly(rx, before);
    drive(static_cast<Level>(full_.can_tx_o));
  }
  [[nodiscard]] std::uint64_t trace() const override { return full_.trace_o; }

  [[nodiscard]] unsigned differences() const { return differences_; }
  [[nodiscard]] unsigned passed() const { return passed_; }
  [[nodiscard]] unsigned light() const { return light_; }
  [[nodiscard]] unsigned sent() const { return sent_; }
  [[nodiscard]] unsigned crossed() const { return crossed_; }
  /// How often an edge on the bus synchronised in an edge of the clock done lightly.
  [[nodiscard]] unsigned synchronised() const { return synchronised_; }
  /// How often edges from before a boundary to behind it were made good together.
  [[nodiscard]] unsigned across() const { return across_; }
  /// How often the time unit was found at rest.
  [[nodiscard]] unsigned rested() const { return rested_; }

 private:
  static constexpr bool kTimed = kHasTimeUnit<Engine>;

  static void set(Engine &engine, const EngineCase &setting) {
    engine.presdiv_i = setting.timing.prescaler - 1;
    engine.propseg_i = setting.timing.prop - 1;
    engine.pseg1_i = setting.timing.ps1 - 1;
    engine.pseg2_i = setting.timing.ps2 - 1;
    engine.rjw_i = setting.timing.sjw - 1;
    engine.smp_i = setting.triple_sampling;
    engine.lpb_i = setting.loop_back;
    engine.lom_i = setting.listen_only;
    engine.run_i = 1;
    engine.tx_dlc_i = 2;
    engine.tx_word_i = 0x4A5A5A5A;
  }

  // Inputs change: a frame to send, or no longer; the engine stops, or begins anew.
  void change_inputs() {
    catch_up_engine();
    const bool running = full_.run_i == 0 || random_() % 4 != 0;
    for (Engine *engine : {&short_, &full_}) {
      if (engine->run_i != 0) engine->tx_req_i = !engine->tx_req_i;
      engine->run_i = running;
      engine->eval();
    }
    quiet_.disturbed();
    allowed_ = 0;
  }

  // A pulse of one clock.
  void command() {
    catch_up_engine();
    const std::uint64_t dice = std::uint64_t{random_()} << 32 | random_();
    commanded_ = !commanded_;
    for (Engine *engine : {&short_, &full_})
      if (command_time(*engine, dice, commanded_)) engine->eval();
    quiet_.disturbed();
    allowed_ = 0;
  }

  // From one clock to a bit, at any place in the bit: edges there come early and late.
  bool glitch() {
    if (glitch_ != 0) return --glitch_ != 0;
    if (glitches_ && random_() % 400 == 0) glitch_ = 1 + random_() % 40;
    return glitch_ != 0;
  }

  // `before`: the trace before this edge.
  void shortly(Level rx, std::uint64_t before) {
    const bool same = short_.can_rx_i == static_cast<std::uint8_t>(rx);
    if (same && behind_ < allowed_) {
      across_ += behind_ != 0 && (before & kTraceBoundary) != 0;
      ++behind_;
      ++passed_;
      if (random_() % 8 == 0) catch_up_engine();
      return;
    }
    catch_up_engine(false);
    if (quiet_.counts(short_)) {
      quiet_.clock_lightly(short_, rx);
      ++light_;
    } else if (quiet_.crosses_boundary(short_)) {
      quiet_.cross_boundary(short_, rx);
      ++crossed_;
    } else if (quiet_.synchronises(short_)) {
      quiet_.synchronise(short_, rx);
      ++synchronised_;
    } else {
      short_.can_rx_i = static_cast<std::uint8_t>(rx);
      if (kPlainEdges)
        rising_edge(short_, short_.clk_i);
      else
        settled_edge(short_);
      quiet_.clocked(short_);
    }
    sent_ += short_.tx_ok_o;
    compare();
    if constexpr (kTimed)
      if (random_() % 50 == 0) compare_units();
    allowed_ = quiet_.edges(short_, random_() % 2 == 0);
  }

  void catch_up_engine(bool look = true) {
    quiet_.pass(short_, behind_);
    allowed_ -= behind_;
    behind_ = 0;
    if (look) compare();
  }

  void compare() {
    if (!members_->same(*short_.rootp, *full_.rootp)) ++differences_;
  }

  void compare_units() {
    if (short_.time() != full_.time()) ++differences_;
    rested_ += short_.edges_of_time() != 0;
    if (!unit_members_->same(*short_.settled_unit().rootp, *full_.settled_unit().rootp))
      ++differences_;
  }

  SerialContext context_;
  Engine short_{&context_, "short"}, full_{&context_, "full"};
  ModelContext model_context_{context_};
  QuietEngine quiet_;
  std::optional<ModelMembers<Root>> members_;
  std::optional<ModelMembers<Vcan_time_unit___024root>> unit_members_;
  std::mt19937 random_{11};
  std::uint64_t allowed_ = 0, behind_ = 0;
  bool commanded_ = false, glitches_;
  unsigned glitch_ = 0;
  unsigned differences_ = 0, passed_ = 0, light_ = 0, sent_ = 0, rested_ = 0, crossed_ = 0;
  unsigned across_ = 0, synchronised_ = 0;
};

constexpr BitTiming kNarrow{.prescaler = 1, .prop = 3, .ps1 = 2, .ps2 = 2, .sjw = 2};
constexpr BitTiming kWide{.prescaler = 5, .prop = 4, .ps1 = 3, .ps2 = 2, .sjw = 1};
constexpr BitTiming kLongPhase{.prescaler = 2, .prop = 7, .ps1 = 8, .ps2 = 8, .sjw = 2};
constexpr EngineCase kCases[] = {
    {"OneClockAQuantum", kNarrow},
    {"FiveClocksAQuantum", kWide},
    {"TwoClocksAQuantum", {.prescaler = 2, .prop = 7, .ps1 = 8, .ps2 = 8, .sjw = 4}},
    {"ThreeSamples", kWide, true},
    {"ThreeSamplesNarrow", kNarrow, true},
    {"LoopBack", kWide, false, true},
    {"ListenOnly", kNarrow, false, false, true},
    {"Noise", kNarrow, false, false, false, 0.005},
    {"NoiseAndThreeSamples", kWide, true, false, false, 0.005},
    {"Glitches", kWide, false, false, false, 0, true},
    {"GlitchesInALongPhase", kLongPhase, false, false, false, 0, true},
};

class QuietEngineTest : public ::testing::TestWithParam<EngineCase> {};

template <typename Engine, typename Root>
void compare_twins(const EngineCase &each) {
  Bus bus;
  EngineTwins<Engine, Root> twins{each, {.error_ppm = 300}};
  bus.add(twins);
  std::vector<std::unique_ptr<CoreNode>> others;
  for (int i = 0; i < 2; ++i) {
    const ClockConfig clock{.error_ppm = -400.0 + 350 * i, .phase = 17'003 * (i + 1)};
    others.push_back(std::make_unique<CoreNode>("other", CoreConfig{.timing = each.timing}, clock));
    bus.add(*others.back());
    others.back()->start();
  }
  NoiseFault noise{{.per_bit = each.noise, .window = {.from = kMillisecond}}};
  if (each.noise > 0) bus.add(noise);
  std::mt19937 random{5};
  for (int i = 0; i < 300; ++i) {
    bus.run_for(static_cast<Time>(random() % 400) * kMicrosecond);
    others[random() % 2]->request({.id = static_cast<std::uint32_t>(random() % 0x800),
                                   .dlc = static_cast<std::uint8_t>(random() % 9),
                                   .data = {static_cast<std::uint8_t>(random()), 0xAA, 0xFF}});
  }
  EXPECT_EQ(twins.differences(), 0u);
  EXPECT_TRUE(kPlainEdges || twins.passed() > 10'000);
  EXPECT_TRUE(kPlainEdges || twins.light() > 1'000);
  EXPECT_TRUE(kPlainEdges || each.loop_back || twins.crossed() > 500) << twins.crossed();
  EXPECT_TRUE(kPlainEdges || twins.across() > 200) << twins.across();
  EXPECT_TRUE(kPlainEdges || each.loop_back || kHasTimeUnit<Engine> || twins.synchronised() > 200)
      << twins.synchronised();
  EXPECT_TRUE(each.listen_only || each.glitches || twins.sent() > 5);
  EXPECT_TRUE(kPlainEdges || !kHasTimeUnit<Engine> || twins.rested() > 200);
}

TEST_P(QuietEngineTest, SameMembersAsWithEveryEdgeEvaluated) {
  compare_twins<Vcan_core, Vcan_core___024root>(GetParam());
}

// TM-122: with its time unit under way.
TEST_P(QuietEngineTest, SameMembersWithTheTimeUnit) {
  compare_twins<TimedEngine, Vcan_core_time___024root>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Cases, QuietEngineTest, ::testing::ValuesIn(kCases),
                         [](const auto &each) { return std::string{each.param.name}; });

}  // namespace
}  // namespace vericansim
