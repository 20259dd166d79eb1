// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// See parse_mistake.hpp.
#include "cli/parse_mistake.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string_view>

#include "cli/option_message.hpp"
#include "trace/input_error.hpp"

namespace vericansim::cli {
namespace {

void add_name(std::string &names, const std::string &name) {
  names += (names.empty() ? "" : ", ") + name;
}

/// What is said of a command in front of the message; nothing of the tool itself.
std::string prefix(const CLI::App &app) {
  return app.get_parent() == nullptr ? "" : app.get_name() + ": ";
}

/// "verican memory read"
std::string words_of(const CLI::App &app) {
  return app.get_parent() == nullptr ? "verican"
                                     : words_of(*app.get_parent()) + " " + app.get_name();
}

/// The command that was parsed last.
const CLI::App &innermost(const CLI::App &app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : innermost(*commands.back());
}

/// Why `word` is no command of `app`; nothing if it is one.
std::optional<std::string> no_command(const CLI::App &app, const std::string &word) {
  std::string names;
  for (const CLI::App *command : app.get_subcommands({})) {
    if (command->get_name() == word) return std::nullopt;
    add_name(names, command->get_name());
  }
  return prefix(app) + in_quotes(word) + " is no command; allowed: " + names;
}

/// Why `word` is no option of `app`; nothing if it does not look like one.
std::optional<std::string> no_option(const CLI::App &app, const std::string &word) {
  constexpr std::string_view kDigits = "0123456789.";
  if (word.size() < 2 || word[0] != '-' || kDigits.find(word[1]) != std::string_view::npos)
    return std::nullopt;
  std::string names;
  for (const CLI::App *command = &app; command != nullptr;
       command = command->get_fallthrough() ? command->get_parent() : nullptr)
    for (const CLI::Option *option : command->get_options())
      if (const std::string name = option->get_name();
          name.starts_with('-') && (command == &app || name != "--help"))
        add_name(names, name);
  return prefix(app) + in_quotes(word.substr(0, word.find('='))) +
         " is no option; allowed: " + names;
}

/// CLI11 names all words that are left over, the last one first.
std::optional<std::string> left_over(const CLI::App &app) {
  for (const CLI::App *command = &innermost(app); command != nullptr;
       command = command->get_parent()) {
    const std::vector<std::string> words = command->remaining();
    if (words.empty()) continue;
    if (!command->get_subcommands({}).empty() && command->get_subcommands().empty())
      if (auto why = no_command(*command, words.front())) return why;
    const bool of_tool = command->get_parent() == nullptr;
    if (auto why = no_option(of_tool ? *command : innermost(app), words.front())) return why;
  }
  return std::nullopt;
}

}  // namespace

void refuse_empty(int argc, char **argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view text = argv[i];
    if (text.empty())
      throw InputError(i == 1 ? "COMMAND" : argv[i - 1], 0,
                       i == 1 ? "is empty; allowed: its name, as in 'verican run'"
                              : "an empty value follows; allowed: a value, or none at all");
    if (text.starts_with("--") && text.ends_with('='))
      throw InputError(argv[i], 0, "has an empty value; allowed: a value, or none at all");
  }
}

void refuse_unknown_command(const CLI::App &app, int argc, char **argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  if (const auto why = no_command(app, argv[1])) throw std::invalid_argument(*why);
}

std::string parse_mistake(const CLI::App &app, const CLI::ParseError &error, int argc,
                          char **argv) {
  if (const auto why = left_over(app)) return *why;
  return fmt::format("{}; try '{} --help'", option_message(error.what(), argc, argv),
                     words_of(innermost(app)));
}

}  // namespace vericansim::cli
