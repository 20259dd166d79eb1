// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// BufferModel, the set of states and the events of the bus: see buffer_model.hpp. The CPU's side
// is in buffer_cpu.cpp.
#include "model/buffer_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vericansim {
namespace {

using Kind = Destination::Kind;

std::string name_of(const Frame &frame) {
  std::string text = fmt::format("{:03X}{}{} [{}]", frame.id, frame.extended ? "x" : "",
                                 frame.remote ? " remote" : "", frame.dlc);
  for (unsigned i = 0; i < frame.payload_size(); ++i) text += fmt::format(" {:02X}", frame.data[i]);
  return text;
}

std::string nothing() { return "no state is left"; }

}  // namespace

BufferModel::BufferModel(const BufferConfig &config, const BufferWindows &windows)
    : config_{config}, windows_{windows}, states_{BufferState{config.num_mb}} {
  config.validate();
}

void BufferModel::configure(const BufferConfig &config, std::uint64_t now) {
  config.validate();
  settle(now);
  if (config.first_mailbox() != config_.first_mailbox())
    for (BufferState &state : states_) state.area_changed(config.fen != config_.fen);
  config_ = config;
  for (BufferState &state : states_) {
    for (unsigned n = 0; n < config.num_mb; ++n) {
      BufferContent &buffer = state.mb.change(n);
      const bool sends = code_sends(buffer.code()) && config.takes_part(n);
      if (!sends) buffer.request.reset();
      if (sends) buffer.request = state.request_of(n, config, 0);
    }
    state.withdrawn.clear();
  }
}

void BufferModel::replace(const std::function<void(const BufferState &, DistinctStates &)> &each,
                          const std::function<std::string()> &otherwise) {
  if (!ok()) return;
  DistinctStates next;
  for (const BufferState &state : states_) each(state, next);
  if (next.size() == 0) {
    failure_ = otherwise();
    return;
  }
  states_ = next.take();
  limit();
}

void BufferModel::limit() {
  if (!ok() || states_.size() <= kMostStates) return;
  too_open_ = true;
  failure_ = "more is open than can be judged";
}

void BufferModel::keep(const std::function<bool(const BufferState &)> &possible,
                       const std::function<std::string()> &otherwise) {
  if (!ok()) return;
  if (std::none_of(states_.begin(), states_.end(), possible)) {
    failure_ = otherwise();
    return;
  }
  std::erase_if(states_, [&](const BufferState &state) { return !possible(state); });
}

// What may happen in this state without further ado: a match decided, a frame moved in, a flight
// concluded.
void BufferModel::steps_of(const BufferState &state, std::uint64_t now, States &out) const {
  if (state.matching && state.destination.kind == Kind::kUndecided) {
    for (const Destination &to : state.destinations(*state.matching, masks_, config_)) {
      out.push_back(state);
      out.back().destination = to;
    }
  } else if (state.matching && state.valid) {
    const auto arrive = [&](const Destination &to) {
      out.push_back(state);
      BufferState &next = out.back();
      next.end_round();
      next.store(*state.matching, to, now, config_);
    };
    arrive(state.destination);
    if (const auto place = state.late_place(masks_, config_)) arrive(*place);
  }
  if (state.released) {
    out.push_back(state);
    out.back().release();
  }
  // A frame that has moved out, but is not on the bus yet, can still be taken back: for an abort,
  // or because the others begin one, or an overload frame.
  if (state.moved_out && !state.moved_out_abort && !bus_free_) {
    out.push_back(state);
    out.back().moved_out.reset();
  }
  if (state.moved_out && state.moved_out_abort) {
    BufferState next = state;
    next.moved_out.reset();
    next.abort(*state.moved_out, now);
    next.mb.change(*state.moved_out).words.known[0] &= 0x0F000000 | ~kCsStored;
    out.push_back(std::move(next));
  }
  if (state.ended) {
    BufferState next = state;
    next.ended.reset();
    next.finish(*state.ended, now);
    out.push_back(std::move(next));
  }
}

