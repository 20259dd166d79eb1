// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// FlopNode: see flop_node.hpp. The flip-flops are members of the model's root (flops.inc).
#include "softerror/flop_node.hpp"

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

#include "Vcan_ahb_flops.h"
#include "Vcan_ahb_flops___024root.h"
#include "node/model_context.hpp"
#include "node/model_edge.hpp"
#include "node/model_pins.hpp"

// Verilator's own (5.006): evaluates all logic that is not clocked.
void Vcan_ahb_flops___024root___eval_settle(Vcan_ahb_flops___024root *root);

namespace vericansim {
namespace {

using Root = Vcan_ahb_flops___024root;

/// A variable of the model that holds flip-flops.
struct Variable {
  const char *name;
  std::size_t offset;
  std::size_t size;
  std::uint64_t mask;
};

const std::vector<Variable> &variables() {
  static const std::vector<Variable> list = {
#define FLOP(name, member, mask) {name, offsetof(Root, member), sizeof(Root::member), mask},
#include "flops.inc"
#undef FLOP
  };
  return list;
}

/// Where flip-flop n of FlopNode::flops() lies.
const std::vector<std::pair<std::size_t, unsigned>> &places() {
  static const auto list = [] {
    std::vector<std::pair<std::size_t, unsigned>> all;
    for (std::size_t v = 0; v < variables().size(); ++v) {
      for (unsigned bit = 0; bit < 64; ++bit) {
        if ((variables()[v].mask >> bit) & 1) all.emplace_back(v, bit);
      }
    }
    return all;
  }();
  return list;
}

std::uint64_t load(const unsigned char *at, std::size_t size) {
  std::uint64_t word = 0;
  std::memcpy(&word, at, size);  // little-endian hosts only, as all of CI's
  return word;
}

// TIME, of a model with the time unit.
template <typename Model>
std::optional<std::uint64_t> time_in(const Model &root) {
#define TIME_OF(root, member) \
  (root).can_ahb__DOT__u_top__DOT__u_core__DOT__gen_time__DOT__u_time__DOT__##member
  if constexpr (requires { TIME_OF(root, lo_q); }) {
    return std::uint64_t{TIME_OF(root, u_clock__DOT__hi_o)} << 32 | TIME_OF(root, lo_q);
  }
#undef TIME_OF
  return std::nullopt;
}

constexpr unsigned kCsWords = 128, kMsgWords = 256, kMaskWords = 128;

}  // namespace

struct FlopNode::Impl {
  SerialContext context;
  Vcan_ahb_flops top{&context, "can_ahb"};
  ModelContext model_context{context};
  std::vector<std::pair<unsigned, bool>> stuck;

