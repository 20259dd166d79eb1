# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""The rows of the register tests: initialisers of struct RegisterRow (register_table.hpp)."""
from regmap.model import LAST_MB, MORE_THAN_32, NUM_MB, camel_to_snake, single_builds

HEAD = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// The registers for their tests: initialisers of RegisterRow, see register_table.hpp. Written by
// tools/registers.py from sw/registers.yaml; edits are lost.
// clang-format off
"""

ACCESSES = ("ro", "w1c", "rc", "w1s", "wo")
WRITES = ("any", "freeze", "disable", "wrn_en")


def conditions(register, features):
    """Which bits belong to a feature, and what they read without it."""
    for feature in features:
        mask = 0xFFFFFFFF if register.feature == feature.name else \
            register.feature_mask(feature.name)
        if mask:
            yield f".needs_{camel_to_snake(feature.name)} = 0x{mask:08X}"
    fixed = sum(part.without << part.low for part in register.fields if part.without != LAST_MB)
    if fixed:
        yield f".without = 0x{fixed:08X}"
    if any(part.without == LAST_MB for part in register.fields):
        yield ".without_adds_last_mb = true"


def members(register, name, offset, count, stride, features):
    """The members that are not what the struct has without an initialiser."""
    yield f'.name = "{name}"'
    yield f".offset = 0x{offset:03X}"
    if count != 1:
        yield f".count = {0 if count == NUM_MB else count}, .stride = {stride}"
    if register.per_buffer is not None:
        yield f".first_buffer = {register.per_buffer}"
    if register.only_if == MORE_THAN_32:
        yield ".min_num_mb = 64"
    if register.in_ram:
        yield ".in_ram = true"
    if any(part.reset == NUM_MB for part in register.fields):
        yield ".adds_num_mb = true"
    words = {"reset": register.value("reset", 0),
             "after_soft_reset": register.value("after_soft_reset", 0),
             "kept": register.mask(lambda part: part.kept),
             "live": register.mask(lambda part: part.live)}
    for access in ACCESSES:
        words[access] = register.mask(lambda part, access=access: part.access == access)
    for write in WRITES:
        words[write] = register.mask(
            lambda part, write=write: part.writable and part.write == write)
    for word, value in words.items():
        if value:
            yield f".{word} = 0x{value:08X}"
    yield from conditions(register, features)


def row(*arguments):
    """One initialiser, in lines of at most 100 columns."""
    lines, line = [], "{"
    for member in members(*arguments):
        if len(line) + len(member) > 96:
            lines.append(line.rstrip())
            line = " "
        line += member + ", "
    return "\n".join([*lines, line[:-2] + "},"])


def render(regmap):
    """The text of the file."""
    rows = [row(one, one.name, one.offset, one.count, one.stride, regmap.features)
            for one in regmap.registers]
    block = regmap.buffers
    rows += [row(one, f"{block.name} {one.name}", block.offset + one.offset, block.count,
                 block.stride, regmap.features) for one in regmap.words]
    return HEAD + "\n".join(rows) + "\n"


BUILDS = """\
// SPDX-FileCopyrightText: 2026 The VeriCAN authors
// SPDX-License-Identifier: Apache-2.0
//
// {what}: initialisers of CoreBuild, see core_build.hpp. Written by
// tools/registers.py from {source}; edits are lost.
// clang-format off
"""


def build(name, parameters, features):
    """One profile."""
    other = [f".{camel_to_snake(feature.name)} = {str(not feature.default).lower()}"
             for feature in features
             if parameters.get(feature.name, feature.default) != feature.default]
    return (f'{{.name = "{name}", .num_mb = {parameters[NUM_MB]},\n'
            f" .features = {{{', '.join(other)}}}}},".replace(", .wake", ",\n  .wake"))


def builds(regmap, named, head):
    """The text of a file of builds, {name: parameters}."""
    return head + "\n".join(build(name, parameters, regmap.features)
                            for name, parameters in named.items()) + "\n"


def render_builds(regmap, profiles):
    """The text of the profiles' file."""
    return builds(regmap, profiles, BUILDS.format(what="The profiles of the core",
                                                  source="sw/profiles.yaml"))


def render_single_builds(regmap):
    """The text of the file of the builds that lack one feature."""
    return builds(regmap, single_builds(regmap), BUILDS.format(
        what="Cores that lack one feature each", source="sw/registers.yaml"))
