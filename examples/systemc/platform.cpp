// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// A SystemC platform: two controllers on a bus with 20 m of cable, each with a small initiator that
// runs the C driver. Frames go both ways; what happens is printed.
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <systemc>

#include "driver_host.hpp"
#include "systemc/can_bus.hpp"
#include "systemc/verican_tlm.hpp"

using namespace vericansim;
using sc_core::sc_time;

namespace {

const char *const kUsage =
    "systemc_platform - two controllers with the C driver in a SystemC platform\n"
    "Usage: systemc_platform [options]\n"
    "  --frames N            frames that each side sends, 1 to 100000 (8)\n"
    "  --loosely-timed US    loosely timed with a quantum of US microseconds, 1 to 1000;\n"
    "                        without: cycle-exact\n"
    "  --vcd FILE            writes the pins and interrupt lines (FILE.vcd)\n"
    "  --quiet               prints the summary only\n";

struct Options {
  unsigned frames = 8;
  unsigned quantum_us = 0;  // 0: cycle-exact
  std::string vcd;
  bool quiet = false;
};

[[nodiscard]] bool complain(const std::string &what) {
  std::fprintf(stderr, "systemc_platform: %s\n", what.c_str());
  return false;
}

bool parse_number(const std::string &option, const char *text, unsigned max, unsigned &value) {
  const char *end = text + std::strlen(text);
  const auto [rest, error] = std::from_chars(text, end, value);
  if (error == std::errc{} && rest == end && value >= 1 && value <= max) return true;
  return complain(option + ": '" + text + "' is not a number from 1 to " + std::to_string(max));
}

bool parse(int argc, char **argv, Options &options) {
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--quiet") {
      options.quiet = true;
      continue;
    }
    if (option != "--frames" && option != "--loosely-timed" && option != "--vcd")
      return complain("unknown option '" + option + "', see --help");
    if (i + 1 == argc) return complain(option + " needs a value");
    const char *value = argv[++i];
    if (option == "--vcd") options.vcd = value;
    if (option == "--frames" && !parse_number(option, value, 100'000, options.frames)) return false;
    if (option == "--loosely-timed" && !parse_number(option, value, 1000, options.quantum_us))
      return false;
  }
  return true;
}

// A controller and its processor.
struct Station {
  VericanTlm can;
  DriverHost host;
  sc_core::sc_signal<bool> irq;

  Station(const std::string &name, const TlmConfig &config, const DriverHost::Settings &settings)
      : can{name.c_str(), config},
        host{(name + "_host").c_str(), settings},
        irq{(name + "_irq").c_str()} {
    host.socket.bind(can.socket);
    can.irq.bind(irq);
    host.irq.bind(irq);
  }
};

// The two of them on the bus.
struct Platform {
  explicit Platform(const Options &options) {
    TlmConfig config;
    if (options.quantum_us != 0) config.timing = TlmTiming::kLooselyTimed;
    const Link link{.cable = cable_delay(10), .transmitter = 50'000, .receiver = 70'000};
    for (unsigned i = 0; i < 2; ++i) {
      config.clock = {.error_ppm = i == 0 ? 40.0 : -35.0, .phase = 1'000 + 30'000 * Time{i}};
      stations[i] = std::make_unique<Station>(
          i == 0 ? "left" : "right", config,
          DriverHost::Settings{
              .base_id = 0x100 * (i + 1), .to_send = options.frames, .to_receive = options.frames});
      bus.attach(stations[i]->can, link);
      DriverHost &host = stations[i]->host;
      if (!options.quiet) print_frames_of(host);
      host.on_done = [this] {
        if (++done == 2) sc_core::sc_stop();
      };
    }
  }

  static void print_frames_of(DriverHost &host) {
    host.on_frame = [&host](const sc_time &time, const verican_frame_t &frame) {
      std::printf("%12.3f us  %-10s  received  %03X#", time.to_seconds() * 1e6, host.basename(),
                  static_cast<unsigned>(frame.id));
      for (unsigned i = 0; i < frame.dlc; ++i) std::printf("%02X", frame.data[i]);
      std::printf("\n");
    };
    host.on_sent = [&host](const sc_time &time, unsigned number) {
      std::printf("%12.3f us  %-10s  sent      number %u\n", time.to_seconds() * 1e6,
                  host.basename(), number - 1);
    };
  }

  void trace(sc_core::sc_trace_file *file) {
    bus.trace(file);
    for (const auto &station : stations) sc_core::sc_trace(file, station->irq, station->irq.name());
  }

  // True if both have received what the other has sent, in order.
  [[nodiscard]] bool complete(unsigned frames) const {
    for (unsigned side = 0; side < 2; ++side) {
      const auto &received = stations[side]->host.received();
      if (received.size() != frames) return false;
      for (unsigned i = 0; i < frames; ++i) {
        const verican_frame_t expected = stations[1 - side]->host.frame(i);
        if (received[i].id != expected.id || received[i].dlc != expected.dlc ||
            std::memcmp(received[i].data, expected.data, sizeof expected.data) != 0)
          return false;
      }
    }
    return true;
  }

  CanBus bus{"bus"};
  std::unique_ptr<Station> stations[2];
  unsigned done = 0;
};

int run(const Options &options) {
  if (options.quantum_us != 0)
    tlm::tlm_global_quantum::instance().set(sc_time(options.quantum_us, sc_core::SC_US));
  Platform platform(options);
  sc_core::sc_trace_file *vcd = nullptr;
  if (!options.vcd.empty()) {
    vcd = sc_core::sc_create_vcd_trace_file(options.vcd.c_str());
    vcd->set_time_unit(1, sc_core::SC_PS);
    platform.trace(vcd);
  }
  // A frame takes at most 0.3 ms; the set-up less than 10 ms.
  sc_core::sc_start(sc_time(10 + options.frames, sc_core::SC_MS));
  if (vcd != nullptr) sc_core::sc_close_vcd_trace_file(vcd);
  for (const auto &station : platform.stations) {
    std::printf("%-10s  sent %u, received %zu, %llu register accesses, %llu interrupts\n",
                station->host.basename(), station->host.sent(), station->host.received().size(),
                static_cast<unsigned long long>(station->host.accesses()),
                static_cast<unsigned long long>(station->host.interrupts()));
  }
  std::printf("%.3f ms simulated\n", sc_core::sc_time_stamp().to_seconds() * 1e3);
  if (platform.complete(options.frames)) return 0;
  std::printf("FRAMES ARE MISSING OR CHANGED\n");
  return 1;
}

}  // namespace

int sc_main(int argc, char **argv) {
  sc_core::sc_report_handler::set_actions(sc_core::SC_INFO, sc_core::SC_DO_NOTHING);
  if (argc == 2 && std::strcmp(argv[1], "--help") == 0) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  Options options;
  if (!parse(argc, argv, options)) return 2;
  return run(options);
}
