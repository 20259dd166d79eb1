// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Session: the bus of a scenario with every kind of node on it, from the first edge to the report.
#pragma once

#include <ctime>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "session/operator.hpp"
#include "session/pacer.hpp"
#include "session/wall.hpp"
#include "simulation/simulation.hpp"

namespace vericansim {

class LiveBus;

/// One bus of a session.
struct SessionBus {
  Scenario scenario;
  double bitrate = 0;  ///< bit/s; 0: the first of the scenario
};

/// How a session runs.
struct SessionOptions {
  std::vector<OperatorFactory *> factories;  ///< for kinds of nodes beyond the library's own
  Time limit = 0;                            ///< longest simulated time; 0: what the scenario says
  /// Real time, for sessions that are held to it or have programs as nodes; nullptr: the steady
  /// clock.
  Wall *wall = nullptr;
  /// Each line for the user: interfaces that come and go, the lag.
  std::function<void(const std::string &)> say = [](const std::string &) {};
  /// What the software of a node prints: name of the node, text.
  std::function<void(std::string_view, std::string_view)> output;
  std::function<void(double)> progress;  ///< 0..1
};

/// Runs in rounds: wait for programs or for real time, if there is any need to; simulate a stretch;
/// exchange messages. Nothing is dropped: a program's frame waits until its node has room, and
/// while programs do not take what the bus has for them, simulated time stands still.
class Session {
 public:
  /// Builds the buses (usually one; firmware may have cores on two). Throws InputError if a
  /// scenario cannot have these nodes or a bit rate; std::invalid_argument without a bus, or for a
  /// bit rate outside 1000 to 1,000,000 bit/s.
  explicit Session(std::vector<SessionBus> buses, SessionOptions options = {});
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  /// Lets all nodes join the bus; times count from here.
  void start();
  /// One round; false once it is over.
  bool round();
  /// True if the user has ended it before its time. With programs as nodes any time is right.
  [[nodiscard]] bool interrupted() const { return interrupted_; }
  /// Lets what waits go out, for at most the scenario's `drain`; completes files. A report for each
  /// bus.
  [[nodiscard]] std::vector<RunReport> finish();
  /// All of these.
  [[nodiscard]] std::vector<RunReport> run();

  [[nodiscard]] Simulation &simulation(std::size_t bus = 0);
  /// Simulated time since start(), ps.
  [[nodiscard]] Time elapsed() const;
  [[nodiscard]] const Pacer &pacer() const { return pacer_; }
  /// True if simulated time is held to real time.
  [[nodiscard]] bool paced() const { return paced_; }
  [[nodiscard]] bool has_outlets() const { return !outlets_.empty(); }

 private:
  /// No limit of simulated time, with room for what is added to it.
  static constexpr Time kNoLimit = kNever / 2;

  struct Worker {
    std::unique_ptr<Operator> op;
    std::size_t bus;
  };

  void build_workers();
  void set_limits();
  void join_workers();
  void wait();
  [[nodiscard]] std::optional<WallTime> patience();
  void advance();
  void advance_fast();
  void advance_paced();
  void run_until(Time target, Time most = kNever);
  void clock_workers(Time edge);
  bool pass_over(Time target);
  void run_buses(Time target);
  void give();
  void exchange();
  void watch();
  void drain();
  void let_read(Simulation &simulation) const;
  void give_last();
  void show_progress();
  void describe(std::size_t bus, RunReport &report);
  [[nodiscard]] Time now() const;
  [[nodiscard]] Time next_edge() const;
  [[nodiscard]] bool idle() const;
  [[nodiscard]] bool quiet() const;
  [[nodiscard]] bool awaits_time() const;
  [[nodiscard]] bool stalled() const;
  [[nodiscard]] bool all_up() const;
  [[nodiscard]] bool all_done() const;

  SessionOptions options_;
  SteadyWall steady_;
  Wall &wall_;
  std::vector<std::unique_ptr<LiveBus>> buses_;
  std::vector<Worker> workers_;
  std::vector<Outlet *> outlets_;
  std::vector<Operator *> due_;
  std::vector<char> was_up_;
  std::vector<pollfd> poll_set_;
  Pacer pacer_;
  Time bit_time_ = 0;
  Time start_ = 0;
  Time stretch_ = 0;       // simulated between two looks at the world
  Time limit_ = kNoLimit;  // of simulated time
  bool until_done_ = false;
  bool paced_ = false;
  bool passes_ = false;   // time in which nothing happens may be passed over
  bool refused_ = false;  // an outlet has no room for a message
  bool ended_ = false;
  bool interrupted_ = false;  // before its time
  WallTime begin_ = 0;
  std::clock_t cpu_begin_ = 0;
};

}  // namespace vericansim
