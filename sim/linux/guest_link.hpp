// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// GuestLink: the three UNIX sockets between a guest kernel and its simulator, and what is said on
// them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace vericansim {

/// What the guest's glue module asks for (sw/linux/glue/verican_glue.c).
enum class GuestOp : std::uint32_t { kRead = 0, kWrite = 1, kCommand = 2 };

/// A request on the socket `registers`; a command is followed by `size` bytes of text.
struct GuestRequest {
  std::uint32_t op = 0;
  std::uint32_t address = 0;  ///< within the register window
  std::uint32_t value = 0;    ///< to write
  std::uint32_t size = 0;     ///< bytes of the access: 1, 2, 4; or of the text
};

/// The answer; that of a command is followed by `value` bytes of text, which begins with "error:"
/// if the command could not be done.
struct GuestAnswer {
  std::uint32_t value = 0;
  std::uint32_t level = 0;  ///< bit n: interrupt line n is high
};
static_assert(sizeof(GuestRequest) == 16 && sizeof(GuestAnswer) == 8);

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_{fd} {}
  ~Descriptor();
  Descriptor(Descriptor &&other) noexcept;
  Descriptor &operator=(Descriptor &&other) noexcept;
  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// A stream socket on which whole messages go.
class Channel {
 public:
  Channel() = default;
  explicit Channel(Descriptor fd) : fd_{std::move(fd)} {}

  [[nodiscard]] int get() const { return fd_.get(); }
  [[nodiscard]] bool open() const { return fd_.valid(); }
  /// Blocks until `size` bytes are there; false if the peer has closed. Throws std::system_error.
  bool read(void *data, std::size_t size);
  /// Throws std::system_error; a peer that has gone is noticed by the next read().
  void write(const void *data, std::size_t size);

  template <typename Message>
  bool read(Message &message) {
    return read(&message, sizeof message);
  }
  template <typename Message>
  void send(const Message &message) {
    write(&message, sizeof message);
  }

 private:
  Descriptor fd_;
};

/// A listening socket at a path, which is removed again.
class Listener {
 public:
  /// Throws std::system_error, or std::invalid_argument if the path is too long for a socket.
  explicit Listener(std::string path);
  ~Listener();
  Listener(const Listener &) = delete;
  Listener &operator=(const Listener &) = delete;
  [[nodiscard]] Channel accept() const;
  [[nodiscard]] int get() const { return fd_.get(); }

 private:
  std::string path_;
  Descriptor fd_;
};

}  // namespace vericansim
