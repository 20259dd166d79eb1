// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Numbers are taken whole or not at all.
#include "socketcand_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "trace/input_error.hpp"

namespace vericansim {
namespace {

/// Up to a million seconds in an interval, so that sums stay within Time.
constexpr std::uint64_t kLongestSeconds = 1'000'000;
constexpr std::uint64_t kLongestMicroseconds = 1'000'000'000;

/// Cuts the first word off.
std::string_view cut_word(std::string_view &text) {
  const auto end = std::min(text.find(' '), text.size());
  const auto word = text.substr(0, end);
  text.remove_prefix(std::min(text.find_first_not_of(' ', end), text.size()));
  return word;
}

template <typename Number>
std::optional<Number> whole_number(std::string_view word, int base, Number largest) {
  Number number = 0;
  const auto *last = word.data() + word.size();
  const auto [end, failure] = std::from_chars(word.data(), last, number, base);
  if (failure != std::errc{} || end != last || number > largest) return std::nullopt;
  return number;
}

std::string id_text(canid_t id) {
  return (id & CAN_EFF_FLAG) != 0 ? fmt::format("{:08X}", id & CAN_EFF_MASK)
                                  : fmt::format("{:03X}", id & CAN_SFF_MASK);
}

std::string time_text(Time time) {
  return fmt::format("{}.{:06}", time / kSecond, time % kSecond / kMicrosecond);
}

}  // namespace

CommandWords::CommandWords(std::string_view command) : rest_{command} {
  rest_.remove_suffix(rest_.size() - (rest_.find_last_not_of(' ') + 1));
  rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
  name_ = cut_word(rest_);
}

CommandError CommandWords::error(const std::string &text) const {
  return CommandError(std::string(name_) + ": " + text);
}

std::string_view CommandWords::next(std::string_view what) {
  if (rest_.empty()) throw error(std::string(what) + " is missing");
  return cut_word(rest_);
}

std::uint64_t CommandWords::decimal(std::string_view what, std::uint64_t largest) {
  const auto word = next(what);
  const auto number = whole_number<std::uint64_t>(word, 10, largest);
  if (!number)
    throw error(fmt::format("{} {} is not allowed; allowed: a decimal number, 0 to {}", what,
                            in_quotes(std::string(word)), largest));
  return *number;
}

std::uint32_t CommandWords::hex(std::string_view what, std::uint32_t largest) {
  const auto word = next(what);
  const auto number = whole_number<std::uint32_t>(word, 16, largest);
  if (!number)
    throw error(fmt::format("{} {} is not allowed; allowed: a hexadecimal number, 0 to {:X}", what,
                            in_quotes(std::string(word)), largest));
  return *number;
}

canid_t CommandWords::id() {
  const auto word = next("identifier");
  const auto number =
      whole_number<canid_t>(word, 16, word.size() > 3 ? CAN_EFF_MASK : CAN_SFF_MASK);
  if (!number || word.size() > 8)
    throw error("identifier " + in_quotes(std::string(word)) +
                " is not allowed; allowed: 000 to 7FF, or 8 digits, 00000000 to 1FFFFFFF");
  const bool extended = word.size() == 8 || *number > CAN_SFF_MASK;
  return extended ? *number | CAN_EFF_FLAG : *number;
}

void CommandWords::data(can_frame &frame) {
  frame.len = static_cast<__u8>(hex("DLC", CAN_MAX_DLEN));
  for (unsigned i = 0; i < frame.len; ++i)
    frame.data[i] = static_cast<__u8>(hex("data byte " + std::to_string(i + 1), 0xFF));
  end();
}

Time CommandWords::interval() {
  const auto seconds = decimal("seconds", kLongestSeconds);
  const auto microseconds = decimal("microseconds", kLongestMicroseconds);
  return static_cast<Time>(seconds) * kSecond + static_cast<Time>(microseconds) * kMicrosecond;
}

void CommandWords::end() {
  if (more()) throw error("nothing may follow, got " + in_quotes(std::string(rest_)));
}

can_frame send_frame(CommandWords &words) {
  can_frame frame{};
  frame.can_id = words.id();
  CommandWords ahead = words;
  ahead.next("DLC");
  if (ahead.more()) {
    words.data(frame);
    return frame;
  }
  frame.len = static_cast<__u8>(words.hex("DLC", CAN_MAX_DLEN));
  if (frame.len != 0) frame.can_id |= CAN_RTR_FLAG;
  return frame;
}

can_frame remote_frame(CommandWords &words) {
  can_frame frame{};
  frame.can_id = words.id() | CAN_RTR_FLAG;
  frame.len = static_cast<__u8>(words.hex("DLC", CAN_MAX_DLEN));
  words.end();
  return frame;
}

std::string message_text(const PortMessage &message, std::string_view separator) {
  const can_frame &frame = message.frame;
  const auto time = time_text(message.time);
  if ((frame.can_id & CAN_RTR_FLAG) != 0 && (frame.can_id & CAN_ERR_FLAG) == 0)
    return fmt::format("\n< rtr {} {} {} >", id_text(frame.can_id), time, frame.len);
  const std::size_t length = std::min<std::size_t>(frame.len, CAN_MAX_DLEN);
  const auto data = fmt::format("{:02X}", fmt::join(frame.data, frame.data + length, separator));
  if ((frame.can_id & CAN_ERR_FLAG) != 0)
    return fmt::format("\n< error {:08X} {} {} >", frame.can_id, time, data);
  return fmt::format("\n< frame {} {} {} >", id_text(frame.can_id), time, data);
}

std::string error_text(std::string text) {
  std::replace(text.begin(), text.end(), '<', '(');
  std::replace(text.begin(), text.end(), '>', ')');
  return "< error " + text + " >";
}

}  // namespace vericansim
