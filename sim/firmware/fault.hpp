// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Fault: what can go wrong when the CPU executes something, and what the registers say of it.
#pragma once

#include <cstdint>
#include <string>

namespace vericansim::firmware {

enum class FaultKind : std::uint8_t {
  kFetch,          ///< no memory at the PC
  kNotExecutable,  ///< there is something, but no code may run there
  kAccess,         ///< nothing at the address of a load or store
  kReadOnly,       ///< store to flash
  kDeviceError,    ///< the device answered with ERROR
  kUnaligned,      ///< to a device or a system register
  kSystemSize,     ///< byte or half-word access to a system register that takes words
  kUndefined,      ///< no such instruction
  kInvalidState,   ///< branch to an even address: ARM code, which the CPU has not got
  kNoThumb,        ///< behind a vector or an exception return that says so
  kInvalidReturn,  ///< EXC_RETURN that does not fit the state
  kNoCoprocessor,
  kSystemInIt,  ///< conditional system or coprocessor instruction; a limit of this
                ///< simulation
  kStacking,    ///< exception entry: no memory at the stack pointer
  kUnstacking,  ///< exception return: no memory at the stack pointer
  kVector,      ///< vector table cannot be read
  kBreakpoint,  ///< BKPT other than semihosting, without a debugger
  kSvc,         ///< SVC where it cannot be taken
};

/// One fault. `address` and `size` are those of the access, `pc` that of the instruction.
struct Fault {
  FaultKind kind = FaultKind::kUndefined;
  std::uint32_t pc = 0;
  std::uint32_t address = 0;
  unsigned size = 0;
  bool write = false;
};

/// Exception (MemManage, BusFault, UsageFault, or HardFault) that the fault raises.
[[nodiscard]] unsigned fault_exception(FaultKind kind);
/// Its bit of CFSR; 0 for faults that are HardFaults from the start.
[[nodiscard]] std::uint32_t fault_status(FaultKind kind);
/// True if BFAR gets the address.
[[nodiscard]] bool fault_has_address(FaultKind kind);
/// "write of 2 bytes to 0x40050001: unaligned; ...".
[[nodiscard]] std::string fault_text(const Fault &fault, std::size_t cores);

}  // namespace vericansim::firmware
