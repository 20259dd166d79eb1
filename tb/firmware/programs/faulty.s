@ SPDX-FileCopyrightText: 2026 The VeriCAN authors
@ SPDX-License-Identifier: Apache-2.0
@
@ Reads where nothing is, in a function of its own.
  .syntax unified
  .cpu cortex-m3
  .thumb
  .section .vectors, "a"
  .word 0x20008000
  .word start
  .word 0
  .word hard_fault

  .text
  .thumb_func
  .type start, %function
start:
  ldr r3, =0x12345678
  ldr r0, =0x40060000
  bl reader
  b .
  .size start, . - start
  .thumb_func
  .type reader, %function
reader:
  nop
  ldrh r1, [r0, #2]
  bx lr
  .size reader, . - reader
  .thumb_func
  .type hard_fault, %function
hard_fault:
  ldr r1, [r0]             @ once more: lock-up
  .size hard_fault, . - hard_fault
  .ltorg
