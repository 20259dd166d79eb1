// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// getaddrinfo for names and both versions of IP; the port is read back after bind.
#include "socketcand_listener.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <vector>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

constexpr int kBacklog = 16;

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses look_up(const std::string &option, const SocketcandAddress &address) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo *found = nullptr;
  const int failure =
      ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &hints, &found);
  if (failure != 0)
    throw InputError(option, 0,
                     in_quotes(address.text()) + ": no such address: " + ::gai_strerror(failure));
  return {found, &::freeaddrinfo};
}

/// Addresses of IPv4 first: a name may have one of each version, as localhost has, and python-can's
/// clients look for servers at IPv4 alone.
std::vector<const addrinfo *> in_order(const addrinfo *found) {
  std::vector<const addrinfo *> order;
  for (const addrinfo *entry = found; entry != nullptr; entry = entry->ai_next)
    order.push_back(entry);
  std::stable_partition(order.begin(), order.end(),
                        [](const addrinfo *entry) { return entry->ai_family == AF_INET; });
  return order;
}

/// A socket that listens there; -1 with errno if that is not possible.
int listen_at(const addrinfo &entry) {
  const int fd = ::socket(entry.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  const int on = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (::bind(fd, entry.ai_addr, entry.ai_addrlen) == 0 && ::listen(fd, kBacklog) == 0) return fd;
  const int failure = errno;
  ::close(fd);
  errno = failure;
  return -1;
}

/// The port that the kernel has chosen.
std::uint16_t port_of(int fd) {
  sockaddr_storage name{};
  socklen_t size = sizeof name;
  ::getsockname(fd, reinterpret_cast<sockaddr *>(&name), &size);
  // The port has the same place in both.
  return ntohs(name.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6 *>(&name)->sin6_port
                                          : reinterpret_cast<sockaddr_in *>(&name)->sin_port);
}

}  // namespace

SocketcandAddress SocketcandAddress::parse(const std::string &option, const std::string &text) {
  SocketcandAddress address;
  address.option = option;
  std::string port = text;
  if (const auto colon = text.rfind(':'); colon != std::string::npos) {
    port = text.substr(colon + 1);
    address.host = text.substr(0, colon);
    const bool brackets =
        address.host.size() > 2 && address.host.front() == '[' && address.host.back() == ']';
    if (brackets) address.host = address.host.substr(1, address.host.size() - 2);
    if (!brackets && address.host.find(':') != std::string::npos) address.host.clear();
  }
  const auto *last = port.data() + port.size();
  const auto [end, failure] = std::from_chars(port.data(), last, address.port);
  const bool zeros_in_front = port.size() > 1 && port.front() == '0';
  if (address.host.empty() || failure != std::errc{} || end != last || zeros_in_front)
    throw InputError(option, 0,
                     in_quotes(text) +
                         " is not allowed; allowed: [ADDRESS:]PORT with a port from 0 "
                         "(any free one) to 65535, as in 29536, 127.0.0.1:0 or "
                         "[::1]:29536");
  return address;
}

std::string SocketcandAddress::text() const {
  const bool brackets = host.find(':') != std::string::npos;
  return (brackets ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

SocketcandListener::SocketcandListener(const std::string &option, const SocketcandAddress &address)
    : address_{address} {
  const Addresses found = look_up(option, address);
  int failure = 0;
  for (const addrinfo *entry : in_order(found.get())) {
    fd_ = listen_at(*entry);
    if (fd_ >= 0) break;
    failure = errno;
  }
  if (fd_ < 0)
    throw InputError(option, 0,
                     "cannot listen on " + address.text() + ": " + std::strerror(failure));
  address_.port = port_of(fd_);
}

SocketcandListener::~SocketcandListener() {
  if (fd_ >= 0) ::close(fd_);
}

int SocketcandListener::accept() const {
  return ::accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
}

}  // namespace vericansim
