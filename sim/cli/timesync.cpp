// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican timesync: how well clocks are synchronised over a bus.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "cli/cli.hpp"
#include "cli/output_files.hpp"
#include "cli/timesync_output.hpp"
#include "simulation/stop_request.hpp"
#include "timesync/hardware_follower.hpp"
#include "timesync/sync_page.hpp"
#include "timesync/sync_settings.hpp"
#include "timesync/sync_way.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::cli {
namespace {

struct TimeSyncOptions {
  std::string file;
  std::string how = sync_ways().front().name;
  SyncValues values;  // of options
  bool sweep = false;
  bool p4 = false;
  bool json = false;
  std::string page;
};

/// Refuses a setting where it was given.
[[noreturn]] void refuse_setting(const TimeSyncOptions &options, const std::string &name,
                                 const std::string &why) {
  if (options.values.contains(name)) throw InputError("--" + name, 0, why);
  throw InputError(options.file, 0, name + ": " + why);
}

/// A setting of something that is not there would change nothing but which goal the case has, no
/// bus takes more than all of it, and no core a KD above KI.
void refuse_idle(const TimeSyncOptions &options, const SyncCase &setting) {
  const auto refuse = [&](const std::string &name, const std::string &why) {
    refuse_setting(options, name, why);
  };
  if (setting.hardware && setting.filter != SyncCase{}.filter)
    refuse("filter", "is that of the servo in software; allowed: without hardware");
  if (const FollowerGains gains = gains_of(setting); setting.hardware && gains.ki < gains.kd)
    refuse("interval", fmt::format("at this clock KI is {}, and KD of followers in hardware is {}; "
                                   "allowed: KD up to KI",
                                   gains.ki, gains.kd));
  if (setting.restless && !setting.hardware)
    refuse("restless", "is a setting of followers in hardware; allowed: with hardware");
  if (setting.clocks.sine_period_s != SyncCase{}.clocks.sine_period_s &&
      setting.clocks.sine_ppm == 0)
    refuse("sine-period", "is that of a swing; allowed: with sine above 0");
  if (setting.master_cut && setting.followers < 2)
    refuse("master-cut", "leaves nobody to follow; allowed: with 2 followers or more");
  if (setting.load + setting.load_above > 1 + 1e-9)
    refuse(options.values.contains("load") ? "load" : "load-above",
           fmt::format("load and load-above take {} % of the bus; allowed: 100 % together",
                       plain_number((setting.load + setting.load_above) * 100)));
}

/// Why a setting does not count in what is to be run; nullptr if it does.
using WhyNot = std::function<const char *(const std::string &name)>;

/// A setting that does not count would be taken for one that does.
void refuse_uncounted(const TimeSyncOptions &options, const SyncCase &usual,
                      const SyncValues &values, const WhyNot &why_not) {
  for (const SyncSetting &one : sync_settings()) {
    const auto given = values.find(one.name);
    const char *why = why_not(one.name);
    if (given == values.end() || why == nullptr) continue;
    SyncCase changed = usual;
    one.set(changed, given->second);
    if (!(changed == usual)) refuse_setting(options, one.name, why);
  }
}

/// What is given on the command line takes the place of what the file says. Returns the name.
std::string take_settings(
    const TimeSyncOptions &options, SyncCase &setting,
    const WhyNot &why_not = [](const std::string &) { return nullptr; }) {
  const SyncCase usual = setting;
  SyncValues values;
  const std::string name = options.file.empty() ? "" : read_case(options.file, setting, values);
  for (const SyncSetting &one : sync_settings()) {
    const auto given = options.values.find(one.name);
    if (given != options.values.end() && !one.set(setting, given->second))
      throw InputError("--" + std::string{one.name}, 0,
                       in_quotes(given->second) + " is not allowed; allowed: " + one.allowed);
  }
  for (const auto &[setting_name, value] : options.values) values[setting_name] = value;
  refuse_uncounted(options, usual, values, why_not);
  refuse_idle(options, setting);
  return name;
}

std::unique_ptr<SyncPage> open_page(const TimeSyncOptions &options) {
  std::vector<NamedFile> inputs, outputs;
  add_file(inputs, "the case", options.file);
  add_file(outputs, "--report", options.page);
  claim_files(inputs, outputs);
  return std::make_unique<SyncPage>(options.page);
}

void say_how(const SyncWay &way) { fmt::print("how: {} ({})\n\n", way.name, way.what); }

int exit_code_of(bool ok) { return exit_code_after(ok && !stop_requested() ? kOk : kFailed); }

int run_one(const TimeSyncOptions &options, const SyncWay &way) {
  SyncCase setting;
  const std::string name = take_settings(options, setting);
  SyncOutcome outcome{{name.empty() ? "this case" : name, setting, goal_of(setting)},
                      SyncFigures{}};
  Json runs = Json::array();
  std::unique_ptr<SyncPage> page;
  if (!options.page.empty()) page = open_page(options);
  const bool samples = options.json || page != nullptr;
  outcome.figures = run_case(way, setting, [&](const SyncRun &run) {
    if (samples) runs.push_back(cli::to_json(run));
  });
  Json json = {{"how", way.name}};
  json.update(cli::to_json(outcome));
  json["runs"] = std::move(runs);
  if (page != nullptr) page->write(json, cli::to_text(setting));
  if (options.json) {
    print_json(json);
  } else {
    fmt::print("{}\n", cli::to_text(setting));
    say_how(way);
    print_sync_head();
    print_sync_row(outcome);
    print_sync_foot();
  }
  return exit_code_of(outcome.ok());
}

SyncRow in_sweep(const SyncWay &way, const SyncRow &row) {
  SyncRow result = row;
  result.setting = way.in_sweep(row.setting);
  if (result.setting == row.setting) return result;
  result.name += ", R = 0.1 s";
  result.goal = goal_of(result.setting);
  return result;
}

int run_sweep(const TimeSyncOptions &options, const SyncWay &way) {
  SyncCase base;
  take_settings(options, base, [](const std::string &name) {
    return counts_in_sweep(name) ? nullptr
                                 : "is set by the rows of the sweep; allowed: without sweep";
  });
  if (base.followers < 2)
    refuse_setting(options, "followers",
                   "leaves nobody to follow where the sweep cuts the master; allowed: 2 or more");
  bool ok = true;
  Json tables = Json::array();
  if (!options.json) {
    fmt::print("Base: {}\n", cli::to_text(base));
    say_how(way);
  }
  for (const SyncTable &table : sweep(base)) {
    Json rows = Json::array();
    if (!options.json) {
      fmt::print("{}\n", table.title);
      print_sync_head();
    }
    for (const SyncRow &as_specified : table.rows) {
      if (stop_requested()) break;
      const SyncRow row = in_sweep(way, as_specified);
      if (const char *missing = way.missing(row.setting); missing != nullptr) {
        if (options.json)
          rows.push_back(cli::to_json(row, missing));
        else
          fmt::print("{}: not by this way, which knows no {}\n", row.name, missing);
        continue;
      }
      const SyncOutcome outcome{row, run_case(way, row.setting)};
      ok = ok && outcome.ok();
      if (options.json)
        rows.push_back(cli::to_json(outcome));
      else
        print_sync_row(outcome);
    }
    tables.push_back({{"title", table.title}, {"rows", std::move(rows)}});
    if (!options.json) fmt::print("\n");
  }
  if (options.json)
    print_json({{"how", way.name}, {"ok", ok}, {"tables", std::move(tables)}});
  else
    fmt::print(
        "With wander the oscillator decides: at 1e-7 and R = 1 s no filter helps, only a shorter "
        "R.\n");
  if (!options.json) print_sync_foot();
  return exit_code_of(ok);
}

int run_p4(const TimeSyncOptions &options, const SyncWay &way) {
  SyncCase setting = p4_case();
  take_settings(options, setting,
                [&](const std::string &name) { return missing_in_p4(way, name); });
  const P4Result result = vericansim::run_p4(way, setting);
  if (options.json) {
    Json json = {{"how", way.name}};
    json.update(cli::to_json(result));
    print_json(json);
  } else {
    print_p4(result);
    fmt::print("\n");
    say_how(way);
  }
  return exit_code_of(std::all_of(result.checks.begin(), result.checks.end(),
                                  [](const P4Check &check) { return check.ok; }));
}

int run(const TimeSyncOptions &options) {
  const StopSignals signals;
  const SyncWay &way = sync_way(options.how);
  if (options.sweep) return run_sweep(options, way);
  return options.p4 ? run_p4(options, way) : run_one(options, way);
}

}  // namespace

