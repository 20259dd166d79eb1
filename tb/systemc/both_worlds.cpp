// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Both worlds: see both_worlds.hpp.
#include "systemc/both_worlds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "systemc/can_bus.hpp"
#include "systemc/node_clock.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

// When the spoiler drives dominant, clock by clock.
class Spoils {
 public:
  explicit Spoils(const Story &story) : list_{&story.spoils} {}
  Level clock() {
    while (next_ < list_->size() && cycle_ >= (*list_)[next_].first + (*list_)[next_].second)
      ++next_;
    const bool now = next_ < list_->size() && cycle_ >= (*list_)[next_].first;
    ++cycle_;
    return now ? Level::kDominant : Level::kRecessive;
  }

 private:
  const std::vector<std::pair<std::uint64_t, unsigned>> *list_;
  std::size_t next_ = 0;
  std::uint64_t cycle_ = 0;
};

class SpoilerNode : public Node {
 public:
  explicit SpoilerNode(const Story &story) : Node{"spoiler", story.spoiler_clock}, spoils_{story} {}
  void clock(Level) override { drive(spoils_.clock()); }

 private:
  Spoils spoils_;
};

class Recorder : public BusObserver {
 public:
  explicit Recorder(Seen &seen) : seen_{seen} {}
  [[nodiscard]] unsigned interests() const override { return kLevels | kNodeLevels; }
  void on_level(Time time, Level level) override { seen_.level.push_back({time, level}); }
  void on_node_tx(NodeId node, Time time, Level level) override {
    seen_.tx[node].push_back({time, level});
  }

 private:
  Seen &seen_;
};

Seen empty(const Story &story) {
  Seen seen;
  const std::size_t count = story.nodes.size();
  seen.ahb.resize(count);
  seen.tx.resize(count + 1);
  return seen;
}

void watch(RtlNode &node, std::vector<AhbRow> &rows) {
  node.ahb().watch([&node, &rows](const AhbRequest &request, const AhbResponse &response) {
    rows.push_back({node.cycles(), request, response});
  });
}

void take_results(Seen &seen, RtlNode &node, const DriverProgram &program) {
  seen.stats.push_back(program.stats());
  seen.received.push_back(program.received);
  std::vector<std::uint32_t> words;
  for (std::uint32_t address = 0; address < kSocketWindow; address += 4)
    words.push_back(address == 8 ? 0 : node.peek({.address = address}).data);
  seen.registers.push_back(std::move(words));
}

}  // namespace

Seen run_in_simulator(const Story &story) {
  Seen seen = empty(story);
  std::vector<std::unique_ptr<RtlNode>> nodes;
  std::vector<std::unique_ptr<DriverProgram>> programs(story.nodes.size());
  std::vector<std::unique_ptr<NodeProcessor>> processors;
  SpoilerNode spoiler(story);
  Recorder recorder(seen);
  Bus bus;
  for (std::size_t i = 0; i < story.nodes.size(); ++i) {
    const ScenarioNode &node = story.nodes[i];
    nodes.push_back(RtlNode::create("n" + std::to_string(i), node.clock, node.num_mb));
    watch(*nodes[i], seen.ahb[i]);
    bus.add(*nodes[i], node.link);
    processors.push_back(std::make_unique<NodeProcessor>(*nodes[i], [&, i](Processor &processor) {
      programs[i] = std::make_unique<DriverProgram>(processor, story.nodes[i].program);
      programs[i]->run();
    }));
  }
  if (!story.spoils.empty()) bus.add(spoiler);
  bus.add(recorder);
  for (auto &processor : processors) processor->start();
  bus.run_until(story.end);
  for (std::size_t i = 0; i < nodes.size(); ++i) take_results(seen, *nodes[i], *programs[i]);
  return seen;
}

// ---- SystemC

namespace {

// A module with the initiator that is its processor.
class Station : public sc_core::sc_module, private Processor {
 public:
  Station(const sc_core::sc_module_name &name, const ScenarioNode &node,
          const SystemcVariant &variant, unsigned late)
      : sc_core::sc_module{name},
        can{"can", {.timing = variant.timing, .num_mb = node.num_mb, .clock = node.clock}},
        program{*this, node.program},
        cpu_{"cpu",
             [this, late](Master &) {
               if (late != 0) wait_clocks(late);
               program.run();
             },
             variant.timing == TlmTiming::kLooselyTimed ? to_sc_time(variant.quantum)
                                                        : sc_core::SC_ZERO_TIME},
        loose_{variant.timing == TlmTiming::kLooselyTimed},
        edges_{node.clock} {
    cpu_.socket.bind(can.socket);
    can.irq.bind(irq_);
    if (!variant.clk_ports) return;
    clock_ = std::make_unique<NodeClock>("clock", node.clock);
    clock_->out.bind(clk_);
    if (variant.delta_lag == 0) {
      can.clk.bind(clk_);
    } else {
      lag_ = std::make_unique<DeltaLag>("lag", clk_, variant.delta_lag * (1 + node.program.number));
      can.clk.bind(lag_->out());
    }
  }

