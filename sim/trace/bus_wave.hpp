// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BusWave: writes a bus to a waveform: the wire, and for each node its pins and, as text, what it
// thinks.
#pragma once

#include <memory>
#include <queue>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/observer.hpp"
#include "trace/wave_sink.hpp"

namespace vericansim {

/// An observer to be added to a bus after all its nodes. Signals: `bus.can`; and for each node
/// `tx`, `rx`, `sampled` (level at the last sample point), `stuff`, `field` (text, one name for the
/// whole length of each bit: SOF, ID, CRC, ERROR FLAG...), `role`, `state` and `error` (texts),
/// `tec`, `rec`.
class BusWave : public BusObserver {
 public:
  /// `bus` must hold all its nodes already; `bit_time` is the longest bit of a node, ps.
  BusWave(const Bus &bus, std::unique_ptr<WaveSink> sink, Time bit_time);

  [[nodiscard]] unsigned interests() const override {
    return kLevels | kNodeLevels | kBits | kClocks;
  }
  void on_level(Time time, Level level) override;
  void on_node_tx(NodeId node, Time time, Level level) override;
  void on_node_rx(NodeId node, Time time, Level level) override;
  void on_bit(NodeId node, const BitRecord &bit) override;
  void on_clock(NodeId node, Time time, std::uint64_t trace) override;

  /// Writes what is still held back and ends the file at `time` (WaveSink::finish()).
  void finish(Time time);

 private:
  // A change that waits until no earlier one can come: a bit's name is known only at its sample
  // point.
  struct Change {
    Time time;
    std::uint64_t order;
    WaveSink::Signal signal;
    std::uint64_t value;
    const char *text;  // static storage, or nullptr
    bool operator<(const Change &other) const {
      return time != other.time ? time > other.time : order > other.order;
    }
  };

  struct NodeSignals {
    WaveSink::Signal tx, rx, sampled, stuff, field, role, state, error, tec, rec;
    Time bit_start = 0;
    bool boundary = false;  // the clock before was the last of a bit
    const char *field_text = nullptr;
    const char *role_text = nullptr;
    const char *state_text = nullptr;
    const char *error_text = nullptr;
    int tec_value = -1, rec_value = -1, sampled_value = -1, stuff_value = -1;
  };

  void declare(const std::string &scope);
  void put(Time time, WaveSink::Signal signal, std::uint64_t value, const char *text = nullptr);
  void put_text(Time time, WaveSink::Signal signal, const char *&last, const char *text);
  void put_value(Time time, WaveSink::Signal signal, int &last, int value);
  void drain(Time before);

  std::unique_ptr<WaveSink> sink_;
  Time hold_;
  std::uint64_t order_ = 0;
  WaveSink::Signal can_ = 0;
  std::vector<NodeSignals> nodes_;
  std::priority_queue<Change> changes_;
};

/// Opens a VCD or FST file by its suffix ".vcd" or ".fst". Throws InputError for any other.
[[nodiscard]] std::unique_ptr<WaveSink> open_wave(const std::string &path);

}  // namespace vericansim
