// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// AccessScript: see access_script.hpp.
#include "simulation/access_script.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenario/access_step.hpp"

namespace vericansim {
namespace {

bool matches(const AccessStep &step, std::uint32_t seen) {
  return ((seen ^ step.value) & step.mask) == 0;
}

bool demands(const AccessStep &step) {
  return step.kind == AccessStep::Kind::kUntil || step.kind == AccessStep::Kind::kCheck;
}

}  // namespace

// The coroutine may wait for a transfer; the master must forget it first.
AccessScript::~AccessScript() {
  if (!task_.done()) node_.ahb().reset();
}

void AccessScript::add(const AccessSpec &spec, Time when) {
  ahead_.push_back(&spec);
  bus_.at(when, [this, &spec] {
    std::erase(ahead_, &spec);
    due_.push_back(&spec);
    if (!serving_) task_ = serve();
  });
}

Task<> AccessScript::serve() {
  serving_ = true;
  while (!due_.empty()) {
    steps_done_ = 0;
    co_await run(due_.front());
    due_.pop_front();
  }
  serving_ = false;
}

Task<> AccessScript::run(const AccessSpec *spec) {
  for (const AccessStep &item : spec->steps) {
    if (!co_await step(item)) co_return;
    ++steps_done_;
  }
}

Task<std::uint32_t> AccessScript::read(std::uint32_t address) {
  ++accesses_;
  co_return (co_await node_.ahb().read(address)).data;
}

Task<> AccessScript::write(std::uint32_t address, std::uint32_t data) {
  ++accesses_;
  static_cast<void>(co_await node_.ahb().write(address, data));
}

// False: the rest of the script is not to be done.
Task<bool> AccessScript::step(AccessStep step) {
  using Kind = AccessStep::Kind;
  if (step.kind == Kind::kWrite) {
    co_await write(step.address, step.value);
    co_return true;
  }
  std::uint32_t seen = co_await read(step.address);
  switch (step.kind) {
    case Kind::kSet: co_await write(step.address, seen | step.value); break;
    case Kind::kClear: co_await write(step.address, seen & ~step.value); break;
    case Kind::kUntil:
      while (!matches(step, seen)) seen = co_await read(step.address);
      break;
    case Kind::kIf: co_return matches(step, seen);
    case Kind::kCheck:
      if (!matches(step, seen)) failed(step, seen);
      break;
    default: break;
  }
  co_return true;
}

void AccessScript::failed(const AccessStep &step, std::uint32_t seen) {
  if (failures_.size() >= kMostFailures) return;
  failures_.push_back(
      {fmt::format("{}: {}", node_.name(), to_text(step)),
       fmt::format("0x{:X}", step.value & step.mask),
       fmt::format("0x{:08X} at {:.3f} us", seen, static_cast<double>(bus_.now()) / kMicrosecond),
       false});
}

std::vector<CheckResult> AccessScript::failures() const {
  std::vector<CheckResult> all = failures_;
  for (std::size_t i = 0; i < due_.size(); ++i) {
    const auto &steps = due_[i]->steps;
    const auto from = steps.begin() + static_cast<std::ptrdiff_t>(i == 0 ? steps_done_ : 0);
    const auto demand = std::find_if(from, steps.end(), demands);
    if (demand != steps.end()) add_undone(*demand, all);
  }
  for (const AccessSpec *spec : ahead_) add_undone(spec->steps.front(), all);
  return all;
}

void AccessScript::add_undone(const AccessStep &step, std::vector<CheckResult> &all) const {
  if (all.size() >= kMostFailures) return;
  all.push_back({fmt::format("{}: {}", node_.name(), to_text(step)),
                 step.kind == AccessStep::Kind::kUntil ? "comes true" : "done", "not until the end",
                 false});
}

}  // namespace vericansim
