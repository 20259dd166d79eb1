// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// record_main: see record_main.hpp.
#include "four_state/record_main.hpp"

#include <exception>

namespace vericansim {
namespace {

int usage(const std::string &program, const std::vector<unsigned> &sizes) {
  std::string allowed;
  for (const unsigned size : sizes) allowed += (allowed.empty() ? "" : "|") + std::to_string(size);
  std::fprintf(stderr, "usage: %s --list | %s RECORDING %s FILE\n", program.c_str(),
               program.c_str(), allowed.c_str());
  return 2;
}

int failed(const std::string &path) {
  std::perror(path.c_str());
  return 1;
}

int record(const RecordTask &task, unsigned size, const std::string &path) {
  std::FILE *file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return failed(path);
  task.run(size, file);
  return std::fclose(file) == 0 ? 0 : failed(path);
}

}  // namespace

int record_main(int argc, char **argv, const std::vector<unsigned> &sizes,
                const std::vector<RecordTask> &tasks) {
  const std::vector<std::string> words{argv + 1, argv + argc};
  const std::string name = argv[0];
  const std::string program = name.substr(name.rfind('/') + 1);
  try {
    if (words == std::vector<std::string>{"--list"}) {
      for (const RecordTask &task : tasks) std::printf("%s\n", task.name.c_str());
      return 0;
    }
    if (words.size() != 3) return usage(program, sizes);
    for (const RecordTask &task : tasks)
      for (const unsigned size : sizes)
        if (task.name == words[0] && std::to_string(size) == words[1])
          return record(task, size, words[2]);
    return usage(program, sizes);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), error.what());
    return 1;
  }
}

}  // namespace vericansim
