// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Scenario files: parts of to_yaml() that have a file of their own; shared only by its files.
#pragma once

#include <string>

#include "scenario/scenario.hpp"

namespace vericansim::detail {

/// A text that people choose, as a value of YAML: in quotes unless it is a plain word.
[[nodiscard]] std::string yaml_text(const std::string &text);

/// The keys of a node's kind, ", replay: 'a.log', rate: 2". Throws std::invalid_argument, which
/// names the node, if no file can say it.
[[nodiscard]] std::string role_text(const NodeSpec &node);

/// The keys by which a file sets up the simulation's own software, ", listen_only: true".
[[nodiscard]] std::string host_text(const HostConfig &host);

/// The same of a remote node.
[[nodiscard]] std::string remote_text(const RemoteRole &role);

/// A line of `commands`.
[[nodiscard]] std::string commands_text(const Scenario &scenario,
                                        const RemoteCommandSpec &commands);
/// A line of `user`.
[[nodiscard]] std::string user_text(const Scenario &scenario, const UserSpec &user);

/// A line of `nodes` for who is no node. Throws the same.
[[nodiscard]] std::string listener_text(const ListenerSpec &listener);

/// The lines `duration`, `pacing` and `end`. Throws the same for an end that no file can say.
[[nodiscard]] std::string end_text(const Scenario &scenario);

/// Whether nodes or listeners are programs of the host.
[[nodiscard]] bool any_programs(const Scenario &scenario);
/// Whether a recording is sent that comes to an end.
[[nodiscard]] bool any_finite_replay(const Scenario &scenario);

}  // namespace vericansim::detail
