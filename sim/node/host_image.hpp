// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// HostImage: what a Verilated host side was before a clock, to be compared with what it is then.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>

#include "node/model_edge.hpp"

namespace vericansim {

/// A copy of a model's root without the buffers' RAMs, which are two thirds of its bytes.
///
/// A clock in which nothing outside the RAMs changes is like the next one: it has written the same
/// word to the same place, and the outputs of the RAMs, which are not left out, show it already.
///
/// Needs the members that Verilator 5.006 gives the model; without them (left_out() = 0) the RAMs
/// are compared, too.
template <typename Root>
class HostImage {
 public:
  /// Bytes of the root that are left out.
  [[nodiscard]] static std::size_t left_out(const Root &root) {
    const Gap gap = rams(root);
    return gap.end - gap.begin;
  }

  /// The members as they were when taken; those of the RAMs have no meaning.
  [[nodiscard]] Root &root() { return *reinterpret_cast<Root *>(bytes_.get()); }

  /// Keeps what `root` is now.
  void take(const Root &root) {
    const std::byte *now = bytes_of(root);
    const Gap gap = rams(root);
    std::memcpy(bytes_.get(), now, gap.begin);
    std::memcpy(bytes_.get() + gap.end, now + gap.end, sizeof(Root) - gap.end);
  }

  /// Whether `root` is what was taken.
  [[nodiscard]] bool matches(const Root &root) const {
    const std::byte *now = bytes_of(root);
    const Gap gap = rams(root);
    return std::memcmp(bytes_.get(), now, gap.begin) == 0 &&
           std::memcmp(bytes_.get() + gap.end, now + gap.end, sizeof(Root) - gap.end) == 0;
  }

 private:
  // Where the RAMs are in the root.
  struct Gap {
    std::size_t begin, end;
  };

  template <typename R>
  static constexpr bool kKnown = !kPlainEdges && requires(R & root) {
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__cs;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__msg;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__mask;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem;
    root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__gen_mask__DOT__u_mask__DOT__mem;
  };

  template <typename T>
  static const std::byte *bytes_of(const T &object) {
    return reinterpret_cast<const std::byte *>(&object);
  }

  // Verilator sorts members by size, so that nothing lies between the RAMs; if anything does, none
  // is left out.
  template <typename R>
  static Gap rams(const R &root) {
    if constexpr (kKnown<R>) {
      const auto first =
          bytes_of(root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem);
      const auto last = bytes_of(masks(root));
      const std::size_t size =
          sizeof root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_cs__DOT__mem +
          sizeof root.can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__u_msg__DOT__mem;
      const auto begin = static_cast<std::size_t>(first - bytes_of(root));
      if (last == first + size) return {begin, begin + size + sizeof masks(root)};
    }
    return {0, 0};
  }

  template <typename R>
  static const auto &masks(const R &root) {
    return root
        .can_ahb__DOT__u_top__DOT__u_mailbox__DOT__u_port__DOT__gen_mask__DOT__u_mask__DOT__mem;
  }

  std::unique_ptr<std::byte[]> bytes_ = std::make_unique<std::byte[]>(sizeof(Root));
};

}  // namespace vericansim
