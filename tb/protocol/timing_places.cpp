// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Places: see timing_places.hpp.
#include "protocol/timing_places.hpp"

namespace vericansim {

void receive_frame(TimingBench &bench) {
  bench.start();
  bench.partner().request(kPairsFrame);
}

void send_frame(TimingBench &bench) {
  bench.start();
  bench.dut().request(kPairsFrame);
}

void reach_sent(TimingBench &bench, Field field, Level level) {
  send_frame(bench);
  bench.run_to([=](const TimingBench &b) {
    return b.place().field() == field && b.sent() == level && b.last_sample() == Level::kRecessive;
  });
}

void reach_received(TimingBench &bench, Field field) {
  receive_frame(bench);
  bench.run_to([=](const TimingBench &b) {
    return b.place().field() == field && b.place().index() >= 1 &&
           b.last_sample() == Level::kRecessive;
  });
}

}  // namespace vericansim
