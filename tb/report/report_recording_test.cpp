// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A report against independent sources: log, frame codec, bus decoder, monitor, clocks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/bus_decoder.hpp"
#include "model/frame_codec.hpp"
#include "report/report_run.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {
namespace {

/// A run of each kind, made once for all tests.
const ReportedRun &busy() {
  static const ReportedRun run = run_with_report(busy_scenario());
  return run;
}
const ReportedRun &disturbed() {
  static const ReportedRun run = run_with_report(disturbed_scenario());
  return run;
}

std::vector<BusEvent> decode(const ReportPage &page, const std::string &signal) {
  std::vector<BusEvent> events;
  DecoderConfig config;
  config.bit_time = static_cast<Time>(1e12 / page.meta.at("bitrate").get<double>());
  config.sample_point = 750;
  config.starts_idle = true;
  BusDecoder decoder{config, [&](const BusEvent &event) { events.push_back(event); }};
  for (const auto &[time, level] : page.edges(signal))
    decoder.on_level(static_cast<Time>(time * 1e3), level);
  decoder.finish(static_cast<Time>(page.meta.at("duration_ns").get<double>() * 1e3));
  return events;
}

std::vector<BusEvent> good_frames(const std::vector<BusEvent> &events) {
  std::vector<BusEvent> frames;
  std::copy_if(events.begin(), events.end(), std::back_inserter(frames),
               [](const BusEvent &e) { return e.kind == BusEventKind::kFrame && e.acked; });
  return frames;
}

void expect_frames_of_log(const ReportedRun &run) {
  ASSERT_GT(run.log.entries.size(), 20U);
  ASSERT_EQ(run.page.size("f.start"), run.log.entries.size());
  const double first = run.page.at("f.start", 0);
  for (std::size_t i = 0; i < run.log.entries.size(); ++i) {
    EXPECT_EQ(run.page.frame(i), run.log.entries[i].frame) << i;
    // The log cuts to microseconds.
    EXPECT_NEAR(run.page.at("f.start", i) - first,
                static_cast<double>(run.log.entries[i].time) / 1e3, 1000.0);
    EXPECT_GT(run.page.at("f.end", i), run.page.at("f.start", i));
  }
}

TEST(ReportFrames, AreThoseOfTheLog) {
  expect_frames_of_log(busy());
  expect_frames_of_log(disturbed());
}

TEST(ReportFrames, KnowTheirSenderAndMessage) {
  const ReportPage &page = busy().page;
  std::map<int, int> by_message;
  for (std::size_t i = 0; i < page.size("f.start"); ++i) {
    const auto message = static_cast<int>(page.at("f.message", i));
    ASSERT_GE(message, 0);
    const auto &m = page.meta.at("messages").at(static_cast<std::size_t>(message));
    EXPECT_EQ(m.at("id"), page.frame(i).id);
    EXPECT_EQ(m.at("node"), page.at("f.sender", i));
    ++by_message[message];
  }
  for (const auto &[message, count] : by_message)
    EXPECT_EQ(busy().report.messages[static_cast<std::size_t>(message)].sent,
              static_cast<std::uint64_t>(count));
}

// Response times of the frames and those of the messages were added up on different ways.
TEST(ReportFrames, ResponseTimesAreThoseOfTheMessages) {
  const ReportPage &page = busy().page;
  for (std::size_t m = 0; m < busy().report.messages.size(); ++m) {
    const MessageReport &message = busy().report.messages[m];
    double least = 1e18, most = 0, sum = 0;
    for (std::size_t i = 0; i < page.size("f.start"); ++i) {
      if (page.at("f.message", i) != static_cast<double>(m)) continue;
      least = std::min(least, page.at("f.response", i));
      most = std::max(most, page.at("f.response", i));
      sum += page.at("f.response", i);
    }
    EXPECT_DOUBLE_EQ(least * 1e3, static_cast<double>(message.shortest));
    EXPECT_DOUBLE_EQ(most * 1e3, static_cast<double>(message.longest));
    EXPECT_NEAR(sum * 1e3, static_cast<double>(message.sum), 1.0);
    ASSERT_TRUE(message.bound);
    EXPECT_DOUBLE_EQ(page.meta.at("messages").at(m).at("bound_ns").get<double>() * 1e3,
                     static_cast<double>(*message.bound));
  }
}

// The page says why a scenario that asks for bounds has none.
TEST(ReportFrames, AReasonForNoBoundIsOnThePage) {
  EXPECT_EQ(busy().page.meta.at("no_bound"), "");
  Scenario scenario = busy_scenario();
  scenario.analysis = true;
  scenario.nodes.at(1).host.lowest_buffer_first = true;  // it has two messages
  const ReportedRun run = run_with_report(scenario);
  EXPECT_THAT(run.page.meta.at("no_bound").get<std::string>(),
              ::testing::HasSubstr("has 'lowest_buffer_first'"));
  EXPECT_TRUE(run.page.meta.at("messages").at(0).at("bound_ns").is_null());
}

void expect_retries_of_nodes(const ReportedRun &run) {
  ASSERT_EQ(run.report.pending, 0U);
  std::vector<double> failed(run.report.nodes.size()), lost(run.report.nodes.size());
  for (std::size_t i = 0; i < run.page.size("f.start"); ++i) {
    const auto sender = static_cast<std::size_t>(run.page.at("f.sender", i));
    failed[sender] += run.page.at("f.retries", i);
    lost[sender] += run.page.at("f.lost", i);
  }
  for (std::size_t n = 0; n < failed.size(); ++n) {
    const NodeCounts &counts = run.report.nodes[n].counts;
    EXPECT_EQ(failed[n], static_cast<double>(counts.retries())) << n;
    EXPECT_EQ(lost[n], static_cast<double>(counts.lost_arbitration)) << n;
    EXPECT_EQ(run.page.meta.at("nodes").at(n).at("retries"), counts.retries()) << n;
  }
}

TEST(ReportFrames, RetriesAndLostArbitrationsAddUp) {
  expect_retries_of_nodes(busy());
  expect_retries_of_nodes(disturbed());
}

// Clocks of different errors: a quantum is as long as the clock makes it.
TEST(ReportNodes, QuantaHaveTheErrorOfTheClock) {
  for (const auto &node : disturbed().page.meta.at("nodes")) {
    const double ticks = node.at("tq_ns").get<double>() * node.at("clock_hz").get<double>() *
                         (1 + node.at("error_ppm").get<double>() * 1e-6) / 1e9;
    EXPECT_NEAR(ticks, std::round(ticks), 1e-9) << node;
  }
  EXPECT_NE(disturbed().page.meta.at("nodes").at(0).at("error_ppm"),
            disturbed().page.meta.at("nodes").at(1).at("error_ppm"));
}

// FF-01, FF-02, ST-01: the frame codec gives every bit, its field and the stuff bits; three bits of
// intermission follow.
TEST(ReportBits, AreThoseOfTheCodec) {
  const ReportPage &page = busy().page;
  std::size_t joined = 0;
  for (std::size_t i = 0; i < page.size("f.start"); ++i) {
    const auto segment = static_cast<std::size_t>(page.at("f.segment", i));
    ASSERT_EQ(page.at("s.lanes", segment), 1);
    const auto bits = page.bits(static_cast<std::size_t>(page.at("s.lane", segment)));
    const EncodedFrame wanted = encode_frame(page.frame(i));
    ASSERT_EQ(bits.size(), wanted.bits.size() + 3) << i;
    for (std::size_t k = 0; k < wanted.bits.size(); ++k) {
      EXPECT_EQ(bits[k].seen, wanted.bits[k].level) << i << " " << k;
      EXPECT_EQ(bits[k].field, wanted.bits[k].field) << i << " " << k;
      EXPECT_EQ(bits[k].stuff, wanted.bits[k].is_stuff) << i << " " << k;
      // The lane is the sender's: it drives what is seen but the ACK slot, and the SOF of a frame
      // that it joins (IF-06).
      const bool others =
          wanted.bits[k].field == Field::kAck || (k == 0 && bits[k].sent == Level::kRecessive);
      EXPECT_EQ(bits[k].sent, others ? Level::kRecessive : wanted.bits[k].level) << i << " " << k;
      joined += k == 0 && others ? 1 : 0;
    }
    for (std::size_t k = wanted.bits.size(); k < bits.size(); ++k)
      EXPECT_EQ(bits[k].field, Field::kInt);
  }
  EXPECT_LT(joined, page.size("f.start") / 2) << "most senders send their SOF";
}

TEST(ReportBits, SegmentsHoldTheirFramesAndDoNotOverlap) {
  for (const ReportedRun *run : {&busy(), &disturbed()}) {
    const ReportPage &page = run->page;
    const double bit = 1e9 / page.meta.at("bitrate").get<double>();
    for (std::size_t i = 0; i < page.size("f.start"); ++i) {
      const auto segment = static_cast<std::size_t>(page.at("f.segment", i));
      EXPECT_LE(page.at("s.start", segment), page.at("f.start", i) + bit);
      EXPECT_GE(page.at("s.end", segment), page.at("f.end", i) - bit);
    }
    for (std::size_t s = 1; s < page.size("s.start"); ++s) {
      EXPECT_LT(page.at("s.start", s - 1), page.at("s.start", s));
      EXPECT_LE(page.at("s.end", s - 1), page.at("s.start", s) + bit) << s;
    }
  }
}

TEST(ReportEdges, TheWireDecodesToTheFrames) {
  for (const ReportedRun *run : {&busy(), &disturbed()}) {
    const auto frames = good_frames(decode(run->page, "wire"));
    ASSERT_EQ(frames.size(), run->page.size("f.start"));
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].frame, run->page.frame(i));
  }
}

