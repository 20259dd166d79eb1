// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The smallest platform: two controllers on a bus, and a thread that reads a register of each.
#include <tlm_utils/simple_initiator_socket.h>

#include <cstdio>
#include <systemc>
#include <tlm>

#include "systemc/can_bus.hpp"
#include "systemc/verican_tlm.hpp"

struct Cpu : sc_core::sc_module {
  tlm_utils::simple_initiator_socket<Cpu> socket{"socket"};

  explicit Cpu(const sc_core::sc_module_name &name) : sc_core::sc_module{name} {
    SC_HAS_PROCESS(Cpu);
    SC_THREAD(run);
  }

  void run() {
    unsigned word = 0;
    tlm::tlm_generic_payload payload;
    payload.set_read();
    payload.set_address(0x000);  // MCR
    payload.set_data_ptr(reinterpret_cast<unsigned char *>(&word));
    payload.set_data_length(4);
    payload.set_streaming_width(4);
    sc_core::sc_time delay;
    socket->b_transport(payload, delay);
    std::printf("%s: MCR is %08X, read until %s\n", name(), word,
                (sc_core::sc_time_stamp() + delay).to_string().c_str());
  }
};

int sc_main(int, char **) {
  using namespace vericansim;
  const TlmConfig config{.clock = {.frequency_hz = 8e6, .error_ppm = 50, .phase = 1000}};
  CanBus bus("bus");
  VericanTlm left("left", config), right("right", config);
  bus.attach(left, {.cable = cable_delay(10), .transmitter = 50'000, .receiver = 70'000});
  bus.attach(right);
  Cpu left_cpu("left_cpu"), right_cpu("right_cpu");
  left_cpu.socket.bind(left.socket);
  right_cpu.socket.bind(right.socket);
  sc_core::sc_start(1, sc_core::SC_US);
  return 0;
}
