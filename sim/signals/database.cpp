// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Database: messages by identifier, parameter group and name.
#include "signals/database.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "signals/database_json.hpp"
#include "trace/input_error.hpp"
#include "trace/input_file.hpp"
#include "trace/log.hpp"
#include "trace/python_helper.hpp"

namespace vericansim {
namespace {

constexpr std::uint32_t kExtendedFlag = 0x80000000;

std::uint32_t key_of(std::uint32_t id, bool extended) { return extended ? id | kExtendedFlag : id; }

}  // namespace

const Signal *SignalMessage::find(std::string_view signal) const {
  const auto found = std::find_if(signals.begin(), signals.end(),
                                  [&](const Signal &s) { return s.name == signal; });
  return found == signals.end() ? nullptr : &*found;
}

std::uint32_t parameter_group(std::uint32_t id) {
  constexpr std::uint32_t kBroadcastFormats = 240;  // from here on bits 8 to 15 belong to the group
  const bool has_destination = ((id >> 16) & 0xFF) < kBroadcastFormats;
  return (id >> 8) & (has_destination ? 0x3FF00U : 0x3FFFFU);
}

void Database::add_file(const std::string &path) {
  add_text(path, read_text_file(path, kMostWritten));
}

void Database::add_text(const std::string &path, const std::string &text) {
  refuse_utf16(text, path);
  const std::string json = run_python({"dbc_to_json.py", {}, text, path});
  DatabaseContent content = parse_database_json(path, json);
  for (SignalMessage &message : content.messages) add(std::move(message));
  if (content.text.empty()) content.text = text;
  files_.push_back({path, std::move(content.text)});
}

void Database::add(SignalMessage message) {
  const std::uint32_t key = key_of(message.id, message.extended);
  const auto [place, is_new] = by_id_.try_emplace(key, nullptr);
  if (!is_new)
    throw InputError(message.file, 0,
                     fmt::format("message {} has the identifier {:0{}X} of {} in {}; allowed: one "
                                 "message for an identifier",
                                 message.name, message.id, message.extended ? 8 : 3,
                                 place->second->name, place->second->file));
  messages_.push_back(std::make_shared<const SignalMessage>(std::move(message)));
  const SignalMessage *added = messages_.back().get();
  place->second = added;
  if (added->j1939) by_group_[parameter_group(added->id)].push_back(added);
}

const SignalMessage *Database::find(std::uint32_t id, bool extended) const {
  if (const auto exact = by_id_.find(key_of(id, extended)); exact != by_id_.end())
    return exact->second;
  if (!extended) return nullptr;
  const auto group = by_group_.find(parameter_group(id));
  if (group == by_group_.end()) return nullptr;
  const auto &members = group->second;
  const auto same_source =
      std::find_if(members.begin(), members.end(),
                   [&](const SignalMessage *m) { return (m->id & 0xFF) == (id & 0xFF); });
  return same_source == members.end() ? members.front() : *same_source;
}

std::vector<const SignalMessage *> Database::named(std::string_view name) const {
  std::vector<const SignalMessage *> found;
  for (const auto &message : messages_)
    if (message->name == name) found.push_back(message.get());
  return found;
}

std::shared_ptr<const Database> with_files(std::shared_ptr<const Database> database,
                                           const std::vector<std::string> &paths) {
  if (paths.empty()) return database;
  auto larger = database ? std::make_shared<Database>(*database) : std::make_shared<Database>();
  for (const std::string &path : paths) larger->add_file(path);
  return larger;
}

}  // namespace vericansim
