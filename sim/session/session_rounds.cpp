// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Session: the rounds between start and end.
#include <fmt/format.h>

#include <algorithm>

#include "session/live_bus.hpp"
#include "session/session.hpp"

namespace vericansim {
namespace {

// Real time between two looks at the programs, ns: while something is under way, and else.
constexpr WallTime kBusyTick = 500'000;
constexpr WallTime kQuietTick = 5'000'000;
// While an outlet is down, or has no room: look again after.
constexpr WallTime kDownTick = 100'000'000;
constexpr WallTime kRefusedTick = 1'000'000;
// Longest stretch that is simulated, not passed over, without a look at the programs.
constexpr Time kLongestStretch = 2 * kMillisecond;
// The same as fast as possible, while an outlet has something to do at a later simulated time.
constexpr Time kAwaitedStretch = kMillisecond;
// What is simulated between two looks for quiet, bits.
constexpr Time kQuietLook = 16;

}  // namespace

bool Session::round() {
  if (paced_ || !outlets_.empty()) wait();
  advance();
  exchange();
  watch();
  show_progress();
  if (ended_) return false;
  ended_ = wall_.stop_requested();
  interrupted_ = ended_ && outlets_.empty();
  return !ended_;
}

// ---- Questions

Time Session::now() const { return buses_.front()->simulation().bus().now(); }

bool Session::idle() const {
  return std::all_of(buses_.begin(), buses_.end(),
                     [](const auto &bus) { return bus->simulation().quiet(); }) &&
         std::all_of(workers_.begin(), workers_.end(),
                     [](const Worker &worker) { return worker.op->idle(); });
}

bool Session::quiet() const {
  return idle() &&
         std::none_of(buses_.begin(), buses_.end(),
                      [](const auto &bus) { return bus->simulation().bus().has_actions(); }) &&
         !awaits_time();
}

bool Session::awaits_time() const {
  return std::any_of(outlets_.begin(), outlets_.end(),
                     [](const Outlet *outlet) { return outlet->awaits_time(); });
}

bool Session::stalled() const {
  return std::any_of(outlets_.begin(), outlets_.end(),
                     [](const Outlet *outlet) { return outlet->stalled(); });
}

bool Session::all_up() const {
  return std::all_of(outlets_.begin(), outlets_.end(),
                     [](const Outlet *outlet) { return outlet->up(); });
}

bool Session::all_done() const {
  return std::all_of(workers_.begin(), workers_.end(),
                     [](const Worker &worker) { return worker.op->done(); });
}

Time Session::next_edge() const {
  Time next = kNever;
  for (const Worker &worker : workers_) next = std::min(next, worker.op->next_edge());
  return next;
}

// ---- Waiting

// How long to wait for the programs if they do not come; unset: for ever.
std::optional<WallTime> Session::patience() {
  std::optional<WallTime> least;
  const auto at_most = [&least](WallTime limit) { least = std::min(least.value_or(limit), limit); };
  if (!all_up()) at_most(kDownTick);
  if (refused_) at_most(kRefusedTick);
  if (stalled()) return least;
  if (!paced_) {
    if (!quiet()) at_most(0);
    return least;
  }
  const Time tick = (quiet() ? kQuietTick : kBusyTick) * kNanosecond;
  at_most(std::max<WallTime>(0, pacer_.wall_of(now() + tick) - wall_.now()));
  return least;
}

void Session::wait() {
  poll_set_.clear();
  std::vector<std::size_t> begin;
  for (Outlet *outlet : outlets_) {
    outlet->tick(now());
    begin.push_back(poll_set_.size());
    outlet->poll_set(poll_set_, refused_);
  }
  begin.push_back(poll_set_.size());
  wall_.wait(poll_set_, patience());
  const std::span<const pollfd> all{poll_set_};
  for (std::size_t i = 0; i < outlets_.size(); ++i)
    outlets_[i]->service(all.subspan(begin[i], begin[i + 1] - begin[i]));
}

// ---- Simulated time

void Session::advance() {
  if (stalled()) return;
  if (paced_)
    advance_paced();
  else
    advance_fast();
  for (const auto &bus : buses_) bus->simulation().check();
  for (const Worker &worker : workers_) worker.op->check();
  if (elapsed() >= limit_) ended_ = true;
}

// A session may wait for programs without a limit as soon as all is quiet, so that by then those
// who listen to the bus must have all frames.
void Session::advance_fast() {
  const Time stretch = awaits_time() ? std::min(stretch_, kAwaitedStretch) : stretch_;
  const Time target = std::min(start_ + limit_, now() + stretch);
  if (outlets_.empty() || !quiet()) run_until(target);
  if (outlets_.empty() || !quiet()) return;
  for (const auto &bus : buses_) bus->simulation().settle();
}

// What programs send is taken after this, so that no frame is on the bus before it was sent.
void Session::advance_paced() {
  const Time due = pacer_.due(wall_.now());
  // Behind real time no wait limits a round, and the programs' time limits are real.
  const Time most = pacer_.lagging() ? kBusyTick * kNanosecond : kLongestStretch;
  const Time reach = quiet() ? due : now() + most;
  run_until(std::min({due, start_ + limit_, reach}), most);
  if (pacer_.reached(wall_.now(), now()))
    options_.say(
        fmt::format("the simulation lags {:.0f} ms behind real time; fewer nodes, a slower "
                    "clock or bit rate, or --fast help",
                    static_cast<double>(pacer_.lag()) / 1e6));
}

// Runs buses and CPUs up to `target`, or until `most` has been simulated; where nothing is under
// way time may pass at no cost, and such time does not count.
void Session::run_until(Time target, Time most) {
  const Time look = passes_ ? kQuietLook * bit_time_ : most;
  while (!ended_ && now() < target && most > 0) {
    const Time before = now(), edge = next_edge();
    const bool passed = passes_ && edge > target && pass_over(target);
    if (edge <= target)
      clock_workers(edge);
    else if (!passed)
      run_buses(before + std::min({target - before, most, look}));
    if (!passed) most -= now() - before;
    if (until_done_ && all_done()) ended_ = true;
  }
}

void Session::run_buses(Time target) {
  for (const auto &bus : buses_) bus->simulation().bus().run_until(target);
}

// At an edge of its clock the buses come first, then what follows them: a CPU (board.hpp).
void Session::clock_workers(Time edge) {
  due_.clear();
  for (const Worker &worker : workers_)
    if (worker.op->next_edge() == edge) due_.push_back(worker.op.get());
  run_buses(edge);
  for (Operator *op : due_) op->clock(edge);
}

bool Session::pass_over(Time target) {
  if (!idle()) return false;
  Simulation &simulation = buses_.front()->simulation();
  simulation.settle();
  // With nobody to look after in between, up to what the bus has planned.
  const bool alone = !paced_ && outlets_.empty() && simulation.bus().has_actions();
  return simulation.bus().skip(alone ? start_ + limit_ : target);
}

// ---- Programs

void Session::give() {
  for (Outlet *outlet : outlets_)
    if (!outlet->give()) refused_ = true;
}

void Session::exchange() {
  refused_ = false;
  give();
  for (Outlet *outlet : outlets_) outlet->take();
}

void Session::watch() {
  for (std::size_t i = 0; i < outlets_.size(); ++i) {
    Outlet &outlet = *outlets_[i];
    if (outlet.up() == (was_up_[i] != 0)) continue;
    was_up_[i] = outlet.up() ? 1 : 0;
    if (outlet.up()) {
      options_.say(fmt::format("{} is back", outlet.name()));
      outlet.restart();  // as on hardware: an interface that comes up starts its controller
      continue;
    }
    options_.say(fmt::format("{} is down or gone; {}", outlet.name(),
                             outlet.ends_when_down() ? "this is the end" : "waiting for it"));
    ended_ = ended_ || outlet.ends_when_down();
  }
  if (wall_.restart_requested())
    for (Outlet *outlet : outlets_) outlet->restart();
}

void Session::show_progress() {
  if (!options_.progress) return;
  double part = static_cast<double>(elapsed()) / static_cast<double>(limit_);
  if (limit_ == kNoLimit) {
    part = 1;
    for (const Worker &worker : workers_) part = std::min(part, worker.op->progress());
  }
  options_.progress(std::min(part, 1.0));
}

}  // namespace vericansim
