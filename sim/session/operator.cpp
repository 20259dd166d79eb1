// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Operators of the library's own kinds of nodes.
#include "session/operator.hpp"

#include <fmt/format.h>

#include "session/firmware_operator.hpp"
#include "session/replay_operator.hpp"
#include "simulation/simulation.hpp"
#include "trace/input_error.hpp"

namespace vericansim {

const Scenario &OperatorContext::scenario() const { return simulation().scenario(); }

const NodeSpec &OperatorContext::spec() const { return scenario().nodes[id]; }

std::unique_ptr<Operator> make_operator(const OperatorContext &context,
                                        std::span<OperatorFactory *const> factories) {
  const NodeRole &role = context.role;
  // The firmware's node looks after a second core.
  if (std::holds_alternative<TrafficRole>(role) || std::holds_alternative<SecondCoreRole>(role) ||
      std::holds_alternative<RemoteRole>(role))
    return nullptr;
  if (const auto *own = std::get_if<OwnRole>(&role)) return own->make(context);
  if (std::holds_alternative<FirmwareRole>(role))
    return std::make_unique<firmware::FirmwareOperator>(context);
  if (std::holds_alternative<ReplayRole>(role)) return std::make_unique<ReplayOperator>(context);
  for (OperatorFactory *factory : factories)
    if (auto made = factory->make(context)) return made;
  throw InputError(context.scenario().file, context.line,
                   fmt::format("node '{}': this program cannot make a node with '{}'", context.name,
                               name_of(role)));
}

}  // namespace vericansim
