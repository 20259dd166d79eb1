// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// TestWave: the waveform of the running test, for `make wave`.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "bus/bus.hpp"

namespace vericansim {

/// Writes what the nodes of a test do to <VERICAN_WAVE_DIR>/<suite>.<test>.fst. Without that
/// environment variable it does nothing and costs one comparison a clock.
class TestWave {
 public:
  /// Follows a bus, which must hold all its nodes already and outlive this object.
  explicit TestWave(Bus &bus);
  /// For benches that clock their nodes themselves: one clock() and then one node() for each node
  /// tell what happened in a clock, drawn as 125 ns.
  explicit TestWave(std::vector<const Node *> nodes);
  ~TestWave();
  TestWave(TestWave &&) noexcept;
  /// Name of the file in a program that is no GoogleTest; without one it writes no waveform.
  static void name_run(const std::string &name);
  TestWave &operator=(TestWave &&) = delete;

  /// The next clock begins; level of the wire in it.
  void clock(Level wire) {
    if (direct_) begin_clock(wire);
  }
  /// Node `i` has been clocked and saw `rx` at its pin.
  void node(unsigned i, Level rx) {
    if (direct_) record(i, rx);
  }

 private:
  struct Direct;

  void begin_clock(Level wire);
  void record(unsigned i, Level rx);

  struct Attached;
  std::unique_ptr<Attached> attached_;
  std::unique_ptr<Direct> direct_;
};

}  // namespace vericansim
