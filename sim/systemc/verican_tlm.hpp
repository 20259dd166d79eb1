// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// VericanTlm: the whole core, Verilated, as a SystemC module with a TLM-2.0 target socket.
#pragma once

#include <tlm_utils/simple_target_socket.h>

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <systemc>
#include <tlm>
#include <vector>

#include "node/rtl_node.hpp"
#include "systemc/payload.hpp"
#include "systemc/time.hpp"

namespace vericansim {

class CanBus;

/// How a module keeps time.
enum class TlmTiming : std::uint8_t {
  kCycleExact,    ///< every clock is an event; a transport takes the clocks of its AHB transfers
  kLooselyTimed,  ///< transports return at once and annotate their time; see CanBus
};

/// Settings of a module.
struct TlmConfig {
  TlmTiming timing = TlmTiming::kCycleExact;
  unsigned num_mb = 64;  ///< message buffers: 16, 32 or 64 (std::invalid_argument otherwise)
  /// The core's own oscillator, in use where clk is not bound, and in loosely timed mode.
  ClockConfig clock = {};
};

/// The core. The socket has the register window at address 0 and takes reads and writes as
/// plan_beats() says. A transfer that the core answers with ERROR is TLM_ADDRESS_ERROR_RESPONSE;
/// one that meets a reset is TLM_GENERIC_ERROR_RESPONSE.
///
/// b_transport: cycle-exact, it waits for the annotated delay and then for its transfers; those of
/// several threads run in the order of their calls, back to back. Loosely timed, the delay
/// grows by the clocks that the transfers took, and it waits only, for the annotated delay, while
/// another module of the bus is accessed too (within a quantum). nb_transport_fw is converted to
/// b_transport by the socket (tlm_utils::simple_target_socket). transport_dbg reads the window of
/// 8 KiB, of any length and alignment, as a read that began now would, and changes nothing: no
/// buffer is locked, no time passes; writes serve 0 bytes. DMI is refused for the whole region.
///
/// All ports but can_rx and can_tx may be left unbound, and those too if a CanBus has the module.
/// An edge sees what its inputs were strictly before it, so edges at the same instant do not race;
/// a transport is taken by the first edge after its call.
class VericanTlm : public sc_core::sc_module {
 public:
  /// `config.timing` loosely timed: attach the module to a CanBus, clk is not looked at.
  VericanTlm(const sc_core::sc_module_name &name, const TlmConfig &config);

  tlm_utils::simple_target_socket<VericanTlm> socket{"socket"};
  sc_core::sc_in<bool> clk{"clk"};            ///< rising edges; unbound: TlmConfig::clock
  sc_core::sc_in<bool> rst_n{"rst_n"};        ///< asynchronous, active low; unbound: 1
  sc_core::sc_in<bool> stop_req{"stop_req"};  ///< the system asks for stop mode; unbound: 0
  sc_core::sc_in<bool> can_rx{"can_rx"};      ///< RXD, true is recessive
  sc_core::sc_out<bool> can_tx{"can_tx"};     ///< TXD, true is recessive
  sc_core::sc_out<bool> irq{"irq"};           ///< level, active high: OR of the lines below
  sc_core::sc_out<bool> irq_mb{"irq_mb"};
  sc_core::sc_out<bool> irq_bus_off{"irq_bus_off"};
  sc_core::sc_out<bool> irq_error{"irq_error"};
  sc_core::sc_out<bool> irq_tx_warning{"irq_tx_warning"};
  sc_core::sc_out<bool> irq_rx_warning{"irq_rx_warning"};
  sc_core::sc_out<bool> irq_wake{"irq_wake"};

  [[nodiscard]] TlmTiming timing() const { return config_.timing; }
  /// The core, for observers: AhbMaster::watch(), the AHB checker, the trace word.
  [[nodiscard]] RtlNode &node() { return *node_; }

 private:
  friend class CanBus;

  // The transfers of one call that are on the bus together.
  struct Request {
    std::vector<AhbTransfer> transfers;
    sc_core::sc_time arrival;
    AhbMaster::Ticket first = 0;
    bool done = false;
    bool aborted = false;
  };

  void before_end_of_elaboration() override;
  void end_of_elaboration() override;
  template <typename Port>
  void bind_if_open(Port &port, bool value);

  void b_transport(tlm::tlm_generic_payload &payload, sc_core::sc_time &delay);
  unsigned transport_dbg(tlm::tlm_generic_payload &payload);
  bool get_direct_mem_ptr(tlm::tlm_generic_payload &payload, tlm::tlm_dmi &dmi);
  tlm::tlm_response_status run(tlm::tlm_generic_payload &payload, const std::vector<Beat> &beats,
                               sc_core::sc_time &delay);
  AhbMaster::Ticket submit(const std::vector<AhbTransfer> &transfers);
  bool run_exact(const std::shared_ptr<Request> &request, sc_core::sc_time &delay);
  bool run_loosely(Request &request, sc_core::sc_time &delay);

  void own_clock();
  void edge();
  void take_requests();
  void finish_requests();
  void on_can_rx() { rx_.update(can_rx.read()); }
  void on_stop_req();
  void on_reset();
  void reset();
  void outputs_changed(const sc_core::sc_time &delay);
  void drive_outputs();

  TlmConfig config_;
  std::unique_ptr<RtlNode> node_;
  CanBus *bus_ = nullptr;       // loosely timed
  sc_core::sc_time idle_from_;  // loosely timed: end of the last transfer; zero: none so far
  std::vector<std::unique_ptr<sc_core::sc_signal<bool>>> open_ends_;
  Settled rx_{true}, reset_n_{true}, stop_{false};
  bool stop_given_ = false;
  std::deque<std::shared_ptr<Request>> requests_;  // oldest first
  std::size_t taken_ = 0;                          // of them, by the AHB master
  sc_core::sc_event finished_;
  sc_core::sc_event outputs_;
  std::uint8_t shown_irq_ = 0;
  Level shown_tx_ = Level::kRecessive;
};

}  // namespace vericansim
