// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// verican._core: ProgramBus and what it gives and takes, for Python. Times are seconds there.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bridge/frame_form.hpp"
#include "bus/range.hpp"
#include "program_bus.hpp"
#include "results/report.hpp"
#include "timing/analysis.hpp"
#include "trace/input_error.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace vericansim {
namespace {

constexpr double kSecondPs = 1e12;

Time to_ps(const char *what, double seconds) {
  constexpr double kMost = 1e6;
  if (!(seconds >= 0 && seconds <= kMost))
    throw std::invalid_argument(std::string{what} + ": 0 to 1000000 s are allowed");
  return static_cast<Time>(std::llround(seconds * kSecondPs));
}

double to_seconds(Time time) { return static_cast<double>(time) / kSecondPs; }

Frame make_frame(std::uint32_t id, const py::bytes &data, bool extended, bool remote,
                 std::optional<unsigned> dlc) {
  const std::string_view bytes = data;
  Frame frame{.id = id, .extended = extended, .remote = remote};
  if (bytes.size() > frame.data.size()) throw std::invalid_argument("a frame has 0 to 8 bytes");
  const unsigned code = dlc.value_or(static_cast<unsigned>(bytes.size()));
  if (code > 15) throw std::invalid_argument("a DLC is 0 to 15");
  frame.dlc = static_cast<std::uint8_t>(code);
  if (bytes.size() != frame.payload_size())
    throw std::invalid_argument("a DLC of " + std::to_string(code) + " means " +
                                std::to_string(frame.payload_size()) + " bytes, not " +
                                std::to_string(bytes.size()));
  std::memcpy(frame.data.data(), bytes.data(), bytes.size());
  frame.validate();
  return frame;
}

py::bytes payload(const Frame &frame) {
  return {reinterpret_cast<const char *>(frame.data.data()), frame.payload_size()};
}

// As Python writes it: Frame(0x123, b'\x01').
std::string to_text(const Frame &frame) {
  const auto flag = [](bool set, const char *text) { return set ? text : ""; };
  return py::str("Frame({:#x}, {!r}{}{}, dlc={})")
      .format(frame.id, payload(frame), flag(frame.extended, ", extended=True"),
              flag(frame.remote, ", remote=True"), unsigned{frame.dlc});
}

const char *state_of(const Trace &trace) {
  if (trace.bus_off) return "bus-off";
  return trace.passive ? "passive" : "active";
}

Effect effect_of(const std::string &word) {
  if (word == "flip") return Effect::kFlip;
  if (word == "dominant") return Effect::kDominant;
  if (word == "recessive") return Effect::kRecessive;
  throw std::invalid_argument("effect '" + word + "': flip, dominant or recessive");
}

std::unique_ptr<ProgramBus> make_bus(const std::vector<std::string> &nodes, double bitrate,
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
  setup.bitrate = bitrate != 0 || !scenario.empty() ? bitrate : 500e3;
  setup.nodes = nodes;
  setup.clock_hz = clock_hz;
  setup.restart = to_ps("restart", restart);
  setup.by_identifier = order == "identifier";
  if (!vcd.empty()) setup.scenario.outputs.vcd = vcd;
  return std::make_unique<ProgramBus>(std::move(setup));
}

// Identifier of a message with SocketCAN's flags taken off.
std::uint32_t id_of(const PortMessage &message) {
  const std::uint32_t id = message.frame.can_id;
  if ((id & CAN_ERR_FLAG) != 0) return id & CAN_ERR_MASK;
  return (id & CAN_EFF_FLAG) != 0 ? id & CAN_EFF_MASK : id & CAN_SFF_MASK;
}

template <std::uint32_t kFlag>
bool has(const PortMessage &message) {
  return (message.frame.can_id & kFlag) != 0;
}

py::bytes data_of(const PortMessage &message) {
  const bool remote = has<CAN_RTR_FLAG>(message) && !has<CAN_ERR_FLAG>(message);
  return {reinterpret_cast<const char *>(message.frame.data),
          remote ? 0U : std::size_t{message.frame.len}};
}

void bind_values(py::module_ &m) {
  py::class_<Frame>(m, "Frame", "A data or remote frame; a value.")
      .def(py::init(&make_frame), "id"_a, "data"_a = py::bytes(), "extended"_a = false,
           "remote"_a = false, "dlc"_a = py::none())
      .def_readonly("id", &Frame::id)
      .def_readonly("extended", &Frame::extended)
      .def_readonly("remote", &Frame::remote)
      .def_readonly("dlc", &Frame::dlc)
      .def_property_readonly("data", &payload)
      .def("__eq__", [](const Frame &a, const Frame &b) { return a == b; })
      .def("__repr__", &to_text);
  py::class_<PortMessage>(m, "Message",
                          "What a node has for its program: a frame, or an error message in "
                          "SocketCAN's form (linux/can/error.h).")
      .def_property_readonly("id", &id_of)
      .def_property_readonly("extended", &has<CAN_EFF_FLAG>)
      .def_property_readonly("remote", &has<CAN_RTR_FLAG>)
      .def_property_readonly("error", &has<CAN_ERR_FLAG>)
      .def_property_readonly("data", &data_of)
      .def_property_readonly("dlc", [](const PortMessage &of) { return of.frame.len; })
      .def_readonly("echo", &PortMessage::echo, "True: the node's own frame has left.")
      .def_readonly("time_ps", &PortMessage::time, "Of the bus's own clock: Bus.started_ps is 0 s.")
      .def("__repr__", [](const PortMessage &message) {
        return py::str("Message({}id={:#x}, data={!r}, dlc={})")
            .format(has<CAN_ERR_FLAG>(message) ? "error, "
                    : message.echo             ? "echo, "
                                               : "",
                    id_of(message), data_of(message), unsigned{message.frame.len});
      });
  py::class_<Trace>(m, "NodeState", "Error counters and state of a core.")
      .def_readonly("tec", &Trace::tec)
      .def_readonly("rec", &Trace::rec)
      .def_property_readonly("state", &state_of, "active, passive or bus-off")
      .def("__repr__", [](const Trace &trace) {
        return std::string{"NodeState("} + state_of(trace) + ", tec " + std::to_string(trace.tec) +
               ", rec " + std::to_string(trace.rec) + ")";
      });
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
  for (const auto &[bytes, extended, period, jitter] : messages)
    specs.push_back({bytes, extended, to_ps("period", period), to_ps("jitter", jitter)});
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
  bus.disturb(node, effect_of(effect), to_ps("begin", begin), to_ps("duration", duration));
}

using Unlocked = py::call_guard<py::gil_scoped_release>;

void bind_bus(py::module_ &m) {
  py::class_<ProgramBus>(m, "Bus",
                         "A bus of Verilated controllers. Nothing happens but in step() and "
                         "run_until_quiet(). Not for two threads at once.")
      .def(py::init(&make_bus), "nodes"_a, py::kw_only(), "bitrate"_a = 0.0, "clock_hz"_a = 8e6,
           "scenario"_a = "", "restart"_a = 0.0, "vcd"_a = "", "order"_a = "program")
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
        "of their priority; None where the bus is full.");
}
