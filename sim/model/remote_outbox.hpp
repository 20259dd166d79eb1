// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteOutbox: what a node has to say and has not said yet (RN-15, RN-30, RN-54).
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "model/frame.hpp"

namespace vericansim {

/// The answer queue, with the two that need no place in it: HERE, and the STATUS that follows a
/// result. What has been chosen is sent before anything else, whatever comes.
class RemoteOutbox {
 public:
  enum class Item : std::uint8_t { kNone, kHere, kStatus, kAnswer };

  /// `depth`: places of the queue.
  explicit RemoteOutbox(unsigned depth) : depth_{depth} {}

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
  /// The attempt ended in an error. `retry`: attempts that a frame has (0: no limit). True: it was
  /// the last one, the frame is dropped.
  [[nodiscard]] bool failed(unsigned retry);
  /// A millisecond has passed; what is older than `life` ms (0: no limit) and not under way is
  /// dropped. Returns how many.
  [[nodiscard]] unsigned tick(unsigned life);

 private:
  struct Answer {
    Frame frame;
    unsigned age = 0;  // ms
  };
  void choose();
  void drop_chosen();

  unsigned depth_;
  std::deque<Answer> answers_;
  std::optional<unsigned> here_age_;
  std::optional<unsigned> status_age_;
  Item chosen_ = Item::kNone;
  unsigned failures_ = 0;  // of the chosen one
  bool under_way_ = false;
};

}  // namespace vericansim
