# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# can.mk: bitstream of can_ahb for an HX8K, to see it placed and timed as it is, without a harness:
#   make -f constraints/ice40/can.mk            in the project's root
# A design of your own takes the Yosys line, adds its own files and replaces the top.
# With plain abc: abc9 stops at some sizes ("Boxes are not in a topological order"), a fault of abc's.
# Newer Yosys take abc9 unless told not to.
RTL   := $(addprefix rtl/,$(shell sed 's/\#.*//' rtl/can.f))
TOP   ?= can_ahb
NUMMB ?= 32
OUT   := build/ice40
BUILD := $(OUT)/$(TOP)_$(NUMMB)
PLAIN := $(shell yosys -p 'help synth_ice40' | grep -o -m 1 -e -noabc9)

.DELETE_ON_ERROR:

$(BUILD).bin: $(BUILD).asc
	icepack $< $@

$(BUILD).asc: $(BUILD).json constraints/ice40/can.pcf
	nextpnr-ice40 --hx8k --package ct256 --json $< --pcf constraints/ice40/can.pcf \
	  --pcf-allow-unconstrained --freq 12 --asc $@ --log $(BUILD).log -q

$(BUILD).json: $(RTL)
	mkdir -p $(OUT)
	yosys -q -p "read_verilog -sv $(RTL); hierarchy -check -top $(TOP) -chparam NumMb $(NUMMB); \
	  synth_ice40 $(PLAIN) -device hx -top $(TOP) -json $@"
