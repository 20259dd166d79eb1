// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Expectations of a scenario.
#include "simulation/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scenario/output_pattern.hpp"
#include "simulation/signal_expectations.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim {
namespace {

std::string to_text(const Range &range) {
  if (range.least == range.most) return plain_number(range.least);
  if (std::isinf(range.least)) return "at most " + plain_number(range.most);
  if (std::isinf(range.most)) return "at least " + plain_number(range.least);
  return plain_number(range.least) + " to " + plain_number(range.most);
}

double bus_number(const RunReport &report, const std::string &key) {
  if (key == "frames") return static_cast<double>(report.frames);
  if (key == "error_frames") return static_cast<double>(report.error_frames);
  if (key == "overload_frames") return static_cast<double>(report.overload_frames);
  if (key == "pending") return static_cast<double>(report.pending);
  return report.load * 100;
}

double node_number(const NodeReport &node, const std::string &key) {
  const NodeCounts &c = node.counts;
  if (key == "tec") return c.tec;
  if (key == "rec") return c.rec;
  if (key == "max_tec") return c.max_tec;
  if (key == "max_rec") return c.max_rec;
  if (key == "sent") return static_cast<double>(c.sent);
  if (key == "received") return static_cast<double>(node.received);
  if (key == "overruns") return static_cast<double>(node.overruns);
  if (key == "errors") return static_cast<double>(c.errors);
  if (key == "lost") return static_cast<double>(c.lost_arbitration);
  if (key == "retries") return static_cast<double>(c.retries());
  return static_cast<double>(c.bus_off);
}

std::string printed_text(bool found, const std::string &output) {
  return fmt::format("{}in {} bytes printed", found ? "" : "not ", output.size());
}

CheckResult check_pattern(const std::string &pattern, const firmware::BoardReport &board) {
  CheckResult result{board.node + ".output", "matches " + in_quotes(pattern), "", false};
  try {
    result.ok = OutputPattern{pattern}.found_in(board.output);
    result.seen = printed_text(result.ok, board.output);
  } catch (const std::regex_error &error) {
    result.seen = fmt::format("cannot be looked for: {}", error.what());
  }
  return result;
}

/// What firmware has to print and how it has to end.
void check_board(const NodeExpectation &node, const firmware::BoardReport &board,
                 std::vector<CheckResult> &results) {
  using End = firmware::BoardReport::End;
  if (node.exit_code)
    results.push_back({board.node + ".exit_code", fmt::format("{}", *node.exit_code),
                       board.end == End::kExit    ? fmt::format("{}", board.exit_code)
                       : board.end == End::kFault ? "a fault"
                                                  : "no end in time",
                       board.end == End::kExit && board.exit_code == *node.exit_code});
  for (const std::string &text : node.output) {
    const bool found = board.output.find(text) != std::string::npos;
    results.push_back(
        {board.node + ".output", in_quotes(text), printed_text(found, board.output), found});
  }
  for (const std::string &pattern : node.matches) results.push_back(check_pattern(pattern, board));
}

/// A frame that a node must have received; or may have, as its transmitter repeats it (VA-03).
struct Wanted {
  Frame frame;
  bool must;
};

std::vector<Wanted> wanted_at(NodeId node, const HostConfig &host,
                              const std::vector<BusFrame> &frames) {
  std::vector<Wanted> wanted;
  for (const BusFrame &frame : frames) {
    const bool own = frame.transmitted_by(node);
    if (!own || (host.self_reception && frame.sent_by(node)))
      wanted.push_back({frame.frame, !frame.repeated()});
  }
  return wanted;
}

/// How many frames, from the first one on, are the wanted ones in their order; and whether that is
/// all.
struct Match {
  std::size_t good = 0;
  bool all = false;
};

Match match(const std::vector<Frame> &received, const std::vector<Wanted> &wanted) {
  // An attempt and its repetition are alike, so there may be several ways to pass an attempt that
  // may be missing: all numbers of frames that some way has used so far.
  std::set<std::size_t> used{0};
  Match result;
  for (const Wanted &next : wanted) {
    std::set<std::size_t> then;
    for (const std::size_t n : used) {
      if (n < received.size() && received[n] == next.frame) then.insert(n + 1);
      if (!next.must) then.insert(n);
    }
    if (then.empty()) return result;
    used = std::move(then);
    result.good = std::max(result.good, *used.rbegin());
  }
  result.all = used.contains(received.size());
  return result;
}

/// Every node that takes any frame must have all frames of the others, bit-exact and in their
/// order.
CheckResult check_complete(const Scenario &scenario, NodeId node,
                           const std::vector<BusFrame> &frames, const std::vector<Frame> &received,
                           std::size_t &compared) {
  const std::vector<Wanted> wanted = wanted_at(node, scenario.nodes[node].host, frames);
  const auto least =
      std::count_if(wanted.begin(), wanted.end(), [](const Wanted &w) { return w.must; });
  const auto most = static_cast<std::ptrdiff_t>(wanted.size());
  const std::string number =
      least == most ? fmt::format("{}", most) : fmt::format("{} to {}", least, most);
  CheckResult result{scenario.nodes[node].name + " has every frame of the others",
                     fmt::format("{} frames, the same and in order", number), "", false};
  const Match found = match(received, wanted);
  result.ok = found.all;
  compared += wanted.size();
  result.seen = result.ok ? fmt::format("{} frames", received.size())
                          : fmt::format("{} frames, the first {} as they should be",
                                        received.size(), found.good);
  return result;
}

// Where there was nothing to receive nothing has been shown.
void check_all_complete(const Scenario &scenario, const RunReport &report,
                        const std::vector<BusFrame> &frames,
                        const std::vector<std::vector<Frame>> &received,
                        std::vector<CheckResult> &results) {
  std::size_t compared = 0;
  for (NodeId id = 0; id < scenario.nodes.size(); ++id)
    if (report.nodes[id].own_software && scenario.nodes[id].host.filters.empty())
      results.push_back(check_complete(scenario, id, frames, received[id], compared));
  if (compared == 0)
    results.push_back({"complete", "a data frame, and another node without filters",
                       "nothing to compare", false});
}

std::string ms(Time time) {
  return fmt::format("{:.3f} ms", static_cast<double>(time) / kMillisecond);
}

/// A frame that still waits has no response time yet, but it is longer than the wait.
CheckResult check_longest(const MessageReport &message, std::optional<Time> limit,
                          const std::string &wanted) {
  const bool sent = message.sent != 0;
  const bool late = limit && message.waiting > *limit;
  return {"response of " + message.name, wanted,
          !sent  ? "not sent"
          : late ? fmt::format("a frame waits for {}", ms(message.waiting))
                 : ms(message.longest),
          sent && !late && limit && message.longest <= *limit};
}

CheckResult check_bound(const MessageReport &message) {
  return check_longest(message, message.bound,
                       message.bound ? "at most the bound, " + ms(*message.bound) : "a bound");
}

// A message that nobody has queued has no response time; without any nothing has been shown.
void check_bounds(const RunReport &report, std::vector<CheckResult> &results) {
  if (!report.no_bound.empty()) {
    results.push_back({"within_bound", "a bound", "none: " + report.no_bound, false});
    return;
  }
  bool any = false;
  for (const MessageReport &message : report.messages) {
    if (message.queued == 0) continue;
    any = true;
    results.push_back(check_bound(message));
  }
  if (!any) results.push_back({"within_bound", "a message that is sent", "none", false});
}

CheckResult check_response(const RunReport &report, const std::string &name, Time limit) {
  const auto message = std::find_if(report.messages.begin(), report.messages.end(),
                                    [&](const MessageReport &m) { return m.name == name; });
  const std::string wanted = "at most " + ms(limit);
  if (message == report.messages.end()) return {"response of " + name, wanted, "not sent", false};
  return check_longest(*message, limit, wanted);
}

/// A message that the run has left out; where a user has made the run shorter, it may be.
void check_queued(const Scenario &scenario, const RunReport &report,
                  std::vector<CheckResult> &results) {
  if (!scenario.expect.given || scenario.cut_short) return;
  for (std::size_t i = 0; i < scenario.traffic.size(); ++i)
    if (report.messages[i].queued == 0)
      results.push_back({report.messages[i].name + " was queued", "at least once", "never", false});
}

/// A run that is shorter than its scenario may be over before a fault begins.
bool left_out(const Scenario &scenario, const FaultSpec &fault) {
  return scenario.cut_short && fault.window.from >= scenario.duration;
}

/// How often a fault took effect; at least once if the scenario says what it expects.
void check_fault(const Scenario &scenario, const FaultSpec &spec, const FaultReport &fault,
                 std::vector<CheckResult> &results) {
  constexpr Range kEffect{1, std::numeric_limits<double>::infinity()};
  if (spec.hits)
    results.push_back(
        check_number(fault.name + ".hits", static_cast<double>(fault.hits), *spec.hits));
  else if (scenario.expect.given && !left_out(scenario, spec))
    results.push_back(
        check_number(fault.name + " took effect", static_cast<double>(fault.hits), kEffect));
}

}  // namespace