// Without delays the bus is the AND of what is driven, at the same instants.
TEST(ReportEdges, TheWireIsTheAndOfTheNodes) {
  const ReportPage &page = busy().page;
  std::map<double, std::map<std::size_t, Level>> changes;
  for (std::size_t n = 0; n < 4; ++n)
    for (const auto &[time, level] : page.edges("tx" + std::to_string(n))) changes[time][n] = level;
  std::vector<Level> driven(4, Level::kRecessive);
  std::vector<std::pair<double, Level>> wire;
  for (const auto &[time, nodes] : changes) {
    for (const auto &[node, level] : nodes) driven[node] = level;
    Level level = Level::kRecessive;
    for (const Level d : driven) level = level & d;
    if (wire.empty() || wire.back().second != level) wire.emplace_back(time, level);
  }
  EXPECT_EQ(wire, page.edges("wire"));
  EXPECT_GT(wire.size(), 1000U);
  EXPECT_FALSE(page.has("rx0")) << "nobody can see anything but the wire";
}

// With cables each node's pin carries the frames too, later.
TEST(ReportEdges, ReceivedLevelsAreThereWithDelays) {
  Scenario scenario = busy_scenario();
  scenario.nodes[3].link.cable = cable_delay(20);
  const ReportedRun run = run_with_report(scenario);
  for (std::size_t n = 0; n < 4; ++n) {
    const auto frames = good_frames(decode(run.page, "rx" + std::to_string(n)));
    ASSERT_EQ(frames.size(), run.page.size("f.start")) << n;
    for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].frame, run.page.frame(i));
  }
  EXPECT_FALSE(run.page.edges("rx3").empty());
}

