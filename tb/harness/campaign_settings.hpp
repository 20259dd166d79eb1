// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What the programs of a campaign's stages share: settings from tools/campaign.py, options,
// figures, the file of the result. tb/campaign_settings.py is the same for programs in Python.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "trace/input_error.hpp"

namespace vericansim {

/// The values that a setting may have, in the environment as on the command line.
template <typename Value>
class Allowed {
 public:
  /// `above`: `least` itself is not one of them.
  constexpr Allowed(Value least, Value most, bool above = false)
      : least_{least}, most_{most}, above_{above} {}

  [[nodiscard]] constexpr Value most() const { return most_; }
  /// Such as "1 to 64".
  [[nodiscard]] std::string text() const {
    return above_ ? fmt::format("above {}, at most {}", least_, most_)
                  : fmt::format("{} to {}", least_, most_);
  }
  /// Nothing if the whole of `text` is not such a number.
  [[nodiscard]] std::optional<Value> read(const std::string &text) const {
    Value value{};
    const char *end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool enough = above_ ? value > least_ : value >= least_;
    if (error != std::errc{} || stop != end || !enough || !(value <= most_)) return {};
    return value;
  }
  /// A check of an option.
  [[nodiscard]] CLI::Validator check() const {
    const auto refusal = [*this](std::string &given) {
      const auto value = read(given);
      if (!value) return in_quotes(given) + " is not allowed; allowed: " + text();
      given = fmt::format("{}", *value);  // a leading 0 would make it an octal number
      return std::string{};
    };
    return {refusal, text()};
  }

 private:
  Value least_, most_;
  bool above_;
};

inline constexpr Allowed<std::uint64_t> kSeeds{0, std::numeric_limits<std::int64_t>::max()};
inline constexpr Allowed<double> kScales{0, 1, true};
inline constexpr Allowed<unsigned> kJobs{1, 64};
/// How many cases, frames or runs a program may be asked for.
inline constexpr Allowed<std::uint64_t> kAmounts{1, 1'000'000'000'000};

/// A variable of the environment; `otherwise` if there is none or it is empty.
inline std::string campaign_variable(const char *name, const std::string &otherwise) {
  const char *text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
  return text == nullptr || *text == 0 ? otherwise : text;
}

/// The same for a number. Throws std::runtime_error with variable, value and what is allowed.
template <typename Value>
Value campaign_variable(const char *name, Value otherwise, const Allowed<Value> &allowed) {
  const std::string text = campaign_variable(name, "");
  if (text.empty()) return otherwise;
  if (const auto value = allowed.read(text)) return *value;
  throw std::runtime_error(
      fmt::format("{} is {}; allowed: {}", name, in_quotes(text), allowed.text()));
}

/// Settings of a stage; by default what the environment of tools/campaign.py says. Throws
/// std::runtime_error if a variable has a value that is not allowed.
struct CampaignSettings {
  std::uint64_t seed = campaign_variable<std::uint64_t>("CAMPAIGN_SEED", 1, kSeeds);
  double scale = campaign_variable("CAMPAIGN_SCALE", 1.0, kScales);
  unsigned jobs = campaign_variable("CAMPAIGN_JOBS", 2U, kJobs);
  std::string directory = campaign_variable("CAMPAIGN_DIR", ".");
  std::string json = campaign_variable("CAMPAIGN_OUT", "");

  /// Seed, scale, jobs and the result's file. `part`: what --scale is a part of; `result`: how the
  /// option of the file is called.
  void add_to(CLI::App &app, const std::string &part, const char *result = "--json") {
    app.add_option("--seed", seed, "Seed; else CAMPAIGN_SEED")
        ->check(kSeeds.check())
        ->capture_default_str();
    app.add_option("--scale", scale, "Part of " + part + "; else CAMPAIGN_SCALE")
        ->check(kScales.check())
        ->capture_default_str();
    add_jobs_to(app, jobs);
    app.add_option(result, json, "File for the result; else CAMPAIGN_OUT");
  }
  /// The option of the threads or processes of a program.
  static void add_jobs_to(CLI::App &app, unsigned &jobs) {
    app.add_option("--jobs", jobs, "How many at a time; else CAMPAIGN_JOBS")
        ->check(kJobs.check())
        ->capture_default_str();
  }
};

/// Reads the command line. The program's exit code if it ends here: 0 behind --help, 2 behind the
/// message about an option that is not allowed.
inline std::optional<int> read_options(CLI::App &app, int argc, char **argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return {};
}

/// A figure as tools/campaign.py reads it; without a bar: no verdict.
inline nlohmann::ordered_json campaign_figure(const char *name, const nlohmann::ordered_json &value,
                                              const nlohmann::ordered_json &bar = nullptr,
                                              const nlohmann::ordered_json &ok = nullptr) {
  return {{"name", name}, {"value", value}, {"bar", bar}, {"ok", ok}};
}

inline void print_figure(const nlohmann::ordered_json &figure) {
  fmt::print("{}: {}\n", figure["name"].get<std::string>(), figure["value"].dump());
}

inline void print_notes(const nlohmann::ordered_json &result) {
  for (const auto &note : result["notes"]) fmt::print("{}\n", note.get<std::string>());
}

inline void print_result(const nlohmann::ordered_json &result) {
  for (const auto &figure : result["figures"]) print_figure(figure);
  print_notes(result);
}

/// Whether no figure misses its bar.
inline bool bars_hold(const nlohmann::ordered_json &result) {
  const auto &figures = result["figures"];
  return std::none_of(figures.begin(), figures.end(),
                      [](const auto &figure) { return figure["ok"] == false; });
}

/// Before the work whose result goes to `path`: throws std::runtime_error if no file can be written
/// there. What is there stays as it is. "": there is no such file.
inline void check_writable(const std::string &path) {
  if (path.empty()) return;
  const bool there = std::filesystem::exists(std::filesystem::symlink_status(path));
  if (!std::ofstream{path, std::ios::app}) throw std::runtime_error("cannot write '" + path + "'");
  if (!there) std::filesystem::remove(path);
}

/// Writes `text` to `path`, nothing if that is "". Throws std::runtime_error if it cannot be
/// written.
inline void write_result(const std::string &path, const std::string &text) {
  if (path.empty()) return;
  std::ofstream file{path};
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "'");
}

/// work(n) for each n below `count`, on `jobs` threads.
template <typename Work>
void run_jobs(std::size_t count, unsigned jobs, const Work &work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  for (unsigned job = 0; job < jobs; ++job)
    threads.emplace_back([&] {
      for (std::size_t n = next++; n < count; n = next++) work(n);
    });
  for (std::thread &thread : threads) thread.join();
}

}  // namespace vericansim
