// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Firmware on simulated buses: see firmware_run.hpp.
#include "firmware/firmware_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <set>

#include "scenario/simulation.hpp"
#include "scenario/stop_request.hpp"
#include "trace/input_error.hpp"

namespace vericansim::firmware {
namespace {

class Run {
 public:
  Run(const FirmwareSetup &setup, const std::function<void(std::size_t, std::string_view)> &output);
  FirmwareReport execute(const std::function<void(double)> &progress);

 private:
  struct Place {
    std::size_t bus;
    NodeId node;
  };

  void place_cores();
  void check_traffic() const;
  void build_boards(const std::function<void(std::size_t, std::string_view)> &output);
  void start();
  void run(const std::function<void(double)> &progress);
  void clock_boards(Time now);
  [[nodiscard]] Time next_edge() const;
  [[nodiscard]] bool all_ended() const;
  [[nodiscard]] BoardReport describe(std::size_t board) const;

  const FirmwareSetup &setup_;
  std::vector<Scenario> scenarios_;
  std::vector<Place> cores_;
  std::vector<std::unique_ptr<Simulation>> buses_;
  std::vector<std::unique_ptr<Board>> boards_;
  std::vector<std::string> printed_;
  std::vector<Time> ended_;
  Time start_ = 0, limit_ = 0, stopped_ = 0;
  bool interrupted_ = false;
};

Run::Run(const FirmwareSetup &setup,
         const std::function<void(std::size_t, std::string_view)> &output)
    : setup_{setup}, scenarios_{setup.scenarios} {
  place_cores();
  check_traffic();
  for (std::size_t bus = 0; bus < scenarios_.size(); ++bus) {
    std::set<NodeId> bare;
    for (const Place &place : cores_)
      if (place.bus == bus) bare.insert(place.node);
    const double bitrate =
        bus == 0 && setup.bitrate != 0 ? setup.bitrate : scenarios_[bus].bitrates.front();
    buses_.push_back(std::make_unique<Simulation>(scenarios_[bus], bitrate, bare));
  }
  build_boards(output);
}

// One core for each board, and perhaps a second one for the only board, with the same clock.
void Run::place_cores() {
  const bool second = setup_.second_core || scenarios_.size() > 1;
  if (second && setup_.images.size() != 1)
    throw std::invalid_argument("a second core needs exactly one firmware file");
  const std::size_t count = setup_.images.size() + (second ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t bus = second && i == 1 ? scenarios_.size() - 1 : 0;
    cores_.push_back({bus, find_or_add_node(scenarios_[bus], firmware_node(i))});
  }
  if (second)
    scenarios_[cores_[1].bus].nodes[cores_[1].node].clock =
        scenarios_[cores_[0].bus].nodes[cores_[0].node].clock;
}

void Run::check_traffic() const {
  for (std::size_t bus = 0; bus < scenarios_.size(); ++bus)
    for (const TrafficSpec &traffic : scenarios_[bus].traffic)
      for (const Place &core : cores_)
        if (core.bus == bus && core.node == traffic.node)
          throw InputError(scenarios_[bus].file, 0,
                           fmt::format("traffic '{}' is that of node '{}', which runs firmware; "
                                       "allowed: the other nodes",
                                       traffic.name, firmware_node(&core - cores_.data())));
}

void Run::build_boards(const std::function<void(std::size_t, std::string_view)> &output) {
  printed_.resize(setup_.images.size());
  ended_.resize(setup_.images.size());
  for (std::size_t i = 0; i < setup_.images.size(); ++i) {
    std::vector<RtlNode *> nodes{&buses_[cores_[i].bus]->node(cores_[i].node)};
    if (cores_.size() > setup_.images.size())
      nodes.push_back(&buses_[cores_[1].bus]->node(cores_[1].node));
    boards_.push_back(
        std::make_unique<Board>(firmware_node(i), setup_.images[i], std::move(nodes), setup_.cpu));
    boards_.back()->set_output([this, i, output](std::string_view text) {
      printed_[i] += text;
      if (output) output(i, text);
    });
  }
}

// The other nodes are on their buses before the CPUs begin, all at the same time.
void Run::start() {
  for (const auto &bus : buses_) {
    bus->join();
    start_ = std::max(start_, bus->bus().now());
  }
  for (const auto &bus : buses_) bus->start(start_);
  const Scenario &first = scenarios_.front();
  limit_ = start_ + (setup_.limit != 0 ? setup_.limit : first.duration + first.drain);
}

Time Run::next_edge() const {
  Time next = std::numeric_limits<Time>::max();
  for (const auto &board : boards_)
    if (!board->ended()) next = std::min(next, board->cores()[0]->oscillator().next());
  return next;
}

bool Run::all_ended() const {
  return std::all_of(boards_.begin(), boards_.end(), [](const auto &b) { return b->ended(); });
}

// At each edge of a board's clock the buses come first, then the CPU (board.hpp).
void Run::run(const std::function<void(double)> &progress) {
  constexpr Time kPart = kMillisecond;
  Time shown = start_;
  while (!all_ended() && !stop_requested()) {
    const Time next = next_edge();
    if (next > limit_) break;
    clock_boards(next);
    if (next < shown) continue;
    for (const auto &bus : buses_) bus->check();
    if (progress)
      progress(static_cast<double>(next - start_) / static_cast<double>(limit_ - start_));
    shown = next + kPart;
  }
}

void Run::clock_boards(Time now) {
  std::uint64_t due = 0;
  for (std::size_t i = 0; i < boards_.size(); ++i)
    if (boards_[i]->cores()[0]->oscillator().next() == now) due |= 1ULL << i;
  for (const auto &bus : buses_) bus->bus().run_until(now);
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    if ((due >> i & 1) == 0 || boards_[i]->ended()) continue;
    boards_[i]->clock();
    if (boards_[i]->ended()) ended_[i] = now - start_;
  }
}

BoardReport Run::describe(std::size_t index) const {
  const Board &board = *boards_[index];
  BoardReport report;
  report.node = board.name();
  report.file = board.image().file;
  report.clocks = board.cpu().cycles();
  report.instructions = board.cpu().instructions();
  report.output = printed_[index];
  report.state = board.report();
  report.time = board.ended() ? ended_[index] : (interrupted_ ? stopped_ : limit_) - start_;
  report.end = board.exit_code()      ? BoardReport::End::kExit
               : board.cpu().halted() ? BoardReport::End::kFault
               : interrupted_         ? BoardReport::End::kInterrupted
                                      : BoardReport::End::kLimit;
  report.exit_code = board.exit_code().value_or(0);
  return report;
}

FirmwareReport Run::execute(const std::function<void(double)> &progress) {
  const auto begin = std::chrono::steady_clock::now();
  start();
  run(progress);
  interrupted_ = stop_requested();
  stopped_ = buses_.front()->bus().now();
  FirmwareReport report;
  report.endless = setup_.endless;
  for (const auto &bus : buses_) {
    bus->drain();
    report.buses.push_back(bus->finish(interrupted_));
    report.buses.back().wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  for (std::size_t i = 0; i < boards_.size(); ++i) report.boards.push_back(describe(i));
  return report;
}

}  // namespace

bool FirmwareReport::ok() const {
  const bool ended = std::all_of(boards.begin(), boards.end(), [this](const BoardReport &board) {
    return board.end == BoardReport::End::kLimit
               ? endless
               : board.end == BoardReport::End::kExit && board.exit_code == 0;
  });
  return ended && std::all_of(buses.begin(), buses.end(), [](const auto &b) { return b.ok(); });
}

std::string firmware_node(std::size_t index) {
  return index == 0 ? "firmware" : fmt::format("firmware{}", index + 1);
}

FirmwareReport run_firmware(const FirmwareSetup &setup,
                            const std::function<void(std::size_t, std::string_view)> &output,
                            const std::function<void(double)> &progress) {
  return Run{setup, output}.execute(progress);
}

}  // namespace vericansim::firmware
