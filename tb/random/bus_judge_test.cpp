// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The judges of a bus see what they are there for: each test tells them one thing about a healthy
// bus that is not true.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "judge/bus_judge.hpp"
#include "node/host.hpp"

namespace vericansim {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Tells the judge something else than what was seen.
class Liar : public BusObserver {
 public:
  using Lie = std::function<bool(NodeId, BitRecord &)>;  // false: the bit is kept back

  explicit Liar(BusJudge &judge) : judge_{judge} {}
  [[nodiscard]] unsigned interests() const override { return judge_.interests(); }
  void on_bit(NodeId id, const BitRecord &record) override {
    BitRecord told = record;
    if (lie && !lie(id, told)) return;
    judge_.on_bit(id, told);
  }
  void on_node_tx(NodeId id, Time time, Level level) override {
    if (id != muted) judge_.on_node_tx(id, time, level);
  }
  Lie lie;
  NodeId muted = kAllNodes;  // whose pin is kept back

 private:
  BusJudge &judge_;
};

/// Three nodes at 1 Mbit/s, of which the first one sends.
class JudgedBus : public ::testing::Test {
 protected:
  JudgedBus() {
    for (const char *name : {"a", "b", "c"}) {
      nodes_.push_back(RtlNode::create(name, {}, 16));
      bus_.add(*nodes_.back());
      judge_.add(*nodes_.back());
    }
    bus_.add(liar_);
    monitor_ = std::make_unique<BusMonitor>(bus_, kMicrosecond, 0.75);
    monitor_->on_frame = [this](const BusFrame &frame) { judge_.on_wire(frame); };
    bus_.add(*monitor_);
    for (const auto &node : nodes_) hosts_.push_back(std::make_unique<Host>(*node, HostConfig{}));
    for (const auto &host : hosts_) host->start_and_wait();
    bus_.run_for(30 * kMicrosecond);
    judge_.all_on_bus(bus_.now());
  }

  std::vector<std::string> run(Liar::Lie lie) {
    liar_.lie = std::move(lie);
    for (unsigned n = 0; n < 4; ++n)
      hosts_[0]->send({.id = 0x123 + n, .dlc = 2, .data = {0x55, 0x0F}});
    bus_.run_for(kMillisecond);
    monitor_->advance(bus_.now());
    judge_.finish(bus_.now());
    return judge_.findings();
  }

  Bus bus_;
  std::vector<std::unique_ptr<RtlNode>> nodes_;
  BusJudge judge_{kMicrosecond};
  Liar liar_{judge_};
  std::unique_ptr<BusMonitor> monitor_;
  std::vector<std::unique_ptr<Host>> hosts_;
};

TEST_F(JudgedBus, TruthIsAccepted) {
  EXPECT_THAT(run({}), IsEmpty());
  const JudgeCounts counts = judge_.counts();
  EXPECT_EQ(counts.wire.exchanges, 4u);
  EXPECT_EQ(counts.wire.deliveries, 8u);
  EXPECT_EQ(counts.wire.strict, 4u);
  EXPECT_GT(counts.node_bits, 3000u);
}

// TH-06 and 19.5: one wrong level, place, counter, event.
TEST_F(JudgedBus, SeesAWrongLevel) {
  const auto findings = run([n = 0](NodeId id, BitRecord &bit) mutable {
    if (id == 0 && bit.at.field == Field::kData && ++n == 5) bit.at.tx = !bit.at.tx;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.back(), HasSubstr("sends"));
}

TEST_F(JudgedBus, SeesAWrongPlace) {
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id == 1 && bit.at.field == Field::kR0) bit.at.field = Field::kDlc;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front(), HasSubstr("is at DLC, the rules say R0"));
}

TEST_F(JudgedBus, SeesAWrongCounter) {
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id == 2 && bit.at.field == Field::kEof) bit.after.rec = 3;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front(), HasSubstr("REC"));
}

TEST_F(JudgedBus, SeesAMissingDelivery) {
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id == 2) bit.after.rx_valid = false;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front(), HasSubstr("delivery 0, the rules say 1"));
}

TEST_F(JudgedBus, SeesAMissingSuccess) {
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id == 0) bit.after.tx_ok = false;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front(), HasSubstr("success 0, the rules say 1"));
}

// IF-03: a frame that waits must start; told of a node that idles.
TEST_F(JudgedBus, SeesAMissedStart) {
  liar_.muted = 0;
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id != 0) return true;
    bit.at = {.sample = true, .tx = Level::kRecessive, .field = Field::kIdle, .running = true};
    bit.at.rx = Level::kRecessive;
    bit.after = bit.at;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings, testing::Contains(HasSubstr("sends 1, the rules say 0")));
}

TEST_F(JudgedBus, SeesASpuriousError) {
  const auto findings = run([](NodeId id, BitRecord &bit) {
    if (id == 1 && bit.at.field == Field::kDlc) bit.after.errors = kErrForm;
    return true;
  });
  ASSERT_FALSE(findings.empty());
  EXPECT_THAT(findings.front(), HasSubstr("error kinds 2, the rules say 0"));
  EXPECT_THAT(findings, testing::Contains(HasSubstr("on an undisturbed bus")));
}

