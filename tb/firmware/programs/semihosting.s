@ SPDX-FileCopyrightText: 2026 The VeriCAN authors
@ SPDX-License-Identifier: Apache-2.0
@
@ Prints and ends with exit code 3.
  .syntax unified
  .cpu cortex-m3
  .thumb
  .section .vectors, "a"
  .word 0x20008000
  .word start

  .text
  .thumb_func
  .type start, %function
start:
  movs r0, #4              @ SYS_WRITE0
  ldr r1, =text
  bkpt 0xAB
  movs r0, #0x20           @ SYS_EXIT_EXTENDED
  ldr r1, =block
  bkpt 0xAB
  b .
  .ltorg
  .align 2
block:
  .word 0x20026, 3
text:
  .asciz "hello\n"