TEST(ReportEvents, AreAsManyAsTheMonitorCounts) {
  const ReportPage &page = disturbed().page;
  const auto &kinds = page.column("e.kind");
  const auto count = [&](double kind) {
    return static_cast<std::uint64_t>(std::count(kinds.begin(), kinds.end(), kind));
  };
  EXPECT_GT(disturbed().report.error_frames, 10U);
  EXPECT_EQ(count(0), disturbed().report.error_frames);
  EXPECT_EQ(count(1), disturbed().report.overload_frames);
  EXPECT_GT(count(2), 0U) << "errors of the node that is cut off";
  EXPECT_EQ(page.meta.at("summary").at("error_frames"), disturbed().report.error_frames);
  EXPECT_TRUE(busy().page.column("e.kind").empty());
}

TEST(ReportEvents, LieInTheirSegments) {
  const ReportPage &page = disturbed().page;
  for (std::size_t e = 0; e < page.size("e.start"); ++e) {
    EXPECT_LT(page.at("e.start", e), page.at("e.end", e));
    if (page.at("e.node", e) == 255) continue;
    const auto segment = static_cast<std::size_t>(page.at("e.segment", e));
    ASSERT_LT(segment, page.size("s.start"));
    EXPECT_LE(page.at("s.start", segment), page.at("e.start", e) + 2000);
    EXPECT_GT(page.at("s.end", segment), page.at("e.start", e));
  }
}

