// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FirmwareOperator: see firmware_operator.hpp.
#include "session/firmware_operator.hpp"

#include <utility>
#include <vector>

#include "simulation/simulation.hpp"

namespace vericansim::firmware {
namespace {

std::vector<RtlNode *> cores_of(const OperatorContext &context) {
  std::vector<RtlNode *> cores{&context.simulation().node(context.id)};
  for (Simulation *simulation : context.simulations)
    for (NodeId id = 0; id < simulation->scenario().nodes.size(); ++id) {
      const auto *second = std::get_if<SecondCoreRole>(&simulation->scenario().nodes[id].role);
      if (second != nullptr && second->board == context.spec().name)
        cores.push_back(&simulation->node(id));
    }
  return cores;
}

int wanted_exit(const OperatorContext &context) {
  for (const NodeExpectation &node : context.scenario().expect.nodes)
    if (node.node == context.id && node.exit_code) return *node.exit_code;
  return 0;
}

}  // namespace

FirmwareOperator::FirmwareOperator(const OperatorContext &context)
    : role_{std::get<FirmwareRole>(context.spec().role)}, wanted_exit_{wanted_exit(context)} {
  const CortexConfig config{.clocks_per_instruction = role_.clocks_per_instruction,
                            .catch_hard_fault = !role_.run_hard_fault_handler};
  board_ = std::make_unique<Board>(context.spec().name,
                                   role_.image ? *role_.image : read_elf(role_.file),
                                   cores_of(context), config);
  board_->set_output([this, output = context.output](std::string_view text) {
    printed_ += text;
    if (output) output(board_->name(), text);
  });
}

Time FirmwareOperator::next_edge() const {
  return board_->ended() ? kNever : board_->cores()[0]->oscillator().next();
}

void FirmwareOperator::clock(Time now) {
  board_->clock();
  if (board_->ended()) time_ = now - start_;
}

void FirmwareOperator::end(Time elapsed) {
  if (!board_->ended()) time_ = elapsed;
}

void FirmwareOperator::report(RunReport &report) {
  using End = BoardReport::End;
  BoardReport board;
  board.node = board_->name();
  board.file = board_->image().file;
  board.clocks = board_->cpu().cycles();
  board.instructions = board_->cpu().instructions();
  board.output = printed_;
  board.state = board_->report();
  board.time = time_;
  board.endless = role_.endless;
  board.wanted_exit = wanted_exit_;
  board.end = board_->exit_code()      ? End::kExit
              : board_->cpu().halted() ? End::kFault
              : report.interrupted     ? End::kInterrupted
                                       : End::kLimit;
  board.exit_code = board_->exit_code().value_or(0);
  report.boards.push_back(std::move(board));
}

}  // namespace vericansim::firmware
