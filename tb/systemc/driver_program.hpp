// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// DriverProgram: software around the C driver that behaves the same wherever it runs; and the way
// to run it in the C++ simulator, beside the bus.
#pragma once

#include <ucontext.h>

#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "node/rtl_node.hpp"
#include "node/task.hpp"
#include "verican/verican.h"

namespace vericansim {

/// What the program asks of whoever runs it.
class Processor {
 public:
  virtual ~Processor() = default;
  /// Transfers in a row (a single one, or a burst of words); the result of the last one.
  virtual AhbResult access(const std::vector<AhbTransfer> &transfers) = 0;
  virtual void wait_for_interrupt() = 0;
  /// 1 or more clocks.
  virtual void wait_clocks(unsigned count) = 0;
};

/// Sends `frames` random frames through the driver, as many at once as it takes, and receives by
/// interrupt. Between its interrupts it waits at random and makes accesses that no driver makes:
/// bytes, half words, bursts, beyond the window.
class DriverProgram {
 public:
  struct Settings {
    unsigned frames = 100;
    std::uint32_t bitrate = 500'000;
    unsigned number = 0;  ///< 0..3, the two last bits of its identifiers: nobody else's
    std::uint64_t seed = 1;
    bool odd_accesses = true;
  };

  DriverProgram(Processor &processor, const Settings &settings)
      : processor_{processor},
        settings_{settings},
        random_{settings.seed},
        contents_{~settings.seed} {}

  [[nodiscard]] const verican_stats_t &stats() const { return device_.stats; }
  /// Never returns, unless the driver's set-up fails.
  void run();

  verican_result_t result = VERICAN_OK;
  unsigned sent = 0;
  std::vector<verican_frame_t> received;

 private:
  void send_more();
  void odd_access();
  static std::uint32_t read(void *self, std::uint32_t offset);
  static void write(void *self, std::uint32_t offset, std::uint32_t value);

  Processor &processor_;
  Settings settings_;
  std::mt19937_64 random_;    // accesses
  std::mt19937_64 contents_;  // frames
  verican_t device_{};
  std::vector<verican_frame_t> ring_ = std::vector<verican_frame_t>(128);
  verican_frame_t next_{};
  unsigned queued_ = 0;
  bool have_next_ = false;
};

/// A program on a node of the C++ simulator, on a stack of its own: it gives way where it waits.
class NodeProcessor : public Processor {
 public:
  NodeProcessor(RtlNode &node, std::function<void(Processor &)> program);
  ~NodeProcessor() override;

  /// Begins; the rest happens as the node is clocked.
  void start() { task_ = drive(); }

  AhbResult access(const std::vector<AhbTransfer> &transfers) override;
  void wait_for_interrupt() override;
  void wait_clocks(unsigned count) override;

 private:
  enum class Wish : std::uint8_t { kAccess, kInterrupt, kClocks, kEnd };

  Task<> drive();
  void give_way(Wish wish);
  static void enter(unsigned high, unsigned low);

  RtlNode &node_;
  std::function<void(Processor &)> program_;
  std::vector<char> stack_ = std::vector<char>(256 * 1024);
  ucontext_t inside_{}, outside_{};
  Wish wish_ = Wish::kEnd;
  const std::vector<AhbTransfer> *transfers_ = nullptr;
  unsigned clocks_ = 0;
  AhbResult result_;
  Task<> task_;
};

}  // namespace vericansim
