/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * Between the two files of the port.
 */
#ifndef CO_VERICAN_H
#define CO_VERICAN_H

#include "CO_driver_target.h"

/** on_sent of the driver: a mailbox is free again. */
void co_verican_sent(void *user, verican_t *dev, const verican_tx_event_t *event);

/** Under lock: hands what waits to the driver. Behind a start nothing else would, as no frame ends.
 */
void co_verican_send_waiting(CO_CANmodule_t *module);

#endif /* CO_VERICAN_H */
