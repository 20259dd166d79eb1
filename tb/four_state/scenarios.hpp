// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// What happens to the recorded core: short runs that lead through its functions.
#pragma once

#include <vector>

#include "mailbox/mailbox_rig.hpp"

namespace vericansim {

/// One recording. Node 0 of the rig is recorded, node 1 is its peer; both come from reset.
struct Recording {
  const char *name;
  void (*run)(MailboxRig &rig);
};

/// All of them; each throws std::runtime_error if the core does not do what the run is about.
const std::vector<Recording> &recordings();

}  // namespace vericansim
