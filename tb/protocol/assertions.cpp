// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Assertions: see assertions.hpp.
#include "protocol/assertions.hpp"

#include <utility>

namespace vericansim {

Assertions::Assertions(CoreBench &bench) : bench_{bench} {
  for (unsigned i = 0; i < bench.size(); ++i)
    watched_.emplace_back([this, i](const std::string &what) { broken(i, what); });
  bench.on_bit = [this, then = std::move(bench.on_bit)](unsigned i, const DutBit &bit) {
    const CoreNode &dut = bench_.dut(i);
    const NodeAssertions::Mode mode{dut.config().listen_only, dut.config().loop_back};
    watched_[i].look(bit, mode, dut.pending());
    if (then) then(i, bit);
  };
}

void Assertions::broken(unsigned i, const std::string &what) {
  if (broken_.size() >= kMaxReports) return;
  broken_.push_back("bit " + std::to_string(bench_.bits()) + ", DUT " + std::to_string(i) + " " +
                    what);
}

std::string Assertions::report() const {
  std::string text;
  for (const std::string &line : broken_) text += line + "\n";
  return text;
}

}  // namespace vericansim
