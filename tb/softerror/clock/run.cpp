// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run_flips(): see run.hpp. fork() is the snapshot: a child has the whole bus as it is.
#include "softerror/clock/run.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <utility>

#include "softerror/clock/unit_check.hpp"

namespace vericansim {
namespace {

// Behind so many pairs in a row it has been right and locked, and stays so.
constexpr unsigned kQuiet = 4;
constexpr unsigned kMost = kMostPairs + 2 + kQuiet;
// Pairs before the first flip, and those of the run without one: flips come in two intervals.
constexpr unsigned kBefore = 10, kChecks = kBefore + 2 + kMost;
// Software writes what it can write anew when a frame has been late for so long; then 2.2 s.
constexpr Time kPatience = 20 * kMillisecond, kLongest = 2'200 * kMillisecond;
constexpr Time kBehind = 300 * kMicrosecond;  // a launch: the driver has been told

/// The run without a flip: states at the end of each interval; or [0] behind the launch.
struct Reference {
  std::array<std::uint64_t, kChecks> state, host;
  Time sof;
};

/// One child's part of the memory that it shares with its parent.
struct Shared {
  Reference reference;
  ClockOutcome outcomes[1];  // and all others
};

class Experiment {
 public:
  Experiment(ClockWorld &world, Reference &reference, ClockOutcome &out)
      : world_{world}, reference_{reference}, out_{out} {}

  /// No flip: fills the reference.
  void run(ClockScene scene, const ClockFlip *flip) {
    golden_ = flip == nullptr;
    if (!golden_) apply(*flip);
    world_.worst = 0;
    world_.servo_events = 0;
    if (scene == ClockScene::kTime) {
      follow();
    } else {
      launch();
    }
    if (!out_.gone) cure();
    out_.babbled = world_.babbled();
    out_.finished = true;
  }

 private:
  void apply(const ClockFlip &flip) {
    FlopNode &dut = world_.dut();
    if (flip.stuck) {
      dut.stick(flip.flop, *flip.stuck);
    } else {
      dut.flip(flip.flop);
    }
  }

  /// Compares with the reference, or fills it; true: nothing more can come of the flip.
  bool check(unsigned n) {
    const std::uint64_t state = world_.state(), host = world_.dut().seen_by_host();
    if (golden_) {
      reference_.state[n] = state;
      reference_.host[n] = host;
      return false;
    }
    out_.seen = host != reference_.host[n];
    out_.gone = state == reference_.state[n];
    return out_.gone;
  }

  void follow() {
    const unsigned end = golden_ ? kChecks : world_.pairs + kMost;
    for (unsigned quiet = 0, n = 0; world_.pairs < end && quiet < kQuiet; ++n) {
      world_.run_to(world_.next_pair - 1);
      const bool right = std::abs(world_.error()) < kRight;
      if (!right) out_.pairs = n + 1;
      out_.locked = world_.tsyn.servo.state == VERICAN_SYNC_LOCKED;
      quiet = right && out_.locked && !golden_ ? quiet + 1 : 0;
      if (check(world_.pairs)) break;
      world_.run_to(world_.next_pair);
    }
    out_.worst_ns = world_.worst;
    out_.wrong = world_.worst > kRight || out_.pairs > 0;
    out_.told = world_.servo_events != 0;
  }

  void launch() {
    world_.last_launch();
    const unsigned expected = world_.launches;
    const auto sent = [this, expected] { return world_.sent().size() >= expected; };
    if (!world_.run_until(sent, kPatience)) {
      world_.write(VERICAN_TCTRL_OFFSET, VERICAN_TCTRL_RESET);
      (void)verican_clock_rate(world_.dev(), world_.dev()->increment);
      out_.lost = !world_.run_until(sent, kLongest);
    }
    if (golden_) reference_.sof = world_.sof;
    const double late_ms = static_cast<double>(world_.sof - reference_.sof) / kMillisecond;
    (late_ms < 0 ? out_.early_ms : out_.late_ms) = std::abs(late_ms);
    world_.run_to(std::max(reference_.sof, world_.bus.now()) + kBehind);
    (void)check(0);
  }

