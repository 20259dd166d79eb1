// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Models of remote nodes and the C client on a bus of whole frames.
#include "remote/model_bus.hpp"

#include <algorithm>
#include <utility>

#include "trace/candump.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kFrameUs = 130;
constexpr std::uint32_t kTickUs = 1000;

}  // namespace

RemoteModel &ModelBus::add(const RemoteConfig &config, unsigned number) {
  nodes_.push_back(std::make_unique<RemoteModel>(config, number));
  nodes_.back()->start();
  return *nodes_.back();
}

verican_remote_port_t ModelBus::port() {
  const auto send = [](void *context, const verican_remote_frame_t *out) {
    auto &bus = *static_cast<ModelBus *>(context);
    if (bus.bus_off) return VERICAN_REMOTE_BUS_OFF;
    Frame frame;
    frame.id = out->id;
    frame.remote = out->remote;
    frame.dlc = out->dlc;
    if (!frame.remote) std::copy_n(out->data, std::min<unsigned>(out->dlc, 8), frame.data.begin());
    bus.from_host_.emplace_back(bus.now_us_ + bus.latency_us, frame);
    if (bus.latency_us == 0) (void)bus.send_waiting();
    return VERICAN_REMOTE_OK;
  };
  const auto receive = [](void *context, verican_remote_frame_t *in, std::uint32_t timeout_us) {
    return static_cast<ModelBus *>(context)->receive(*in, timeout_us);
  };
  const auto now = [](void *context) { return static_cast<ModelBus *>(context)->now_us_; };
  return {send, receive, now, this};
}

void ModelBus::send(const Frame &frame) {
  for (unsigned i = 0; i < repeat; ++i) {
    sent_.push_back(candump_frame(frame));
    deliver(frame, nullptr);
    wait(kFrameUs);
  }
}

void ModelBus::deliver(const Frame &frame, const RemoteModel *sender) {
  for (auto &node : nodes_) {
    if (node.get() == sender || !filter(node.get(), frame)) continue;
    node->receive(frame);
    node->intermission();
  }
  if (sender == nullptr || !filter(nullptr, frame)) return;
  to_host_.insert(to_host_.end(), doubled, heard(frame));
}

void ModelBus::wait(std::uint32_t us) {
  now_us_ += us;
  tick_us_ += us;
  for (; tick_us_ >= kTickUs; tick_us_ -= kTickUs)
    for (auto &node : nodes_) node->tick();
}

// The oldest frame of the host that has reached the bus.
bool ModelBus::send_waiting() {
  if (from_host_.empty() || static_cast<std::int32_t>(from_host_.front().first - now_us_) > 0)
    return false;
  const Frame frame = from_host_.front().second;
  from_host_.pop_front();
  send(frame);
  return true;
}

// Whether another node sends a different frame under this identifier: then both have an error.
bool ModelBus::collide(const Frame &frame) {
  const auto wants_it = [&](const auto &node) {
    const auto wanted = node->wants();
    return wanted && wanted->id == frame.id;
  };
  const bool differ = std::any_of(nodes_.begin(), nodes_.end(), [&](const auto &node) {
    return wants_it(node) && *node->wants() != frame;
  });
  if (!differ) return false;
  for (auto &node : nodes_) {
    if (!wants_it(node)) continue;
    node->attempt();
    node->failed();
  }
  wait(kFrameUs);
  return true;
}

// One frame of the nodes, that of the lowest identifier; equal ones are one (RN-12).
bool ModelBus::step() {
  std::optional<Frame> first;
  for (const auto &node : nodes_) {
    const auto frame = node->wants();
    if (frame && (!first || frame->id < first->id)) first = frame;
  }
  if (!first) return false;
  if (collides && collide(*first)) return true;
  const RemoteModel *sender = nullptr;
  for (auto &node : nodes_) {
    if (node->wants() != first) continue;
    node->attempt();
    node->sent();
    sender = node.get();
  }
  said_.push_back(candump_frame(*first));
  deliver(*first, sender);
  wait(kFrameUs);
  return true;
}

verican_remote_result_t ModelBus::receive(verican_remote_frame_t &frame, std::uint32_t timeout_us) {
  if (bus_off) return VERICAN_REMOTE_BUS_OFF;
  const std::uint32_t start = now_us_;
  while (to_host_.empty()) {
    const std::uint32_t passed = now_us_ - start;
    const bool over = passed >= timeout_us;
    // Without latency a node's frame is there as soon as the host looks for it.
    if ((!over || latency_us == 0) && (send_waiting() || step())) continue;
    if (over) return VERICAN_REMOTE_TIMEOUT;
    const std::uint32_t next = from_host_.empty() ? kTickUs : from_host_.front().first - now_us_;
    wait(std::min(timeout_us - passed, next));
  }
  const Frame in = to_host_.front();
  to_host_.pop_front();
  frame.id = static_cast<std::uint16_t>(in.id);
  frame.remote = in.remote;
  frame.dlc = in.dlc;
  std::copy(in.data.begin(), in.data.end(), frame.data);
  return VERICAN_REMOTE_OK;
}

std::vector<std::string> ModelBus::take_sent() { return std::exchange(sent_, {}); }

std::vector<std::string> ModelBus::take_said() { return std::exchange(said_, {}); }

}  // namespace vericansim
