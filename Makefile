# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# The front door: every target installs what it needs, builds, runs and says what it did.
# "make help" lists the targets; "make V=1 ..." shows the build's own output.

# A variable of the environment that is empty counts as not given.
PRESET := $(or $(PRESET),release)
# One for each core; in a job of a cluster two.
JOBS   := $(or $(JOBS),$(if $(filter 1,$(SLURM)),2,$(shell n=$$(nproc) && echo $$((n > 64 ? 64 : n)))))
LINUX  ?= build/linux
PREFIX := $(or $(PREFIX),/usr/local)
BUILD  := build/$(PRESET)
OUT    := $(BUILD)/out

# $(call on,NAME): 1 if the option NAME is on, nothing if it is 0 or not given.
on      = $(if $(filter-out 0 1,$($1))$(word 2,$($1)),$\
            $(error $1 is '$($1)'; allowed: 0 and 1),$(filter 1,$($1)))
# Asked here, so that a mistake is told before anything is built or removed.
options := $(foreach name,ALL SHORT SLURM V,$(if $(call on,$(name)),$(name)))
# Given and empty: cmake would take others without a word.
$(foreach name,JOBS PRESET PREFIX,$(if $(strip $($(name))),,$(error $(name) is empty; allowed: a value, or no $(name))))
$(if $(filter ~%,$(PREFIX)),$(error PREFIX is '$(PREFIX)'; allowed: a path without ~, which only shells replace))
QUIET   := tools/quiet.sh$(if $(filter V,$(options)), --show)

.DEFAULT_GOAL := help
.PHONY: help packages build install demo test test-linux campaign lint bench synth dist boards hx8k coverage coverage-rtl size wave rules rows registers docs format clean

help:  ## List the targets
	@echo "VeriCAN: a CAN 2.0 controller in RTL and its bus simulator"
	@sed -n 's/^\([a-z0-9-]*\):.*## */\1|/p' Makefile | while IFS='|' read -r t d; do \
	    printf '  make %-10s %s\n' "$$t" "$$d"; done
	@echo "Options: PRESET=release|debug|asan  JOBS=$(JOBS)  V=1 (show the build)"

packages:  ## Install what the project needs (packages.txt)
	@tools/install-packages.sh

$(BUILD)/build.ninja: | packages
	@$(QUIET) "Configuring ($(PRESET))" cmake --preset $(PRESET)

build: packages $(BUILD)/build.ninja  ## Build the library, the tool and the tests
	@$(QUIET) "Building ($(PRESET))" cmake --build $(BUILD) -j $(JOBS)

install: packages $(BUILD)/build.ninja  ## Install tool, libraries and RTL: make install PREFIX=/opt/verican
	@$(QUIET) "Building what is installed" cmake --build $(BUILD) -j $(JOBS) --target installable
	@$(QUIET) "Installing to $(PREFIX)" cmake --install $(BUILD) --prefix "$(PREFIX)"

demo: packages $(BUILD)/build.ninja  ## Controllers exchange frames: examples, the paper's experiments, firmware, python-can, SystemC, a real recording
	@$(QUIET) "Building the tool" cmake --build $(BUILD) -j $(JOBS) --target verican verican_python firmware systemc_platform
	@tools/demo.sh $(BUILD) $(OUT)

test: build  ## Run every test and check that every protocol rule has one
	@tools/install-packages.sh packages-docs.txt
	@tools/test.sh $(BUILD) $(JOBS)

test-linux: packages $(BUILD)/build.ninja  ## Run Linux's own driver on the core (SHORT=1: fewer cases)
	@tools/linux-test.sh $(BUILD) $(JOBS) $(LINUX) $(if $(filter SHORT,$(options)),--short)

campaign: packages  ## The whole verification campaign, hours: STAGES=matrix,formal SEED=1 SCALE=0.01 RESUME=1 (docs/verification.md); SLURM=1 (docs/cluster.md)
	@SEED=$(SEED) SCALE=$(SCALE) RESUME=$(RESUME) JOBS=$(JOBS) SHARDS=$(SHARDS) RETRIES=$(RETRIES) \
	    SBATCH="$(SBATCH)" tools/campaign.py --only "$(STAGES)" $(if $(filter SLURM,$(options)),--slurm)

lint: packages  ## Check RTL with Verilator, Yosys, Icarus; C++ with clang-format and clang-tidy
	@$(QUIET) "Configuring ($(PRESET))" cmake --preset $(PRESET)
	@tools/lint.sh $(BUILD)

bench: packages $(BUILD)/build.ninja  ## Measure the simulator's speed; writes docs/performance.md
	@$(QUIET) "Building" cmake --build $(BUILD) -j $(JOBS)
	@tools/bench.sh $(BUILD)

synth: $(if $(FAMILY),packages,boards)  ## Measure area and clock rate (iCE40, VersaTiles); FAMILY=ecp5 or all: area in other families
	@$(if $(FAMILY),/usr/bin/python3 tools/families.py $(FAMILY),tools/synth.sh)

dist: packages  ## The archives of a release in build/dist, reproducible, and all checks of them
	@tools/dist.sh build/dist

boards: packages $(BUILD)/build.ninja  ## Bitstreams of the boards with a remote node; netlists and bitstreams run on the simulated bus
	@tools/boards.sh build/boards
	@tools/boards-test.sh $(BUILD) build/boards $(JOBS)

hx8k: packages $(BUILD)/build.ninja  ## Bitstream of examples/hx8k, a CAN node at a serial port; its netlist runs on the simulated bus
	@tools/hx8k.sh build/hx8k
	@tools/boards-test.sh $(BUILD) build/hx8k $(JOBS) VERICAN_HX8K hx8k_tests hx8k.node_

coverage: packages $(BUILD)/build.ninja  ## Measure which lines of the C driver its tests run
	@tools/driver-coverage.sh $(BUILD)

coverage-rtl: packages  ## Measure line, branch and toggle coverage of the RTL over its tests
	@tools/coverage.py --jobs $(JOBS)

size: packages  ## Build the C driver for a Cortex-M3 and print its size, per function and in total
	@tools/driver-size.sh

wave: build  ## Run one test with waveforms: make wave TEST=LoserContends
	@tools/wave.sh $(BUILD) "$(TEST)"

rules: packages  ## Regenerate docs/rules.md, remote-rules.md and time-rules.md, the tables of rules and tests
	@/usr/bin/python3 tools/rules.py
	@/usr/bin/python3 tools/remote_rules.py
	@/usr/bin/python3 tools/time_rules.py
	@/usr/bin/python3 tools/packaging_rules.py

rows: packages  ## Regenerate docs/flexcan-rows.md, the table of FlexCAN rows and their tests
	@/usr/bin/python3 tools/flexcan_rows.py

registers: packages  ## Regenerate what is made from the register map, sw/registers.yaml
	@/usr/bin/python3 tools/registers.py

docs: packages  ## Build the documentation as a searchable site that needs no network, with Doxygen's reference
	@tools/install-packages.sh packages-docs.txt
	@tools/site.py

format: packages  ## Let clang-format rewrite our C++
	@git ls-files '*.cpp' '*.hpp' '*.c' '*.h' | xargs -r clang-format -i

clean:  ## Remove what was built, but for the Linux kernel (ALL=1: that, too)
	@if [ -d build ]; then \
	    find build -mindepth 1 -maxdepth 1 $(if $(filter ALL,$(options)),,! -name linux) -exec rm -rf {} +; fi
