// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the tests of signals share: databases of the tests, frames from bytes.
#pragma once

#include <initializer_list>
#include <map>
#include <string>

#include "signals/database.hpp"
#include "signals/signal_codec.hpp"
#include "signals/signal_text.hpp"

namespace vericansim {

/// features.dbc of this folder, read once.
inline const Database &features() {
  static const Database database = [] {
    Database read;
    read.add_file("tb/signals/features.dbc");
    return read;
  }();
  return database;
}

/// A message of features.dbc by its name.
inline const SignalMessage &message(const std::string &name) {
  return *features().named(name).at(0);
}

inline Frame frame_of(std::initializer_list<unsigned> bytes) {
  Frame frame;
  for (const unsigned byte : bytes) frame.data[frame.dlc++] = static_cast<std::uint8_t>(byte);
  return frame;
}

/// Names and texts of the values in a frame of the message.
inline std::map<std::string, std::string> texts_in(const std::string &name, const Frame &frame) {
  std::map<std::string, std::string> texts;
  for (const SignalValue &value : decode(message(name), frame))
    texts[value.signal->name] = to_text(value);
  return texts;
}

}  // namespace vericansim
