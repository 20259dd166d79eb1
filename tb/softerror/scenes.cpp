// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// World: what happens in each scene, and what disturbs the node under test.
#include <algorithm>

#include "softerror/world.hpp"

namespace vericansim {

const char *to_string(Scene scene) {
  switch (scene) {
    case Scene::kTraffic: return "traffic";
    case Scene::kRegisters: return "registers";
    case Scene::kErrors: return "errors";
    case Scene::kModes: return "modes";
    case Scene::kIdle: return "idle";
    case Scene::kBusOff: return "bus-off";
  }
  return "?";
}

void World::at(std::uint64_t offset, std::function<void()> action) {
  const auto later = [](const auto &entry, std::uint64_t when) { return entry.first <= when; };
  const std::uint64_t when = begin_ + offset;
  events_.insert(std::lower_bound(events_.begin(), events_.end(), when, later),
                 {when, std::move(action)});
}

// Off the bus at `offset` and on it again at `back`.
void World::leave(Order how, std::uint64_t offset, std::uint64_t back) {
  const std::uint64_t bits = 400ULL * bit_clocks();
  at(offset, [this, how, bits, back] {
    ledger_.excuse();
    excused_until_ = std::max(excused_until_, begin_ + back + bits);
    driver_->give(how);
  });
  if (how == Order::kSoftReset) return;
  at(back, [this] { driver_->give(Order::kRun); });
}

void World::plan() {
  traffic(scene_ != Scene::kIdle);
  driver_->set_restless(scene_ == Scene::kRegisters);
  end_ = begin_ + 12'000;
  switch (scene_) {
    case Scene::kTraffic:
    case Scene::kRegisters: break;
    case Scene::kErrors: noise_until_ = end_ + 1'000; break;
    case Scene::kModes:
      end_ = begin_ + 36'000;
      leave(Order::kFreeze, 1'000, 6'000);
      leave(Order::kDisable, 12'000, 17'000);
      at(23'000, [this] {
        ledger_.excuse();
        excused_until_ = begin_ + 28'000 + 400ULL * bit_clocks();
        dut_->request_stop(true);
      });
      at(28'000, [this] { dut_->request_stop(false); });
      leave(Order::kSoftReset, 34'000, 38'000);
      break;
    case Scene::kIdle:
      end_ = begin_ + 3'000;
      at(3'500, [this] { traffic(true); });
      break;
    case Scene::kBusOff:
      deaf_from_ = begin_ + 200;
      deaf_until_ = begin_ + 1'200ULL * bit_clocks();
      end_ = begin_ + 3'000ULL * bit_clocks();
      break;
  }
}

// What the node under test sees of the bus.
Level World::dut_level(Level bus) const {
  if (clock_ >= deaf_from_ && clock_ < deaf_until_ && !was_off_) return Level::kRecessive;
  if (clock_ >= begin_ && clock_ < noise_until_) {
    // One bit in 100 or so is wrong until a little after the last moment of a flip.
    const std::uint64_t bit = clock_ / bit_clocks();
    if (mix(seed_ ^ (bit << 20)) % 100 == 0) return !bus;
  }
  return bus;
}

}  // namespace vericansim
