# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""profiles: the builds of sw/profiles.yaml, which lies beside the RTL."""
import yaml

# What a core has if a profile does not say that it has not.
FEATURES = ("Fifo", "Abort", "Status", "OwnMasks", "Wake", "Extras", "ClearRam")


def load_profiles(rtl):
    """name -> parameters of the profile; `rtl` is the folder with can.f."""
    text = (rtl.parent / "sw/profiles.yaml").read_text(encoding="utf-8")
    return {name: entry["parameters"] for name, entry in yaml.safe_load(text)["profiles"].items()}