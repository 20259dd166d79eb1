// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes without a core behind them, in place of the Verilated ones: an RtlNode that remembers what
// is written to it and never takes part, and a CoreNode that sends nothing. The readers that are
// fuzzed are those of the board around them. Remote nodes and nodes with a clock are named by the
// sources around them, and never made.
#include <array>
#include <stdexcept>
#include <utility>

#include "node/core_node.hpp"
#include "node/lean_core.hpp"
#include "node/remote_node.hpp"
#include "node/rtl_node.hpp"
#include "node/time_node.hpp"

namespace vericansim {
namespace {

class PlainNode final : public RtlNode {
 public:
  PlainNode(std::string name, const ClockConfig &clock, unsigned num_mb)
      : RtlNode{std::move(name), clock, num_mb} {}

  void reset() override { ahb().reset(); }
  void clock(Level) override {
    if (ahb().active()) transfer();
    after_edge();
  }
  [[nodiscard]] std::uint8_t irq_lines() const override { return words_[0] & kIrqAll; }
  void request_stop(bool) override {}
  [[nodiscard]] AhbResult peek(const AhbTransfer &) override { return {}; }

 private:
  // Each access is an address phase and a data phase.
  void transfer() {
    const AhbRequest request = ahb().request();
    ahb().clock({words_[address_ / 4 % words_.size()], true, false});
    if (writes_) words_[address_ / 4 % words_.size()] = request.hwdata;
    writes_ = request.hwrite && request.htrans == AhbTrans::kNonseq;
    address_ = request.haddr;
  }

  std::array<std::uint32_t, 64> words_{};
  std::uint32_t address_ = 0;
  bool writes_ = false;
};

}  // namespace

std::unique_ptr<RtlNode> RtlNode::create(std::string name, const ClockConfig &clock,
                                         unsigned num_mb) {
  return std::make_unique<PlainNode>(std::move(name), clock, num_mb);
}

std::unique_ptr<RtlNode> create_lean_core(std::string name, const ClockConfig &clock) {
  return std::make_unique<PlainNode>(std::move(name), clock, 64);
}

struct CoreNode::Impl {};

CoreNode::CoreNode(std::string name, const CoreConfig &config, const ClockConfig &clock)
    : Node{std::move(name), clock}, config_{config} {
  config.timing.validate();
}
CoreNode::~CoreNode() = default;
void CoreNode::clock(Level) {}
void CoreNode::clock_lightly(Level) {}
std::uint64_t CoreNode::quiet() const { return 0; }
void CoreNode::pass(std::uint64_t) {}
std::uint64_t CoreNode::trace() const { return 0; }
void CoreNode::configure(const CoreConfig &config) {
  config.timing.validate();
  config_ = config;
}
void CoreNode::start() {}
void CoreNode::stop() {}
bool CoreNode::running() const { return false; }
bool CoreNode::idle() const { return true; }
void CoreNode::request(const Frame &, bool) {}
void CoreNode::cancel() {}

bool RemoteNode::has(const RemoteConfig &) { return true; }
std::string RemoteNode::available() { return "all"; }
std::unique_ptr<RemoteNode> RemoteNode::create(std::string, const RemoteConfig &, unsigned,
                                               const BitTiming &, const ClockConfig &) {
  throw std::logic_error("nothing that is fuzzed makes a remote node");
}

struct TimeNode::Impl {};

TimeNode::TimeNode(std::string name, const ClockConfig &clock)
    : RtlNode{std::move(name), clock, 64} {
  throw std::logic_error("nothing that is fuzzed makes a node with a clock");
}
TimeNode::~TimeNode() = default;
void TimeNode::reset() {}
void TimeNode::clock(Level) {}
std::uint64_t TimeNode::quiet() const { return 0; }
void TimeNode::pass(std::uint64_t) {}
std::uint64_t TimeNode::trace() const { return 0; }
std::uint8_t TimeNode::irq_lines() const { return 0; }
void TimeNode::request_stop(bool) {}
AhbResult TimeNode::peek(const AhbTransfer &) { return {}; }
void TimeNode::let_rest(bool) {}
bool TimeNode::irq_time() const { return false; }
void TimeNode::external(bool) {}

}  // namespace vericansim
