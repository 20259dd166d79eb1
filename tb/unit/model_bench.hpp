// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Bench of the node model tests: one node against a written script, or several nodes on one wire.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/frame_codec.hpp"
#include "model/node_model.hpp"

namespace vericansim::model_bench {

/// GV-1: 43 bits SOF..CRC, data field at 20..27, CRC delimiter 43, ACK slot 44, EOF 46..52.
inline const Frame kGv1{.id = 0x123, .dlc = 1, .data = {0x55}};
inline const std::string kGv1Bits = "0001001000110000010101010101010001101100011";

/// `count` times `text`.
inline std::string rep(int count, const std::string &text) {
  std::string out;
  for (int i = 0; i < count; ++i) out += text;
  return out;
}

/// Runs `node` against the rest of the bus: per bit '0' or '1' is what the node samples; '.' means
/// the others are quiet and it samples its own level; '!' inverts its own level. Returns what it
/// sent.
inline std::string play(NodeModel &node, const std::string &script) {
  std::string sent;
  for (const char c : script) {
    const Level own = node.drive();
    sent.push_back(own == Level::kRecessive ? '1' : '0');
    switch (c) {
      case '0': node.sample(Level::kDominant); break;
      case '1': node.sample(Level::kRecessive); break;
      case '.': node.sample(own); break;
      case '!': node.sample(!own); break;
      default: throw std::invalid_argument("script takes 0 1 . !");
    }
  }
  return sent;
}

/// A node in idle with the given counters.
inline NodeModel idle_node(int tec = 0, int rec = 0, const NodeConfig &config = {}) {
  NodeModel node(config);
  node.preset_idle();
  node.preset_counters(tec, rec);
  return node;
}

/// A node whose SOF of `frame` is the next bit.
inline NodeModel sender(const Frame &frame, int tec = 0, int rec = 0,
                        const NodeConfig &config = {}) {
  NodeModel node = idle_node(tec, rec, config);
  node.request(frame);
  play(node, ".");
  return node;
}

/// Bits SOF..CRC delimiter of `frame` as text.
inline std::string to_delimiter(const Frame &frame, const EncodeOptions &options = {}) {
  const EncodedFrame e = encode_frame(frame, options);
  return to_string(levels_of({e.bits.data(), e.stuffed_length + 1}));
}

/// A whole good frame with d in the ACK slot, SOF..EOF7.
inline std::string whole(const Frame &frame, const EncodeOptions &options = {}) {
  return to_delimiter(frame, options) + "0" + rep(8, "1");
}

/// Several nodes on one wire, in step.
class Wire {
 public:
  explicit Wire(std::size_t count) : nodes(count) {
    for (NodeModel &node : nodes) node.preset_idle();
  }

  /// One bit. `disturb(node, level)` may change what a node samples.
  void step(const std::function<Level(std::size_t, Level)> &disturb = {}) {
    Level bus = Level::kRecessive;
    for (const NodeModel &node : nodes) bus = bus & node.drive();
    waveform.push_back(bus);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      nodes[i].sample(disturb ? disturb(i, bus) : bus);
      if (nodes[i].events().delivered) delivered.push_back({i, nodes[i].received()});
    }
  }

  void run(int bits) {
    for (int i = 0; i < bits; ++i) step();
  }

  struct Delivery {
    std::size_t node;
    Frame frame;
  };
  std::vector<NodeModel> nodes;
  std::vector<Level> waveform;
  std::vector<Delivery> delivered;
};

}  // namespace vericansim::model_bench
