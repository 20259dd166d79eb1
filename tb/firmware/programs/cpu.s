@ SPDX-FileCopyrightText: 2026 The VeriCAN authors
@ SPDX-License-Identifier: Apache-2.0
@
@ Pieces of code for the CPU tests. A test sets the PC to one of the functions; handlers append
@ their exception number to a log: its end is at LOG, its words follow.
  .syntax unified
  .cpu cortex-m3
  .thumb

  .equ LOG, 0x20000000
  .equ CAN, 0x40050000
  .equ ISPR, 0xE000E200

  .macro FUNCTION name
  .thumb_func
  .type \name, %function
  .global \name
\name:
  .endm

  .section .vectors, "a"
  .word 0x20008000
  .word idle
  .word log_handler        @ NMI
  .word log_handler        @ HardFault
  .word log_handler        @ MemManage
  .word skip_handler       @ BusFault
  .word skip_handler       @ UsageFault
  .word 0, 0, 0, 0
  .word log_handler        @ SVCall
  .word 0, 0
  .word log_handler        @ PendSV
  .word log_handler        @ SysTick
  .rept 31
  .word 0
  .endr
  .word nesting_handler    @ IRQ 31
  .word log_handler        @ IRQ 32

  .text
@ Endless, without any effect.
FUNCTION idle
  b idle

@ Ten instructions without effect, then idle.
FUNCTION ten_nops
  .rept 10
  nop
  .endr
  b idle

@ ---- Handlers

FUNCTION log_handler
  mrs r0, ipsr
append:
  ldr r1, =LOG
  ldr r2, [r1]
  str r0, [r2]
  adds r2, #4
  str r2, [r1]
  bx lr

@ Logs, makes IRQ 32 pending, logs again with 0x100 added.
FUNCTION nesting_handler
  push {r4, lr}
  mrs r0, ipsr
  bl append
  ldr r3, =ISPR + 4
  movs r4, #1
  str r4, [r3]
  nop
  nop
  mrs r0, ipsr
  add r0, r0, #0x100
  bl append
  pop {r4, pc}

@ Logs, then returns behind the (four-byte) instruction that made the fault.
FUNCTION skip_handler
  push {lr}
  mrs r0, ipsr
  bl append
  ldr r0, [sp, #28]        @ return address: 6 words up in the frame, one pushed
  adds r0, #4
  str r0, [sp, #28]
  pop {pc}

@ Clears the registers that need not survive a call, and returns with flags changed.
FUNCTION spoil_handler
  movs r0, #0
  mov r1, r0
  mov r2, r0
  mov r3, r0
  mov r12, r0
  bx lr

@ A return value that is none.
FUNCTION bad_return_handler
  ldr r0, =0xFFFFFFF5
  bx r0

@ The process stack has no room for a frame any more.
FUNCTION lose_process_stack_handler
  ldr r0, =0x2000FFF0
  msr psp, r0
  bx lr

@ ---- System instructions

FUNCTION wait_for_interrupt
  wfi
  movs r7, #1
  b idle

FUNCTION wait_for_event
  wfe
  movs r7, #1
  wfe
  movs r7, #2
  b idle

FUNCTION send_event
  sev
  wfe
  movs r7, #1
  b idle

FUNCTION supervisor_call
  movs r6, #1
  svc #7
  movs r7, #1
  b idle

@ r4-r11 get what was read back.
FUNCTION special_registers
  movs r0, #0xFF
  msr basepri, r0
  mrs r4, basepri          @ 0xF8: five bits
  movs r0, #0x20
  msr basepri_max, r0
  mrs r5, basepri          @ 0x20: lower
  movs r0, #0x40
  msr basepri_max, r0
  mrs r6, basepri          @ 0x20: never higher
  movs r0, #0
  msr basepri, r0
  cpsid i
  mrs r7, primask          @ 1
  cpsie i
  cpsid f
  mrs r8, faultmask        @ 1
  cpsie f
  ldr r0, =0x20004000
  msr psp, r0
  movs r0, #2
  msr control, r0
  mrs r9, control          @ 2
  mov r10, sp              @ 0x20004000
  ldr r0, =0xA8000000
  msr apsr_nzcvq, r0
  mrs r11, apsr            @ 0xA8000000
  b idle

FUNCTION conditional_system
  cmp r0, r0
  it eq
  mrseq r0, primask
  b idle

@ ---- Accesses

FUNCTION sizes
  ldr r0, =CAN
  ldr r1, =0x89ABCDEF
  str r1, [r0, #0x80]
  strh r1, [r0, #0x86]
  strb r1, [r0, #0x8B]
  ldr r2, [r0, #0x80]
  ldrh r3, [r0, #0x86]
  ldrsb r4, [r0, #0x8B]
  movs r7, #1
  b idle

FUNCTION several_accesses
  ldr r0, =CAN
  ldm r0, {r1, r2, r3}
  ldrd r4, r5, [r0, #0x10]
  movs r7, #1
  b idle

@ Adds 1 to the word at r0 and reads a device within the same IT block.
FUNCTION it_block
  ldr r1, =CAN
  cmp r1, r1
  itttt eq
  ldreq r2, [r0]
  addeq r2, #1
  streq r2, [r0]
  ldreq r3, [r1]
  movs r7, #1
  b idle

@ As unprivileged code, which cannot get its privilege back.
FUNCTION unprivileged
  movs r0, #1
  msr control, r0
  movs r0, #0
  msr control, r0
  ldr r0, =CAN
  ldr.w r1, [r0, #4]
  movs r7, #1
  b idle

FUNCTION system_bytes
  ldr r0, =0xE000E400
  movs r1, #0x55
  strb r1, [r0, #31]
  ldr r2, [r0, #28]
  b idle

FUNCTION system_byte_refused
  ldr r0, =0xE000E100
  ldrb.w r1, [r0]
  b idle

FUNCTION unaligned_device
  ldr r0, =CAN
  ldr.w r1, [r0, #2]
  movs r7, #1
  b idle

FUNCTION unaligned_ram
  ldr r0, =0x20001001
  ldr r1, =0x01020304
  str r1, [r0]
  ldr r2, [r0]
  b idle

FUNCTION read_nowhere
  ldr r0, =0x40060000
  ldr.w r1, [r0]
  movs r7, #1
  b idle

FUNCTION write_nowhere
  ldr r0, =0x20010000
  strb.w r1, [r0]
  b idle

FUNCTION write_flash
  movs r0, #0
  str.w r1, [r0, #64]
  b idle

FUNCTION jump_nowhere
  ldr r0, =0x10000001
  bx r0

FUNCTION jump_to_device
  ldr r0, =CAN + 1
  bx r0

FUNCTION jump_to_arm
  ldr r0, =idle
  bic r0, r0, #1
  bx r0

FUNCTION undefined
  udf.w #0
  movs r7, #1
  b idle

FUNCTION breakpoint
  bkpt 1

FUNCTION floating_point
  .inst.w 0xEE300A00       @ vadd.f32
  b idle

FUNCTION empty_stack
  ldr r0, =0x20000010
  mov sp, r0
  b idle

FUNCTION request_reset
  ldr r0, =0xE000ED0C
  ldr r1, =0x05FA0004
  str r1, [r0]
  b idle

@ Copies the loop to SRAM and runs it there.
FUNCTION run_in_ram
  ldr r0, =0x20002000
  ldr r1, =0xE7FE2709      @ movs r7, #9; b .
  str r1, [r0]
  adds r0, #1
  bx r0
  .ltorg
