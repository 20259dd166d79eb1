// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican bittime: clock and bit rate to register settings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "cli/cli.hpp"
#include "cli/print_error.hpp"
#include "cli/rate_option.hpp"
#include "timing/bittime.hpp"
#include "timing/rate_table.hpp"
#include "trace/input_error.hpp"
#include "trace/quantity.hpp"

namespace vericansim::cli {
namespace {

struct BitTimeOptions {
  BitTimingRequest request;
  double clock = 8e6;
  double bitrate = 0;
  std::optional<double> sample_point;  // per cent or part of one; none: recommended
  unsigned sjw = 0;
  unsigned rows = 10;
  bool json = false;
  bool table = false;
};

Json to_json(const BitTimingResult &result) {
  const BitTiming &t = result.timing;
  return {
      {"brp", t.prescaler},
      {"prop", t.prop},
      {"ps1", t.ps1},
      {"ps2", t.ps2},
      {"sjw", t.sjw},
      {"quanta", t.quanta()},
      {"bitrate", result.bitrate},
      {"rate_error_ppm", result.rate_error_ppm},
      {"rate_fits", result.rate_fits()},
      {"sample_point", result.sample_point},
      {"oscillator_tolerance_percent", result.oscillator_tolerance * 100},
      {"cable_m", result.cable_m},
      {"crystal_cable_m", result.crystal_cable_m ? Json(*result.crystal_cable_m) : Json(nullptr)},
      {"ctrl", fmt::format("0x{:08X}", t.ctrl_fields())}};
}

/// A number that is promised is not rounded up.
double cut(double value, double unit) { return std::floor(value / unit * (1 + 1e-12)) * unit; }

void print_table(const BitTimingRequest &request, const std::vector<BitTimingResult> &results,
                 unsigned rows) {
  fmt::print("{} Hz, {} bit/s, {} m of cable; delays: transceiver {} ns, controller {} ns\n\n",
             request.clock_hz, request.bitrate, plain_number(request.cable_m),
             plain_number(request.node_delay_ns),
             plain_number(results.front().controller_delay_ns));
  fmt::print("{:>4} {:>4} {:>4} {:>4} {:>4} {:>4} {:>7} {:>11} {:>9} {:>9} {:>8} {:>8}  {}\n",
             "BRP", "PROP", "PS1", "PS2", "SJW", "tq", "sample", "bit/s", "error", "clock", "cable",
             plain_number(request.clock_error_ppm) + " ppm", "CTRL");
  for (std::size_t i = 0; i < results.size() && i < rows; ++i) {
    const BitTimingResult &r = results[i];
    const BitTiming &t = r.timing;
    fmt::print(
        "{:>4} {:>4} {:>4} {:>4} {:>4} {:>4} {:>5.1f} % {:>11.1f} {:>5.0f} ppm {:>7.3f} % {:>6.0f} "
        "m {:>8}  0x{:08X}{}\n",
        t.prescaler, t.prop, t.ps1, t.ps2, t.sjw, t.quanta(), r.sample_point * 100, r.bitrate,
        r.rate_error_ppm, cut(r.oscillator_tolerance * 100, 0.001), cut(r.cable_m, 1),
        r.crystal_cable_m ? fmt::format("{:.0f} m", cut(*r.crystal_cable_m, 1)) : "-",
        t.ctrl_fields(), r.rate_fits() ? "" : "  rate is off by more than clock");
  }
  if (results.size() > rows) fmt::print("... and {} more (--rows)\n", results.size() - rows);
  fmt::print(
      "\nclock: largest error of each node's clock, that of the bit rate included (BT-08);\n"
      "cable: longest at 5 ns/m that goes with it (BT-07); {:g} ppm: with clocks of that error.\n",
      request.clock_error_ppm);
}

/// Why there is nothing to show.
void explain_nothing(const BitTimingRequest &request, bool found) {
  if (found)
    print_error(
        "verican: {} m of cable and the delays of the nodes ({} ns a transceiver, {} ns a "
        "controller) are too long for {} bit/s from {} Hz\n",
        plain_number(request.cable_m), plain_number(request.node_delay_ns),
        plain_number(request.controller_delay_ns.value_or(core_delay_ns(request.clock_hz))),
        request.bitrate, request.clock_hz);
  else
    print_error("verican: no setting of 8 to 25 quanta gives {} bit/s within {} ppm from {} Hz\n",
                request.bitrate, plain_number(request.max_rate_error_ppm), request.clock_hz);
}

void warn_of_rate(const BitTimingRequest &request, const BitTimingResult &best) {
  if (best.rate_fits()) return;
  print_error(
      "verican: warning: the nearest rate is off by {:+.0f} ppm, and a node's clock may be by "
      "{:.0f}: no bus with nodes at {} bit/s\n",
      best.rate_error_ppm, best.oscillator_tolerance * 1e6, request.bitrate);
}

Json to_json(const BitTimingRequest &request, const std::vector<BitTimingResult> &results) {
  Json list = Json::array();
  for (const auto &result : results) list.push_back(to_json(result));
  return {{"clock_hz", request.clock_hz},
          {"bitrate", request.bitrate},
          {"cable_m", request.cable_m},
          {"node_delay_ns", request.node_delay_ns},
          {"clock_error_ppm", request.clock_error_ppm},
          {"controller_delay_ns",
           request.controller_delay_ns.value_or(core_delay_ns(request.clock_hz))},
          {"settings", list}};
}

/// A part of one as it is, per cent as a part.
double part_of_bit(double given) {
  constexpr double kLeast = 50, kMost = 90;  // per cent
  if (given <= 1) return given;
  if (given >= kLeast && given <= kMost) return given / 100;
  throw std::invalid_argument(
      fmt::format("sample point {} % is out of range; allowed: 50 to 90 %, or 0.5 to 0.9",
                  plain_number(given)));
}

Json to_json(const std::vector<RateRow> &rows) {
  Json list = Json::array();
  for (const RateRow &row : rows) {
    const BitTiming &t = row.timing;
    list.push_back({{"bitrate", row.bitrate},
                    {"brp", t.prescaler},
                    {"prop", t.prop},
                    {"ps1", t.ps1},
                    {"ps2", t.ps2},
                    {"sjw", t.sjw}});
  }
  return list;
}

/// can_remote counts a millisecond by its parameter ClocksPerMs, which bounds its clock.
void check_remote_clock(double hz) {
  constexpr double kLeastPerMs = 8000, kMostPerMs = 131071;
  if (hz >= kLeastPerMs * 1000 && hz <= kMostPerMs * 1000) return;
  throw std::invalid_argument(
      fmt::format("--clock: {} Hz is not allowed with --table; allowed: 8 MHz to 131.071 MHz, "
                  "ClocksPerMs of can_remote",
                  plain_number(hz)));
}

/// RateTable of can_remote (RN-73).
int rate_rows(const BitTimeOptions &options) {
  check_remote_clock(options.clock);
  const std::vector<RateRow> rows = rate_table(options.clock);
  if (options.json)
    print_json({{"clock_hz", options.clock}, {"rows", to_json(rows)}});
  else if (!rows.empty())
    fmt::print("// {} Hz\n{}", plain_number(options.clock), rate_parameters(rows));
  if (!rows.empty()) return kOk;
  print_error("verican: no rate of the table can be made from {} Hz\n",
              plain_number(options.clock));
  return kBadInput;
}

int bittime(const BitTimeOptions &options) {
  if (options.table) return rate_rows(options);
  BitTimingRequest request = options.request;
  const BitTimingRequest whole = bit_timing_request(options.clock, options.bitrate);
  request.clock_hz = whole.clock_hz;
  request.bitrate = whole.bitrate;
  if (options.sample_point) request.sample_point = part_of_bit(*options.sample_point);
  if (options.sjw != 0) request.sjw = options.sjw;
  auto results = find_bit_timings(request);
  const bool found = !results.empty();
  std::erase_if(results, [](const BitTimingResult &result) { return !result.usable(); });
  if (options.json)
    print_json(to_json(request, results));
  else if (!results.empty())
    print_table(request, results, options.rows);
  if (results.empty()) {
    explain_nothing(request, found);
    return kBadInput;
  }
  warn_of_rate(request, results.front());
  return kOk;
}

}  // namespace

void add_bittime(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<BitTimeOptions>();
  CLI::App *command =
      app.add_subcommand("bittime", "Bit timing registers for a clock and a bit rate");
  command->add_option("--clock,-c", options->clock, "Clock of the controller, Hz (8M)")
      ->transform(clock_units());
  auto *rate = command->add_option("--bitrate,-b", options->bitrate, "Bit rate, bit/s, as in 500k")
                   ->transform(bitrate_units());
  CLI::Option *table =
      command
          ->add_flag("--table", options->table,
                     "Rows of a remote node's RateTable for this clock, as parameters")
          ->excludes(rate);
  command->add_option("--sample-point,-s", options->sample_point,
                      "Wanted sample point, 0.5..0.9 or 50..90 % (default: CiA's recommendation)");
  command
      ->add_option("--sjw", options->sjw,
                   "Resynchronisation jump width, 1..4 tq (default: the largest)")
      ->check(CLI::Range(1U, 4U));
  command->add_option("--cable", options->request.cable_m,
                      "Length between the ends of the bus, m (0)");
  command->add_option("--node-delay", options->request.node_delay_ns,
                      "Driver and comparator of a transceiver together, ns (100)");
  command->add_option("--controller-delay", options->request.controller_delay_ns,
                      "Of another controller, in and out, ns (default: this core, 2 clocks)");
  command->add_option("--clock-error", options->request.clock_error_ppm,
                      "Error of each node's clock, for the longest cable, ppm (100)");
  command->add_option("--max-error", options->request.max_rate_error_ppm,
                      "Largest bit-rate error, ppm (50000)");
  CLI::Option *rows = command->add_option("--rows", options->rows, "Lines of the table (10)");
  for (const char *of_search : {"--sample-point", "--sjw", "--cable", "--node-delay",
                                "--controller-delay", "--clock-error", "--max-error", "--rows"})
    table->excludes(command->get_option(of_search));
  command->add_flag("--json", options->json, "All settings as JSON")->excludes(rows);
  command->callback([options, rate, &exit_code] {
    if (!options->table && rate->empty()) throw CLI::RequiredError("--bitrate");
    if (options->rows == 0) throw InputError("--rows", 0, "'0' is not allowed; allowed: 1 or more");
    exit_code = bittime(*options);
  });
}

}  // namespace vericansim::cli
