// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Jobs keep the time of their next period; filters keep what they have shown last.
#include "socketcand_broadcast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "socketcand_words.hpp"

namespace vericansim {
namespace {

std::string shown_id(canid_t id) {
  return (id & CAN_EFF_FLAG) != 0 ? fmt::format("{:08X}", id & CAN_EFF_MASK)
                                  : fmt::format("{:03X}", id);
}

}  // namespace

std::uint64_t content_of(const can_frame &frame) {
  std::uint64_t content = 0;
  for (unsigned i = 0; i < CAN_MAX_DLEN; ++i)
    content = content << 8U | (i < frame.len ? frame.data[i] : 0U);
  return content;
}

void BroadcastManager::add_job(const can_frame &frame, Time interval, Time now) {
  if (interval == 0)
    throw CommandError("add: an interval of 0 is not allowed; to send a frame once: send");
  if (jobs_.size() == kMost && !jobs_.contains(frame.can_id))
    throw CommandError(fmt::format("add: a client may have {} jobs", kMost));
  jobs_[frame.can_id] = {frame, interval, now};
}

void BroadcastManager::update_job(const can_frame &frame) {
  const auto job = jobs_.find(frame.can_id);
  if (job == jobs_.end()) throw CommandError("update: there is no job " + shown_id(frame.can_id));
  job->second.frame = frame;
}

void BroadcastManager::delete_job(canid_t id) {
  if (jobs_.erase(id) == 0) throw CommandError("delete: there is no job " + shown_id(id));
}

std::optional<can_frame> BroadcastManager::due(Time now) {
  Job *first = nullptr;
  for (auto &[id, job] : jobs_)
    if (job.due <= now && (first == nullptr || job.due < first->due)) first = &job;
  if (first == nullptr) return std::nullopt;
  const Time too_late = now - first->due - kCatchUp;
  if (too_late > 0) {
    const Time periods = too_late / first->interval;
    missed_ += static_cast<std::uint64_t>(periods);
    first->due += periods * first->interval;
  }
  first->due += first->interval;
  return first->frame;
}

void BroadcastManager::put_filter(canid_t id, Filter filter) {
  if (filters_.size() == kMost && !filters_.contains(id))
    throw CommandError(fmt::format("a client may have {} filters", kMost));
  filters_[id] = std::move(filter);
}

void BroadcastManager::subscribe(canid_t id, Time throttle) {
  put_filter(id, {.throttle = throttle, .always = true, .contents = {Content{}}});
}

void BroadcastManager::filter(canid_t id, Time throttle, std::uint64_t mask) {
  put_filter(id, {.throttle = throttle, .contents = {Content{.mask = mask}}});
}

void BroadcastManager::mux_filter(canid_t id, Time throttle,
                                  const std::vector<std::uint64_t> &tuples) {
  Filter filter{.throttle = throttle, .mux = tuples.front()};
  for (std::size_t i = 1; i < tuples.size(); ++i)
    filter.contents.push_back({.value = tuples[i] & filter.mux, .mask = tuples[i] & ~filter.mux});
  put_filter(id, std::move(filter));
}

void BroadcastManager::unsubscribe(canid_t id) {
  if (filters_.erase(id) == 0)
    throw CommandError("unsubscribe: there is no subscription or filter " + shown_id(id));
}

void BroadcastManager::receive(const PortMessage &message, std::vector<PortMessage> &out) {
  const auto found = filters_.find(message.frame.can_id);
  if (found == filters_.end()) return;
  Filter &filter = found->second;
  const std::uint64_t content = content_of(message.frame);
  for (Content &part : filter.contents) {
    if (((content ^ part.value) & filter.mux) != 0) continue;
    const bool changed = !part.last || ((content ^ *part.last) & part.mask) != 0;
    if (!filter.always && !changed) return;
    part.last = content;
    if (filter.shown && message.time < *filter.shown + filter.throttle) {
      part.held = message;
    } else {
      part.held.reset();
      filter.shown = message.time;
      out.push_back(message);
    }
    return;
  }
}

void BroadcastManager::release(Time now, std::vector<PortMessage> &out) {
  for (auto &[id, filter] : filters_) {
    if (!filter.shown || now < *filter.shown + filter.throttle) continue;
    for (Content &part : filter.contents) {
      if (!part.held) continue;
      out.push_back(*part.held);
      part.held.reset();
      filter.shown = now;
    }
  }
}

bool BroadcastManager::awaits_time() const {
  const auto held = [](const Content &part) { return part.held.has_value(); };
  return !jobs_.empty() || std::any_of(filters_.begin(), filters_.end(), [&](const auto &entry) {
    const auto &contents = entry.second.contents;
    return std::any_of(contents.begin(), contents.end(), held);
  });
}

void BroadcastManager::clear() {
  jobs_.clear();
  filters_.clear();
}

}  // namespace vericansim
