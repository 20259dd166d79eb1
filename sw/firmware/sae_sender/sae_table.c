/* SPDX-FileCopyrightText: 2026 The VeriCAN authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * The SAE class-C messages. Made by make_table.py; do not edit.
 */
#include "sae_table.h"

/* clang-format off */
const sae_message_t sae_table[SAE_MESSAGES] = {
    {1, 1, 50}, /* message 17 */
    {2, 2, 5}, /* message 16 */
    {3, 1, 5}, /* message 15 */
    {4, 2, 5}, /* message 14 */
    {5, 1, 5}, /* message 13 */
    {6, 2, 5}, /* message 12 */
    {7, 6, 10}, /* message 11 */
    {8, 1, 10}, /* message 10 */
    {9, 2, 10}, /* message 9 */
    {10, 2, 10}, /* message 8 */
    {11, 1, 100}, /* message 7 */
    {12, 4, 100}, /* message 6 */
    {13, 1, 100}, /* message 5 */
    {14, 1, 100}, /* message 4 */
    {15, 3, 1000}, /* message 3 */
    {16, 1, 1000}, /* message 2 */
    {17, 1, 1000}, /* message 1 */
};
