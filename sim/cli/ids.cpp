// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican ids: the identifiers of a recording, without a simulation.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "cli/log_options.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

struct IdsOptions {
  std::string log;
  LogSelection selection;
  IdsOutput output;
  bool json = false;
};

int run(const IdsOptions &options) {
  std::vector<NamedFile> outputs;
  add_file(outputs, "--csv", options.output.csv);
  claim_files({{"the recording", options.log}}, outputs);
  const SelectedLog selected = read_selected(options.log, options.selection, true);
  const IdentifierTable table = identifiers_of(selected.log);
  const bool found = !selected.log.entries.empty();
  if (found) write_ids_csv(table, options.output);
  const std::string skipped = skipped_text(selected.log);
  if (options.json) {
    print_json({{"frames", selected.log.entries.size()},
                {"skipped", selected.log.skipped},
                {"interfaces", selected.interfaces},
                {"step_back", to_json(selected.step_back)},
                {"identifiers", to_json(table)}});
  } else {
    fmt::print("{}: {}, {}{}\n{}", options.log,
               text::counted(selected.log.entries.size(), "frame", "frames"),
               text::counted(table.rows().size(), "identifier", "identifiers"),
               skipped.empty() ? "" : "; without " + skipped, to_text(table));
  }
  if (found) return kOk;
  print_error("verican: {}: {}\n", options.log, selected.why_empty());
  return kFailed;
}

}  // namespace

void add_ids(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<IdsOptions>();
  CLI::App *command = app.add_subcommand(
      "ids", "For each identifier of a recording: count, period, jitter, last data, changed bytes");
  command->add_option("log", options->log, "Recording of any known format; - is standard input")
      ->required();
  add_selection(*command, options->selection, true);
  command->add_option("--csv", options->output.csv,
                      "The table as a CSV file; - is standard output");
  command->add_flag("--json", options->json, "The table as JSON");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli
