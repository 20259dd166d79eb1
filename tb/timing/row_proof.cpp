// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RowProof: see row_proof.hpp.
#include "timing/row_proof.hpp"

#include <array>

#include "timing/three_nodes.hpp"

namespace vericansim {
namespace {

// Where the nodes are, as parts of the cable.
constexpr std::array<std::array<double, 3>, 6> kPlaces = {
    {{0, 1, 1}, {0, 1, 0}, {0, 0, 1}, {0, 0.5, 1}, {0, 1, 0.5}, {0.5, 0, 1}}};
constexpr unsigned kSigns = 8;
constexpr unsigned kBuses = 2 * kSigns * kPlaces.size();

ThreeNodes bus_of(const RowPromise &promise, unsigned number, std::uint64_t seed) {
  const bool delays = number % 2 == 0;
  const unsigned signs = number / 2 % kSigns;
  const auto &places = kPlaces[number / (2 * kSigns)];
  ThreeNodes bus{.timing = promise.timing, .clock_hz = promise.clock_hz, .seed = seed + number};
  bus.node_delay_ns = delays ? promise.node_delay_ns : 0;
  for (unsigned i = 0; i < 3; ++i) {
    bus.error_ppm[i] = (signs >> i & 1 ? 1e6 : -1e6) * promise.tolerance;
    bus.metres[i] = delays ? promise.cable_m * places[i] : 0;
  }
  return bus;
}

}  // namespace

std::vector<RowPromise> promises_of(const BitTimingResult &row, const BitTimingRequest &request) {
  RowPromise promise{row.timing, static_cast<double>(request.clock_hz), row.oscillator_tolerance,
                     row.cable_m, request.node_delay_ns};
  std::vector<RowPromise> promises{promise};
  if (row.crystal_cable_m) {
    promise.tolerance = request.clock_error_ppm * 1e-6;
    promise.cable_m = *row.crystal_cable_m;
    promises.push_back(promise);
  }
  return promises;
}

RowProof prove_row(const RowPromise &promise, unsigned frames, std::uint64_t seed) {
  RowProof proof;
  for (unsigned number = 0; number < kBuses; ++number) {
    const ThreeNodesResult result =
        run_three_nodes(bus_of(promise, number, seed), (frames + kBuses - 1) / kBuses);
    ++proof.buses;
    proof.dirty += !result.clean();
    proof.frames += result.frames;
    proof.node_cycles += result.node_cycles;
  }
  return proof;
}

}  // namespace vericansim
