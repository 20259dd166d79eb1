// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteModelNode: the model of a remote node's rules on a Verilated protocol engine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "node/core_node.hpp"
#include "node/remote_unit.hpp"

namespace vericansim {

/// Bits and frames are the engine's, what they mean is the model's. The engine's clock gives the
/// milliseconds. Work takes no time here: what the rules allow 22 clocks for is done in the clock
/// in which a frame becomes valid.
class RemoteModelNode : public RemoteUnit {
 public:
  /// `number`: node_i. Throws std::invalid_argument as RemoteConfig::validate() and
  /// BitTiming::validate().
  RemoteModelNode(std::string name, const RemoteConfig &config, unsigned number,
                  const BitTiming &timing, const ClockConfig &clock = {});

  void clock(Level rx) override;
  [[nodiscard]] std::uint64_t trace() const override { return core_.trace(); }

  void start() override;
  [[nodiscard]] std::uint8_t peek(unsigned address) const override;
  [[nodiscard]] RemoteState state() const override { return model_.state(); }
  [[nodiscard]] bool idle() const override;
  void user_write(unsigned index, std::uint32_t data, unsigned lanes) override;
  void hold(bool on) override;
  void event(unsigned k) override;

  [[nodiscard]] const RemoteModel &model() const { return model_; }

 private:
  void follow(const Trace &trace);
  void follow_sending(const Trace &trace);
  void follow_errors(const Trace &trace);
  void follow_sample(const Trace &trace);
  void show_pulses();
  void expire_hold();
  void restart();
  void present();

  RemoteModel model_;
  CoreNode core_;
  CoreConfig core_config_;
  std::uint64_t clocks_per_ms_;
  std::uint64_t to_tick_;
  std::optional<Frame> presented_;  // to the engine, not under way
  bool under_way_ = false;          // an own frame
  bool off_bus_ = false;
  bool shows_ = false;     // pulses are due in the next clock
  unsigned held_for_ = 0;  // clocks since a valid frame with hold, 0: none
  bool held_ = false;
};

}  // namespace vericansim
