// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Faults: exception numbers and status bits (ARMv7-M, B1.5.14), and words for reports.
#include "firmware/fault.hpp"

#include <fmt/format.h>

#include "firmware/memory_map.hpp"
#include "firmware/nvic.hpp"

namespace vericansim::firmware {
namespace {

std::string access_text(const Fault &fault) {
  return fmt::format("{} of {} byte{} {} {}", fault.write ? "write" : "read", fault.size,
                     fault.size == 1 ? "" : "s", fault.write ? "to" : "at", hex32(fault.address));
}

}  // namespace

unsigned fault_exception(FaultKind kind) {
  switch (kind) {
    case FaultKind::kNotExecutable: return kMemManage;
    case FaultKind::kFetch:
    case FaultKind::kAccess:
    case FaultKind::kReadOnly:
    case FaultKind::kDeviceError:
    case FaultKind::kSystemSize:
    case FaultKind::kStacking:
    case FaultKind::kUnstacking: return kBusFault;
    case FaultKind::kVector:
    case FaultKind::kBreakpoint:
    case FaultKind::kSvc: return kHardFault;
    default: return kUsageFault;
  }
}

std::uint32_t fault_status(FaultKind kind) {
  switch (kind) {
    case FaultKind::kNotExecutable: return 1U << 0;  // IACCVIOL
    case FaultKind::kFetch: return 1U << 8;          // IBUSERR
    case FaultKind::kAccess:
    case FaultKind::kReadOnly:
    case FaultKind::kDeviceError:
    case FaultKind::kSystemSize: return 1U << 9;   // PRECISERR
    case FaultKind::kUnstacking: return 1U << 11;  // UNSTKERR
    case FaultKind::kStacking: return 1U << 12;    // STKERR
    case FaultKind::kUndefined:
    case FaultKind::kSystemInIt: return 1U << 16;  // UNDEFINSTR
    case FaultKind::kInvalidState:
    case FaultKind::kNoThumb: return 1U << 17;        // INVSTATE
    case FaultKind::kInvalidReturn: return 1U << 18;  // INVPC
    case FaultKind::kNoCoprocessor: return 1U << 19;  // NOCP
    case FaultKind::kUnaligned: return 1U << 24;      // UNALIGNED
    default: return 0;
  }
}

bool fault_has_address(FaultKind kind) { return fault_status(kind) == 1U << 9; }

std::string fault_text(const Fault &fault, std::size_t cores) {
  switch (fault.kind) {
    case FaultKind::kFetch:
      return fmt::format("no memory at {}, from where code is to be fetched; there is {}",
                         hex32(fault.address), map_text(cores));
    case FaultKind::kNotExecutable:
      return fmt::format("code must not run at {}; allowed: flash and SRAM", hex32(fault.address));
    case FaultKind::kAccess:
      return access_text(fault) + ": nothing is there; there is " + map_text(cores);
    case FaultKind::kReadOnly: return access_text(fault) + ": flash cannot be written";
    case FaultKind::kDeviceError:
      return access_text(fault) + ": the core answered with an ERROR response";
    case FaultKind::kUnaligned:
      return access_text(fault) + ": unaligned; devices take aligned accesses only";
    case FaultKind::kSystemSize:
      return access_text(fault) + ": this system register takes words only";
    case FaultKind::kUndefined: return "undefined instruction";
    case FaultKind::kInvalidState:
      return fmt::format("branch to {} with bit 0 clear (ARM code; this CPU knows Thumb only)",
                         hex32(fault.address));
    case FaultKind::kNoThumb:
      return fmt::format(
          "no Thumb state at {}: the vector of the handler is even, or bit 24 of the "
          "stacked xPSR is 0",
          hex32(fault.address));
    case FaultKind::kInvalidReturn:
      return fmt::format("exception return with {}, which does not fit the state of the CPU",
                         hex32(fault.address));
    case FaultKind::kNoCoprocessor: return "coprocessor instruction; this CPU has none";
    case FaultKind::kSystemInIt:
      return "system or coprocessor instruction in an IT block, which this simulation does not "
             "support";
    case FaultKind::kStacking:
      return fmt::format("exception entry: no memory for the stack frame at {}",
                         hex32(fault.address));
    case FaultKind::kUnstacking:
      return fmt::format("exception return: no memory at the stack pointer {}",
                         hex32(fault.address));
    case FaultKind::kVector:
      return fmt::format("the vector at {} cannot be read", hex32(fault.address));
    case FaultKind::kBreakpoint: return "BKPT instruction (only BKPT 0xAB, semihosting, is served)";
    case FaultKind::kSvc: return "SVC instruction where SVCall has not priority enough";
  }
  return "unknown fault";
}

}  // namespace vericansim::firmware
