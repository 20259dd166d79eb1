/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * See fst_files.h.
 */
#define _GNU_SOURCE
#include "trace/fst_files.h"

#include <errno.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static _Thread_local int first_error;

static void note(int error) {
  if (first_error == 0) first_error = error != 0 ? error : EIO;
}

FILE *verican_fst_tmpfile(void) {
  const int memory = memfd_create("fst", MFD_CLOEXEC);
  FILE *file = memory < 0 ? NULL : fdopen(memory, "w+b");
  if (file == NULL) {
    note(errno);
    if (memory >= 0) close(memory);
  }
  return file;
}

/* The hierarchy is a scratch file with a name. */
FILE *verican_fst_fopen(const char *name, const char *mode) {
  const char *ending = strrchr(name, '.');
  if (ending != NULL && strcmp(ending, ".hier") == 0 && mode[0] == 'w')
    return verican_fst_tmpfile();
  FILE *file = fopen(name, mode);
  if (file == NULL) note(errno);
  return file;
}

int verican_fst_fputc(int byte, FILE *file) {
  const int result = fputc(byte, file);
  if (result == EOF) note(errno);
  return result;
}

size_t verican_fst_fwrite(const void *data, size_t size, size_t count, FILE *file) {
  const size_t result = fwrite(data, size, count, file);
  if (ferror(file)) note(errno);
  return result;
}

int verican_fst_fseeko(FILE *file, off_t offset, int whence) {
  const int result = fseeko(file, offset, whence);
  if (result != 0) note(errno);
  return result;
}

int verican_fst_fflush(FILE *file) {
  const int result = fflush(file);
  if (result != 0) note(errno);
  return result;
}

int verican_fst_fclose(FILE *file) {
  const int result = fclose(file);
  if (result != 0) note(errno);
  return result;
}

int verican_fst_error(void) {
  const int error = first_error;
  first_error = 0;
  return error;
}
