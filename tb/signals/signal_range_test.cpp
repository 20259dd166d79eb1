// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Limits of signals where doubles are too coarse.
#include <gtest/gtest.h>

#include "signals/signal_range.hpp"
#include "signals/signal_statistics.hpp"

namespace vericansim {
namespace {

Signal integer_of_64_bits(bool is_signed, double factor) {
  Signal signal;
  signal.length = 64;
  signal.is_signed = is_signed;
  signal.factor = factor;
  return signal;
}

constexpr std::uint64_t kMost = ~std::uint64_t{0};

TEST(SignalRange, NeighboursOf64BitsHaveAnOrder) {
  const Signal up = integer_of_64_bits(false, 1), down = integer_of_64_bits(false, -1),
               with_sign = integer_of_64_bits(true, 1);
  EXPECT_TRUE(is_below(value_of(up, kMost - 1), value_of(up, kMost)));
  EXPECT_FALSE(is_below(value_of(up, kMost), value_of(up, kMost - 1)));
  EXPECT_TRUE(is_below(value_of(down, kMost), value_of(down, kMost - 1)));
  EXPECT_TRUE(is_below(value_of(with_sign, kMost), value_of(with_sign, 0))) << "-1 and 0";
}

TEST(SignalRange, LimitsAreExact) {
  const Signal signal = integer_of_64_bits(false, 1);
  const SignalRange range{limit_of(signal, "18446744073709551614"),
                          limit_of(signal, "18446744073709551614")};
  EXPECT_TRUE(range.contains(value_of(signal, kMost - 1)));
  EXPECT_FALSE(range.contains(value_of(signal, kMost)));
  EXPECT_FALSE(range.contains(value_of(signal, kMost - 2)));
  EXPECT_EQ(to_text(signal, range), "18446744073709551614");
  EXPECT_TRUE(is_empty(signal, {limit_of(signal, "18446744073709551615"), range.most}));
}

TEST(SignalRange, LimitsThatAreNoValuesOfTheSignal) {
  const Signal signal = integer_of_64_bits(false, 1);
  EXPECT_TRUE((SignalRange{limit_of(signal, "-5"), {}}.contains(value_of(signal, 0))));
  EXPECT_FALSE((SignalRange{limit_of(signal, "0.5"), {}}.contains(value_of(signal, 0))));
  EXPECT_THROW((void)limit_of(signal, "18446744073709551616"), SignalError);
  EXPECT_THROW((void)limit_of(integer_of_64_bits(true, 2), "1e17"), SignalError);
  EXPECT_THROW((void)limit_of(signal, "many"), SignalError);
}

TEST(SignalStatistics, LeastAndMostOf64Bits) {
  auto database = std::make_shared<Database>();
  database->add_text("wide.dbc", "BO_ 1 A: 8 X\n SG_ S : 0|64@1+ (1,0) [0|0] \"\" X\n");
  const SignalMessage &message = *database->messages()[0];
  SignalStatistics statistics{database};
  for (const std::uint64_t raw : {kMost - 1, kMost, kMost - 2})
    statistics.add(&message, {value_of(message.signals[0], raw)});
  const SignalReport report = statistics.report();
  EXPECT_EQ(report.signals[0].least.raw, kMost - 2);
  EXPECT_EQ(report.signals[0].most.raw, kMost);
}

}  // namespace
}  // namespace vericansim
