// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Python helpers: what a well-kept Python library does better than code of ours (log formats,
// databases of signals) is done by a script of sim/python, as a process of its own.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vericansim {

/// One run of a script.
struct PythonCall {
  std::string script;                  ///< file name in sim/python, such as "log_format.py"
  std::vector<std::string> arguments;  ///< of the script
  std::string_view input;              ///< what it finds on its standard input
  std::string subject;                 ///< file or option that error messages begin with
};

/// Runs the script and returns its standard output. The scripts are looked for in
/// $VERICAN_PYTHON_DIR, in share/verican/python beside the bin folder of the running program, and
/// in share/verican/python beside the program; the interpreter is $VERICAN_PYTHON, else
/// /usr/bin/python3. Throws InputError "subject: ..." if scripts, interpreter or Python package are
/// missing or the script refuses its input (exit code 2, its message is the last line of stderr),
/// and std::runtime_error if it fails in another way.
[[nodiscard]] std::string run_python(const PythonCall &call);

}  // namespace vericansim
