/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * What check.c and peer.c agree on.
 */
#ifndef MCUX_PARTNER_H
#define MCUX_PARTNER_H

/** Bit of the identifier that an answer has more than the frame that it answers. */
#define ANSWER 0x400u
/** Bits of the data that an answer has inverted. */
#ifndef INVERTED
#define INVERTED 0xFFu
#endif
/** Identifier of the remote frame, and a byte of the data frame that answers it. */
#define REMOTE_ID 0x2A5u
#define REMOTE_BYTE(i) (0xA0u + (i))
/** Asks for data[0] frames without a pause, data[1] ms later: BURST_ID, numbered in data[0]. */
#define ORDER_ID 0x2B0u
#define BURST_ID 0x4C0u
/** A frame of this identifier ends the partner. */
#define END_ID 0x3FFu
/** From when on the partner listens, microseconds. */
#define READY_US 2000u

#endif /* MCUX_PARTNER_H */