// AR-02: the first bit in which the identifiers differ, the loser's recessive; what went on is the
// frame that ends.
TEST(ReportLosses, HaveTheirWinnerAndTheirPlace) {
  const ReportPage &page = busy().page;
  std::vector<std::uint64_t> lost(4);
  for (std::size_t l = 0; l < page.size("l.time"); ++l) {
    const auto node = static_cast<std::size_t>(page.at("l.node", l));
    ++lost[node];
    std::size_t frame = 0;
    while (page.at("f.end", frame) < page.at("l.time", l)) ++frame;
    EXPECT_EQ(page.at("l.winner", l), page.at("f.sender", frame));
    EXPECT_NE(page.at("l.winner", l), page.at("l.node", l));
    // The place names a recessive bit of the arbitration field, which the winner has dominant.
    const auto lane = page.at("s.lane", static_cast<std::size_t>(page.at("l.segment", l)));
    const auto bits = page.bits(static_cast<std::size_t>(lane));
    unsigned index = 0;
    bool found = false;
    for (std::size_t k = 1; k < bits.size() && !found; ++k) {
      if (bits[k].stuff) continue;
      index = bits[k].field == bits[k - 1].field ? index + 1 : 0;
      found = static_cast<double>(bits[k].field) == page.at("l.field", l) &&
              index == page.at("l.index", l);
      if (found) {
        EXPECT_EQ(bits[k].seen, Level::kDominant) << l;
      }
    }
    EXPECT_TRUE(found) << l;
  }
  for (std::size_t n = 0; n < 4; ++n)
    EXPECT_EQ(lost[n], busy().report.nodes[n].counts.lost_arbitration) << n;
  EXPECT_GT(page.size("l.time"), 20U);
}

TEST(ReportCounters, EndWhereTheNodesEnd) {
  const ReportPage &page = disturbed().page;
  std::vector<double> tec(3), rec(3), state(3), most(3);
  for (std::size_t c = 0; c < page.size("c.time"); ++c) {
    const auto node = static_cast<std::size_t>(page.at("c.node", c));
    if (c < 3) {
      EXPECT_EQ(page.at("c.time", c), 0);
    }
    tec[node] = page.at("c.tec", c);
    rec[node] = page.at("c.rec", c);
    state[node] = page.at("c.state", c);
    most[node] = std::max(most[node], page.at("c.tec", c));
    // FC-11: passive from 128 on.
    EXPECT_EQ(state[node] == 0, tec[node] < 128 && rec[node] < 128);
  }
  for (std::size_t n = 0; n < 3; ++n) {
    const NodeCounts &counts = disturbed().report.nodes[n].counts;
    EXPECT_EQ(tec[n], counts.tec);
    EXPECT_EQ(rec[n], counts.rec);
    EXPECT_EQ(most[n], counts.max_tec);
    EXPECT_GT(counts.max_tec + counts.max_rec, 0U);
  }
}

/// Where the bits of each node really begin: the clock edge behind the trace's boundary.
class Boundaries : public BusObserver {
 public:
  [[nodiscard]] unsigned interests() const override { return kClocks; }
  void on_clock(NodeId node, Time time, std::uint64_t word) override {
    if (ending[node]) starts[node].insert(time);
    ending[node] = (word & kTraceBoundary) != 0;
  }
  std::map<NodeId, std::set<Time>> starts;
  std::map<NodeId, bool> ending;
};

