// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveforms of a bus: the modules that its nodes become.
#include "trace/bus_wave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/bus.hpp"

namespace vericansim {
namespace {

using ::testing::ElementsAre;

class Named : public Node {
 public:
  explicit Named(const std::string &name) : Node{name, {.frequency_hz = 1e6}} {}
  void clock(Level) override {}
};

/// Modules in the order in which they are declared, each once in a row.
class Modules : public WaveSink {
 public:
  explicit Modules(std::vector<std::string> &names) : names_{names} {}
  Signal add_wire(const std::string &scope, const std::string &name, unsigned) override {
    return add_text(scope, name);
  }
  Signal add_text(const std::string &scope, const std::string &) override {
    if (names_.empty() || names_.back() != scope) names_.push_back(scope);
    return 0;
  }
  void start() override {}
  void set(Time, Signal, std::uint64_t) override {}
  void set(Time, Signal, std::string_view) override {}
  void finish(Time) override {}

 private:
  std::vector<std::string> &names_;
};

std::vector<std::string> modules_of(const std::vector<std::string> &nodes) {
  std::deque<Named> all;
  Bus bus;
  for (const std::string &name : nodes) bus.add(all.emplace_back(name));
  std::vector<std::string> modules;
  const BusWave wave{bus, std::make_unique<Modules>(modules), kMicrosecond};
  return modules;
}

TEST(BusWave, ANodeIsAModuleOfItsName) {
  EXPECT_THAT(modules_of({"gateway", "engine.ecu 2", ""}),
              ElementsAre("bus", "gateway", "engine_ecu_2", "node"));
  EXPECT_THAT(modules_of({"Lüfter", "Läufer", "\t\x01"}),
              ElementsAre("bus", "Lüfter", "Läufer", "__"));
}

// A name that can be kept is kept, whatever comes before it.
TEST(BusWave, NamesThatBecomeOneStayApart) {
  EXPECT_THAT(modules_of({"a b", "a.b", "a_b", "a_b_2", "a$b"}),
              ElementsAre("bus", "a_b_3", "a_b_4", "a_b", "a_b_2", "a_b_5"));
  EXPECT_THAT(modules_of({"x", "bus", "x"}), ElementsAre("bus", "x", "bus_2", "x_2"));
}

}  // namespace
}  // namespace vericansim