  void cure() {
    world_.end_scene();
    world_.run(kMillisecond);
    const std::string fails = what_fails(world_);
    if (fails.empty()) return;
    std::snprintf(out_.fails, sizeof out_.fails, "%s", fails.c_str());
    const std::pair<ClockCure, std::function<void()>> cures[] = {
        {ClockCure::kRewrite, [this] { world_.rewrite(); }},
        {ClockCure::kSetUp, [this] { world_.set_up(), world_.rewrite(); }},
        {ClockCure::kHardReset, [this] { world_.reset(); }}};
    for (const auto &[cure, act] : cures) {
      out_.cure = cure;
      if (works_after(act)) return;
    }
    out_.cure = ClockCure::kNever;
  }

  /// The driver may find that the core does not answer any more: std::runtime_error.
  bool works_after(const std::function<void()> &act) {
    try {
      act();
      world_.run(kMillisecond);
      return what_fails(world_).empty();
    } catch (const std::runtime_error &) {
      return false;
    }
  }

  ClockWorld &world_;
  Reference &reference_;
  ClockOutcome &out_;
  bool golden_ = false;
};

class Children {
 public:
  Children(ClockWorld &world, ClockScene scene, std::size_t flips, unsigned jobs)
      : world_{world},
        scene_{scene},
        jobs_{jobs},
        size_{sizeof(Shared) + flips * sizeof(ClockOutcome)} {
    void *at = mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::runtime_error("no shared memory");
    shared_ = static_cast<Shared *>(at);
  }
  ~Children() { munmap(shared_, size_); }
  Children(const Children &) = delete;
  Children &operator=(const Children &) = delete;

  ClockOutcome &outcome(std::size_t n) { return shared_->outcomes[n]; }

  /// Without a flip: alone, and it must be right.
  void reference(std::size_t n) {
    begin(n, nullptr);
    wait_for(0);
    const ClockOutcome &out = outcome(n);
    if (!out.finished || out.hangs || out.babbled || out.cure != ClockCure::kNone || out.wrong ||
        out.told || !out.locked || out.lost)
      throw std::runtime_error("the scene is not right without a flip: " + std::string{out.fails});
  }
  void begin(std::size_t n, const ClockFlip *flip) {
    wait_for(jobs_ - 1);
    outcome(n) = {};
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no process for a flip");
    if (child > 0) {
      ++running_;
      return;
    }
    world_.on_hang = [this, n] {
      outcome(n).hangs = outcome(n).finished = true;
      _exit(0);
    };
    try {
      Experiment{world_, shared_->reference, outcome(n)}.run(scene_, flip);
    } catch (const std::exception &error) {
      std::fprintf(stderr, "softerror_clock: %s\n", error.what());
    }
    _exit(0);
  }
  void wait_for(unsigned most) {
    for (int status = 0; running_ > most; --running_) wait(&status);
  }

 private:
  ClockWorld &world_;
  ClockScene scene_;
  unsigned jobs_, running_ = 0;
  std::size_t size_;
  Shared *shared_ = nullptr;
};

}  // namespace

FlipWindow window_of(ClockScene scene) {
  // Locked, with a full filter, behind kBefore pairs.
  if (scene == ClockScene::kTime) return {kFirst + kBefore * kPairs, kPairs, 1'500 * kMicrosecond};
  return {kFirst, kLaunches, 900 * kMicrosecond};
}

std::vector<unsigned> unit_flops() {
  std::vector<unsigned> found;
  const auto &flops = FlopNode::flops();
  for (unsigned n = 0; n < flops.size(); ++n)
    for (const char *part : {"u_core.gen_time.", "u_top.gen_time.", "u_mailbox.gen_stamp."})
      if (std::strstr(flops[n].variable, part) != nullptr) found.push_back(n);
  return found;
}

std::vector<ClockOutcome> run_flips(ClockScene scene, const std::vector<ClockFlip> &flips,
                                    unsigned jobs) {
  ClockWorld world{scene};
  Children children{world, scene, flips.size(), jobs};
  for (std::size_t n = 0; n < flips.size(); ++n) {
    if (n == 0 || flips[n].at != flips[n - 1].at) {
      children.wait_for(0);
      world.run_to(flips[n].at);
      // A launch has its own; all others go on to the end.
      if (n == 0 || scene == ClockScene::kLaunch) children.reference(flips.size());
    }
    children.begin(n, &flips[n]);
  }
  children.wait_for(0);
  std::vector<ClockOutcome> outcomes;
  for (std::size_t n = 0; n < flips.size(); ++n) outcomes.push_back(children.outcome(n));
  return outcomes;
}

}  // namespace vericansim
