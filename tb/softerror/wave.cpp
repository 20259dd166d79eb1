// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Waveform of a soft-error run: see wave.hpp.
#include "softerror/wave.hpp"

#include <memory>

#include "bus/trace.hpp"

namespace vericansim {
namespace {

constexpr Time kClock = 125 * kNanosecond;

struct Wave {
  std::shared_ptr<WaveSink> sink;
  WaveSink::Signal bus, pin, neighbour[2], flop, field, role, tec, rec, off, error, irq;
};

void declare(Wave &wave) {
  WaveSink &sink = *wave.sink;
  wave.bus = sink.add_wire("bus", "level", 1);
  wave.pin = sink.add_wire("dut", "tx", 1);
  wave.flop = sink.add_wire("dut", "flipped", 1);
  wave.field = sink.add_text("dut", "field");
  wave.role = sink.add_wire("dut", "transmitter", 1);
  wave.error = sink.add_wire("dut", "error", 6);
  wave.tec = sink.add_wire("dut", "tec", 8);
  wave.rec = sink.add_wire("dut", "rec", 8);
  wave.off = sink.add_wire("dut", "bus_off", 1);
  wave.irq = sink.add_wire("dut", "irq", 1);
  wave.neighbour[0] = sink.add_wire("a", "tx", 1);
  wave.neighbour[1] = sink.add_wire("b", "tx", 1);
  sink.start();
}

void show(Wave &wave, World &world, unsigned flop) {
  WaveSink &sink = *wave.sink;
  const Time now = static_cast<Time>(world.clock()) * kClock;
  const Trace trace = decode_trace(world.dut().trace());
  const auto level = [](Level l) { return static_cast<std::uint64_t>(l); };
  sink.set(now, wave.bus, level(world.level()));
  sink.set(now, wave.pin, level(world.dut().tx()));
  sink.set(now, wave.flop, std::uint64_t{world.dut().value(flop)});
  sink.set(now, wave.field, field_name(trace.field));
  sink.set(now, wave.role, std::uint64_t{trace.transmitter});
  sink.set(now, wave.error, std::uint64_t{trace.errors});
  sink.set(now, wave.tec, std::uint64_t{trace.tec});
  sink.set(now, wave.rec, std::uint64_t{trace.rec});
  sink.set(now, wave.off, std::uint64_t{trace.bus_off});
  sink.set(now, wave.irq, std::uint64_t{world.dut().irq()});
  for (unsigned n = 0; n < 2; ++n) sink.set(now, wave.neighbour[n], level(world.neighbour(n).tx()));
}

}  // namespace

std::shared_ptr<WaveSink> open_wave(World &world, const std::string &path, unsigned flop) {
  auto wave = std::make_shared<Wave>();
  wave->sink = open_vcd(path);
  declare(*wave);
  world.on_clock = [wave, &world, flop] { show(*wave, world, flop); };
  return wave->sink;
}

void close_wave(World &world, const std::shared_ptr<WaveSink> &wave) {
  world.on_clock = nullptr;
  if (wave) wave->finish(static_cast<Time>(world.clock()) * kClock);
}

}  // namespace vericansim
