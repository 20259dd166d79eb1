// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// CanBus with plain pins: the times at which levels arrive, computed by hand from the links.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "systemc/can_bus.hpp"
#include "systemc/systemc_rig.hpp"

namespace vericansim {
namespace {

using sc_core::sc_time;

// Writes changes of a signal down as "time:level".
class Ear : public sc_core::sc_module {
 public:
  Ear(const sc_core::sc_module_name &name, const sc_core::sc_signal_in_if<bool> &signal)
      : sc_core::sc_module{name}, signal_{signal} {
    SC_HAS_PROCESS(Ear);
    SC_METHOD(hear);
    sensitive << signal.value_changed_event();
    dont_initialize();
  }
  std::string heard;

 private:
  void hear() {
    heard += std::to_string(to_ps(sc_core::sc_time_stamp())) + (signal_.read() ? ":r " : ":d ");
  }
  const sc_core::sc_signal_in_if<bool> &signal_;
};

// Two nodes: stubs of 1 and 2 ns, transmitters 10 and 20 ns, receivers 100 and 200 ns.
struct Pair {
  Pair() {
    bus.add_pins("a", {.cable = 1'000, .transmitter = 10'000, .receiver = 100'000});
    bus.add_pins("b", {.cable = 2'000, .transmitter = 20'000, .receiver = 200'000});
    rx_a = std::make_unique<Ear>("rx_a", bus.pins(0).rx);
    rx_b = std::make_unique<Ear>("rx_b", bus.pins(1).rx);
    star = std::make_unique<Ear>("star", bus.level);
  }
  void drive(NodeId node, Time time, bool level) {
    sc_core::sc_spawn([this, node, time, level] {
      sc_core::wait(to_sc_time(time));
      bus.pins(node).tx.write(level);
    });
  }
  void run() { sc_core::sc_start(sc_time(10, sc_core::SC_US)); }

  CanBus bus{"bus"};
  std::unique_ptr<Ear> rx_a, rx_b, star;
};

TEST(CanBusPins, IsRecessiveWhileNobodyDrives) {
  simulate([] {
    Pair pair;
    pair.run();
    EXPECT_TRUE(pair.bus.level.read());
    EXPECT_TRUE(pair.bus.pins(0).rx.read());
    EXPECT_EQ(pair.star->heard + pair.rx_a->heard + pair.rx_b->heard, "");
  });
}

TEST(CanBusPins, LevelsArriveAfterTransmitterStubsAndReceiver) {
  simulate([] {
    Pair pair;
    pair.drive(0, 1'000'000, false);
    pair.drive(0, 3'000'000, true);
    pair.run();
    EXPECT_EQ(pair.star->heard, "1011000:d 3011000:r ");  // 10 + 1
    EXPECT_EQ(pair.rx_a->heard, "1110000:d 3110000:r ");  // 10 + 100: not through the stub
    EXPECT_EQ(pair.rx_b->heard, "1213000:d 3213000:r ");  // 10 + 1 + 2 + 200
  });
}

// Shorter than the delay, and overlapping: the AND of what has arrived at each place.
TEST(CanBusPins, TheLevelIsTheAndOfWhatHasArrived) {
  simulate([] {
    Pair pair;
    pair.drive(0, 1'000'000, false);
    pair.drive(0, 1'050'000, true);
    pair.drive(1, 1'030'000, false);
    pair.drive(1, 1'080'000, true);
    pair.run();
    EXPECT_EQ(pair.star->heard, "1011000:d 1102000:r ");  // b from 1052 to 1102
    EXPECT_EQ(pair.rx_a->heard, "1110000:d 1203000:r ");  // b from 1153 to 1203
    EXPECT_EQ(pair.rx_b->heard, "1213000:d 1300000:r ");  // b from 1250 to 1300
  });
}

TEST(CanBusPins, ADelayCanBeSetForOneWay) {
  simulate([] {
    Pair pair;
    pair.bus.set_delay(0, 1, 5'000);
    pair.drive(0, 1'000'000, false);
    pair.drive(1, 2'000'000, false);
    pair.run();
    EXPECT_EQ(pair.rx_b->heard, "1005000:d ");
    EXPECT_EQ(pair.rx_a->heard, "1110000:d ");
    EXPECT_THROW(pair.bus.set_delay(0, 1, -1), std::invalid_argument);
  });
}

// What is driven behind a level that is on its way does not overtake it.
TEST(CanBusPins, AShorterDelayKeepsTheOrderOfASource) {
  simulate([] {
    Pair pair;
    pair.bus.set_delay(0, 1, 500'000);
    pair.drive(0, 1'000'000, false);
    sc_core::sc_spawn([&pair] {
      sc_core::wait(to_sc_time(1'050'000));
      pair.bus.set_delay(0, 1, 0);
    });
    pair.drive(0, 1'100'000, true);
    pair.drive(0, 2'000'000, false);
    pair.run();
    EXPECT_EQ(pair.rx_b->heard, "2000000:d ");
  });
}

TEST(CanBusPins, WithoutDelayTheLevelIsThereAtOnce) {
  simulate([] {
    CanBus bus("bus");
    bus.add_pins("a");
    bus.add_pins("b");
    Ear rx("rx", bus.pins(1).rx);
    sc_core::sc_spawn([&bus] {
      sc_core::wait(sc_time(7, sc_core::SC_PS));
      bus.pins(0).tx.write(false);
    });
    sc_core::sc_start(sc_time(1, sc_core::SC_NS));
    EXPECT_EQ(rx.heard, "7:d ");
  });
}

TEST(CanBusPins, TooManyNodesAndNegativeDelaysAreRefused) {
  simulate([] {
    CanBus bus("bus");
    EXPECT_THROW(bus.add_pins("x", {.cable = -1}), std::invalid_argument);
    for (unsigned i = 0; i < Bus::kMaxNodes; ++i) bus.add_pins("n" + std::to_string(i));
    EXPECT_THROW(bus.add_pins("x"), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(bus.pins(Bus::kMaxNodes)), std::out_of_range);
  });
}

TEST(CanBusPins, LooselyTimedModulesHaveNone) {
  simulate([] {
    CanBus bus("bus");
    VericanTlm can("can", {.timing = TlmTiming::kLooselyTimed});
    const NodeId id = bus.attach(can);
    EXPECT_THROW(static_cast<void>(bus.pins(id)), std::out_of_range);
    EXPECT_THROW(bus.attach(can), std::invalid_argument);
  });
}

TEST(CanBusPins, ACoarseTimeResolutionIsFatal) {
  simulate([] {
    sc_core::sc_set_time_resolution(1, sc_core::SC_NS);
    sc_core::sc_report_handler::set_actions(sc_core::SC_FATAL, sc_core::SC_THROW);
    EXPECT_THROW(CanBus("bus"), sc_core::sc_report);
  });
}

}  // namespace
}  // namespace vericansim
