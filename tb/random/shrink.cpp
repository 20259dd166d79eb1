// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shrinking: see shrink.hpp. Each step proposes a smaller scenario and keeps it if it still fails.
#include "random/shrink.hpp"

#include <algorithm>
#include <cctype>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "model/registers.hpp"
#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kSetUp = reg::kMcrFrz | reg::kMcrHalt | 0xF;  // how a script begins
constexpr std::uint32_t kTimingFields = 0xFFFF0007;                   // of CTRL1

/// What a finding is about: without node, time and numbers.
std::string kind_of(const std::string &finding) {
  const std::size_t colon = finding.find(" us: ");
  std::string kind;
  for (const char c : finding.substr(colon == std::string::npos ? 0 : colon + 5))
    if (std::islower(static_cast<unsigned char>(c)) != 0 || c == ' ') kind += c;
  // Frames, codes and names are not what it is about.
  for (const char *words : {"has not received", "which nobody sent", "not on the wire", "as sent",
                            "nobody counts it", "software got", "buffers", "check", "until"})
    if (kind.find(words) != std::string::npos) return words;
  return kind;
}

/// A node without software that does anything begins with its set-up: without it it would run with
/// the timing after reset.
bool legal(const Scenario &scenario) {
  for (NodeId id = 0; id < scenario.nodes.size(); ++id) {
    if (scenario.nodes[id].software) continue;
    const auto first = std::find_if(scenario.accesses.begin(), scenario.accesses.end(),
                                    [id](const AccessSpec &access) { return access.node == id; });
    if (first == scenario.accesses.end()) continue;
    const AccessStep &step = first->steps.front();
    if (step.address != reg::kMcr || step.value != kSetUp) return false;
  }
  return true;
}

class Shrinker {
 public:
  Shrinker(const Scenario &scenario, const JudgedRun &run, unsigned limit)
      : best_{scenario, run, 0}, limit_{limit}, kind_{kind_of(run.findings.front())} {}

  Shrunk run() {
    unsigned before = 0;
    do {
      before = kept_;
      shorten();
      drop_all(best_.scenario.accesses.size(), &Shrinker::without_accesses);
      drop_all(best_.scenario.faults.size(), &Shrinker::without_faults);
      drop_all(best_.scenario.traffic.size(), &Shrinker::without_traffic);
      drop_nodes();
      simplify_nodes();
      simplify_traffic();
      simplify_faults();
      drop_steps();
    } while (kept_ != before && best_.runs < limit_);
    return best_;
  }

 private:
  /// Keeps the candidate if it fails in the same way: as a file, since a file is what is wanted.
  bool keep(const Scenario &candidate) {
    if (best_.runs >= limit_ || !legal(candidate)) return false;
    const std::string text = to_yaml(candidate);
    if (text == to_yaml(best_.scenario)) return false;
    ++best_.runs;
    try {
      Scenario read = parse_scenario(candidate.name, text);
      read.file = candidate.file;
      JudgedRun run = run_judged(read);
      if (run.ok() || kind_of(run.findings.front()) != kind_) return false;
      best_.scenario = std::move(read);
      best_.run = std::move(run);
    } catch (const std::exception &) {
      return false;  // no valid scenario any more
    }
    ++kept_;
    return true;
  }

  template <typename Change>
  bool attempt(Change change) {
    Scenario candidate = best_.scenario;
    change(candidate);
    return keep(candidate);
  }

  /// Nothing after the difference matters.
  void shorten() {
    const Time end = best_.run.failed_at;
    attempt([&](Scenario &s) {
      s.drain = 0;
      cut_to(s, std::min(s.duration, end));
    });
    for (const unsigned per_cent : {50, 75, 90})
      attempt([&](Scenario &s) { cut_to(s, s.duration * per_cent / 100); });
  }

  /// A fault that would begin behind the end is refused, and an access would be missed there.
  static void cut_to(Scenario &s, Time duration) {
    s.duration = std::max<Time>(1'000'000, duration);
    std::erase_if(s.faults,
                  [&](const FaultSpec &f) { return f.window.from >= s.duration + s.drain; });
    std::erase_if(s.accesses, [&](const AccessSpec &a) { return a.at >= s.duration; });
  }

