/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * wide_xstate: a preloaded ptrace() for user-mode Linux 6.1 on processors with large register sets.
 *
 * That kernel keeps 2696 bytes of extended registers of each guest process. Processors with AMX
 * have four times as much, and their host kernel refuses to set a part. Here the missing rest is
 * taken from what the process has: with it, an unpatched 6.1 runs on every x86-64 machine.
 */
#define _GNU_SOURCE
#include <elf.h>
#include <errno.h>
#include <stdarg.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum { WIDEST = 65536 };

/* The register set as a whole; user-mode Linux is one thread. */
static unsigned char whole[WIDEST];

static long set_part(long pid, const struct iovec *part) {
  struct iovec all = {whole, sizeof(whole)};

  if (syscall(SYS_ptrace, PTRACE_GETREGSET, pid, NT_X86_XSTATE, &all) != 0) return -1;
  if (part->iov_len < all.iov_len)
    memcpy(whole, part->iov_base, part->iov_len);
  else
    all = *part;
  return syscall(SYS_ptrace, PTRACE_SETREGSET, pid, NT_X86_XSTATE, &all);
}

long ptrace(enum __ptrace_request request, ...) {
  va_list args;
  long word = 0;
  long result;

  va_start(args, request);
  const long pid = va_arg(args, long);
  void *address = va_arg(args, void *);
  void *data = va_arg(args, void *);
  va_end(args);

  if (request == PTRACE_SETREGSET && (long)address == NT_X86_XSTATE) return set_part(pid, data);
  /* These three return what they read; the system call stores it. */
  if (request == PTRACE_PEEKTEXT || request == PTRACE_PEEKDATA || request == PTRACE_PEEKUSER) {
    result = syscall(SYS_ptrace, request, pid, address, &word);
    if (result < 0) return result;
    errno = 0;
    return word;
  }
  return syscall(SYS_ptrace, request, pid, address, data);
}
