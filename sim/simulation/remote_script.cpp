// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RemoteScript: see remote_script.hpp.
#include "simulation/remote_script.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "trace/quantity.hpp"

namespace vericansim {
namespace {

constexpr Time kTimeOut = 150 * kMillisecond;  // RN-91
constexpr unsigned kTries = 3;

std::string hex(const std::vector<std::uint8_t> &bytes) {
  return fmt::format("{:02X}", fmt::join(bytes, " "));
}

/// In whichever words; it has the same identifier with both NameBits.
bool is_trigger(const Frame &frame) {
  return frame.id == 1 && !frame.extended && !frame.remote && frame.dlc <= 1;
}

}  // namespace

void RemoteScript::add(const RemoteCommandSpec &spec, Time start, Time stop) {
  if (start + spec.at >= stop) never_.push_back(&spec);
  const std::size_t first = messages_.size();
  if (spec.period != 0)
    for (const RemoteStep &step : spec.steps) {
      MessageReport message;
      message.name = step.text;
      message.node = name_;
      messages_.push_back(message);
    }
  schedule(spec, 0, start + spec.at, stop, first);
}

void RemoteScript::schedule(const RemoteCommandSpec &spec, std::uint64_t round, Time when,
                            Time stop, std::size_t first_message) {
  if (when >= stop || round >= spec.count) return;
  bus_.at(when, [this, &spec, round, when, stop, first_message] {
    due_.push_back({&spec, round, when, first_message});
    if (spec.period != 0) schedule(spec, round + 1, when + spec.period, stop, first_message);
    work();
  });
}

void RemoteScript::work() {
  while (waiting_ == nullptr && !due_.empty()) {
    Due &due = due_.front();
    const RemoteStep &step = due.spec->steps[due.step];
    if (step.answer) {
      waiting_ = &step;
      tries_left_ = kTries;
      ask();
      return;
    }
    send(due, step);
    ++done_;
    if (++due.step == due.spec->steps.size()) due_.pop_front();
  }
}

void RemoteScript::send(const Due &due, const RemoteStep &step) {
  Frame frame = step.frame;
  for (const unsigned place : step.rounds) {
    frame.data[place] = static_cast<std::uint8_t>(due.round);
    frame.data[place + 1] = static_cast<std::uint8_t>(due.round >> 8);
  }
  const auto next = static_cast<std::uint8_t>(trigger_ + 1);
  if (step.counts) frame.data[0] = next;
  if (is_trigger(frame)) trigger_ = frame.dlc == 0 ? next : frame.data[0];
  host_.send(frame);
  if (on_command) on_command(frame);
  if (due.spec->period == 0) return;
  const std::size_t message = due.first_message + due.step;
  if (!step.answer || tries_left_ + 1 == kTries) ++messages_[message].queued;
  if (!step.answer) on_bus_.push_back({frame, due.event, message});
}

void RemoteScript::ask() {
  --tries_left_;
  send(due_.front(), *waiting_);
  bus_.at(bus_.now() + kTimeOut, [this, asked = ++asked_] { on_time_out(asked); });
}

void RemoteScript::on_time_out(std::uint64_t asked) {
  if (waiting_ == nullptr || asked != asked_) return;
  if (tries_left_ != 0) return ask();
  failed(*waiting_, "an answer", "none in three tries");
  finish_step();
}

void RemoteScript::on_received(const Frame &frame) {
  if (waiting_ == nullptr) return;
  const Frame &answer = *waiting_->answer;
  if (frame.id != answer.id || frame.extended || frame.remote || frame.dlc != answer.dlc ||
      !std::equal(answer.data.begin(), answer.data.begin() + waiting_->head, frame.data.begin()))
    return;
  const std::vector<std::uint8_t> bytes(frame.data.begin() + waiting_->head,
                                        frame.data.begin() + frame.payload_size());
  if (waiting_->wanted && bytes != *waiting_->wanted)
    failed(*waiting_, hex(*waiting_->wanted), hex(bytes));
  const Due &due = due_.front();
  if (due.spec->period != 0) respond(due.first_message + due.step, bus_.now() - due.event);
  finish_step();
}

void RemoteScript::finish_step() {
  waiting_ = nullptr;
  ++done_;
  if (++due_.front().step == due_.front().spec->steps.size()) due_.pop_front();
  work();
}

// One transmit buffer: frames of the host end in the order in which they were queued.
void RemoteScript::on_frame(const BusFrame &frame) {
  if (!frame.sent_by(node_) || on_bus_.empty() || on_bus_.front().frame != frame.frame) return;
  respond(on_bus_.front().message, frame.end - on_bus_.front().event);
  on_bus_.pop_front();
}

void RemoteScript::respond(std::size_t message, Time response) {
  MessageReport &report = messages_[message];
  report.shortest = report.sent == 0 ? response : std::min(report.shortest, response);
  report.longest = std::max(report.longest, response);
  report.sum += response;
  ++report.sent;
}

void RemoteScript::failed(const RemoteStep &step, const std::string &wanted,
                          const std::string &seen) {
  if (failures_.size() >= kMostFailures) return;
  failures_.push_back({name_ + ": " + step.text, wanted,
                       fmt::format("{} at {}", seen, readable_time(bus_.now())), false});
}

std::vector<CheckResult> RemoteScript::failures() const {
  std::vector<CheckResult> all = failures_;
  const auto add_undone = [&](const RemoteStep &step) {
    if (all.size() < kMostFailures)
      all.push_back({name_ + ": " + step.text, "done", "not until the end", false});
  };
  if (!due_.empty()) add_undone(due_.front().spec->steps[due_.front().step]);
  for (const RemoteCommandSpec *spec : never_) add_undone(spec->steps.front());
  return all;
}

std::vector<MessageReport> RemoteScript::messages() const { return messages_; }

}  // namespace vericansim