  using Drop = void (*)(Scenario &, std::size_t, std::size_t);
  static void without_accesses(Scenario &s, std::size_t from, std::size_t count) {
    erase(s.accesses, from, count);
  }
  static void without_faults(Scenario &s, std::size_t from, std::size_t count) {
    erase(s.faults, from, count);
  }
  static void without_traffic(Scenario &s, std::size_t from, std::size_t count) {
    erase(s.traffic, from, count);
  }
  template <typename T>
  static void erase(std::vector<T> &list, std::size_t from, std::size_t count) {
    const std::size_t end = std::min(list.size(), from + count);
    if (from >= end) return;
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(from),
               list.begin() + static_cast<std::ptrdiff_t>(end));
  }

  /// Halves, quarters, ... single items, from the back.
  void drop_all(std::size_t size, Drop drop) {
    for (std::size_t chunk = size; chunk != 0; chunk /= 2) {
      for (std::size_t end = size; end != 0 && best_.runs < limit_;) {
        const std::size_t from = end > chunk ? end - chunk : 0;
        if (attempt([&](Scenario &s) { drop(s, from, end - from); })) size -= end - from;
        end = from;
      }
    }
  }

  void drop_nodes() {
    for (NodeId id = static_cast<NodeId>(best_.scenario.nodes.size()); id-- > 0;)
      if (best_.scenario.nodes.size() > 1) attempt([&](Scenario &s) { remove_node(s, id); });
  }

  static void remove_node(Scenario &s, NodeId id) {
    const auto gone = [id](const auto &item) { return item.node == id; };
    std::erase_if(s.traffic, gone);
    std::erase_if(s.accesses, gone);
    std::erase_if(s.faults, gone);
    const auto move = [id](NodeId &node) {
      if (node != kAllNodes && node > id) --node;
    };
    for (TrafficSpec &t : s.traffic) move(t.node);
    for (AccessSpec &a : s.accesses) move(a.node);
    for (FaultSpec &f : s.faults) move(f.node);
    s.nodes.erase(s.nodes.begin() + id);
  }

  void simplify_nodes() {
    // The plainest bus; one node alone with another timing might not go with the others.
    attempt([](Scenario &s) {
      s.bitrates = {1e6};
      for (NodeSpec &node : s.nodes) {
        node.timing = BitTiming{};
        node.clock = ClockConfig{};
        node.link = {};
      }
      for (AccessSpec &access : s.accesses)
        for (AccessStep &step : access.steps)
          if (step.address == reg::kCtrl && step.kind == AccessStep::Kind::kWrite)
            step.value = (step.value & ~kTimingFields) | BitTiming{}.ctrl_fields();
    });
    for (NodeId id = 0; id < best_.scenario.nodes.size(); ++id) {
      const auto change = [&](auto edit) { attempt([&](Scenario &s) { edit(s.nodes[id]); }); };
      change([](NodeSpec &node) { node.link = {}; });
      change([](NodeSpec &node) { node.clock.wander = Wander::kNone; });
      change([](NodeSpec &node) { node.clock.error_ppm = 0; });
      change([](NodeSpec &node) { node.clock.phase = 0; });
      if (!best_.scenario.nodes[id].software) continue;
      change([](NodeSpec &node) { node.num_mb = 16; });
      change([](NodeSpec &node) { plain_host(node.host); });
      change([](NodeSpec &node) { node.host.filters.clear(); });
    }
  }

  static void plain_host(HostConfig &host) {
    host.tx_buffers = 1;
    host.lowest_buffer_first = host.fd_tolerant = host.self_reception = false;
  }

  void simplify_traffic() {
    for (std::size_t i = 0; i < best_.scenario.traffic.size(); ++i) {
      const auto change = [&](auto edit) { attempt([&](Scenario &s) { edit(s.traffic[i]); }); };
      change([](TrafficSpec &t) {
        t.saturated = t.random_offset = false;
        t.period = t.offset = t.jitter = 0;
        t.count = 1;
      });
      for (const unsigned count : {2, 4, 16, 64})
        if (best_.scenario.traffic[i].count > count)
          change([&](TrafficSpec &t) { t.count = count; });
      change([](TrafficSpec &t) { t.jitter = 0; });
      change([](TrafficSpec &t) { t.random_offset = false; });
      change([](TrafficSpec &t) {
        t.data = DataKind::kFixed;
        t.frame.dlc = 0;
        t.frame.data = {};
      });
      change([](TrafficSpec &t) { t.frame.dlc = std::min<std::uint8_t>(t.frame.dlc, 1); });
      change([](TrafficSpec &t) { t.frame.remote = false; });
      change([](TrafficSpec &t) { t.frame.extended = false, t.frame.id &= 0x7FF; });
    }
  }

  void simplify_faults() {
    const Time bit = bit_time(best_.scenario);
    for (std::size_t i = 0; i < best_.scenario.faults.size(); ++i) {
      attempt([&](Scenario &s) {
        s.faults[i].window.to = std::min(s.faults[i].window.to, s.faults[i].window.from + bit);
      });
      attempt([&](Scenario &s) { s.faults[i].effect = Effect::kFlip; });
    }
  }

  /// Steps that do not decide over modes and over what comes after them.
  static bool may_go(const AccessStep &step) {
    return step.address != reg::kMcr && step.address != reg::kCtrl &&
           step.kind != AccessStep::Kind::kIf && step.kind != AccessStep::Kind::kUntil;
  }

  void drop_steps() {
    for (std::size_t i = 0; i < best_.scenario.accesses.size(); ++i) {
      const std::size_t size = best_.scenario.accesses[i].steps.size();
      for (std::size_t chunk = size; chunk != 0; chunk /= 2) {
        std::size_t end = best_.scenario.accesses[i].steps.size();
        while (end != 0 && best_.runs < limit_) {
          const std::size_t from = end > chunk ? end - chunk : 0;
          attempt([&](Scenario &s) { drop_part(s.accesses[i].steps, from, end); });
          end = from;
        }
      }
    }
  }

  static void drop_part(std::vector<AccessStep> &steps, std::size_t from, std::size_t end) {
    std::vector<AccessStep> left;
    for (std::size_t n = 0; n < steps.size(); ++n)
      if (n < from || n >= end || !may_go(steps[n]) || steps.size() == 1) left.push_back(steps[n]);
    if (!left.empty()) steps = left;
  }

  Shrunk best_;
  unsigned limit_;
  std::string kind_;
  unsigned kept_ = 0;
};

}  // namespace

Shrunk shrink(const Scenario &scenario, const JudgedRun &run, unsigned limit) {
  return Shrinker{scenario, run, limit}.run();
}

}  // namespace vericansim
