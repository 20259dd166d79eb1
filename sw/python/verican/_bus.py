# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""A bus of Verilated controllers: the module's, with scenarios and reports as Python values."""
import json
import os

from . import _core


def _scenario_text(scenario):
    """The name of a file as it is; a dictionary as the text of a file, JSON, which YAML takes."""
    if isinstance(scenario, (str, os.PathLike)):
        return os.fspath(scenario)
    return json.dumps(scenario, indent=1) + "\n"


class Bus(_core.Bus):
    """A bus. `scenario`: the name of a file, or what would stand in it as a dictionary."""

    def __init__(self, nodes, *, scenario="", **settings):
        super().__init__(nodes, scenario=_scenario_text(scenario), **settings)

    def finish(self):
        """Completes the files of the scenario's outputs and the waveform: no step after it, and no
        frame is taken (RuntimeError). Returns the report, a dictionary as `verican run --json`
        prints it."""
        return json.loads(self.finish_json())
