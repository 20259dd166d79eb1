// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Several nodes at the engine's port in one program.
#include <gtest/gtest.h>

#include <memory>

#include "remote/port_lockstep.hpp"

namespace vericansim {
namespace {

// Made and destroyed in any order: a Verilated model must not look into the context of another one
// that is gone.
TEST(PortPairs, LiveAndEndOnTheirOwn) {
  for (unsigned i = 0; i < 20; ++i) {
    auto first = std::make_unique<PortLockstep>("small", 3, 3);
    auto second = std::make_unique<PortLockstep>("standard", 5, 9);
    auto third = std::make_unique<PortLockstep>("full", 3, 4);
    for (PortLockstep *one : {first.get(), third.get(), second.get()}) {
      one->drain();
      EXPECT_EQ(one->compare(), "");
    }
    (i % 2 == 0 ? third : second).reset();
    auto fourth = std::make_unique<PortLockstep>("small", 3, 5);
    first.reset();
    EXPECT_EQ(fourth->compare(), "");
  }
}

}  // namespace
}  // namespace vericansim
