// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// RawCanPort: see raw_port.hpp.
#include "raw_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

constexpr int kReceiveBuffer = 64 << 20;  // bytes; the kernel takes what it allows
constexpr WallTime kLookAgain = 100'000'000;

WallTime steady_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// What an interface is now.
struct Interface {
  int index = 0;  ///< 0: there is none of that name
  bool can = false;
  bool up = false;
};

Interface look_at(int fd, const std::string &name) {
  ifreq request{};
  std::copy_n(name.c_str(), std::min<std::size_t>(name.size(), IFNAMSIZ - 1), request.ifr_name);
  Interface result;
  if (::ioctl(fd, SIOCGIFINDEX, &request) != 0) return result;
  result.index = request.ifr_ifindex;
  if (::ioctl(fd, SIOCGIFHWADDR, &request) == 0)
    result.can = request.ifr_hwaddr.sa_family == ARPHRD_CAN;
  if (::ioctl(fd, SIOCGIFFLAGS, &request) == 0) result.up = (request.ifr_flags & IFF_UP) != 0;
  return result;
}

/// A message of a program, of the `size` bytes that the kernel gave. What fits in no frame of
/// CAN 2.0 keeps a length that none has, by which the node refuses and counts it.
can_frame message_of(const canfd_frame &read, std::size_t size) {
  can_frame message{};
  static_assert(offsetof(canfd_frame, data) == offsetof(can_frame, data));
  std::memcpy(&message, &read, sizeof message);
  if (size == sizeof read) message.len = CANFD_MAX_DLEN;
  return message;
}

bool gone_or_down(int error) { return error == ENETDOWN || error == ENODEV || error == ENXIO; }

}  // namespace

std::string can_socket_problem(int error) {
  switch (error) {
    case EAFNOSUPPORT:
    case EPROTONOSUPPORT:
      return "this kernel has no CAN sockets; load the modules can and can-raw, or use "
             "--socketcand, which needs no CAN in the kernel";
    case EPERM:
    case EACCES: return "CAN sockets are not allowed for this user";
    default: return fmt::format("no CAN socket: {}", std::strerror(error));
  }
}

RawCanPort::RawCanPort(std::string interface, const RawPortOptions &options)
    : name_{std::move(interface)}, options_{options} {
  if (name_.empty() || name_.size() >= IFNAMSIZ)
    throw InputError(options_.option, 0,
                     in_quotes(name_) + " is no name of an interface; allowed: 1 to 15 characters");
  open_socket();
  try {
    const Interface found = look_at(fd_, name_);
    if (found.index == 0)
      throw InputError(options_.option + " " + name_, 0,
                       fmt::format("there is no such interface; 'ip link add dev {0} type vcan; "
                                   "ip link set {0} up' makes one",
                                   name_));
    if (!found.can) throw InputError(options_.option + " " + name_, 0, "is not a CAN interface");
    if (!found.up)
      throw InputError(options_.option + " " + name_, 0,
                       fmt::format("the interface is down; 'ip link set {} up'", name_));
    look_again();
    if (!up_)
      throw InputError(options_.option + " " + name_, 0,
                       fmt::format("cannot be bound: {}", std::strerror(errno)));
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

RawCanPort::~RawCanPort() { ::close(fd_); }

void RawCanPort::open_socket() {
  fd_ = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd_ < 0) throw InputError(options_.option + " " + name_, 0, can_socket_problem(errno));
  const int off = 0;
  ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, &off, sizeof off);
  if (options_.receives) {
    // Without these the kernel keeps such messages from the socket, and nobody would hear of them.
    const int on = 1;
    const can_err_mask_t all = CAN_ERR_MASK;
    ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on);
    ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &all, sizeof all);
  } else {
    ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0);
  }
  if (::setsockopt(fd_, SOL_SOCKET, SO_RCVBUFFORCE, &kReceiveBuffer, sizeof kReceiveBuffer) != 0)
    ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &kReceiveBuffer, sizeof kReceiveBuffer);
}

// ---- Up and down

void RawCanPort::went_down() {
  up_ = false;
  next_look_ = 0;
}

void RawCanPort::look_again() {
  // An interface that goes away leaves two errors, down and gone; the second may come after the
  // first was read, and is not about the interface that is looked at now.
  int old_error = 0;
  socklen_t size = sizeof old_error;
  ::getsockopt(fd_, SOL_SOCKET, SO_ERROR, &old_error, &size);
  const Interface found = look_at(fd_, name_);
  if (!found.can || !found.up) return;
  if (found.index != index_) {
    // The kernel takes the filter from a socket whose interface goes away.
    const can_filter everything{};
    if (options_.receives)
      ::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_FILTER, &everything, sizeof everything);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = found.index;
    if (::bind(fd_, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0) return;
    index_ = found.index;
  }
  up_ = true;
}

// ---- From the programs

// POLLOUT is of no use: a CAN socket is writable while its interface's queue is full (ENOBUFS), and
// poll() would return at once, again and again. The bridge tries again by time.
void RawCanPort::poll_set(std::vector<pollfd> &set, bool) {
  if (!up_) return;
  const short events = waiting_.size() < options_.queue ? POLLIN : 0;
  set.push_back({fd_, events, 0});
}

void RawCanPort::service(std::span<const pollfd> ready) {
  if (!up_) {
    const WallTime now = steady_now();
    if (now < next_look_) return;
    next_look_ = now + kLookAgain;
    look_again();
    return;
  }
  if (!ready.empty() && (ready.front().revents & (POLLIN | POLLERR)) != 0) read_ahead();
}

void RawCanPort::read_ahead() {
  while (waiting_.size() < options_.queue && read_one()) {
  }
}

bool RawCanPort::read_one() {
  canfd_frame read{};
  const ssize_t got = ::recv(fd_, &read, sizeof read, 0);
  if (got < 0) {
    if (gone_or_down(errno)) went_down();
    return errno == EINTR;
  }
  if (options_.receives && (got == sizeof(can_frame) || got == sizeof read))
    waiting_.push_back(message_of(read, static_cast<std::size_t>(got)));
  return true;
}

std::size_t RawCanPort::remaining() {
  while (up_ && read_one()) {
  }
  return waiting_.size();
}

// The socket's own count is up to date, where SO_RXQ_OVFL tells of a loss only behind all that
// waits.
std::uint64_t RawCanPort::lost() const {
  std::uint32_t info[SK_MEMINFO_VARS] = {};
  socklen_t size = sizeof info;
  if (::getsockopt(fd_, SOL_SOCKET, SO_MEMINFO, info, &size) != 0) return 0;
  return info[SK_MEMINFO_DROPS];
}

std::optional<PortMessage> RawCanPort::take() {
  if (waiting_.empty()) return {};
  PortMessage message;
  message.frame = waiting_.front();
  waiting_.pop_front();
  return message;
}

// ---- To the programs

bool RawCanPort::put(const PortMessage &message) {
  if (!up_) return false;
  ssize_t written = 0;
  do {
    written = ::write(fd_, &message.frame, sizeof message.frame);
  } while (written < 0 && errno == EINTR);
  if (written == sizeof message.frame) return true;
  if (gone_or_down(errno)) went_down();
  return false;
}

}  // namespace vericansim
