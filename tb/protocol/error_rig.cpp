// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ErrorRig: see error_rig.hpp.
#include "protocol/error_rig.hpp"

#include <stdexcept>

namespace vericansim {

std::string bits(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c != ' ') out.push_back(c);
  }
  return out;
}

ErrorRig::ErrorRig(Counters counters, const CoreConfig &config)
    : bench{1, config}, judge{bench}, assertions{bench} {
  judge.preset_counters(0, counters.tec, counters.rec);
  judge.start();
}

ErrorRig::~ErrorRig() {
  EXPECT_TRUE(!judged_ || judge.agrees()) << judge.report();
  EXPECT_TRUE(assertions.hold()) << assertions.report();
}

std::string ErrorRig::play(std::string_view script) {
  std::string sent;
  for (const char c : bits(script)) {
    bench.lt(c == '0' ? Level::kDominant : Level::kRecessive);
    if (c == '!') {
      bench.force_next(0, Effect::kFlip);
    } else if (c == 'R') {
      bench.force_next(0, Effect::kRecessive);
    } else if (c != '0' && c != '1' && c != '.') {
      throw std::invalid_argument("a script takes 0 1 . ! R");
    }
    bench.step();
    sent.push_back(last().tx == Level::kDominant ? '0' : '1');
  }
  bench.lt(Level::kRecessive);
  return sent;
}

void ErrorRig::send(const Frame &frame) {
  request(frame);
  play(".");
  EXPECT_EQ(field(), Field::kSof);
}

void ErrorRig::run_to(const PlaceSpec &place) {
  constexpr unsigned kLimit = 200;
  const bool reached = bench.run_until([&] { return place.matches(bench.place()); }, kLimit);
  EXPECT_TRUE(reached) << "the DUT never comes to "
                       << (place.field ? field_name(*place.field) : "that place");
}

void ErrorRig::expect_rec(unsigned start, unsigned step) {
  if (start + step >= 128) {
    EXPECT_GE(rec(), 128u);
  } else {
    EXPECT_EQ(rec(), start + step);
  }
}

std::string ErrorRig::receive(const Frame &frame) { return play(model_bench::whole(frame)); }

std::string ErrorRig::transmit(const Frame &frame) {
  const std::size_t length = model_bench::to_delimiter(frame).size();
  send(frame);
  return play(rep(static_cast<int>(length), ".") + "0" + rep(8, "."));
}

}  // namespace vericansim
