// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// ReportData: the arrays of a report as docs/report-format.md has them, one column each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "report/edge_list.hpp"

namespace vericansim {

/// "Nobody" in columns of nodes, "left out" in columns of segments.
inline constexpr std::uint8_t kNoNode = 255;
inline constexpr std::uint32_t kNoSegment = std::numeric_limits<std::uint32_t>::max();

struct FrameColumns {
  std::vector<double> start, end;
  std::vector<std::uint8_t> sender;
  std::vector<std::uint32_t> id;
  std::vector<std::uint8_t> dlc, data;
  std::vector<std::uint32_t> segment;
  std::vector<std::int16_t> message;
  std::vector<double> response;
  std::vector<std::uint16_t> retries, lost;
};

struct EventColumns {
  std::vector<std::uint8_t> kind;
  std::vector<double> start, end;
  std::vector<std::uint8_t> node, error, field, index;
  std::vector<std::uint32_t> segment;
  std::vector<std::uint16_t> cause;
};

struct LossColumns {
  std::vector<double> time;
  std::vector<std::uint8_t> node, field, index;
  std::vector<std::uint32_t> segment;
  std::vector<std::uint8_t> winner;
};

struct CounterColumns {
  std::vector<double> time;
  std::vector<std::uint8_t> node;
  std::vector<std::uint16_t> tec, rec;
  std::vector<std::uint8_t> state;
};

struct SegmentColumns {
  std::vector<double> start, end;
  std::vector<std::uint32_t> lane;
  std::vector<std::uint8_t> lanes;
};

struct LaneColumns {
  std::vector<std::uint8_t> node;
  std::vector<double> start, tq;
  std::vector<std::uint32_t> first, count;
  std::vector<std::uint8_t> bit;
  std::vector<std::int8_t> q;
};

/// Remote nodes: their frames in words, their states and the bytes of their windows.
struct RemoteColumns {
  struct Unit {
    std::size_t node;
    unsigned number, window;  ///< window: its bytes
  };
  std::vector<Unit> units;           ///< none: nothing else is there
  std::vector<std::uint32_t> words;  ///< of each frame: which line of `text`
  std::uint32_t texts = 0;           ///< lines of `text`
  std::vector<std::uint8_t> text;    ///< each line once, with its end
  std::vector<double> state_time;
  std::vector<std::uint8_t> state_node, state;
  std::vector<double> byte_time;
  std::vector<std::uint8_t> byte_node, byte_address, byte;
};

/// Everything. Times are ns from the start of the scenario.
struct ReportData {
  FrameColumns frames;
  EventColumns events;
  LossColumns losses;
  CounterColumns counters;
  SegmentColumns segments;
  LaneColumns lanes;
  EdgeList wire;
  std::vector<EdgeList> tx, rx;  ///< of each node; rx is empty if it cannot differ from the wire
  struct CauseText {
    std::string text, rule;
  };
  std::vector<CauseText> causes;

  /// The segment of a moment: the last one that begins before `time_ns`, or kNoSegment.
  [[nodiscard]] std::uint32_t segment_at(double time_ns) const;
};

}  // namespace vericansim
