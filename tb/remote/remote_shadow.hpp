// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteShadow: the model of a remote node's rules beside its RTL on a bus of bits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bus/observer.hpp"
#include "model/remote_model.hpp"
#include "node/remote_node.hpp"

namespace vericansim {

/// Tells a model what happens to one node on the bus, taken from the trace of its engine, and
/// compares what the node sends and shows. difference() is the first thing that is not equal.
class RemoteShadow : public BusObserver {
 public:
  /// `id`: the node's index on its bus. Takes on_pulse, on_access and on_ms of the node.
  RemoteShadow(RemoteNode &node, NodeId id, const RemoteConfig &config, unsigned number);

  [[nodiscard]] unsigned interests() const override { return kBits; }
  void on_bit(NodeId node, const BitRecord &bit) override;

  void start();
  void hold(bool on);
  /// User logic writes this word now: not between the end of a frame and INT2, where the node,
  /// which needs some clocks, and the model, which needs none, may differ in who was last; nor, in
  /// the midst of a frame, what the node looks at before its end, for a map entry (RN-65).
  [[nodiscard]] bool may_write(unsigned word) const;
  /// A RESTART is under way.
  [[nodiscard]] bool restarting() const { return model_.restarting(); }

  /// To be called when nothing is under way: what waits and what is shown; `all`: all of the
  /// memory, else the rows of STATUS and IDENT, the window and the configuration.
  const std::string &compare(bool all);
  [[nodiscard]] const std::string &difference() const { return difference_; }
  [[nodiscard]] RemoteModel &model() { return model_; }
  /// Frames of the node that were sent.
  [[nodiscard]] unsigned sent() const { return sent_; }

 private:
  void follow_header(const BitRecord &bit);
  void follow_sending(const BitRecord &bit);
  void follow_errors(const Trace &trace);
  void pulse(const RemotePulse &pulse);
  void compare_words(unsigned first, unsigned n);
  void compare_byte(unsigned address, unsigned rtl);
  void differ(const std::string &what, const std::string &rtl, const std::string &model);

  RemoteNode &node_;
  NodeId id_;
  RemoteModel model_;
  std::string difference_;
  std::vector<RemotePulse> pulses_;
  std::optional<Frame> under_way_;
  unsigned ms_ = 0;
  unsigned sent_ = 0;
  Time valid_ = 0;     // SP of EOF6 of the last frame received
  Time released_ = 0;  // end of the last hold
  bool holds_ = false;
  unsigned to_int2_ = 0;  // sample points
  bool off_bus_ = false;
  bool may_write_ = true;
  bool in_frame_ = false;
};

}  // namespace vericansim
