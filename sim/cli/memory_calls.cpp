// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See memory_calls.hpp.
#include "cli/memory_calls.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "trace/remote_words.hpp"

namespace vericansim::cli {
namespace {

constexpr std::size_t kMostNodes = 256;

std::string node_text(unsigned node) {
  return node == VERICAN_REMOTE_ALL ? "all nodes" : fmt::format("node {}", node);
}

}  // namespace

MemoryCalls::MemoryCalls(MemoryLink &link, unsigned name_bits, unsigned timeout_ms) {
  const verican_remote_port_t port = link.port();
  check(verican_remote_init(&client_, &port, static_cast<std::uint8_t>(name_bits)), "the client");
  client_.data_frames = !link.remote_frames();
  client_.timeout_us = timeout_ms * 1000;
  // HERE is an answer, too: whoever waits longer for those waits longer for it. By default nothing
  // changes.
  client_.select_us =
      std::max(std::min(client_.timeout_us, client_.select_us), client_.timeout_us / 3);
}

void MemoryCalls::check(verican_remote_result_t result, const std::string &who,
                        const std::string &at) const {
  switch (result) {
    case VERICAN_REMOTE_OK: return;
    case VERICAN_REMOTE_TIMEOUT: throw MemoryFailure(who + " does not answer" + at);
    case VERICAN_REMOTE_REFUSED:
      throw MemoryFailure(fmt::format("{} refuses{}: code {:02X}, {}", who, at, client_.code,
                                      remote_code_name(client_.code)));
    case VERICAN_REMOTE_SEQUENCE: throw MemoryFailure(who + " loses frames");
    case VERICAN_REMOTE_BUS_OFF: throw MemoryFailure("the way to the bus is gone");
    case VERICAN_REMOTE_NOT_TAKEN:
      throw MemoryFailure(who +
                          " is there, but does not take the number; in OPERATE it takes none, so: "
                          "state safe first");
    case VERICAN_REMOTE_IN_USE:
      throw MemoryFailure(
          "another node has that number; 'scan' lists them, and 'assign' with 0 "
          "takes a number away");
    case VERICAN_REMOTE_ARGUMENT: break;
  }
  throw std::logic_error("an argument that the options should have refused");
}

void MemoryCalls::check_transfer(verican_remote_result_t result, unsigned node,
                                 unsigned first) const {
  const bool told = result == VERICAN_REMOTE_REFUSED || client_.address != first;
  check(result, node_text(node), told ? fmt::format(" at 0x{:03X}", client_.address) : "");
}

std::vector<verican_remote_identity_t> MemoryCalls::scan() {
  std::vector<verican_remote_identity_t> nodes(kMostNodes + 1);
  std::size_t count = nodes.size();
  check(verican_remote_scan(&client_, nodes.data(), &count), "the bus");
  if (count > kMostNodes)  // something answers every SELECT
    throw MemoryFailure(fmt::format("more than {} nodes answer", kMostNodes));
  nodes.resize(count);
  return nodes;
}

std::vector<std::uint8_t> MemoryCalls::read(unsigned node, unsigned address, unsigned length) {
  std::vector<std::uint8_t> bytes(length);
  check_transfer(
      verican_remote_read(&client_, static_cast<std::uint8_t>(node),
                          static_cast<std::uint16_t>(address), bytes.data(), bytes.size()),
      node, address);
  return bytes;
}

void MemoryCalls::write(unsigned node, unsigned address, const std::vector<std::uint8_t> &bytes) {
  const auto call =
      node == VERICAN_REMOTE_ALL ? verican_remote_write : verican_remote_write_confirmed;
  check_transfer(call(&client_, static_cast<std::uint8_t>(node),
                      static_cast<std::uint16_t>(address), bytes.data(), bytes.size()),
                 node, address);
}

verican_remote_answers_t MemoryCalls::poll(unsigned address, unsigned length) {
  verican_remote_answers_t answers{};
  check(verican_remote_poll(&client_, static_cast<std::uint16_t>(address),
                            static_cast<std::uint8_t>(length), 0, &answers),
        "the bus");
  return answers;
}

verican_remote_status_t MemoryCalls::status(unsigned node) {
  verican_remote_status_t status{};
  check(verican_remote_status(&client_, static_cast<std::uint8_t>(node), &status), node_text(node));
  return status;
}

void MemoryCalls::trigger(unsigned count) {
  check(verican_remote_trigger(&client_, static_cast<std::uint8_t>(count)), "the bus");
}

void MemoryCalls::state(unsigned node, unsigned command) {
  check(verican_remote_state(&client_, static_cast<std::uint8_t>(node),
                             static_cast<std::uint8_t>(command)),
        "the bus");
}

void MemoryCalls::clear(unsigned node) {
  check(verican_remote_clear(&client_, static_cast<std::uint8_t>(node)), node_text(node));
}

unsigned MemoryCalls::memory_size(unsigned node) {
  verican_remote_identity_t identity{};
  check(verican_remote_identity(&client_, static_cast<std::uint8_t>(node), &identity),
        node_text(node));
  return identity.memory;
}

void MemoryCalls::assign(std::uint32_t serial, unsigned number) {
  check(verican_remote_assign(&client_, serial, static_cast<std::uint8_t>(number)),
        fmt::format("the node with serial number {:08X}", serial));
}

}  // namespace vericansim::cli