// From the first intermission bit, or when the bus is idle, a buffer may have moved out, and is
// locked in until it is sent (3.3): that it comes soon is for the rules to judge. An abort request
// resolves at once.
bool BufferModel::moved_out_too_long(const BufferState &state, std::uint64_t now) const {
  if (!state.moved_out || (bus_free_ && !state.moved_out_abort)) return false;
  return now > state.moved_out_since + windows_.decision;
}

// Adds the states that steps lead to; what is overdue has happened in all of them.
void BufferModel::open_up(std::uint64_t now) {
  DistinctStates reached;
  for (const BufferState &state : states_) reached.add(state);
  for (std::size_t i = 0; i < reached.size(); ++i) {
    States next;
    steps_of(reached[i], now, next);
    for (BufferState &state : next) reached.add(std::move(state));
  }
  States all = reached.take();
  const auto overdue = [&](const BufferState &state) {
    if (state.valid && now > received_at_ + windows_.move_in) return true;
    if (state.released && now > state.released_since + windows_.move_in) return true;
    if (moved_out_too_long(state, now)) return true;
    return state.ended && now > ended_at_ + windows_.completion;
  };
  std::erase_if(all, overdue);
  for (BufferState &state : all)
    std::erase_if(state.withdrawn,
                  [&](const auto &old) { return old.second.until + windows_.decision < now; });
  if (ok()) states_ = std::move(all);
  limit();
}

void BufferModel::settle(std::uint64_t now) {
  const bool open = std::any_of(states_.begin(), states_.end(), [](const BufferState &s) {
    return s.matching || s.released || s.ended || s.moved_out || !s.withdrawn.empty();
  });
  if (open) open_up(now);
  if (states_.size() > 1) merge(now);
}

// States that differ in what no longer matters are one.
void BufferModel::merge(std::uint64_t now) {
  DistinctStates merged;
  for (BufferState &state : states_) {
    if (!state.moved_out) {
      state.moved_out_since = 0;
      state.moved_out_abort = false;
    }
    if (!state.released) state.released_since = 0;
    for (unsigned n = 0; n < state.mb.size(); ++n) {
      const auto &request = state.mb[n].request;
      if (request && request->since != 0 && request->since + windows_.decision < now)
        state.mb.change(n).request->since = 0;
    }
    merged.add(std::move(state));
  }
  states_ = merged.take();
}

bool BufferModel::may_be(const std::function<bool(const BufferState &)> &so) const {
  return std::any_of(states_.begin(), states_.end(), so);
}

bool BufferModel::sending() const {
  return may_be([](const BufferState &state) { return state.flight.has_value(); });
}

bool BufferModel::must_send_since(std::uint64_t clock) const {
  return std::all_of(states_.begin(), states_.end(), [&](const BufferState &state) {
    for (unsigned n = 0; n < state.mb.size(); ++n) {
      const auto &request = state.mb[n].request;
      const bool given_up = state.moved_out == n && state.moved_out_abort;
      if (request && request->since <= clock && !given_up) return true;
    }
    return false;
  });
}

std::vector<Frame> BufferModel::flights() const {
  std::vector<Frame> frames;
  for (const BufferState &state : states_) {
    if (!state.flight) continue;
    const Frame &frame = state.flight->request.frame;
    if (std::find(frames.begin(), frames.end(), frame) == frames.end()) frames.push_back(frame);
  }
  return frames;
}

// What has moved out is sent next, unless a better one comes before its SOF; but an attempt that is
// to be aborted is not put off.
bool BufferModel::may_start(const BufferState &state, unsigned n, const SendRequest &request) {
  if (!state.moved_out || state.moved_out == n) return true;
  const auto &other = state.mb[*state.moved_out].request;
  return !state.moved_out_abort && other && request.value < other->value;
}

