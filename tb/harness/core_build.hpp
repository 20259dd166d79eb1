// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The profiles of the core (sw/profiles.yaml), for tests that run on more than one of them, and
// builds that lack one feature.
#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "node/rtl_node.hpp"

namespace vericansim {

/// Features of a build, parameters of can_ahb (sw/registers.yaml).
struct Features {
  bool fifo = true, abort = true, status = true, own_masks = true, wake = true, extras = true;
  bool clear_ram = true, time_unit = false, time_sync = false;

  friend bool operator==(const Features &, const Features &) = default;
};

/// A build of the core.
struct CoreBuild {
  const char *name = "";
  unsigned num_mb = 64;
  Features features{};
};

/// Its name, for messages of tests.
inline std::ostream &operator<<(std::ostream &out, const CoreBuild &build) {
  return out << build.name;
}

inline constexpr CoreBuild kCoreBuilds[] = {
#include "harness/core_builds.inc"
};

/// Builds of 64 buffers that lack one of the features of *full*: "no_fifo" and so on.
inline constexpr CoreBuild kSingleBuilds[] = {
#include "harness/single_builds.inc"
};

/// The profile or single build of that name; std::out_of_range if there is none.
const CoreBuild &core_build(const std::string &name);

/// The build that VERICAN_TEST_BUILD in the environment names; nullptr if it is not set.
const CoreBuild *build_under_test();

/// `build`, or with VERICAN_TEST_BUS set the one that has a bus, or with VERICAN_TEST_BUILD set
/// that one, if `build` has all features: for tests that do not mind more buffers than they know
/// of.
const CoreBuild &build_of_test(const CoreBuild &build);

/// A node of a build: of a profile, or with all features, and with 64 buffers with the time unit,
/// too; std::invalid_argument for the time unit with fewer. With VERICAN_TEST_BUS=name in the
/// environment those of 64 buffers and all features have that bus (bus_builds.hpp) in place of
/// AHB-Lite: so tests run through every wrapper. In the same way VERICAN_TEST_BUILD=name takes
/// their place by nodes of a single build.
std::unique_ptr<RtlNode> make_node(std::string name, const CoreBuild &build,
                                   const ClockConfig &clock = {});

}  // namespace vericansim