  VericanTlm can;
  DriverProgram program;

 private:
  AhbResult access(const std::vector<AhbTransfer> &transfers) override {
    std::vector<std::uint32_t> words(transfers.size());
    words[0] = transfers[0].data;
    tlm::tlm_generic_payload payload;
    const unsigned size = 1u << static_cast<unsigned>(transfers[0].size);
    Master::fill(payload, transfers[0].write ? tlm::TLM_WRITE_COMMAND : tlm::TLM_READ_COMMAND,
                 transfers[0].address, words.data(),
                 size * static_cast<unsigned>(transfers.size()));
    cpu_.transport(payload);
    return {words.back(), payload.is_response_error(), 0};
  }
  void wait_for_interrupt() override {
    cpu_.sync();
    while (!irq_.read()) cpu_.wait(irq_.posedge_event());
  }
  // Until that many edges have been; what the processor reads then is as of the last one.
  void wait_clocks(unsigned count) override {
    if (loose_) {
      cpu_.ahead += to_sc_time(static_cast<Time>(edges_.period_ps())) * count;
      return;
    }
    const Time now = to_ps(sc_core::sc_time_stamp());
    while (edges_.next() <= now) edges_.tick();
    for (unsigned i = 1; i < count; ++i) edges_.tick();
    cpu_.wait(to_sc_time(edges_.next() - now));
    for (int i = 0; i < 40; ++i) cpu_.wait(sc_core::SC_ZERO_TIME);
  }

  Master cpu_;
  bool loose_;
  Clock edges_;
  sc_core::sc_signal<bool> irq_{"irq"};
  sc_core::sc_signal<bool> clk_{"clk"};
  std::unique_ptr<NodeClock> clock_;
  std::unique_ptr<DeltaLag> lag_;
};

// Drives its pin as SpoilerNode does.
class Spoiler : public sc_core::sc_module {
 public:
  Spoiler(const sc_core::sc_module_name &name, const Story &story)
      : sc_core::sc_module{name}, clock_{story.spoiler_clock}, spoils_{story} {
    SC_HAS_PROCESS(Spoiler);
    SC_METHOD(run);
  }
  sc_core::sc_out<bool> tx{"tx"};

 private:
  void run() {
    const Time now = to_ps(sc_core::sc_time_stamp());
    if (clock_.next() == now) {
      tx.write(to_bool(spoils_.clock()));
      clock_.tick();
    }
    next_trigger(to_sc_time(clock_.next() - now));
  }
  Clock clock_;
  Spoils spoils_;
};

// A debugger that looks at everything, at odd times.
class Debugger : public sc_core::sc_module {
 public:
  Debugger(const sc_core::sc_module_name &name, std::vector<VericanTlm *> targets)
      : sc_core::sc_module{name}, targets_{std::move(targets)} {
    SC_HAS_PROCESS(Debugger);
    SC_METHOD(look);
  }

 private:
  void look() {
    std::vector<std::uint32_t> words(kSocketWindow / 4);
    tlm::tlm_generic_payload payload;
    Master::fill(payload, tlm::TLM_READ_COMMAND, 0, words.data(), kSocketWindow);
    for (VericanTlm *target : targets_) {
      auto *socket = dynamic_cast<tlm::tlm_fw_transport_if<> *>(
          target->socket.get_base_export().get_interface());
      EXPECT_EQ(socket->transport_dbg(payload), kSocketWindow);
    }
    next_trigger(sc_core::sc_time(3'013'007, sc_core::SC_NS));
  }
  std::vector<VericanTlm *> targets_;
};

// Writes the changes of a signal down; of several at one instant, the last.
class Ear : public sc_core::sc_module {
 public:
  Ear(const sc_core::sc_module_name &name, const sc_core::sc_signal_in_if<bool> &signal,
      std::vector<Change> &changes)
      : sc_core::sc_module{name}, signal_{signal}, changes_{changes} {
    SC_HAS_PROCESS(Ear);
    SC_METHOD(hear);
    sensitive << signal.value_changed_event();
    dont_initialize();
  }

