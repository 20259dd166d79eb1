// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// run_python(): scripts as processes; their failures become one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "harness/input_error_of.hpp"
#include "harness/scratch_test.hpp"
#include "trace/input_error.hpp"
#include "trace/python_helper.hpp"

namespace vericansim {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A folder with scripts of the test in place of the tool's.
class PythonHelper : public ScratchTest {
 protected:
  PythonHelper() {
    std::filesystem::copy(VERICAN_PYTHON_SOURCES "/verican_helper.py", folder.path());
    ::unsetenv("PYTHONDONTWRITEBYTECODE");
    ::setenv("VERICAN_PYTHON_DIR", folder.path().c_str(), 1);
  }
  ~PythonHelper() override {
    ::unsetenv("VERICAN_PYTHON_DIR");
    ::unsetenv("VERICAN_PYTHON");
  }
  PythonHelper(const PythonHelper &) = delete;
  PythonHelper &operator=(const PythonHelper &) = delete;

  void script(const std::string &body) const {
    file_with("probe.py", "import sys, verican_helper\n" + body);
  }
  [[nodiscard]] static std::string run(std::string_view input = {}) {
    return run_python({"probe.py", {"one", "two words"}, input, "engine.dbc"});
  }
  /// The message of the InputError that running the script gives.
  [[nodiscard]] static std::string refusal() {
    return input_error_of([] { return run(); });
  }
};

TEST_F(PythonHelper, HandsOverArgumentsInputAndOutput) {
  script(
      "verican_helper.run(lambda args: '|'.join(args).encode() + "
      "sys.stdin.buffer.read()[::-1])\n");
  // Larger than a pipe holds; every byte value.
  std::string input;
  for (int i = 0; i < 300'000; ++i) input += static_cast<char>(i);
  const std::string output = run(input);
  EXPECT_EQ(output, "one|two words" + std::string(input.rbegin(), input.rend()));
  EXPECT_FALSE(std::filesystem::exists(in("__pycache__")));
}

TEST_F(PythonHelper, RefusedInputIsOneLineBehindTheSubject) {
  script(
      "def work(args):\n"
      "    print('chatter', file=sys.stderr)\n"
      "    raise verican_helper.BadInput('line 3:\\n no message')\n"
      "verican_helper.run(work)\n");
  EXPECT_EQ(refusal(), "engine.dbc: line 3: no message");
}

TEST_F(PythonHelper, MissingPackageIsNamedWithItsDebianPackage) {
  script("verican_helper.run(lambda args: verican_helper.need('no_such.io', 'python3-no-such'))\n");
  EXPECT_THAT(refusal(), HasSubstr("engine.dbc: needs the Python package no_such (Debian: "
                                   "python3-no-such)"));
}

TEST_F(PythonHelper, MissingScriptOrInterpreterIsSaid) {
  EXPECT_THAT(refusal(), HasSubstr("engine.dbc: needs probe.py of share/verican/python"));
  script("");
  ::setenv("VERICAN_PYTHON", "/no/such/python", 1);
  EXPECT_THAT(refusal(), HasSubstr("'/no/such/python' cannot be started"));
}

// Programs that end well and badly, and say something or nothing.
TEST_F(PythonHelper, AnInterpreterThatIsNoPythonIsSaid) {
  script("verican_helper.run(lambda args: b'output')\n");
  for (const std::string program : {"/bin/false", "/bin/true", "/bin/cat", "/bin/echo"}) {
    ::setenv("VERICAN_PYTHON", program.c_str(), 1);
    EXPECT_EQ(refusal(), "engine.dbc: needs Python, and '" + program +
                             "' of VERICAN_PYTHON is none; allowed: the file of a Python 3");
  }
  ::setenv("VERICAN_PYTHON", "/usr/bin/python3", 1);
  EXPECT_EQ(run(), "output");
}

TEST_F(PythonHelper, MistakeInAScriptIsNoBadInput) {
  script("verican_helper.run(lambda args: 1 // 0)\n");
  try {
    (void)run();
    FAIL();
  } catch (const InputError &error) {
    FAIL() << error.what();
  } catch (const std::runtime_error &error) {
    EXPECT_THAT(error.what(), HasSubstr("probe.py: ZeroDivisionError"));
  }
}

}  // namespace
}  // namespace vericansim
