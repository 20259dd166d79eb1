// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// NodeRole: the kinds of nodes of a scenario, by what works their registers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "bus/types.hpp"
#include "model/remote_config.hpp"
#include "trace/id_filter.hpp"

namespace vericansim {

class Operator;
struct CanLog;
struct OperatorContext;
namespace firmware {
struct ElfImage;
}

/// The simulation's own software, which sends the scenario's traffic and receives.
struct TrafficRole {};

/// Cortex-M3 firmware (docs/firmware.md).
struct FirmwareRole {
  std::string file;                                 ///< ELF file
  std::shared_ptr<const firmware::ElfImage> image;  ///< already read; unset: read from `file`
  unsigned clocks_per_instruction = 2;
  bool run_hard_fault_handler = false;  ///< false: a HardFault stops the CPU, as a debugger does
  /// Reaching the end of the run without having called the exit function is no failure.
  bool endless = true;
};

/// The second CAN core of a board, which has the firmware's name, on this bus or another.
struct SecondCoreRole {
  std::string board;  ///< name of the node with the firmware
};

/// The simulation's own software, which sends recorded frames.
struct ReplayRole {
  std::string file;                   ///< of any format that read_log() knows
  std::shared_ptr<const CanLog> log;  ///< already read; unset: read from `file`
  std::string channel;                ///< interface in the log; empty: all
  Time start = 0;                     ///< when time `from` of the log is
  /// Part of the log, both ends included. 0: from the first frame on, with all that stand behind
  /// it, whatever their times: clocks of recorders are set back.
  Time from = 0, to = std::numeric_limits<Time>::max();
  double rate = 1;                 ///< of the recorded speed
  bool saturated = false;          ///< as fast as the bus allows instead
  bool loop = false;               ///< again and again
  std::vector<IdFilter> filters;   ///< frames to send; empty: all
  std::size_t frames = 0;          ///< at most so many of these; 0: all
  unsigned share = 0, shares = 1;  ///< of these, the identifiers of one of several equal parts
};

/// How the programs of the host at a node are treated.
struct ProgramSettings {
  std::vector<IdFilter> filters;      ///< frames of the bus for them; empty: all
  std::string errors = "own";         ///< error messages: none, state, own
  Time restart = 100 * kMillisecond;  ///< from bus-off to the begin of recovery; 0: by hand
};

/// A CAN interface of this computer: programs work the node.
struct InterfaceRole {
  std::string interface;
  ProgramSettings programs;
  bool echo = false;            ///< programs hear of their frames when these have really left
  std::size_t queue = 100'000;  ///< frames of programs that wait at most
  bool end_when_down = false;
};

/// A CAN interface that gets all that is on the bus; no node of it.
struct MonitorRole {
  std::string interface;
};

/// TCP clients work the node by the protocol of socketcand. The nodes of one address share a
/// server.
struct SocketcandRole {
  std::string address;  ///< [ADDRESS:]PORT
  ProgramSettings programs;
  unsigned wait_for_clients = 0;  ///< the bus begins when so many of the server's clients receive
};

/// A node without a processor (docs/remote.md): no registers, nothing works it but the bus and user
/// logic.
struct RemoteRole {
  /// What it is made of: the RTL where there is a Verilated one with these parameters, else the
  /// model of its rules on the RTL's engine; or one of the two.
  enum class Body { kBest, kRtl, kModel };
  RemoteConfig config;
  Body body = Body::kBest;
  unsigned number = 0;                                   ///< node_i
  std::map<unsigned, std::vector<std::uint8_t>> memory;  ///< by address; written before the start
};

/// A kind of the caller's own: makes what works the node's registers.
struct OwnRole {
  std::function<std::unique_ptr<Operator>(const OperatorContext &)> make;
};

using NodeRole = std::variant<TrafficRole, FirmwareRole, SecondCoreRole, ReplayRole, InterfaceRole,
                              MonitorRole, SocketcandRole, RemoteRole, OwnRole>;

/// True if the simulation's own software (Host) works a node of this kind.
[[nodiscard]] bool has_host(const NodeRole &role);

/// True if programs of the host, in real time, are behind it.
[[nodiscard]] bool has_programs(const NodeRole &role);

/// What works the nodes of this kind, for messages: "firmware".
[[nodiscard]] const char *name_of(const NodeRole &role);

}  // namespace vericansim
