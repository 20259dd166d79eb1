# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# libero.tcl: makes a Libero SoC project for an A2F500M3G-FG484 from rtl/can.f, with can_ahb as root.
# Use: libero SCRIPT:constraints/smartfusion/libero.tcl   (in the project's root)
# Add the microcontroller subsystem and its AHB-Lite fabric master in SmartDesign afterwards.
# Not run by Libero; tb/integration/smartfusion.py checks the names in it.
set root [file normalize [file join [file dirname [info script]] .. ..]]
set project [file join $root build libero]

# The list of RTL files, in the order of the data path; the comments in it start with '#'.
proc rtl_files {root} {
  set files {}
  set list [open [file join $root rtl can.f] r]
  while {[gets $list line] >= 0} {
    set name [string trim [lindex [split $line "#"] 0]]
    if {$name ne ""} {lappend files [file join $root rtl $name]}
  }
  close $list
  return $files
}

new_project -location $project -name verican -hdl {VERILOG} -family {SmartFusion} \
    -die {A2F500M3G} -package {484 FBGA} -speed {STD}
foreach file [rtl_files $root] {
  import_files -hdl_source $file
}
import_files -sdc [file join $root constraints smartfusion can.sdc]
import_files -pdc [file join $root constraints smartfusion can.pdc]
set_root can_ahb
save_project
run_tool -name {SYNTHESIZE}
