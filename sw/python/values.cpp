// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Values for Python: see values.hpp.
#include "values.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bridge/can_port.hpp"
#include "bus/trace.hpp"
#include "model/frame.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace vericansim {
namespace {

// Numbers of Python have no bounds.
std::uint32_t within(const char *what, const py::object &value, std::uint32_t most) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index) throw py::error_already_set();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || number < 0 || number > most)
    throw std::invalid_argument(
        py::str("{} {}: 0 to {} are allowed").format(what, index, most).cast<std::string>());
  return static_cast<std::uint32_t>(number);
}

Frame make_frame(const py::object &id, const py::buffer &data, bool extended, bool remote,
                 const py::object &dlc) {
  const auto copy = py::reinterpret_steal<py::bytes>(PyBytes_FromObject(data.ptr()));
  if (!copy) throw py::error_already_set();
  const std::string_view bytes = copy;
  Frame frame{.id = within("identifier", id, extended ? CAN_EFF_MASK : CAN_SFF_MASK),
              .extended = extended,
              .remote = remote};
  if (bytes.size() > frame.data.size()) throw std::invalid_argument("a frame has 0 to 8 bytes");
  const auto code =
      dlc.is_none() ? static_cast<std::uint32_t>(bytes.size()) : within("DLC", dlc, 15);
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

// The arguments of make_frame() again.
py::tuple parts_of(const Frame &frame) {
  return py::make_tuple(frame.id, payload(frame), frame.extended, frame.remote, frame.dlc);
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

// SocketCAN keeps a DLC above 8 apart from the length.
unsigned dlc_of(const PortMessage &message) {
  return message.frame.len8_dlc != 0 ? message.frame.len8_dlc : message.frame.len;
}

}  // namespace

void bind_values(py::module_ &m) {
  py::class_<Frame>(m, "Frame", "A data or remote frame; a value.")
      .def(py::init(&make_frame), "id"_a, "data"_a = py::bytes(), "extended"_a = false,
           "remote"_a = false, "dlc"_a = py::none())
      .def_readonly("id", &Frame::id)
      .def_readonly("extended", &Frame::extended)
      .def_readonly("remote", &Frame::remote)
      .def_readonly("dlc", &Frame::dlc)
      .def_property_readonly("data", &payload)
      // As an operator, for which Python asks the other side, too, where types differ.
      .def(
          "__eq__", [](const Frame &a, const Frame &b) { return a == b; }, py::is_operator())
      .def("__hash__", [](const Frame &frame) { return py::hash(parts_of(frame)); })
      // py::pickle() ends the process in protocols 0 and 1.
      .def("__reduce__",
           [](const py::object &frame) {
             return py::make_tuple(py::type::of(frame), parts_of(frame.cast<const Frame &>()));
           })
      .def("__repr__", &to_text);
  py::class_<PortMessage>(m, "Message",
                          "What a node has for its program: a frame, or an error message in "
                          "SocketCAN's form (linux/can/error.h).")
      .def_property_readonly("id", &id_of)
      .def_property_readonly("extended", &has<CAN_EFF_FLAG>)
      .def_property_readonly("remote", &has<CAN_RTR_FLAG>)
      .def_property_readonly("error", &has<CAN_ERR_FLAG>)
      .def_property_readonly("data", &data_of)
      .def_property_readonly("dlc", &dlc_of)
      .def_readonly("echo", &PortMessage::echo, "True: the node's own frame has left.")
      .def_readonly("time_ps", &PortMessage::time, "Of the bus's own clock: Bus.started_ps is 0 s.")
      .def("__repr__", [](const PortMessage &message) {
        return py::str("Message({}id={:#x}, data={!r}, dlc={})")
            .format(has<CAN_ERR_FLAG>(message) ? "error, "
                    : message.echo             ? "echo, "
                                               : "",
                    id_of(message), data_of(message), dlc_of(message));
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

}  // namespace vericansim
