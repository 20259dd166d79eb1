# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""profiles: the builds of sw/profiles.yaml, which lies beside the RTL. LiteX comes without PyYAML,
so the file is read as what it is: of each profile a map of numbers.
"""
import re

# What a core has if a profile does not say that it has not.
FEATURES = ("Fifo", "Abort", "Status", "OwnMasks", "Wake", "Extras", "ClearRam")
PROFILE = re.compile(r"^  (\w+):\n(?:    .*\n)*?    parameters: \{([^}]*)\}", re.MULTILINE)


def load_profiles(rtl):
    """name -> parameters of the profile; `rtl` is the folder with can.f."""
    text = (rtl.parent / "sw/profiles.yaml").read_text(encoding="utf-8")
    return {name: {parameter: int(value)
                   for parameter, value in re.findall(r"(\w+):\s*(\d+)", parameters)}
            for name, parameters in PROFILE.findall(text)}