// What a node received must come to its software.
TEST_F(JudgedBus, SeesWhatSoftwareGetsWrong) {
  judge_.expect_software(1, [](const Frame &) { return true; });
  EXPECT_THAT(run({}), testing::Not(IsEmpty()));  // four frames and nobody took them
  EXPECT_THAT(judge_.findings().front(), HasSubstr("software did not get them"));
}

TEST(WireJudgeAlone, SeesLossesDoublesAndChanges) {
  const Frame frame{.id = 1, .dlc = 1, .data = {7}};
  const auto judge = [&](const std::function<void(WireJudge &)> &what) {
    std::string text;
    WireJudge wire{kMicrosecond, [&](const std::string &line) { text += line + "\n"; }};
    wire.add_node("a");
    wire.add_node("b");
    constexpr Time kSof = kMillisecond;
    wire.bit(0, kSof, {.rx = Level::kRecessive, .started = true}, {});
    wire.bit(1, kSof + kMicrosecond, {.rx = Level::kDominant, .started = true}, {});
    what(wire);
    wire.finish(2 * kMillisecond);
    return text;
  };
  const Time eof6 = kMillisecond + 50 * kMicrosecond;
  const NodeBit delivered{.field = Field::kEof, .left = 1, .delivered = true};
  const NodeBit sent{.field = Field::kEof, .transmitter = true, .sent = true};
  const auto receive = [&](WireJudge &wire, const Frame &got) {
    wire.bit(1, eof6, delivered, got);
  };
  const auto send = [&](WireJudge &wire) { wire.bit(0, eof6 + kMicrosecond, sent, frame); };
  const auto see = [&](WireJudge &wire, const Frame &got) {
    wire.on_wire({got, kMillisecond, eof6 + kMicrosecond, 0});
  };
  EXPECT_EQ(judge([&](WireJudge &w) { receive(w, frame), send(w), see(w, frame); }), "");
  EXPECT_THAT(judge([&](WireJudge &w) { send(w), see(w, frame); }), HasSubstr("has not received"));
  EXPECT_THAT(judge([&](WireJudge &w) { receive(w, frame); }), HasSubstr("which nobody sent"));
  EXPECT_THAT(judge([&](WireJudge &w) { receive(w, {}), send(w), see(w, frame); }),
              HasSubstr("but a sent"));
  EXPECT_THAT(judge([&](WireJudge &w) { receive(w, frame), send(w); }),
              HasSubstr("not on the wire"));
  EXPECT_THAT(judge([&](WireJudge &w) { receive(w, frame), send(w), see(w, {}); }),
              HasSubstr("counts 001 [1] 07 as sent"));
  EXPECT_THAT(judge([&](WireJudge &w) { see(w, frame); }), HasSubstr("nobody counts it"));
  EXPECT_THAT(
      judge([&](WireJudge &w) { receive(w, frame), receive(w, frame), send(w), see(w, frame); }),
      HasSubstr("which nobody sent"));
  // VA-03: disturbed at EOF7, the sender repeats and the receiver keeps the frame.
  EXPECT_EQ(judge([&](WireJudge &w) {
              w.disturbances().add(0, {eof6 - 10 * kMicrosecond, eof6 + kMicrosecond});
              receive(w, frame);
            }),
            "");
  // A third node, disturbed, starts between the sample points of EOF6 at receiver and sender.
  const auto third_starts = [&](unsigned left, Time after) {
    return judge([&](WireJudge &w) {
      w.add_node("c");
      w.disturbances().add(2, {eof6 - 10 * kMicrosecond, eof6 + kMicrosecond});
      receive(w, frame);
      const auto bits = static_cast<std::uint8_t>(left);
      w.bit(0, eof6 + after,
            {.field = Field::kEof, .left = bits, .transmitter = true, .failed = true}, {});
    });
  };
  constexpr Time kPart = kMicrosecond / 5;
  EXPECT_EQ(third_starts(1, kPart), "");
  EXPECT_EQ(third_starts(0, kMicrosecond), "") << "VA-03";
  EXPECT_THAT(third_starts(1, -kPart), HasSubstr("failed before EOF7")) << "seen by the receiver";
  EXPECT_THAT(third_starts(2, kPart), HasSubstr("failed before EOF7"));
}

// The run may be over between the frame's end on the wire and its sender's sample point of EOF7.
TEST(WireJudgeAtTheEnd, TheSenderOfTheLastFrameMayNotHaveEndedIt) {
  const auto judge = [](Time left) {
    std::string text;
    WireJudge wire{kMicrosecond, [&](const std::string &line) { text += line + "\n"; }};
    wire.add_node("a");
    wire.on_wire({{.id = 1, .dlc = 0}, kMillisecond, kMillisecond + 44 * kMicrosecond, 0});
    wire.finish(kMillisecond + 44 * kMicrosecond + left);
    return text;
  };
  EXPECT_EQ(judge(0), "");
  EXPECT_EQ(judge(kMicrosecond), "");
  EXPECT_THAT(judge(3 * kMicrosecond), HasSubstr("nobody counts it"));
}

}  // namespace
}  // namespace vericansim