 private:
  void hear() {
    const Time now = to_ps(sc_core::sc_time_stamp());
    if (!changes_.empty() && changes_.back().time == now) changes_.pop_back();
    const Level before = changes_.empty() ? Level::kRecessive : changes_.back().level;
    if (to_level(signal_.read()) != before) changes_.push_back({now, to_level(signal_.read())});
  }
  const sc_core::sc_signal_in_if<bool> &signal_;
  std::vector<Change> &changes_;
};

}  // namespace

Seen run_in_systemc(const Story &story, const SystemcVariant &variant) {
  Seen seen = empty(story);
  CanBus bus("bus");
  bus.set_quantum(to_sc_time(variant.quantum));
  std::vector<std::unique_ptr<Station>> stations;
  for (std::size_t i = 0; i < story.nodes.size(); ++i) {
    const unsigned late = i + 1 == story.nodes.size() ? variant.shifted_start : 0;
    stations.push_back(std::make_unique<Station>(("n" + std::to_string(i)).c_str(), story.nodes[i],
                                                 variant, late));
    bus.attach(stations[i]->can, story.nodes[i].link);
    watch(stations[i]->can.node(), seen.ahb[i]);
  }
  std::vector<std::unique_ptr<Ear>> ears;
  SpoilerNode loose_spoiler(story);
  Recorder recorder(seen);
  std::unique_ptr<Spoiler> spoiler;
  if (variant.timing == TlmTiming::kLooselyTimed) {
    if (!story.spoils.empty()) bus.kernel().add(loose_spoiler);
    bus.kernel().add(recorder);
  } else {
    spoiler = std::make_unique<Spoiler>("spoiler", story);
    spoiler->tx.bind(bus.pins(bus.add_pins("spoiler")).tx);
    ears.push_back(std::make_unique<Ear>("level_ear", bus.level, seen.level));
    for (std::size_t i = 0; i < seen.tx.size(); ++i)
      ears.push_back(std::make_unique<Ear>(("ear" + std::to_string(i)).c_str(),
                                           bus.pins(static_cast<NodeId>(i)).tx, seen.tx[i]));
  }
  std::unique_ptr<Debugger> debugger;
  if (variant.debugger) {
    std::vector<VericanTlm *> targets;
    for (auto &station : stations) targets.push_back(&station->can);
    debugger = std::make_unique<Debugger>("debugger", targets);
  }
  sc_core::sc_start(to_sc_time(story.end));
  for (auto &station : stations) take_results(seen, station->can.node(), station->program);
  return seen;
}

// ---- Comparison

namespace {

std::string text(const AhbRow &row) {
  const AhbRequest &q = row.request;
  return fmt::format(
      "clock {} addr {:04x} trans {} write {} size {} burst {} prot {:x} wdata {:08x} | rdata "
      "{:08x} ready {} resp {}",
      row.cycle, q.haddr, static_cast<int>(q.htrans), q.hwrite, static_cast<int>(q.hsize),
      static_cast<int>(q.hburst), q.hprot, q.hwdata, row.response.hrdata, row.response.hready,
      row.response.hresp);
}

std::string text(const Change &change) {
  return fmt::format("{} ps level {}", change.time, static_cast<int>(change.level));
}

std::string text(std::uint32_t word) { return fmt::format("{:08x}", word); }

template <typename T>
std::string compare(const std::string &what, const std::vector<T> &expected,
                    const std::vector<T> &found) {
  const std::size_t count = std::max(expected.size(), found.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::string a = i < expected.size() ? text(expected[i]) : "nothing";
    const std::string b = i < found.size() ? text(found[i]) : "nothing";
    if (a != b) return fmt::format("{}, row {}: expected {}, found {}", what, i, a, b);
  }
  return {};
}

}  // namespace

std::string first_difference(const Seen &expected, const Seen &found) {
  std::string difference = compare("level of the bus", expected.level, found.level);
  for (std::size_t i = 0; i < expected.tx.size() && difference.empty(); ++i)
    difference = compare(fmt::format("tx of node {}", i), expected.tx[i], found.tx[i]);
  for (std::size_t i = 0; i < expected.ahb.size() && difference.empty(); ++i)
    difference = compare(fmt::format("AHB of node {}", i), expected.ahb[i], found.ahb[i]);
  for (std::size_t i = 0; i < expected.registers.size() && difference.empty(); ++i)
    difference =
        compare(fmt::format("registers of node {}", i), expected.registers[i], found.registers[i]);
  return difference;
}

}  // namespace vericansim
