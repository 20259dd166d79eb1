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
    try:
        # Escapes beyond 16 bits would be those of JSON alone.
        text = json.dumps(scenario, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
        text.encode()  # UnicodeEncodeError, a ValueError: half a character
    except (TypeError, ValueError, RecursionError) as error:
        raise ValueError(f"scenario: {error}; allowed: what JSON can hold") from error
    return text


class Bus(_core.Bus):
    """A bus. `scenario`: the name of a file, or what would stand in it as a dictionary."""

    def __init__(self, nodes, *, scenario="", **settings):
        super().__init__(nodes, scenario=_scenario_text(scenario), **settings)

    def finish(self):
        """Completes the files of the scenario's outputs and the waveform: after it no step, frame,
        disturb() or restart() (RuntimeError). Returns the report, a dictionary as
        `verican run --json` prints it."""
        return json.loads(self.finish_json())
