/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The client of can_remote over a SocketCAN socket (Linux).
 */
#ifndef VERICAN_REMOTE_SOCKETCAN_H
#define VERICAN_REMOTE_SOCKETCAN_H

#include "verican_remote.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A raw CAN socket. */
typedef struct verican_remote_socketcan {
  int fd;
} verican_remote_socketcan_t;

/**
 * Opens a CAN interface ("can0") that is up. Returns 0, or an errno: ENODEV for no such interface,
 * ENETDOWN, EPERM ...; nothing is open then.
 */
int verican_remote_socketcan_open(verican_remote_socketcan_t *socket, const char *interface);
/** Takes a socket that gives and takes struct can_frame, one a read or write. */
void verican_remote_socketcan_attach(verican_remote_socketcan_t *socket, int fd);
/** The three functions for verican_remote_init(). `socket` must stay where it is. */
verican_remote_port_t verican_remote_socketcan_port(verican_remote_socketcan_t *socket);
void verican_remote_socketcan_close(verican_remote_socketcan_t *socket);

#ifdef __cplusplus
}
#endif

#endif
