// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GuestLink: see guest_link.hpp.
#include "linux/guest_link.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace vericansim {
namespace {

[[noreturn]] void fail(const std::string &what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

Descriptor::Descriptor(Descriptor &&other) noexcept : fd_{std::exchange(other.fd_, -1)} {}

Descriptor &Descriptor::operator=(Descriptor &&other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

bool Channel::read(void *data, std::size_t size) {
  auto *at = static_cast<char *>(data);
  while (size > 0) {
    const ssize_t got = ::recv(fd_.get(), at, size, 0);
    if (got == 0 || (got < 0 && errno == ECONNRESET)) return false;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("reading from the guest");
    at += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

void Channel::write(const void *data, std::size_t size) {
  const auto *at = static_cast<const char *>(data);
  while (size > 0) {
    const ssize_t put = ::send(fd_.get(), at, size, MSG_NOSIGNAL);
    if (put < 0 && (errno == EPIPE || errno == ECONNRESET)) return;
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail("writing to the guest");
    at += put;
    size -= static_cast<std::size_t>(put);
  }
}

Listener::Listener(std::string path)
    : path_{std::move(path)}, fd_{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path)
    throw std::invalid_argument("the path of a socket has at most " +
                                std::to_string(sizeof address.sun_path - 1) +
                                " characters: " + path_);
  std::memcpy(address.sun_path, path_.c_str(), path_.size() + 1);
  if (!fd_.valid() ||
      ::bind(fd_.get(), reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0 ||
      ::listen(fd_.get(), 1) != 0)
    fail(path_);
}

Listener::~Listener() { ::unlink(path_.c_str()); }

Channel Listener::accept() const {
  Descriptor fd{::accept4(fd_.get(), nullptr, nullptr, SOCK_CLOEXEC)};
  if (!fd.valid()) fail("accepting the guest at " + path_);
  return Channel{std::move(fd)};
}

}  // namespace vericansim
