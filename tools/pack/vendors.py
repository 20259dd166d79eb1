# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""vendors: scripts for the packagers of Vivado, Quartus (Platform Designer) and Libero. The tools
were not run; tb/integration/packages.py runs the scripts in tclsh with the tools' commands
recorded.
"""
from pack.shell import window_parameters, window_ports
from pack.wrappers import PACKAGED, rtl_files, version

HEAD = """\
# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# {what}
# Written by tools/package.py. Not run by {tool}: checked by running it in tclsh with the
# commands of {tool} replaced by recorders.
set root [file normalize [file join [file dirname [info script]] .. ..]]
"""
TAGS = {"NumMb": (16, 32, 64)}  # what a parameter may be, where it is not 0 or 1 or any
SWITCHES = ("Fifo", "Abort", "Status", "OwnMasks", "Wake", "Extras", "ClearRam", "TimeUnit",
            "TimeSync", "CheckProt", "CheckHprot", "Pipelined")


def tcl_list(names):
    """The files as lines of a Tcl list."""
    return " \\\n".join(f"    [file join $root {name}]" for name in names)


def allowed(name):
    """The values that a parameter may take; empty: any."""
    return TAGS.get(name, (0, 1) if name in SWITCHES else ())


def vivado_bus(wrapper):
    """The bus with its memory map, clock and reset. The tool's own guess has a name that depends on
    the ports, so it is taken back."""
    bus = "[ipx::get_bus_interfaces s -of_objects $core]"
    return [
        "ipx::remove_all_bus_interface $core\n",
        "foreach map [ipx::get_memory_maps -of_objects $core] {\n"
        "  ipx::remove_memory_map [get_property NAME $map] $core\n}\n",
        "ipx::add_bus_interface s $core\n", f"set bus {bus}\n",
        "set_property abstraction_type_vlnv xilinx.com:interface:aximm_rtl:1.0 $bus\n",
        "set_property bus_type_vlnv xilinx.com:interface:aximm:1.0 $bus\n",
        "set_property interface_mode slave $bus\n",
        "set_property value AXI4LITE [ipx::add_bus_parameter PROTOCOL $bus]\n",
        *[f"set_property physical_name {port.name} [ipx::add_port_map {port.name.upper()} $bus]\n"
          for port in wrapper.bus_ports[2:]],
        f"ipx::infer_bus_interface {wrapper.clock} xilinx.com:signal:clock_rtl:1.0 $core\n",
        f"ipx::infer_bus_interface {wrapper.reset} xilinx.com:signal:reset_rtl:1.0 $core\n",
        "ipx::infer_bus_interface irq_o xilinx.com:signal:interrupt_rtl:1.0 $core\n",
        f"ipx::associate_bus_interfaces -busif s -clock {wrapper.clock} $core\n",
        f"ipx::associate_bus_interfaces -clock {wrapper.clock} -reset {wrapper.reset} $core\n",
        "ipx::add_memory_map registers $core\n",
        "set_property slave_memory_map_ref registers $bus\n",
        "set block [ipx::add_address_block can [ipx::get_memory_maps registers -of_objects "
        "$core]]\n",
        f"set_property range {1 << PACKAGED['RegionBits']} $block\n",
        "set_property width 32 $block\n", "set_property usage register $block\n"]


def vivado(wrapper):
    """fpga/vivado/package.tcl."""
    lines = [HEAD.format(what="package.tcl: packages the core on AXI4-Lite for Vivado's IP "
                         "catalog: vivado -mode batch -source package.tcl", tool="Vivado"),
             "create_project -force -in_memory verican\n",
             f"set files [list \\\n{tcl_list(rtl_files())} \\\n"
             f"    [file join $root verilog {wrapper.module}_v.v]]\n",
             "add_files -norecurse $files\n",
             f"set_property top {wrapper.module}_v [current_fileset]\n",
             "ipx::package_project -root_dir [file join $root fpga vivado ip] -vendor verican "
             "-library ip -taxonomy /UserIP -import_files\n",
             "set core [ipx::current_core]\n",
             "set_property name can $core\n", f"set_property version {version()} $core\n",
             "set_property display_name {VeriCAN CAN 2.0 controller} $core\n",
             *vivado_bus(wrapper)]
    for entry in wrapper.parameters:
        lines.append(f"set parameter [ipx::get_user_parameters {entry.name} -of_objects $core]\n")
        if entry.packaged != entry.number:   # Vivado has read the others
            lines.append(f"set_property value {entry.packaged} $parameter\n")
        if allowed(entry.name):
            lines.append("set_property value_validation_type list $parameter\n"
                         "set_property value_validation_list {"
                         + " ".join(map(str, allowed(entry.name))) + "} $parameter\n")
    lines += ["ipx::create_xgui_files $core\n", "ipx::update_checksums $core\n",
              "ipx::save_core $core\n"]
    return "".join(lines)


def quartus(wrapper):
    """fpga/quartus/can_hw.tcl. Platform Designer takes the width of the address for the size of the
    slave, so that the top is the shell whose addresses end with the window."""
    top = f"{wrapper.module}_window"
    ports = window_ports(wrapper)
    after_bus = len(wrapper.bus_ports)
    lines = [HEAD.format(what="can_hw.tcl: the core on AXI4-Lite as a component of Platform "
                         "Designer; its folder goes into the IP search path.", tool="Quartus"),
             "package require -exact qsys 16.1\n",
             "set_module_property NAME verican_can\n",
             f"set_module_property VERSION {version()}\n",
             "set_module_property DISPLAY_NAME {VeriCAN CAN 2.0 controller}\n",
             "set_module_property GROUP {Interface Protocols}\n",
             "add_fileset rtl QUARTUS_SYNTH {} {}\n",
             f"set_fileset_property rtl TOP_LEVEL {top}\n"]
    for name in rtl_files():
        lines.append(f"add_fileset_file {name} SYSTEM_VERILOG PATH [file join $root {name}]\n")
    lines.append(f"add_fileset_file verilog/{top}.v VERILOG PATH "
                 f"[file join $root verilog {top}.v]\n")
    for entry in window_parameters(wrapper):
        default = f"STD_LOGIC_VECTOR {entry.number:#x}" if entry.width else \
            f"INTEGER {entry.number}"
        lines.append(f"add_parameter {entry.name} {default}\n"
                     f"set_parameter_property {entry.name} HDL_PARAMETER true\n")
        if entry.width:
            lines.append(f"set_parameter_property {entry.name} WIDTH {entry.width}\n")
        if allowed(entry.name):
            lines.append(f"set_parameter_property {entry.name} ALLOWED_RANGES {{"
                         + " ".join(map(str, allowed(entry.name))) + "}\n")
    lines += ["add_interface clock clock end\n",
              f"add_interface_port clock {wrapper.clock} clk Input 1\n",
              "add_interface reset reset end\n",
              "set_interface_property reset associatedClock clock\n",
              f"add_interface_port reset {wrapper.reset} reset_n Input 1\n",
              "add_interface s axi4lite end\n",
              "set_interface_property s associatedClock clock\n",
              "set_interface_property s associatedReset reset\n",
              "set_interface_property s CMSIS_SVD_FILE [file join $root sw verican.svd]\n"]
    for port in ports[2:after_bus]:
        lines.append(f"add_interface_port s {port.name} {port.name} {port.direction.capitalize()} "
                     f"{port.width}\n")
    lines += ["add_interface irq interrupt end\n",
              "set_interface_property irq associatedAddressablePoint s\n",
              "set_interface_property irq associatedClock clock\n",
              "set_interface_property irq associatedReset reset\n",
              "add_interface_port irq irq_o irq Output 1\n",
              "add_interface can conduit end\n"]
    for port in ports[after_bus + 1:]:
        lines.append(f"add_interface_port can {port.name} {port.name} "
                     f"{port.direction.capitalize()} {port.width}\n")
    return "".join(lines)


# Libero's names of the signals of its bus definitions; APB of AMBA 2 has no PSTRB and PPROT.
LIBERO = {"apb": ("APB:AMBA:AMBA2:slave", {"psel": "PSELx"}, {"pstrb": 15, "pprot": 1}),
          "ahb": ("AHB:AMBA:AMBA2:slave", {"hsel": "HSELx", "hready": "HREADYIN",
                                           "hreadyout": "HREADY"}, {})}


def libero(found):
    """fpga/libero/hdl_core.tcl."""
    lines = [HEAD.format(what="hdl_core.tcl: the core as HDL+ of SmartDesign, on APB and AHB-Lite: "
                         "source it in an open project.", tool="Libero"),
             f"set files [list \\\n{tcl_list(rtl_files())}]\n",
             "foreach file $files {create_links -hdl_source $file}\n", "build_design_hierarchy\n"]
    for wrapper in found:
        if wrapper.bus not in LIBERO:
            continue
        definition, names, ties = LIBERO[wrapper.bus]
        core = wrapper.module
        lines += [f"create_hdl_core -file [file join $root {wrapper.file}] -module {core} "
                  "-library {work}\n",
                  f"hdl_core_add_bif -hdl_core_name {core} -bif_definition {{{definition}}} "
                  "-bif_name {s} -signal_map {}\n"]
        for port in wrapper.bus_ports[2:]:
            if port.name in ties:
                lines.append(f"# In SmartDesign: sd_connect_pins_to_constant or a constant of "
                             f"{ties[port.name]} at {port.name}: this bus has no such signal.\n")
                continue
            lines.append(f"hdl_core_assign_bif_signal -hdl_core_name {core} -bif_name {{s}} "
                         f"-bif_signal_name {{{names.get(port.name, port.name.upper())}}} "
                         f"-core_signal_name {{{port.name}}}\n")
    return "".join(lines)


def render(found):
    """path -> text."""
    by_bus = {wrapper.bus: wrapper for wrapper in found}
    files = {"fpga/libero/hdl_core.tcl": libero(found)}
    if "axil" in by_bus:
        files["fpga/vivado/package.tcl"] = vivado(by_bus["axil"])
        files["fpga/quartus/can_hw.tcl"] = quartus(by_bus["axil"])
    return files
