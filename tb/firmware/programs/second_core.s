@ SPDX-FileCopyrightText: 2026 The VeriCAN authors
@ SPDX-License-Identifier: Apache-2.0
@
@ Writes different words to the timers of both cores, reads them back, and ends with 0 if both have
@ kept theirs.
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
  ldr r0, =0x40050000
  ldr r1, =0x40052000
  movs r2, #0x11
  movs r3, #0x22
  str r2, [r0, #0x80]
  str r3, [r1, #0x80]
  ldr r4, [r0, #0x80]
  ldr r5, [r1, #0x80]
  cmp r4, r2
  bne fail
  cmp r5, r3
  bne fail
  ldr r1, =0x20026
  b end
fail:
  ldr r1, =0x20023
end:
  movs r0, #0x18           @ SYS_EXIT
  bkpt 0xAB
  b .
  .ltorg
