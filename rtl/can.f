# RTL in the order of the data path; CMake, Yosys, Icarus, Libero Tcl and FuseSoC read this list.
can_pkg.sv
bit/can_sync.sv
bit/can_tq_gen.sv
bit/can_bit_timing.sv
frame/can_stuff.sv
frame/can_crc15.sv
frame/can_field.sv
frame/can_rx_frame.sv
frame/can_tx_frame.sv
frame/can_error.sv
frame/can_fault.sv
frame/can_bsp.sv
can_core.sv
