// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Semihosting: see semihosting.hpp.
#include "firmware/semihosting.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "firmware/memory_map.hpp"

namespace vericansim::firmware {
namespace {

enum Operation : std::uint32_t {
  kOpen = 0x01,
  kClose = 0x02,
  kWriteC = 0x03,
  kWrite0 = 0x04,
  kWrite = 0x05,
  kRead = 0x06,
  kReadC = 0x07,
  kIsError = 0x08,
  kIsTty = 0x09,
  kSeek = 0x0A,
  kLength = 0x0C,
  kClock = 0x10,
  kTime = 0x11,
  kErrno = 0x13,
  kExit = 0x18,
  kExitExtended = 0x20,
  kElapsed = 0x30,
  kTickFrequency = 0x31,
};

constexpr std::uint32_t kError = 0xFFFF'FFFF;
constexpr std::uint32_t kApplicationExit = 0x2'0026;  // ADP_Stopped_ApplicationExit
constexpr std::uint32_t kConsole = 1, kFeatures = 2;  // handles of ":tt", ":semihosting-features"
/// The file of features: its magic number, SH_EXT_EXIT_EXTENDED and SH_EXT_STDOUT_STDERR.
constexpr std::array<std::uint8_t, 5> kFeatureBytes{'S', 'H', 'F', 'B', 3};
constexpr std::uint32_t kMicrosecondsPerSecond = 1'000'000;

/// A pointer of the firmware leads nowhere.
struct BadPointer : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace

std::uint32_t Semihosting::word(std::uint32_t address, unsigned index) const {
  const auto value = engine_->read(address + 4 * index, 4);
  if (!value) throw BadPointer("no parameter block at " + hex32(address));
  return *value;
}

// `length` bytes, or up to a zero byte.
std::string Semihosting::text_at(std::uint32_t address, std::optional<std::uint32_t> length) const {
  std::string text;
  for (std::uint32_t at = address; !length || at - address < *length; ++at) {
    const auto byte = engine_->read(at, 1);
    if (!byte) throw BadPointer("text at " + hex32(address) + " reaches beyond the memory");
    if (!length && *byte == 0) break;
    text += static_cast<char>(*byte);
  }
  return text;
}

std::uint32_t Semihosting::open(std::uint32_t block) {
  constexpr std::uint32_t kReadBinary = 1;  // and below: to be read
  const std::string name = text_at(word(block, 0), word(block, 2));
  if (name == ":tt") return kConsole;
  if (name != ":semihosting-features" || word(block, 1) > kReadBinary) return kError;
  position_ = 0;
  return kFeatures;
}

// Result: bytes that were not read.
std::uint32_t Semihosting::read(std::uint32_t block) {
  const std::uint32_t to = word(block, 1), wanted = word(block, 2);
  if (word(block, 0) != kFeatures) return wanted;
  const auto left = static_cast<std::uint32_t>(kFeatureBytes.size()) - position_;
  const std::uint32_t length = std::min(wanted, left);
  for (std::uint32_t i = 0; i < length; ++i)
    if (!engine_->write(to + i, 1, kFeatureBytes[position_ + i]))
      throw BadPointer("no memory for what is read at " + hex32(to));
  position_ += length;
  return wanted - length;
}

std::uint32_t Semihosting::seek(std::uint32_t block) {
  const std::uint32_t to = word(block, 1);
  if (word(block, 0) != kFeatures || to > kFeatureBytes.size()) return kError;
  position_ = to;
  return 0;
}

std::uint32_t Semihosting::length(std::uint32_t block) const {
  return word(block, 0) == kFeatures ? static_cast<std::uint32_t>(kFeatureBytes.size()) : kError;
}

// Result: bytes that were not written.
std::uint32_t Semihosting::write(std::uint32_t block) {
  const std::uint32_t length = word(block, 2);
  if (word(block, 0) == 0 || word(block, 0) == kFeatures) return length;
  on_output(text_at(word(block, 1), length));
  return 0;
}

std::uint32_t Semihosting::elapsed(std::uint32_t block) {
  const std::uint64_t ticks = microseconds();
  const bool low = engine_->write(block, 4, static_cast<std::uint32_t>(ticks));
  const bool high = engine_->write(block + 4, 4, static_cast<std::uint32_t>(ticks >> 32));
  if (!low || !high) throw BadPointer("no memory for the ticks at " + hex32(block));
  return 0;
}

void Semihosting::exit(std::uint32_t reason, std::uint32_t code) {
  exit_code_ = reason == kApplicationExit ? static_cast<int>(code) : 1;
}

std::uint32_t Semihosting::call(std::uint32_t operation, std::uint32_t parameter) {
  switch (operation) {
    case kOpen: return open(parameter);
    case kClose: return 0;
    case kWriteC: on_output(text_at(parameter, 1)); return 0;
    case kWrite0: on_output(text_at(parameter, std::nullopt)); return 0;
    case kWrite: return write(parameter);
    case kRead: return read(parameter);
    case kIsError: return static_cast<std::int32_t>(word(parameter, 0)) < 0 ? 1 : 0;
    case kIsTty: return word(parameter, 0) == kFeatures ? 0 : 1;
    case kSeek: return seek(parameter);
    case kLength: return length(parameter);
    case kClock: return static_cast<std::uint32_t>(microseconds() / 10'000);
    case kTime: return static_cast<std::uint32_t>(microseconds() / kMicrosecondsPerSecond);
    case kExit: exit(parameter, 0); return 0;
    case kExitExtended: exit(word(parameter, 0), word(parameter, 1)); return 0;
    case kElapsed: return elapsed(parameter);
    case kTickFrequency: return kMicrosecondsPerSecond;
    case kErrno: return 0;
    case kReadC:
    default: return kError;
  }
}

std::optional<std::string> Semihosting::serve(Engine &engine) {
  engine_ = &engine;
  try {
    engine.set_reg(0, call(engine.reg(0), engine.reg(1)));
  } catch (const BadPointer &error) {
    return error.what();
  }
  return {};
}

}  // namespace vericansim::firmware
