// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SerialProgram: see serial_program.hpp.
#include "boards/serial_program.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

namespace vericansim {
namespace {

[[noreturn]] void refused(const char *what) {
  throw std::system_error(errno, std::generic_category(), what);
}

std::string read_some(int file) {
  std::array<char, 4096> buffer{};
  const ssize_t got = ::read(file, buffer.data(), buffer.size());
  return got > 0 ? std::string(buffer.data(), static_cast<std::size_t>(got)) : std::string{};
}

void write_all(int file, const std::string &bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EAGAIN) refused("write");
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

void no_waiting(int file) {
  if (::fcntl(file, F_SETFL, O_NONBLOCK) != 0) refused("fcntl");
}

}  // namespace

SerialProgram::SerialProgram(std::vector<std::string> command) {
  terminal_ = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal_ < 0 || ::grantpt(terminal_) != 0 || ::unlockpt(terminal_) != 0) refused("terminal");
  std::array<char, 128> name{};
  if (::ptsname_r(terminal_, name.data(), name.size()) != 0) refused("ptsname");
  // Somebody has it open at all times, and raw, so that no byte is lost or changed.
  held_ = ::open(name.data(), O_RDWR | O_NOCTTY);
  termios settings{};
  if (held_ < 0 || ::tcgetattr(held_, &settings) != 0) refused("terminal");
  ::cfmakeraw(&settings);
  if (::tcsetattr(held_, TCSANOW, &settings) != 0) refused("terminal");
  int input[2], output[2];
  if (::pipe(input) != 0 || ::pipe(output) != 0) refused("pipe");
  child_ = ::fork();
  if (child_ < 0) refused("fork");
  if (child_ == 0) become(command, name.data(), input, output);
  ::close(input[0]);
  ::close(output[1]);
  input_ = input[1];
  output_ = output[0];
  no_waiting(terminal_);
  no_waiting(output_);
}

void SerialProgram::become(const std::vector<std::string> &command, const std::string &terminal,
                           const int (&input)[2], const int (&output)[2]) const {
  ::dup2(input[0], STDIN_FILENO);
  ::dup2(output[1], STDOUT_FILENO);
  ::dup2(output[1], STDERR_FILENO);
  for (const int file : {input[0], input[1], output[0], output[1], terminal_, held_}) ::close(file);
  std::vector<char *> words;
  for (const std::string &word : command) words.push_back(const_cast<char *>(word.c_str()));
  words.push_back(const_cast<char *>(terminal.c_str()));
  words.push_back(nullptr);
  ::execv(words[0], words.data());
  ::_exit(127);
}

SerialProgram::~SerialProgram() {
  if (exit_code() < 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  for (const int file : {terminal_, held_, input_, output_})
    if (file >= 0) ::close(file);
}

std::string SerialProgram::from_terminal() { return read_some(terminal_); }
void SerialProgram::to_terminal(const std::string &bytes) { write_all(terminal_, bytes); }
void SerialProgram::type(const std::string &text) { write_all(input_, text); }

void SerialProgram::end_of_input() {
  ::close(input_);
  input_ = -1;
}

std::vector<std::string> SerialProgram::lines() {
  text_ += read_some(output_);
  std::vector<std::string> found;
  for (std::size_t end = 0; (end = text_.find('\n')) != std::string::npos;) {
    found.push_back(text_.substr(0, end));
    text_.erase(0, end + 1);
  }
  return found;
}

void SerialProgram::wait() const {
  std::array<pollfd, 2> files{{{terminal_, POLLIN, 0}, {output_, POLLIN, 0}}};
  (void)::poll(files.data(), files.size(), 5);
}

int SerialProgram::exit_code() {
  int status = 0;
  if (code_ < 0 && ::waitpid(child_, &status, WNOHANG) == child_)
    code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return code_;
}

}  // namespace vericansim
