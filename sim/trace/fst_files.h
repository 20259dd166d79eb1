/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The files of GTKWave's FST writer, which looks at no result of a write: fstapi.c is compiled with
 * this header in front of it, so that each is looked at here. Its scratch files live in memory: it
 * maps them, and what is missing of a mapped file on a full disk is a SIGBUS.
 */
#ifndef VERICAN_TRACE_FST_FILES_H
#define VERICAN_TRACE_FST_FILES_H

#include <stdio.h>
#include <sys/types.h>

#ifdef __cplusplus
extern "C" {
#endif

FILE *verican_fst_fopen(const char *name, const char *mode);
FILE *verican_fst_tmpfile(void);
int verican_fst_fputc(int byte, FILE *file);
size_t verican_fst_fwrite(const void *data, size_t size, size_t count, FILE *file);
int verican_fst_fseeko(FILE *file, off_t offset, int whence);
int verican_fst_fflush(FILE *file);
int verican_fst_fclose(FILE *file);

/* The errno of the first failure in this thread since the last call; 0: all is well. */
int verican_fst_error(void);

#ifdef __cplusplus
}
#endif

#ifdef VERICAN_FST_REDIRECT
#define fopen verican_fst_fopen
#define tmpfile verican_fst_tmpfile
#define fputc verican_fst_fputc
#define fwrite verican_fst_fwrite
#define fseeko verican_fst_fseeko
#define fflush verican_fst_fflush
#define fclose verican_fst_fclose
#endif

#endif
