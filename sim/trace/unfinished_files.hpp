// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// Files that are written aside, under names that nobody knows, until they take their place: what a
// signal that ends the process has to remove.
#pragma once

#include <string>

namespace vericansim {

/// `path` is one of them from now on.
void note_unfinished(const std::string &path);
/// It is none any more; nothing happens if it was none.
void forget_unfinished(const std::string &path);

/// Removes all of them. A signal handler may call it.
void remove_unfinished();

}  // namespace vericansim