void add_timesync(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<TimeSyncOptions>();
  CLI::App *command = app.add_subcommand(
      "timesync", "Clocks of a master and its followers, synchronised over the bus: how well");
  command->add_option("case", options->file, "Case file, YAML (docs/timesync.md)");
  std::string ways;
  for (const SyncWay &way : sync_ways()) ways += (ways.empty() ? "" : ", ") + std::string{way.name};
  command->add_option("--how", options->how, "Way to run it: " + ways + " (" + options->how + ")");
  for (const SyncSetting &one : sync_settings()) {
    const std::string name = one.name;
    if (one.is_flag)
      command->add_flag_callback(
          "--" + name, [options, name] { options->values[name] = "true"; }, one.help);
    else
      command->add_option_function<std::string>(
          "--" + name, [options, name](const std::string &value) { options->values[name] = value; },
          one.help);
  }
  auto *sweep = command->add_flag("--sweep", options->sweep,
                                  "All cases of the specification, then one axis after the other");
  auto *p4 =
      command
          ->add_flag(
              "--p4", options->p4,
              "The published experiment (Park, Kim, Lee 2014), and the same clocks with the servo")
          ->excludes(sweep);
  command
      ->add_option("--report,--report-page", options->page,
                   "A page of a single case, HTML (docs/timesync.md)")
      ->excludes(sweep)
      ->excludes(p4);
  command->add_flag("--json", options->json, "Results as JSON, with all samples of a single case");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli
