// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican convert: a recording in another format, and what that cannot hold.
#include <fmt/format.h>

#include <memory>

#include "cli/cli.hpp"
#include "cli/log_options.hpp"
#include "cli/output_files.hpp"
#include "cli/print_error.hpp"
#include "trace/log_convert.hpp"
#include "trace/output_file.hpp"
#include "trace/text.hpp"

namespace vericansim::cli {
namespace {

struct ConvertOptions {
  std::string in, out, format;
  LogSelection selection;
  IdsOutput ids;
};

void print_losses(const Conversion &result) {
  for (const std::string &loss : result.lost) print_error("lost: {}\n", loss);
}

int run(const ConvertOptions &options) {
  const LogFormat format = output_format(options.format, options.out);
  std::vector<NamedFile> outputs{{"the new file", options.out}};
  add_file(outputs, "--ids-csv", options.ids.csv);
  claim_files({{"the recording", options.in}}, outputs);
  const SelectedLog selected = read_selected(options.in, options.selection, true);
  const Conversion result = convert(selected.log, format, options.out);
  if (!result.faithful) {
    print_error("verican: {}: read again, its frames are not those of {}: {}; not written\n",
                options.out, options.in, result.difference);
    return kFailed;
  }
  if (result.frames == 0) {
    print_losses(result);
    print_error("verican: {}: no frame to convert{}; not written\n", options.in,
                selected.log.skipped == 0 ? "" : ": only " + skipped_text(selected.log));
    return kFailed;
  }
  OutputFile file{options.out};
  file.stream() << result.bytes;
  const IdentifierTable table =
      options.ids.wanted() ? identifiers_of(selected.log) : IdentifierTable{};
  write_ids_csv(table, options.ids);
  file.commit();
  fmt::print("{} -> {} ({}): {}\n", options.in, options.out, name_of(format),
             text::counted(result.frames, "frame", "frames"));
  if (options.ids.text) fmt::print("{}", to_text(table));
  print_losses(result);
  return kOk;
}

}  // namespace

void add_convert(CLI::App &app, int &exit_code) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App *command = app.add_subcommand(
      "convert", "A recording in another format; what that cannot hold is counted and told");
  command->add_option("in", options->in, "Recording of any known format; - is standard input")
      ->required();
  command->add_option("out", options->out, "New file, its ending tells the format; - is stdout")
      ->required();
  command->add_option("--format", options->format,
                      "Format: candump, pcap, pcapng, asc, blf, trc, csv, gvret, sqlite");
  add_selection(*command, options->selection, true);
  add_ids_options(*command, options->ids);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace vericansim::cli