  unsigned char *bytes() { return reinterpret_cast<unsigned char *>(top.rootp); }
  void settle() { Vcan_ahb_flops___024root___eval_settle(top.rootp); }
  [[nodiscard]] bool value(unsigned n) {
    const auto [v, bit] = places().at(n);
    const Variable &variable = variables()[v];
    return ((load(bytes() + variable.offset, variable.size) >> bit) & 1) != 0;
  }
  void flip(unsigned n) {
    const auto [v, bit] = places().at(n);
    bytes()[variables()[v].offset + bit / 8] ^= static_cast<unsigned char>(1u << (bit % 8));
    settle();
  }
};

const std::vector<Flop> &FlopNode::flops() {
  static const auto list = [] {
    std::vector<Flop> all;
    for (const auto &[v, bit] : places()) all.push_back({variables()[v].name, bit});
    return all;
  }();
  return list;
}

FlopNode::FlopNode(std::string name, const ClockConfig &clock)
    : RtlNode{std::move(name), clock, 64}, impl_{std::make_unique<Impl>()} {
  reset();
}

FlopNode::~FlopNode() = default;

void FlopNode::edge() {
  rising_edge(impl_->top, impl_->top.hclk);
  for (const auto &[n, level] : impl_->stuck) {
    if (impl_->value(n) != level) impl_->flip(n);
  }
}

void FlopNode::reset() {
  auto &top = impl_->top;
  ahb().reset();
  top.hsel = 0;
  top.htrans = 0;
  top.hready = 1;
  top.can_rx_i = 1;
  top.hresetn = 0;
  for (int i = 0; i < 4; ++i) edge();
  top.hresetn = 1;
  edge();
  wait_ = 0;
  drive(static_cast<Level>(top.can_tx_o));
}

AhbResponse FlopNode::cycle(const AhbRequest &request) {
  auto &top = impl_->top;
  show_request(top, request);
  top.hready = top.hreadyout;
  top.eval();
  if (top.hready != top.hreadyout) {
    top.hready = top.hreadyout;
    top.eval();
  }
  const AhbResponse response{top.hrdata, top.hreadyout != 0, top.hresp != 0};
  look(host_seen_, request.haddr | (std::uint64_t{request.hwrite} << 32) |
                       (std::uint64_t{top.htrans} << 33) | (std::uint64_t{response.hready} << 35) |
                       (std::uint64_t{response.hresp} << 36));
  look(host_seen_, response.hrdata | (std::uint64_t{request.hwdata} << 32));
  return response;
}

void FlopNode::clock(Level rx) {
  auto &top = impl_->top;
  top.can_rx_i = static_cast<std::uint8_t>(rx);
  const bool active = ahb().active();
  AhbResponse response;
  if (active) {
    response = cycle(ahb().request());
  } else {
    top.hsel = 0;
    top.htrans = 0;
    top.hready = top.hreadyout;
    look(host_seen_, top.hreadyout | (top.hresp << 1));
  }
  edge();
  wait_ = top.hreadyout ? 0 : wait_ + 1;
  longest_wait_ = std::max(longest_wait_, wait_);
  drive(static_cast<Level>(top.can_tx_o));
  look(bus_seen_, top.can_tx_o);
  look(host_seen_, irq_lines());
  if (active) ahb().clock(response);
  after_edge();
}

std::uint64_t FlopNode::trace() const { return impl_->top.trace_o; }

std::uint8_t FlopNode::irq_lines() const { return model_irq_lines(impl_->top); }

void FlopNode::request_stop(bool stop) { impl_->top.stop_req_i = stop; }

bool FlopNode::irq_time() const { return impl_->top.irq_time_o != 0; }

bool FlopNode::time_out() const { return impl_->top.time_out_o != 0; }

std::uint64_t FlopNode::time_of_clock() const {
  const auto time = time_in(*impl_->top.rootp);
  return time ? *time : RtlNode::time_of_clock();
}

void FlopNode::external(bool level) { impl_->top.ext_i = level; }

AhbResult FlopNode::peek(const AhbTransfer &) { throw std::logic_error("FlopNode: no peek"); }

void FlopNode::flip(unsigned n) {
  impl_->flip(n);
  drive(static_cast<Level>(impl_->top.can_tx_o));
}

bool FlopNode::value(unsigned n) const { return impl_->value(n); }

void FlopNode::stick(unsigned n, bool level) {
  impl_->stuck.emplace_back(n, level);
  if (value(n) != level) flip(n);
}

unsigned FlopNode::ram_bits() { return 32 * (kCsWords + kMsgWords + kMaskWords); }

unsigned FlopNode::flip_ram(unsigned bit) {
  auto &root = *impl_->top.rootp;
  const std::uint32_t mask = 1u << (bit % 32);
  unsigned word = bit / 32;
  if (word < kCsWords) {
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem[word] ^= mask;
    return 0;
  }
  word -= kCsWords;
  if (word < kMsgWords) {
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem[word] ^= mask;
    return 1;
  }
  word -= kMsgWords;
  root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__gen_mask__DOT__u_mask__DOT__mem
      [word] ^= mask;
  return 2;
}

unsigned FlopNode::bit_clocks() const {
  const std::uint32_t ctrl =
      impl_->top.rootp->can_ahb__DOT__u_top__DOT__u_regs__DOT__u_ctrl1__DOT__value_q;
  const unsigned quanta = 4 + (ctrl & 7) + ((ctrl >> 16) & 7) + ((ctrl >> 19) & 7);
  return ((ctrl >> 24) + 1) * quanta;
}

std::uint64_t FlopNode::state() const {
  const unsigned char *at = impl_->bytes();
  std::uint64_t digest = 1;
  for (std::size_t i = 0; i + 8 <= sizeof(Root); i += 8) {
    digest = (digest ^ load(at + i, 8)) * 0x9E3779B97F4A7C15ULL + (digest >> 31);
  }
  return digest;
}

}  // namespace vericansim