CheckResult check_number(const std::string &what, double seen, const Range &range) {
  return {what, to_text(range), plain_number(seen), range.contains(seen)};
}

std::vector<CheckResult> check_expectations(const Scenario &scenario, const RunReport &report,
                                            const std::vector<BusFrame> &frames,
                                            const std::vector<std::vector<Frame>> &received) {
  const Expectations &expect = scenario.expect;
  std::vector<CheckResult> results;
  for (const auto &[key, range] : expect.numbers) {
    const std::string what = key == "load" ? "load in per cent" : key;
    results.push_back(check_number(what, bus_number(report, key), range));
  }
  for (const NodeExpectation &node : expect.nodes) {
    const NodeReport &seen = report.nodes[node.node];
    for (const auto &[key, range] : node.numbers)
      results.push_back(check_number(seen.name + "." + key, node_number(seen, key), range));
    if (node.state)
      results.push_back(
          {seen.name + ".state", *node.state, seen.state(), *node.state == seen.state()});
    for (const firmware::BoardReport &board : report.boards)
      if (board.node == seen.name) check_board(node, board, results);
  }
  if (expect.complete) check_all_complete(scenario, report, frames, received, results);
  if (expect.within_bound) check_bounds(report, results);
  for (const auto &[name, limit] : expect.response_times)
    results.push_back(check_response(report, name, limit));
  check_queued(scenario, report, results);
  const auto signals = check_signals(expect.signals, report.signals);
  results.insert(results.end(), signals.begin(), signals.end());
  for (std::size_t i = 0; i < report.faults.size(); ++i)
    check_fault(scenario, scenario.faults[i], report.faults[i], results);
  return results;
}

}  // namespace vericansim
