// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Database: the messages and signals of DBC files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/frame.hpp"

namespace vericansim {

/// When a multiplexed signal is there: while the raw value of another one is in a range.
struct SignalSelection {
  std::size_t multiplexer = 0;                                  ///< index in the message
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;  ///< inclusive
};

/// A number in some bits of a message.
struct Signal {
  std::string name;
  std::string unit;
  unsigned start = 0;   ///< bit of the DBC file: the least significant one of a little-endian
                        ///< signal, the most significant one of a big-endian one; 8 * byte + weight
  unsigned length = 1;  ///< 1..64 bits
  bool little_endian = true;
  bool is_signed = false;
  bool is_float = false;          ///< IEEE 754, 32 or 64 bits
  double factor = 1, offset = 0;  ///< physical value = raw value * factor + offset
  int decimals = 0;               ///< of a physical value, as factor and offset have them
  double minimum = -std::numeric_limits<double>::infinity();  ///< physical, if the file has limits
  double maximum = std::numeric_limits<double>::infinity();
  double start_value = 0;                                     ///< raw, of a signal that nobody sets
  std::vector<std::pair<std::int64_t, std::string>> choices;  ///< texts for raw values
  std::optional<SignalSelection> selection;                   ///< none: always there
};

/// A frame's content.
struct SignalMessage {
  std::string name;
  std::uint32_t id = 0;
  bool extended = false;
  bool j1939 = false;   ///< stands for its parameter group, whatever priority and addresses
  unsigned length = 8;  ///< bytes; more than 8 in CAN FD and in transport protocols
  std::vector<Signal> signals;
  std::string file;  ///< of the database

  /// The signal of that name, or nullptr.
  [[nodiscard]] const Signal *find(std::string_view signal) const;
};

/// A file that was read.
struct DatabaseFile {
  std::string path;
  std::string text;  ///< UTF-8
};

/// The parameter group of an extended identifier of J1939: without priority and source address and,
/// where bits 16 to 23 are below 240, without the destination address.
[[nodiscard]] std::uint32_t parameter_group(std::uint32_t id);

/// All messages of one or more files. A copy has the same messages in memory.
class Database {
 public:
  /// Reads a DBC file and adds its messages. Throws InputError: the file cannot be read or used, or
  /// an identifier has a message already.
  void add_file(const std::string &path);
  /// The same for `text`, as if it stood in the file `path`.
  void add_text(const std::string &path, const std::string &text);

  /// The message of a frame with this identifier, or nullptr: the one with exactly this identifier,
  /// else, of those of its J1939 parameter group, one of the same source address if there is any.
  [[nodiscard]] const SignalMessage *find(std::uint32_t id, bool extended) const;
  /// The messages of that name; databases of several files may have more than one.
  [[nodiscard]] std::vector<const SignalMessage *> named(std::string_view name) const;

  [[nodiscard]] const std::vector<std::shared_ptr<const SignalMessage>> &messages() const {
    return messages_;
  }
  [[nodiscard]] const std::vector<DatabaseFile> &files() const { return files_; }

 private:
  void add(SignalMessage message);

  std::vector<DatabaseFile> files_;
  std::vector<std::shared_ptr<const SignalMessage>> messages_;
  std::unordered_map<std::uint32_t, const SignalMessage *> by_id_;  // bit 31: extended
  std::unordered_map<std::uint32_t, std::vector<const SignalMessage *>> by_group_;
};

/// `database` (nullptr: an empty one) and these files; `database` itself if there is no file.
/// Throws as Database::add_file().
[[nodiscard]] std::shared_ptr<const Database> with_files(std::shared_ptr<const Database> database,
                                                         const std::vector<std::string> &paths);

}  // namespace vericansim
