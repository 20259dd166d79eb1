// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// can_core as can_remote has it, data byte by byte and widths for one timing, beside can_core as it
// is otherwise: on a bus with a third engine and errors both do the same in every clock (RN-80).
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "Vcan_core.h"
#include "Vcan_core_bytes.h"
#include "Vcan_core_fixed.h"
#include "unit/leaf_model.hpp"

namespace vericansim {
namespace {

struct Waiting {
  unsigned id = 0, dlc = 0;
  bool extended = false, remote = false;
  std::array<unsigned, 8> data{};
};

/// One engine, and the frame that it is given: words, or bytes.
template <typename Model, bool kBytes>
class Sender {
 public:
  Sender() {
    model_->can_rx_i = 1;
    model_->pseg1_i = 3;  // 1, 4 and 2 quanta of a clock: eight clocks a bit
    model_->pseg2_i = 1;
    model_->ec_clear_i = 1;
    model_->tick_req_i = 1;
    model_.reset();
    model_->run_i = 1;
  }
  Model *operator->() { return model_.operator->(); }

  void offer(const Waiting &frame) {
    frame_ = frame;
    model_->tx_ide_i = frame.extended;
    model_->tx_rtr_i = frame.remote;
    model_->tx_dlc_i = frame.dlc;
    begin(true);
  }
  void clock(bool level) {
    model_->can_rx_i = level;
    model_.clock();
    if (model_->tx_next_o) next();
    // An error in the last bit before a byte or word: it is asked for, and not sent any more.
    if (model_->tx_ok_o || model_->tx_fail_o) begin(model_->tx_fail_o);
  }
  [[nodiscard]] bool offers() { return offers_; }

 private:
  void begin(bool offers) {
    offers_ = offers;
    at_ = 0;
    model_->tx_req_i = offers;
    model_->tx_word_i = frame_.extended ? frame_.id : frame_.id << 18;
  }
  void next() {
    model_->tx_req_i = 0;
    if (kBytes) {
      model_->tx_word_i = frame_.data.at(at_++ % 8) << 18;
      return;
    }
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i) word = word << 8 | frame_.data.at((at_ + i) % 8);
    at_ += 4;
    model_->tx_word_i = word;
  }

  LeafModel<Model> model_;
  Waiting frame_;
  unsigned at_ = 0;
  bool offers_ = false;
};

template <typename Model>
class CoreBytes : public ::testing::Test {
 protected:
  [[nodiscard]] unsigned up_to(unsigned last) {
    return std::uniform_int_distribution<unsigned>{0, last}(random_);
  }
  [[nodiscard]] Waiting any(bool base) {
    Waiting frame;
    frame.extended = !base && up_to(3) == 0;
    // Few identifiers, so that arbitration is lost in each of their bits.
    frame.id = frame.extended ? up_to(0x1FFF'FFFF) : 0x2AA ^ (1U << up_to(10));
    frame.remote = up_to(7) == 0;
    frame.dlc = up_to(8);
    for (unsigned &byte : frame.data) byte = up_to(3) == 0 ? 0xFF * up_to(1) : up_to(0xFF);
    return frame;
  }
  void clock() {
    const bool disturbed = disturbed_ != 0 ? disturbed_-- != 0 : false;
    if (up_to(3000) == 0) disturbed_ = 1 + up_to(40);
    const bool level = words_->can_tx_o && other_->can_tx_o;
    words_.clock(level != disturbed);
    bytes_.clock(level != disturbed);
    other_.clock(level);
  }
  /// The same told by both, in this clock.
  [[nodiscard]] ::testing::AssertionResult same() {
    const auto &a = *words_.operator->();
    const auto &b = *bytes_.operator->();
    if (a.trace_o != b.trace_o || a.can_tx_o != b.can_tx_o)
      return ::testing::AssertionFailure() << "trace or pin";
    if (a.gap_o != b.gap_o || a.boff_o != b.boff_o || a.rx_hdr_o != b.rx_hdr_o ||
        a.rx_byte_we_o != b.rx_byte_we_o || a.rx_valid_o != b.rx_valid_o)
      return ::testing::AssertionFailure() << "pulses or levels";
    if (a.rx_hdr_o && (a.rx_id_o >> 18 != b.rx_id_o >> 18 || a.rx_ide_o != b.rx_ide_o ||
                       a.rx_rtr_o != b.rx_rtr_o))
      return ::testing::AssertionFailure() << "header";
    if (a.rx_byte_we_o && !a.transmitter_o && a.rx_byte_o != b.rx_byte_o)
      return ::testing::AssertionFailure() << "byte";
    if (a.rx_valid_o && a.rx_dlc_o != b.rx_dlc_o) return ::testing::AssertionFailure() << "DLC";
    return ::testing::AssertionSuccess();
  }

  std::mt19937 random_{20'261'125};
  Sender<Vcan_core, false> words_, other_;
  Sender<Model, true> bytes_;
  unsigned disturbed_ = 0;
};

using Engines = ::testing::Types<Vcan_core_bytes, Vcan_core_fixed>;
TYPED_TEST_SUITE(CoreBytes, Engines);

// RN-80: a byte within eight bits.
TYPED_TEST(CoreBytes, SameAsWordByWord) {
  unsigned sent = 0, lost = 0, received = 0, errors = 0, bytes = 0;
  for (unsigned i = 0; i < 600'000; ++i) {
    if (!this->words_.offers() && this->up_to(500) == 0) {
      const Waiting frame = this->any(true);
      this->words_.offer(frame);
      this->bytes_.offer(frame);
    }
    if (!this->other_.offers() && this->up_to(300) == 0) this->other_.offer(this->any(false));
    this->clock();
    ASSERT_TRUE(this->same()) << "clock " << i;
    sent += this->words_->tx_ok_o;
    lost += this->words_->tx_fail_o && !this->words_->transmitter_o;
    received += this->words_->rx_valid_o && !this->words_->transmitter_o;
    bytes += this->words_->rx_byte_we_o;
    errors += this->words_->err_o != 0;
  }
  EXPECT_GT(sent, 200u);
  EXPECT_GT(lost, 20u);
  EXPECT_GT(received, 200u);
  EXPECT_GT(bytes, 1000u);
  EXPECT_GT(errors, 50u);
}

// RN-80: what the other engine receives is what was given byte by byte.
TYPED_TEST(CoreBytes, BytesGoOutInOrder) {
  for (unsigned dlc = 0; dlc <= 8; ++dlc) {
    Waiting frame;
    frame.id = 0x123;
    frame.dlc = dlc;
    for (unsigned i = 0; i < 8; ++i) frame.data.at(i) = 0x11 * (i + 1);
    this->bytes_.offer(frame);
    std::vector<unsigned> seen;
    for (unsigned i = 0; i < 2000; ++i) {
      const bool level = this->bytes_->can_tx_o && this->other_->can_tx_o;
      this->bytes_.clock(level);
      this->other_.clock(level);
      if (this->other_->rx_byte_we_o) seen.push_back(this->other_->rx_byte_o);
    }
    EXPECT_EQ(seen, std::vector<unsigned>(frame.data.begin(), frame.data.begin() + dlc));
  }
}

}  // namespace
}  // namespace vericansim
