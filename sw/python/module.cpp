// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican._core: ProgramBus and what it gives and takes, for Python. Times are seconds there.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include <cmath>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "bridge/frame_form.hpp"
#include "bus/range.hpp"
#include "program_bus.hpp"
#include "results/report.hpp"
#include "timing/analysis.hpp"
#include "trace/input_error.hpp"
#include "values.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace vericansim {
namespace {

constexpr double kSecondPs = 1e12;

Time to_ps(const char *what, double seconds, Time most = 1'000'000 * kSecond) {
  if (!(seconds >= 0 && seconds * kSecondPs <= static_cast<double>(most)))
    throw std::invalid_argument(std::string{what} + ": 0 to " + std::to_string(most / kSecond) +
                                " s are allowed");
  return static_cast<Time>(std::llround(seconds * kSecondPs));
}

double to_seconds(Time time) { return static_cast<double>(time) / kSecondPs; }

Effect effect_of(const std::string &word) {
  if (word == "flip") return Effect::kFlip;
  if (word == "dominant") return Effect::kDominant;
  if (word == "recessive") return Effect::kRecessive;
  throw std::invalid_argument("effect '" + word + "': flip, dominant or recessive");
}

// Signals, so that Ctrl-C ends a long step. Python handles them in its main thread; others need not
// take the interpreter's lock from it.
std::function<void()> signal_check() {
  const auto main_thread =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return [main_thread] {
    if (PyThread_get_thread_ident() != main_thread) return;
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  };
}

// A process that was forked leaves its parent's files alone.
struct Release {
  void operator()(ProgramBus *bus) const {
    if (!bus->files_of_another()) std::default_delete<ProgramBus>{}(bus);
  }
};
using OwnedBus = std::unique_ptr<ProgramBus, Release>;

OwnedBus make_bus(const std::vector<std::string> &nodes, std::optional<double> bitrate,
                  double clock_hz, const std::string &scenario, double restart,
                  const std::string &vcd, const std::string &order) {
  if (order != "program" && order != "identifier")
    throw std::invalid_argument("order '" + order + "': program or identifier");
  ProgramBusSetup setup;
  // A text of several lines is the scenario itself, which _scenario.py makes of a dictionary.
  const bool is_text = scenario.find('\n') != std::string::npos;
  if (is_text)
    setup.scenario = parse_scenario("scenario", scenario);
  else if (!scenario.empty())
    setup.scenario = read_scenario(scenario);
  else
    setup.scenario.file = "nodes";  // whose arguments messages are about
  setup.bitrate = bitrate || !scenario.empty() ? bitrate : 500e3;
  setup.nodes = nodes;
  setup.clock_hz = clock_hz;
  setup.restart = to_ps("restart", restart);
  setup.by_identifier = order == "identifier";
  if (!vcd.empty()) setup.scenario.outputs.vcd = vcd;
  OwnedBus bus{std::make_unique<ProgramBus>(std::move(setup)).release()};
  bus->on_look = signal_check();
  return bus;
}

void send(ProgramBus &bus, const std::string &node, const Frame &frame) {
  bus.send(node, to_can_frame(frame));
}

// (start, end, sender or None, Frame), times in seconds.
py::list frames(ProgramBus &bus) {
  py::list list;
  const auto names = bus.names();
  for (const BusFrame &frame : bus.frames()) {
    const py::object sender = frame.sender == BusFrame::kNobody
                                  ? py::object{py::none()}
                                  : py::object{py::str(names[frame.sender])};
    list.append(py::make_tuple(to_seconds(frame.start - bus.started()),
                               to_seconds(frame.end - bus.started()), sender, frame.frame));
  }
  return list;
}

const char *kind_of(BusEventKind kind) {
  switch (kind) {
    case BusEventKind::kErrorFrame: return "error frame";
    case BusEventKind::kOverloadFrame: return "overload frame";
    case BusEventKind::kBadFrame: return "bad frame";
    default: return "frame";
  }
}

const char *problem_of(BusProblem problem) {
  switch (problem) {
    case BusProblem::kStuff: return "stuff";
    case BusProblem::kForm: return "form";
    case BusProblem::kCrc: return "CRC";
    default: return "";
  }
}

// Dictionaries, times in seconds.
py::list events(ProgramBus &bus) {
  py::list list;
  for (const BusEvent &event : bus.events()) {
    py::dict value("kind"_a = kind_of(event.kind),
                   "start"_a = to_seconds(event.start - bus.started()),
                   "end"_a = to_seconds(event.end - bus.started()));
    if (event.kind == BusEventKind::kFrame || event.kind == BusEventKind::kBadFrame) {
      value["frame"] = event.frame;
      value["acked"] = event.acked;
    }
    if (event.kind != BusEventKind::kFrame) {
      value["problem"] = problem_of(event.problem);
      value["field"] = std::string{field_name(event.field)};
      value["flag_bits"] = event.flag_bits;
    }
    list.append(value);
  }
  return list;
}

// Messages are (bytes, extended, period, jitter), first the one of highest priority.
std::vector<std::optional<double>> bounds(
    const std::vector<std::tuple<unsigned, bool, double, double>> &messages, double bitrate) {
  if (!(bitrate >= 1e3 && bitrate <= 1e6))
    throw std::invalid_argument("bitrate: 1000 to 1000000 bit/s are allowed");
  std::vector<MessageSpec> specs;
  for (const auto &[bytes, extended, period, jitter] : messages) {
    specs.push_back({bytes, extended, to_ps("period", period), to_ps("jitter", jitter)});
    // As in scenarios: messages that pile up for hours would be gone through one by one.
    if (period != 0 && specs.back().jitter >= specs.back().period)
      throw std::invalid_argument("the jitter must be below the period");
  }
  std::vector<std::optional<double>> seconds;
  for (const auto &bound : response_times(specs, bit_time_of(bitrate)))
    seconds.push_back(bound ? std::optional{to_seconds(*bound)} : std::nullopt);
  return seconds;
}

void step(ProgramBus &bus, double seconds, std::int64_t bits) {
  if (bits < 0 || bits > 1'000'000'000)
    throw std::invalid_argument("bits: 0 to 1000000000 are allowed");
  bus.step(to_ps("seconds", seconds) + bits * bus.bit_time());
}

void disturb(ProgramBus &bus, const std::string &effect, double begin, double duration,
             const std::string &node) {
  // Seconds of late times are no longer exact to the picosecond: `now` is now all the same.
  const Time from =
      begin == to_seconds(bus.now()) ? bus.now() : to_ps("begin", begin, ProgramBus::kLongestLife);
  bus.disturb(node, effect_of(effect), from, to_ps("duration", duration));
}

bool interpreter_ends() {
#if PY_VERSION_HEX >= 0x030D0000
  return Py_IsFinalizing() != 0;
#else
  return _Py_IsFinalizing() != 0;
#endif
}

// Lets other Python threads run. A thread that is in here when the interpreter ends does not come
// back: taking the lock would end the thread in the middle of C++. One that waits for the lock then
// is ended all the same, by an unwinding that the destructor has to let through.
class Elsewhere {
 public:
  Elsewhere() : state_{PyEval_SaveThread()} {}
  ~Elsewhere() noexcept(false) {
    while (interpreter_ends()) ::pause();
    PyEval_RestoreThread(state_);
  }
  Elsewhere(const Elsewhere &) = delete;
  Elsewhere &operator=(const Elsewhere &) = delete;

 private:
  PyThreadState *state_;
};
using Unlocked = py::call_guard<Elsewhere>;

void bind_bus(py::module_ &m) {
  py::class_<ProgramBus, OwnedBus>(
      m, "Bus",
      "A bus of Verilated controllers. Nothing happens but in step() and "
      "run_until_quiet(). Not for two threads at once.")
      .def(py::init(&make_bus), "nodes"_a, py::kw_only(), "bitrate"_a = py::none(),
           "clock_hz"_a = 8e6, "scenario"_a = "", "restart"_a = 0.0, "vcd"_a = "",
           "order"_a = "program")
      .def("send", &send, "node"_a, "frame"_a, "Queues a frame.")
      .def("receive", &ProgramBus::receive, "node"_a, "Messages since the last call.")
      .def("pending", &ProgramBus::pending, "node"_a, "Frames that have not left.")
      .def("state", &ProgramBus::trace, "node"_a)
      .def("restart", &ProgramBus::restart, "node"_a, "Lets a bus-off node recover.")
      .def("step", &step, "seconds"_a = 0.0, "bits"_a = 0, Unlocked())
      .def(
          "pass_time", [](ProgramBus &bus, double time) { bus.pass(to_ps("seconds", time)); },
          "seconds"_a, "As step(), at no cost while nothing is under way.", Unlocked())
      .def(
          "run_until_quiet",
          [](ProgramBus &bus, double limit) { return bus.run_until_quiet(to_ps("limit", limit)); },
          "limit"_a = 1.0, "False if the limit (s) came first.", Unlocked())
      .def(
          "run_until_message",
          [](ProgramBus &bus, double limit) {
            return bus.run_until_message(to_ps("limit", limit));
          },
          "limit"_a, "Until a node has a message for receive(); False if the limit (s) came first.",
          Unlocked())
      .def("disturb", &disturb, "effect"_a, "begin"_a, "duration"_a, "node"_a = "",
           "Receivers see another level: flip, dominant or recessive; one node alone, or all.")
      .def("frames", &frames,
           "(start, end, sender, Frame) of each valid frame since the last call.")
      .def("events", &events,
           "Dictionary of each frame, error frame and overload frame since the last call.")
      .def(
          "finish_json", [](ProgramBus &bus) { return to_json(bus.finish()).dump(); },
          "Completes the files; the report as JSON.")
      .def_property_readonly("nodes", &ProgramBus::names)
      .def_property_readonly("quiet", &ProgramBus::quiet)
      .def_property_readonly("settled", &ProgramBus::settled)
      .def_property_readonly("now", [](ProgramBus &bus) { return to_seconds(bus.now()); })
      .def_property_readonly("started_ps", &ProgramBus::started)
      .def_property_readonly("bit_time",
                             [](const ProgramBus &bus) { return to_seconds(bus.bit_time()); });
}

}  // namespace
}  // namespace vericansim

PYBIND11_MODULE(_core, m) {
  m.doc() = "VeriCAN's simulator for Python (docs/python.md).";
  py::register_exception<vericansim::InputError>(m, "InputError", PyExc_ValueError);
  vericansim::bind_values(m);
  vericansim::bind_bus(m);
  m.def("response_times", &vericansim::bounds, "messages"_a, "bitrate"_a,
        "Worst-case response times, s, of messages (bytes, extended, period, jitter) in the order "
        "of their priority; None where the bus is full.",
        vericansim::Unlocked());
}
