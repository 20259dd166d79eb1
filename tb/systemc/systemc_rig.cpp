// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// SystemC rig: see systemc_rig.hpp.
#include "systemc/systemc_rig.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

// SystemC's library asks for it; the simulations here are started by tests.
int sc_main(int, char **) { return 0; }

namespace vericansim {

// ---- Processes

namespace {

void write_all(int descriptor, const std::string &text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(descriptor, text.data() + done, text.size() - done);
    if (count <= 0) _exit(3);
    done += static_cast<std::size_t>(count);
  }
}

[[noreturn]] void run_child(const std::function<std::string()> &body, int descriptor) {
  int status = 0;
  try {
    write_all(descriptor, body());
  } catch (const std::exception &error) {
    std::printf("the simulation threw: %s\n", error.what());
    status = 2;
  }
  std::fflush(stdout);
  std::fflush(stderr);
  _exit(status != 0 ? status : ::testing::Test::HasFailure() ? 1 : 0);
}

}  // namespace

std::string simulate_for(const std::function<std::string()> &body) {
  int ends[2];
  if (pipe(ends) != 0) {
    ADD_FAILURE() << "no pipe";
    return {};
  }
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    run_child(body, ends[1]);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t count; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
    text.append(buffer, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0)
      << "the simulation's process ended with status " << status;
  return text;
}

void simulate(const std::function<void()> &body) {
  simulate_for([&body]() -> std::string {
    body();
    return {};
  });
}

// ---- Master

Master::Master(const sc_core::sc_module_name &name, Program program, sc_core::sc_time quantum)
    : sc_core::sc_module{name}, program_{std::move(program)}, quantum_{quantum} {
  SC_HAS_PROCESS(Master);
  SC_THREAD(run);
}

void Master::run() {
  if (program_) program_(*this);
  sync();
  finished = true;
}

void Master::sync() {
  if (ahead == sc_core::SC_ZERO_TIME) return;
  wait(ahead);
  ahead = sc_core::SC_ZERO_TIME;
}

void Master::fill(tlm::tlm_generic_payload &payload, tlm::tlm_command command,
                  std::uint64_t address, void *data, unsigned length) {
  payload.set_command(command);
  payload.set_address(address);
  payload.set_data_ptr(static_cast<unsigned char *>(data));
  payload.set_data_length(length);
  payload.set_streaming_width(length);
}

Outcome Master::transport(tlm::tlm_generic_payload &payload) {
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
  const sc_core::sc_time before = local();
  socket->b_transport(payload, ahead);
  const Outcome outcome{payload.get_response_status(), local() - before};
  if (ahead >= quantum_) sync();
  return outcome;
}

Outcome Master::transport(tlm::tlm_command command, std::uint64_t address, void *data,
                          unsigned length) {
  tlm::tlm_generic_payload request;
  fill(request, command, address, data, length);
  return transport(request);
}

std::uint32_t Master::read32(std::uint32_t address) {
  std::uint32_t word = 0;
  EXPECT_EQ(transport(tlm::TLM_READ_COMMAND, address, &word, 4).status, tlm::TLM_OK_RESPONSE)
      << "reading " << std::hex << address;
  return word;
}

void Master::write32(std::uint32_t address, std::uint32_t value) {
  EXPECT_EQ(transport(tlm::TLM_WRITE_COMMAND, address, &value, 4).status, tlm::TLM_OK_RESPONSE)
      << "writing " << std::hex << address;
}

std::uint32_t Master::peek32(std::uint32_t address) {
  std::uint32_t word = 0;
  tlm::tlm_generic_payload request;
  fill(request, tlm::TLM_READ_COMMAND, address, &word, 4);
  EXPECT_EQ(socket->transport_dbg(request), 4u) << "peeking " << std::hex << address;
  return word;
}

// ---- DeltaLag

DeltaLag::DeltaLag(const sc_core::sc_module_name &name, const sc_core::sc_signal_in_if<bool> &in,
                   unsigned deltas)
    : sc_core::sc_module{name} {
  const sc_core::sc_signal_in_if<bool> *before = &in;
  for (unsigned i = 0; i < deltas; ++i) {
    stages_.push_back(std::make_unique<sc_core::sc_signal<bool>>());
    sc_core::sc_spawn_options options;
    options.spawn_method();
    options.set_sensitivity(&before->value_changed_event());
    sc_core::sc_spawn([before, stage = stages_.back().get()] { stage->write(before->read()); },
                      sc_core::sc_gen_unique_name("lag"), &options);
    before = stages_.back().get();
  }
}

// ---- Junction

Junction::Junction(const sc_core::sc_module_name &name, unsigned inputs)
    : sc_core::sc_module{name} {
  for (unsigned i = 0; i < inputs; ++i) {
    inputs_.push_back(std::make_unique<tlm_utils::simple_target_socket_tagged<Junction>>(
        ("input" + std::to_string(i)).c_str()));
    inputs_.back()->register_b_transport(this, &Junction::b_transport, static_cast<int>(i));
  }
}

}  // namespace vericansim
