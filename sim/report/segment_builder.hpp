// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SegmentBuilder: cuts the bits of all nodes into stretches of bus activity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bus/node.hpp"
#include "report/bit_track.hpp"
#include "report/report_data.hpp"

namespace vericansim {

/// Collects the bits of each node of a stretch; a finished stretch goes into the columns, as one
/// lane if all nodes saw the same bits in the same fields.
class SegmentBuilder {
 public:
  SegmentBuilder(std::size_t nodes, Time origin, ReportData &data);

  /// The next bit of a node; bits of one node come in their order, those of several nearly so.
  void take(NodeId node, const TrackedBit &bit);
  /// Ends what is under way.
  void finish();

 private:
  struct Lane {
    double start = 0, tq = 0;  // ps
    unsigned quanta = 0;
    std::vector<std::uint8_t> bits;
    std::vector<std::int8_t> changes;
    std::size_t used = 0;    // up to the last bit that is not quiet
    bool transmits = false;  // in the last bit of a frame
  };
  struct Segment {
    bool open = false;
    double start = 0;  // ps; bits sampled before belong to the segment before
    std::vector<Lane> lanes;
  };

  void begin(double start);
  void close(Segment &segment);
  void append(Lane &lane, const TrackedBit &bit);
  void store(const Lane &lane, std::size_t node);
  [[nodiscard]] bool must_split(NodeId node, const TrackedBit &bit) const;
  [[nodiscard]] static std::size_t reference(const std::vector<Lane> &lanes);
  [[nodiscard]] static bool agree(const std::vector<Lane> &lanes, std::size_t reference);
  [[nodiscard]] double ns(double ps) const { return (ps - origin_) / 1e3; }

  double origin_;
  ReportData &data_;
  std::vector<TrackedBit> last_;
  Segment current_, before_;
};

}  // namespace vericansim
