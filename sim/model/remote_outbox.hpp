// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteOutbox: what a node has to say and has not said yet (RN-15, RN-30, RN-54).
#pragma once

#include <cstdint>
#include <deque>

#include "model/frame.hpp"
#include "model/remote_memory.hpp"

namespace vericansim {

/// The answer queue, with the two that need no place in it: HERE, and the STATUS that follows a
/// result. What has been chosen is sent before anything else, whatever comes. LIFE and RETRY count
/// as they were when the frame before had gone, LIFE also when an answer entered the queue before
/// (docs/remote.md, "What waits to be sent").
class RemoteOutbox {
 public:
  enum class Item : std::uint8_t { kNone, kHere, kStatus, kAnswer };

  /// `depth`: places of the queue; `memory` tells LIFE and RETRY and must outlive this.
  RemoteOutbox(unsigned depth, const RemoteMemory &memory) : depth_{depth}, memory_{memory} {}

  [[nodiscard]] bool full() const { return answers_.size() >= depth_; }
  [[nodiscard]] bool empty() const { return answers_.empty(); }
  /// Puts a snapshot into the queue, which has room.
  void answer(const Frame &frame);
  /// A STATUS frame shall be sent; one that waits is replaced.
  void status();
  /// HERE shall be sent, or no longer.
  void here(bool wanted);
  /// Forgets everything.
  void clear();

  /// What is to be sent now; kNone: nothing.
  [[nodiscard]] Item chosen() const { return chosen_; }
  /// The snapshot, if an answer has been chosen.
  [[nodiscard]] const Frame &front() const { return answers_.front().frame; }

  /// The chosen one is on its way from now on.
  void attempt() { under_way_ = true; }
  void sent();
  void lost();
  /// The attempt ended in an error. True: it was the last one, the frame is dropped.
  [[nodiscard]] bool failed();
  /// 10 ms have passed; answers whose life is over by then are dropped, the first before the next,
  /// but for one under way. Returns how many.
  [[nodiscard]] unsigned ten_ms();

 private:
  struct Answer {
    Frame frame;
    unsigned life = 0;  // 10 ms; 0: no limit
  };
  void choose();
  void drop_chosen();
  void read_limits();

  unsigned depth_;
  const RemoteMemory &memory_;
  std::deque<Answer> answers_;
  bool here_ = false, status_ = false;
  Item chosen_ = Item::kNone;
  unsigned next_life_ = 0;  // of the answer that comes next
  unsigned tries_ = 0;      // left to what is chosen; 0: no limit
  bool under_way_ = false;
};

}  // namespace vericansim