TEST(ReportBits, BeginWhereTheCoresBitsBegin) {
  Scenario scenario = disturbed_scenario();
  scenario.outputs.report = report_file(".html");
  Time started = 0;
  Boundaries real;
  {
    Simulation simulation{scenario, 250e3};
    simulation.bus().add(real);
    simulation.join();
    simulation.start(simulation.bus().now());
    started = simulation.started();
    simulation.bus().run_for(scenario.duration);
    simulation.drain();
    static_cast<void>(simulation.finish());
    simulation.bus().remove(real);
  }
  const ReportPage page{scenario.outputs.report};
  std::size_t longer = 0, shorter = 0, checked = 0;
  for (std::size_t lane = 0; lane < page.size("b.start"); ++lane) {
    const auto node = static_cast<NodeId>(page.at("b.node", lane));
    const double quanta = page.meta.at("nodes").at(node).at("quanta");
    const auto bits = page.bits(lane);
    double start = page.at("b.start", lane);
    const double tq = page.at("b.tq", lane) * 1e3;
    for (const ReportBit &bit : bits) {
      const auto time = started + static_cast<Time>(std::llround(start * 1e3));
      const auto next = real.starts.at(node).lower_bound(time - kNanosecond);
      const bool exact = next != real.starts.at(node).end() && *next <= time + kNanosecond;
      // An edge that ends PHASE_SEG2 early lies in the SYNC_SEG of the next bit (SY-08); the core
      // takes the bit over at the end of that quantum.
      const bool early = !exact && (&bit == bits.data() || (&bit - 1)->q < 0) &&
                         std::abs(static_cast<double>(*next - time) - tq) <= 1e3;
      // A hard synchronisation begins a SOF without a boundary; the bit behind it shows its length.
      ASSERT_TRUE(exact || early || bit.field == Field::kSof)
          << "node " << node << " lane " << lane << " bit " << (&bit - bits.data());
      ++checked;
      longer += bit.q > 0 ? 1 : 0;
      shorter += bit.q < 0 ? 1 : 0;
      start += (quanta + bit.q) * page.at("b.tq", lane);
    }
  }
  EXPECT_GT(checked, 5000U);
  EXPECT_GT(longer, 50U);
  EXPECT_GT(shorter, 50U);
}

TEST(ReportLimit, FramesEventsAndCountersStayComplete) {
  Scenario scenario = disturbed_scenario();
  scenario.outputs.report_frames = 10;
  const ReportedRun run = run_with_report(scenario);
  EXPECT_TRUE(run.page.meta.at("truncated").is_string());
  EXPECT_TRUE(disturbed().page.meta.at("truncated").is_null());
  const double end = run.page.meta.at("detail_end_ns");
  EXPECT_LT(end, run.page.meta.at("duration_ns").get<double>());
  EXPECT_GE(end, run.page.at("f.end", 9));
  EXPECT_LT(end, run.page.at("f.end", 10));
  for (const char *column : {"f.start", "f.id", "e.start", "e.kind", "c.tec", "l.time"})
    EXPECT_EQ(run.page.column(column), disturbed().page.column(column)) << column;
  EXPECT_GT(run.page.size("s.start"), 9U);
  EXPECT_LT(run.page.size("s.start"), disturbed().page.size("s.start"));
  for (const char *edges : {"wire", "tx0", "rx2"}) {
    const auto all = disturbed().page.edges(edges), some = run.page.edges(edges);
    ASSERT_LT(some.size(), all.size());
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << edges;
    EXPECT_LE(some.back().first, end);
  }
  for (std::size_t i = 0; i < run.page.size("f.start"); ++i)
    EXPECT_EQ(run.page.at("f.segment", i) == 4294967295.0, run.page.at("f.start", i) > end) << i;
}

}  // namespace
}  // namespace vericansim
