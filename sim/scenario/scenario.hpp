// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario: nodes, traffic, faults and expectations of one simulation, as a scenario file describes
// them.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/bus.hpp"
#include "bus/faults.hpp"
#include "model/frame.hpp"
#include "node/host.hpp"
#include "scenario/node_role.hpp"
#include "scenario/number_range.hpp"
#include "scenario/remote_spec.hpp"
#include "signals/database.hpp"
#include "signals/signal_range.hpp"

namespace vericansim {

/// What Scenario::duration may be.
inline constexpr Time kShortestDuration = kMicrosecond, kLongestDuration = 100'000 * kSecond;

/// One node of the bus.
struct NodeSpec {
  std::string name;
  ClockConfig clock;
  Link link;
  unsigned num_mb = 64;
  bool software = true;  ///< false: nothing but `accesses` drives the core
  NodeRole role;         ///< what works the core
  HostConfig host;       ///< `timing` is filled for the bit rate; tx_buffers 0: as many as messages
  std::optional<BitTiming> timing;     ///< given segment by segment; unset: calculated
  std::optional<double> bitrate;       ///< own rate, bit/s; unset: that of the bus
  std::optional<double> sample_point;  ///< 0..1; unset: that of the bus, or CiA's
  std::optional<unsigned> sjw;
  std::size_t line = 0;  ///< in the file
  /// True if the simulation's own software works the core.
  [[nodiscard]] bool hosted() const { return software && has_host(role); }
};

/// Somebody who hears all of the bus and is no node of it.
struct ListenerSpec {
  std::string name;
  NodeRole role;
  std::size_t line = 0;  ///< in the file
};

enum class DataKind : std::uint8_t {
  kFixed,
  kCounter,  ///< the number of the frame, little-endian
  kRandom,
};

/// A message: one frame, or one frame again and again.
struct TrafficSpec {
  NodeId node = 0;
  std::string name = {};
  Frame frame = {};
  DataKind data = DataKind::kFixed;
  Time period = 0;             ///< 0: once
  Time offset = 0;             ///< of the first frame
  bool random_offset = false;  ///< offset anywhere in the first period
  Time jitter = 0;             ///< each frame is queued up to this much later, within `duration`
  std::uint64_t count = std::numeric_limits<std::uint64_t>::max();  ///< frames at most
  bool saturated = false;  ///< always one more waiting, as fast as the bus allows
  std::size_t line = 0;    ///< in the file
};

/// A fault, as Bus knows them.
struct FaultSpec {
  enum class Kind : std::uint8_t { kLevel, kPlace, kCut, kShort, kClock, kNoise };
  Kind kind = Kind::kLevel;
  Effect effect = Effect::kFlip;
  NodeId node = kAllNodes;  ///< victim
  Window window;
  NodeId watched = 0;  ///< kPlace: the node whose place counts
  PlaceSpec place;     ///< kPlace
  std::optional<unsigned> first_quantum,
      last_quantum;           ///< kPlace: part of the bit, tq of the watched node
  double ppm = 0;             ///< kClock
  NoiseConfig noise;          ///< kNoise
  std::string name;           ///< empty: kind and place in the list, "flip 3"
  std::optional<Range> hits;  ///< how often it must take effect; unset: Expectations::given
  std::size_t line = 0;       ///< in the file
};

/// One thing that a script does with a register or a word of a buffer.
struct AccessStep {
  enum class Kind : std::uint8_t {
    kRead,   ///< the value is of no interest (but a judge looks at it)
    kWrite,  ///< `value`
    kSet,    ///< the bits of `value`, by reading and writing
    kClear,  ///< the same
    kUntil,  ///< reads until the bits of `mask` are those of `value`
    kIf,     ///< goes on only if the bits of `mask` are those of `value`
    kCheck,  ///< the run fails unless the bits of `mask` are those of `value`
  };
  Kind kind = Kind::kRead;
  std::uint32_t address = 0;
  std::uint32_t value = 0;
  std::uint32_t mask = 0xFFFFFFFF;
  friend bool operator==(const AccessStep &, const AccessStep &) = default;
};

/// Accesses of a node's CPU, one after the other.
struct AccessSpec {
  NodeId node = 0;
  Time at = 0;  ///< or as soon as the node's earlier ones are done
  std::vector<AccessStep> steps;
};

/// Whether a step writes a buffer, or a flag or interrupt mask of one.
[[nodiscard]] bool writes_buffers(const AccessSpec &access);
/// What `accesses` of a node may do whose buffers programs of the host work, for messages.
inline constexpr const char *kBesidePrograms =
    "to read, and to write other registers than buffers, IFLAG and IMASK";

/// What must be true of one node at the end.
struct NodeExpectation {
  NodeId node = 0;
  std::map<std::string, Range> numbers;  ///< sent, received, overruns, tec, rec, max_tec, max_rec,
                                         ///< errors, lost, retries, bus_off
  std::optional<std::string> state;      ///< active, passive, bus-off
  std::optional<int> exit_code;          ///< of firmware
  std::vector<std::string> output;       ///< firmware: each is somewhere in what it prints
  std::vector<std::string> matches;      ///< firmware: each, a regular expression, is found there
};

/// What must be true of one signal on the bus.
struct SignalExpectation {
  std::string name;  ///< message.signal
  const Signal *signal = nullptr;
  SignalRange all;             ///< every value
  std::optional<Range> count;  ///< frames that hold it
  std::optional<Range> mean;
  std::optional<SignalRange> first, last;
};

/// What must be true at the end.
struct Expectations {
  bool given = false;  ///< there are any; then every fault must take effect at least once
  std::map<std::string, Range>
      numbers;            ///< frames, error_frames, overload_frames, load (per cent), pending
  bool complete = false;  ///< every node without filters has every frame of the others, in order
  bool within_bound = false;                   ///< no response time above the analytic bound
  std::map<std::string, Time> response_times;  ///< message name: largest allowed
  std::vector<NodeExpectation> nodes;
  std::vector<SignalExpectation> signals;  ///< of the database in `outputs`
  RemoteExpectations remote;
};

/// Files to write; empty: none.
struct Outputs {
  std::string vcd, fst, candump, pcap;
  std::string report;                        ///< HTML page
  std::uint64_t report_frames = 200'000;     ///< the report keeps the bits of so many frames
  std::shared_ptr<const Database> database;  ///< of the signals in `signals_csv`, `report` and JSON
  std::string signals_csv;
  bool report_frames_given = false;  ///< a command line says how many
  std::vector<std::string> dbc;      ///< files that a command line adds to `database`
  bool signals = false;              ///< a command line wants them as a table
  std::string ids_csv;               ///< the table of identifiers
  bool ids = false;                  ///< a command line wants it as text
};

/// How simulated time goes on.
enum class Pacing : std::uint8_t {
  kFast,      ///< as fast as the computer can
  kRealTime,  ///< held to real time
};

struct Scenario {
  std::string file;
  std::string name;
  std::vector<double> bitrates = {500e3};  ///< one run for each
  std::optional<double> sample_point;
  Time duration = 100 * kMillisecond;
  bool endless = false;     ///< `duration` is that of the traffic alone
  bool cut_short = false;   ///< it is below that of the file: what lies behind it is no mistake
  bool until_done = false;  ///< ends as soon as no node has anything left to do
  Pacing pacing = Pacing::kFast;
  /// `until_done` because the file says so, not because recordings without programs are usually so.
  bool done_given = false;
  Time drain = 20 * kMillisecond;  ///< at most, after the duration, for frames that still wait
  std::uint64_t seed = 1;
  bool analysis = false;  ///< print the analytic bound beside the measured response times
  std::vector<NodeSpec> nodes;
  std::vector<ListenerSpec> listeners;
  std::vector<TrafficSpec> traffic;
  std::vector<FaultSpec> faults;
  std::vector<AccessSpec> accesses;
  std::vector<RemoteCommandSpec> commands;  ///< of hosts to remote nodes
  std::vector<UserSpec> user;               ///< logic of remote nodes
  bool lockstep = false;                    ///< judge: lockstep
  Expectations expect;
  Outputs outputs;
};

/// The scenario as a file that read_scenario() makes the same scenario of, in any folder: paths are
/// absolute. Outputs, databases and expectations are left out. Throws std::invalid_argument for
/// what no file can say: a program that works a node by itself (OwnRole), a recording in memory.
[[nodiscard]] std::string to_yaml(const Scenario &scenario);

/// Reads a scenario file. Throws InputError that names file, line, key, value and what is allowed.
[[nodiscard]] Scenario read_scenario(const std::string &path);
/// Reads `text` as if it stood in the file `path`.
[[nodiscard]] Scenario parse_scenario(const std::string &path, const std::string &text);

/// The node of that name, added with a clock of `clock_hz` if the scenario has none. Throws
/// InputError if the bus is full (Bus::kMaxNodes).
NodeId find_or_add_node(Scenario &scenario, const std::string &name,
                        double clock_hz = ClockConfig{}.frequency_hz);
/// The same for a node that something else works, which `user` tells: "runs firmware". Throws
/// InputError also if the node is of a kind of its own, or traffic of the scenario is its.
NodeId take_node(Scenario &scenario, const std::string &name, const std::string &user,
                 double clock_hz = ClockConfig{}.frequency_hz);
/// The same for a node whose registers something else works. Throws InputError also if the file
/// sets up the simulation's own software there, which nobody would obey.
NodeId take_core(Scenario &scenario, const std::string &name, const std::string &user,
                 double clock_hz = ClockConfig{}.frequency_hz);
/// The same for a node whose software hands frames to programs. Throws InputError also if
/// `accesses` write its buffers: frames that nobody has sent, and those whose flags are cleared by
/// others, would confuse it.
NodeId take_buffers(Scenario &scenario, const std::string &name, const std::string &user,
                    double clock_hz = ClockConfig{}.frequency_hz);

}  // namespace vericansim
