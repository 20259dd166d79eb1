// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Shrinking: see shrink.hpp. Each step proposes a smaller scenario and keeps it if it still fails.
#include "random/shrink.hpp"

#include <algorithm>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "random/random_scenario.hpp"

namespace vericansim {
namespace {

class Shrinker {
 public:
  Shrinker(const Scenario &scenario, const JudgedRun &run, unsigned limit)
      : best_{scenario, run, 0}, limit_{limit} {}

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
  /// Keeps the candidate if it fails, too: as a file, since a file is what is wanted.
  bool keep(const Scenario &candidate) {
    if (best_.runs >= limit_) return false;
    ++best_.runs;
    try {
      Scenario read = parse_scenario(candidate.name, to_yaml(candidate));
      read.file = candidate.file;
      JudgedRun run = run_judged(read);
      if (run.ok()) return false;
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
      s.duration = std::min(s.duration, end);
      s.drain = 0;
      std::erase_if(s.accesses, [&](const AccessSpec &a) { return a.at > end; });
      std::erase_if(s.faults, [&](const FaultSpec &f) { return f.window.from > end; });
    });
    for (const unsigned per_cent : {50, 75, 90})
      attempt([&](Scenario &s) {
        s.duration = std::max<Time>(1'000'000, s.duration * per_cent / 100);
      });
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
    attempt([](Scenario &s) {  // the plainest bus
      s.bitrates = {1e6};
      for (NodeSpec &node : s.nodes) plain_clock(node);
    });
    for (NodeId id = 0; id < best_.scenario.nodes.size(); ++id) {
      attempt([&](Scenario &s) { plain_clock(s.nodes[id]); });
      attempt([&](Scenario &s) { s.nodes[id].link = {}; });
      attempt([&](Scenario &s) { s.nodes[id].clock.wander = Wander::kNone; });
      attempt([&](Scenario &s) { s.nodes[id].clock.error_ppm = 0; });
      attempt([&](Scenario &s) { s.nodes[id].clock.phase = 0; });
      attempt([&](Scenario &s) { s.nodes[id].num_mb = 16; });
      attempt([&](Scenario &s) { plain_host(s.nodes[id].host); });
      attempt([&](Scenario &s) { s.nodes[id].host.filters.clear(); });
    }
  }

  static void plain_clock(NodeSpec &node) {
    node.timing = BitTiming{};
    node.clock = ClockConfig{};
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

  void drop_steps() {
    for (std::size_t i = 0; i < best_.scenario.accesses.size(); ++i) {
      const std::size_t size = best_.scenario.accesses[i].steps.size();
      for (std::size_t chunk = size / 2; chunk != 0; chunk /= 2) {
        std::size_t end = best_.scenario.accesses[i].steps.size();
        while (end != 0 && best_.runs < limit_) {
          const std::size_t from = end > chunk ? end - chunk : 0;
          attempt([&](Scenario &s) { erase(s.accesses[i].steps, from, end - from); });
          end = from;
        }
      }
    }
  }

  Shrunk best_;
  unsigned limit_;
  unsigned kept_ = 0;
};

}  // namespace

Shrunk shrink(const Scenario &scenario, const JudgedRun &run, unsigned limit) {
  return Shrinker{scenario, run, limit}.run();
}

}  // namespace vericansim
