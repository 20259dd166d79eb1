/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The client of can_remote over a SocketCAN socket.
 */
#define _DEFAULT_SOURCE

#include "verican_remote_socketcan.h"

#include <errno.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

enum { SEND_US = 1000000, RETRY_US = 200 };

static uint32_t socketcan_now(void *context) {
  struct timespec now;
  (void)context;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (uint32_t)((uint64_t)now.tv_sec * 1000000u + (uint64_t)now.tv_nsec / 1000u);
}

/* Waits until the socket has something to read; false: not within the time. Signals do not shorten
 * it: after a handler poll() fails with EINTR, whatever SA_RESTART says. */
static bool wait_for_frame(int fd, uint32_t timeout_us) {
  struct pollfd one = {.fd = fd, .events = POLLIN};
  const uint32_t start = socketcan_now(NULL);
  for (;;) {
    const uint32_t passed = socketcan_now(NULL) - start;
    const uint32_t left = passed < timeout_us ? timeout_us - passed : 0;
    const int ready = poll(&one, 1, (int)(left / 1000u + (left % 1000u != 0u ? 1u : 0u)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

/* Whether a call that failed so is worth repeating: no room, or a signal. */
static bool passes(int error) {
  return error == ENOBUFS || error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

static verican_remote_result_t socketcan_send(void *context, const verican_remote_frame_t *frame) {
  const verican_remote_socketcan_t *s = context;
  struct can_frame out;
  memset(&out, 0, sizeof out);
  out.can_id = frame->id | (frame->remote ? CAN_RTR_FLAG : 0u);
  out.can_dlc = frame->dlc;
  memcpy(out.data, frame->data, sizeof out.data);
  const uint32_t start = socketcan_now(NULL);
  for (;;) {
    /* A socket that blocks would wait longer than this loop does: for ever, if no frame leaves. */
    if (send(s->fd, &out, sizeof out, MSG_DONTWAIT) == (ssize_t)sizeof out)
      return VERICAN_REMOTE_OK;
    if (!passes(errno)) return VERICAN_REMOTE_BUS_OFF;
    if (socketcan_now(NULL) - start >= SEND_US) return VERICAN_REMOTE_TIMEOUT;
    const struct timespec pause = {.tv_nsec = RETRY_US * 1000};
    nanosleep(&pause, NULL); /* ENOBUFS: poll() says that there is room, and there is none */
  }
}

/* Base frames are taken; false: another one. */
static bool take(const struct can_frame *in, verican_remote_frame_t *frame) {
  if ((in->can_id & (CAN_ERR_FLAG | CAN_EFF_FLAG)) != 0) return false;
  *frame = (verican_remote_frame_t){.id = (uint16_t)(in->can_id & CAN_SFF_MASK),
                                    .remote = (in->can_id & CAN_RTR_FLAG) != 0,
                                    .dlc = in->can_dlc < 8 ? in->can_dlc : 8};
  memcpy(frame->data, in->data, sizeof frame->data);
  return true;
}

static bool says_bus_off(const struct can_frame *in) {
  return (in->can_id & CAN_ERR_FLAG) != 0 && (in->can_id & CAN_ERR_BUSOFF) != 0;
}

static verican_remote_result_t socketcan_receive(void *context, verican_remote_frame_t *frame,
                                                 uint32_t timeout_us) {
  const verican_remote_socketcan_t *s = context;
  const uint32_t start = socketcan_now(NULL);
  for (;;) {
    const uint32_t passed = socketcan_now(NULL) - start;
    if (!wait_for_frame(s->fd, passed < timeout_us ? timeout_us - passed : 0))
      return VERICAN_REMOTE_TIMEOUT;
    struct can_frame in;
    const ssize_t got = read(s->fd, &in, sizeof in);
    if (got < 0 && passes(errno)) continue;
    if (got != (ssize_t)sizeof in) return VERICAN_REMOTE_BUS_OFF; /* the interface went down */
    if (take(&in, frame)) return VERICAN_REMOTE_OK;
    if (says_bus_off(&in)) return VERICAN_REMOTE_BUS_OFF;
    if (socketcan_now(NULL) - start >= verican_remote_skip_us(timeout_us))
      return VERICAN_REMOTE_TIMEOUT;
  }
}

/* Of an interface that is down bind() says nothing: the socket has the error. */
static int bind_to(int fd, const struct sockaddr_can *address) {
  int error = 0;
  socklen_t size = sizeof error;
  if (bind(fd, (const struct sockaddr *)address, sizeof *address) != 0) return -1;
  if (getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size) != 0) return -1;
  errno = error;
  return error == 0 ? 0 : -1;
}

int verican_remote_socketcan_open(verican_remote_socketcan_t *s, const char *interface) {
  struct ifreq request;
  memset(&request, 0, sizeof request);
  s->fd = -1; /* whatever comes: verican_remote_socketcan_close() may follow */
  if (interface == NULL || strlen(interface) >= sizeof request.ifr_name) return ENODEV;
  strcpy(request.ifr_name, interface);
  const int fd = socket(PF_CAN, SOCK_RAW, CAN_RAW);
  if (fd < 0) return errno;
  const can_err_mask_t errors = CAN_ERR_BUSOFF;
  struct sockaddr_can address;
  memset(&address, 0, sizeof address);
  address.can_family = AF_CAN;
  int bad = ioctl(fd, SIOCGIFINDEX, &request);
  address.can_ifindex = request.ifr_ifindex;
  if (bad == 0) bad = setsockopt(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
  if (bad == 0) bad = bind_to(fd, &address);
  if (bad != 0) {
    const int error = errno;
    close(fd);
    return error;
  }
  s->fd = fd;
  return 0;
}

void verican_remote_socketcan_attach(verican_remote_socketcan_t *s, int fd) { s->fd = fd; }

verican_remote_port_t verican_remote_socketcan_port(verican_remote_socketcan_t *s) {
  return (verican_remote_port_t){
      .send = socketcan_send, .receive = socketcan_receive, .now_us = socketcan_now, .context = s};
}

void verican_remote_socketcan_close(verican_remote_socketcan_t *s) {
  if (s->fd >= 0) close(s->fd);
  s->fd = -1;
}