void BufferModel::start_own(const BufferState &state, std::uint64_t now,
                            DistinctStates &out) const {
  // The best of those that stand long enough must not be passed over by a worse one.
  std::uint64_t best = ~std::uint64_t{0};
  std::vector<std::pair<unsigned, SendRequest>> able;
  for (unsigned n = 0; n < config_.num_mb; ++n) {
    const auto &request = state.mb[n].request;
    if (!request) continue;
    able.emplace_back(n, *request);
    if (request->since + windows_.decision <= now) best = std::min(best, request->value);
  }
  if (!config_.aen)
    for (const auto &old : state.withdrawn) able.push_back(old);
  for (const auto &[n, request] : able) {
    if (request.value > best || !may_start(state, n, request)) continue;
    BufferState next = state;
    const bool orphan = request.until != ~std::uint64_t{0};
    next.flight = Flight{.mb = n, .request = request, .orphan = orphan};
    next.flight->abort = state.moved_out && state.moved_out_abort;
    next.moved_out.reset();
    if (!orphan) next.mb.change(n).request.reset();
    out.add(std::move(next));
  }
}

void BufferModel::frame_started(bool transmitter, std::uint64_t now) {
  settle(now);
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        if (transmitter) return start_own(state, now, out);
        BufferState next = state;
        if (state.moved_out && state.moved_out_abort) {
          out.add(state);  // not just yet
          next.abort(*state.moved_out, now);
        }
        next.moved_out.reset();
        out.add(std::move(next));
      },
      [] { return "a frame is being sent, but no buffer may be"; });
}

void BufferModel::header(const std::optional<Frame> &foreign, Stamp stamp, std::uint64_t now) {
  if (foreign) foreign->validate();
  settle(now);
  stamp_ = stamp;
  for (BufferState &state : states_) {
    if (!foreign && !state.flight) continue;
    state.end_round();
    state.matching = ArrivedFrame{.frame = foreign ? *foreign : state.flight->request.frame,
                                  .stamp = stamp_,
                                  .own = !foreign};
  }
}

void BufferModel::received(std::uint64_t now) {
  settle(now);
  received_at_ = now;
  for (BufferState &state : states_) state.valid = state.matching.has_value();
}

void BufferModel::received(const Frame &foreign, std::uint64_t now) {
  foreign.validate();
  settle(now);
  for (BufferState &state : states_)
    if (state.matching && !state.matching->own) state.matching->frame = foreign;
  received(now);
}

void BufferModel::receive_failed(std::uint64_t now) {
  settle(now);
  replace(
      [](const BufferState &state, DistinctStates &out) {
        BufferState next = state;
        if (!state.valid) next.end_round();
        out.add(std::move(next));
      },
      nothing);
}

void BufferModel::sent(const Frame &wire, std::uint64_t now) {
  wire.validate();
  settle(now);
  ended_at_ = now;
  std::string expected;
  for (const BufferState &state : states_)
    if (state.flight)
      expected += fmt::format(" MB{} {};", state.flight->mb, name_of(state.flight->request.frame));
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        if (!state.flight || state.flight->request.frame != wire) return;
        BufferState next = state;
        next.ended = FlightEnd{.flight = *state.flight, .success = true, .stamp = stamp_};
        next.flight.reset();
        out.add(std::move(next));
      },
      [&] { return fmt::format("{} was sent; allowed:{}", name_of(wire), expected); });
}

void BufferModel::send_failed(std::uint64_t now) {
  settle(now);
  ended_at_ = now;
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        if (!state.flight) return;
        BufferState next = state;
        const FlightEnd end{.flight = *state.flight, .success = false, .stamp = stamp_};
        next.flight.reset();
        // A retry needs no time; an end with code and flag does.
        if (state.flight->abort || state.flight->request.one_shot) {
          next.ended = end;
        } else {
          next.finish(end, now);
        }
        out.add(std::move(next));
      },
      [] { return "a frame failed that was not being sent"; });
}

void BufferModel::send_not_begun(std::uint64_t now) {
  settle(now);
  ended_at_ = now;
  replace(
      [&](const BufferState &state, DistinctStates &out) {
        if (!state.flight) return;
        BufferState next = state;
        const Flight flight = *state.flight;
        next.flight.reset();
        if (flight.abort) {
          next.ended = FlightEnd{.flight = flight, .success = false, .stamp = stamp_};
        } else if (!flight.orphan) {
          next.mb.change(flight.mb).request = flight.request;
        }
        out.add(std::move(next));
      },
      nothing);
}

void BufferModel::soft_reset(std::uint64_t now) {
  settle(now);
  for (BufferState &state : states_) state.soft_reset();
}

}  // namespace vericansim
