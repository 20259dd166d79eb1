// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The search for the bit rate on the RTL, bit by bit: RN-70, RN-73, RN-74.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "bus/bus.hpp"
#include "node/core_node.hpp"
#include "node/remote_node.hpp"
#include "timing/bittime.hpp"

namespace vericansim {
namespace {

constexpr unsigned kRates[] = {1'000'000, 800'000, 500'000, 250'000,
                               125'000,   50'000,  20'000,  10'000};

BitTiming timing_of(unsigned row) {
  return find_bit_timings(bit_timing_request(8e6, kRates[row])).front().timing;
}

/// Nodes of one bit rate, and a node of profile full that does not know it.
class Search {
 public:
  Search(unsigned row, unsigned senders, double ppm = 0) : row_{row} {
    CoreConfig config;
    config.timing = timing_of(row);
    for (unsigned i = 0; i < senders; ++i) {
      hosts_.push_back(std::make_unique<CoreNode>("host" + std::to_string(i), config));
      bus_.add(*hosts_.back());
    }
    RemoteConfig full = RemoteConfig::profile("full");
    ClockConfig clock;
    clock.error_ppm = ppm;
    node_ = RemoteNode::create("node", full, 3, timing_of(0), clock);
    std::vector<BitTiming> rates;
    for (unsigned i = 0; i < 8; ++i) rates.push_back(timing_of(i));
    node_->search(rates);
    bus_.add(*node_);
    for (auto &host : hosts_) host->start();
    node_->start();
    bus_.run_for(20 * bit());
  }

  /// Frames until the node has joined the bus; more than `limit`: it has not.
  unsigned frames(unsigned limit) {
    unsigned sent = 0;
    while (sent <= limit && node_->state() == RemoteState::kListen) {
      Frame frame;
      frame.id = 0x123 + 37 * sent;
      frame.dlc = static_cast<std::uint8_t>(sent % 9);
      for (unsigned i = 0; i < frame.dlc; ++i)
        frame.data[i] = static_cast<std::uint8_t>(91 * sent + i);
      hosts_[0]->request(frame);
      ++sent;
      // A frame of at most 135 bits, and a pause that is none of the bus's.
      bus_.run_for((150 + sent * 7 % 40) * bit());
    }
    return sent;
  }
  void run_bits(unsigned bits) { bus_.run_for(bits * bit()); }
  [[nodiscard]] RemoteNode &node() { return *node_; }
  [[nodiscard]] unsigned row() const { return row_; }
  [[nodiscard]] CoreNode &host(std::size_t i) { return *hosts_.at(i); }

 private:
  [[nodiscard]] Time bit() const { return kSecond / kRates[row_]; }

  unsigned row_;
  std::vector<std::unique_ptr<CoreNode>> hosts_;
  std::unique_ptr<RemoteNode> node_;
  Bus bus_;
};

// RN-73: every rate is found, within 40 frames, and the node takes part then.
TEST(RtlRate, IsFoundOnABusOfTwo) {
  for (unsigned row = 0; row < 8; ++row) {
    for (const double ppm : {-1000.0, 0.0, 1000.0}) {
      SCOPED_TRACE(kRates[row]);
      Search search{row, 2, ppm};
      EXPECT_EQ(search.node().state(), RemoteState::kListen);  // RN-70
      EXPECT_LE(search.frames(40), 40U);
      EXPECT_EQ(search.node().rate_row(), row);
      search.run_bits(40);
      EXPECT_EQ(search.node().state(), RemoteState::kSafe);
      search.run_bits(200);
      EXPECT_EQ(search.host(0).events().errors, 0U);  // it has disturbed nobody
    }
  }
}

// RN-73: on a silent bus it waits at the first row and sends nothing.
TEST(RtlRate, SilentBusIsLeftAlone) {
  Search search{0, 1};
  search.run_bits(50'000);
  EXPECT_EQ(search.node().state(), RemoteState::kListen);
  EXPECT_EQ(search.node().rate_row(), 0U);
  EXPECT_EQ(search.host(0).events().errors, 0U);
}

// RN-74: a single sender, whom nobody acknowledges, is error passive after 16 attempts; then its
// frames are valid for a listener. It repeats without rest, which rows below may not see at all.
TEST(RtlRate, IsFoundWithASingleSender) {
  for (const unsigned row : {0U, 2U, 3U}) {
    SCOPED_TRACE(kRates[row]);
    Search search{row, 1};
    Frame frame;
    frame.id = 0x2A5;
    frame.dlc = 2;
    search.host(0).request(frame);
    for (unsigned i = 0; i < 3000 && search.node().state() == RemoteState::kListen; ++i)
      search.run_bits(100);
    EXPECT_EQ(search.node().rate_row(), row);
    search.run_bits(400);
    EXPECT_EQ(search.node().state(), RemoteState::kSafe);
    EXPECT_FALSE(search.host(0).pending());  // now there is one that acknowledges
  }
}

}  // namespace
}  // namespace vericansim
