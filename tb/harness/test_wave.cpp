// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TestWave: see test_wave.hpp.
#include "harness/test_wave.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "bus/trace.hpp"
#include "trace/bus_wave.hpp"

namespace vericansim {
namespace {

constexpr Time kDirectClock = 125 * kNanosecond;
// BusWave holds changes back for the longest bit: 256 clocks x 25 quanta at 8 MHz.
constexpr Time kLongestBit = kMillisecond;

std::string &run_name() {
  static std::string name;
  return name;
}

/// A file named after the running test, and numbered if the test has more than one bench; empty if
/// no waveform is wanted.
std::string wave_path() {
  const char *folder = std::getenv("VERICAN_WAVE_DIR");
  const ::testing::TestInfo *test = ::testing::UnitTest::GetInstance()->current_test_info();
  if (folder == nullptr || (test == nullptr && run_name().empty())) return {};
  std::string name = run_name();
  if (test != nullptr) name = std::string{test->test_suite_name()} + "." + test->name();
  for (char &c : name)
    if (c == '/') c = '_';
  static std::string last;
  static unsigned benches = 0;
  benches = name == last ? benches + 1 : 1;
  last = name;
  if (benches > 1) name += "-" + std::to_string(benches);
  return (std::filesystem::path{folder} / (name + ".fst")).string();
}

/// Stands for a node that the bench clocks itself.
class NamedNode : public Node {
 public:
  explicit NamedNode(const std::string &name) : Node{name, {}} {}
  void clock(Level) override {}
};

}  // namespace

struct TestWave::Attached {
  Attached(Bus &watched, const std::string &path)
      : bus{watched}, wave{watched, open_fst(path), kLongestBit} {
    bus.add(wave);
  }
  ~Attached() {
    bus.remove(wave);
    wave.finish(bus.now());
  }
  Attached(const Attached &) = delete;
  Attached &operator=(const Attached &) = delete;

  Bus &bus;
  BusWave wave;
};

struct TestWave::Direct {
  struct Watched {
    const Node *node;
    std::unique_ptr<NamedNode> stand_in;
    BitRecorder recorder{};
    Level tx = Level::kRecessive;
    Level rx = Level::kRecessive;
  };

  std::vector<Watched> nodes;
  Bus stage;  // never runs; names the nodes
  std::unique_ptr<BusWave> wave;
  Time now = 0;
  Level wire = Level::kRecessive;
};

void TestWave::name_run(const std::string &name) { run_name() = name; }

TestWave::TestWave(Bus &bus) {
  const std::string path = wave_path();
  if (!path.empty()) attached_ = std::make_unique<Attached>(bus, path);
}

TestWave::TestWave(std::vector<const Node *> nodes) {
  const std::string path = wave_path();
  if (path.empty()) return;
  direct_ = std::make_unique<Direct>();
  for (const Node *node : nodes) {
    direct_->nodes.push_back({.node = node, .stand_in = std::make_unique<NamedNode>(node->name())});
    direct_->stage.add(*direct_->nodes.back().stand_in);
  }
  direct_->wave = std::make_unique<BusWave>(direct_->stage, open_fst(path), kLongestBit);
}

TestWave::~TestWave() {
  if (direct_) direct_->wave->finish(direct_->now);
}

TestWave::TestWave(TestWave &&) noexcept = default;

void TestWave::begin_clock(Level wire) {
  direct_->now += kDirectClock;
  if (wire != std::exchange(direct_->wire, wire)) direct_->wave->on_level(direct_->now, wire);
}

void TestWave::record(unsigned i, Level rx) {
  Direct::Watched &watched = direct_->nodes[i];
  BusWave &wave = *direct_->wave;
  const Time now = direct_->now;
  const std::uint64_t word = watched.node->trace();
  if (rx != std::exchange(watched.rx, rx)) wave.on_node_rx(i, now, rx);
  const Level tx = watched.node->tx();
  if (tx != std::exchange(watched.tx, tx)) wave.on_node_tx(i, now, tx);
  if (watched.recorder.clocked(word, now + kDirectClock)) wave.on_bit(i, watched.recorder.record());
  wave.on_clock(i, now, word);
}

}  // namespace vericansim
