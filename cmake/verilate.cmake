# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican_verilate(<target> TOP <module> [PARAMS Name=value ...] [REPLACE <file> ...]
#                  [FILES <file> ...] [ASSERT]): a static library with the Verilated model of any
# module of rtl/can.f; its class has the name of the target and its header is <target>.h. REPLACE
# files take the places of those of their names in rtl/can.f; FILES are taken instead of all of
# rtl/can.f. With ASSERT an assertion that fails ends the program.
#
# VERICAN_RTL_TRANSFORM: a program that rewrites the RTL before Verilation (a netlist, mutants):
#   <program> OUT.v TOP [Name=value ...] [--keep FILE ...] -- FILE...
# It writes module TOP to OUT.v, instance names and hierarchy kept. The modules of the files after
# --keep stay as they are: C++ reaches their signals by name, and they are Verilated beside OUT.v.
#
# VERICAN_COVERAGE: the models count what of the RTL was run (docs/coverage.md).
include_guard(GLOBAL)
option(VERICAN_COVERAGE "Line, branch and toggle coverage of the Verilated RTL" OFF)
set(VERICAN_RTL_TRANSFORM "" CACHE FILEPATH "Program that rewrites the RTL before it is Verilated")
# The short cuts of sim/node/model_edge.hpp need models without combinational loops. The RTL has
# none; in a netlist bits of one vector that depend on one another are a loop for Verilator.
option(VERICAN_PLAIN_EDGES "Clock transformed models by both edges, without short cuts" ON)
find_program(VERILATOR verilator REQUIRED)
execute_process(COMMAND "${VERILATOR}" --getenv VERILATOR_ROOT
                OUTPUT_VARIABLE VERILATOR_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE)
execute_process(COMMAND "${VERILATOR}" --version OUTPUT_VARIABLE version
                OUTPUT_STRIP_TRAILING_WHITESPACE)
include("${CMAKE_CURRENT_LIST_DIR}/verilator_version.cmake")
verican_has_short_cuts(VERICAN_SHORT_CUTS "${version}")
if(NOT VERICAN_SHORT_CUTS)
  message(STATUS "${version}: the simulator's short cuts are for 5.006, so it is slower")
elseif(VERICAN_COVERAGE OR VERICAN_RTL_TRANSFORM AND VERICAN_PLAIN_EDGES)
  # The short cuts look at members that do not exist in a model that counts; what they pass over
  # would not be counted either.
  set(VERICAN_SHORT_CUTS FALSE)
else()
  include("${CMAKE_CURRENT_LIST_DIR}/short_cuts.cmake")
  set(short_cuts "${PROJECT_SOURCE_DIR}/sim/node/short_cuts.txt")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${short_cuts}" ${VERICAN_RTL})
  file(READ "${short_cuts}" proven)
  verican_short_cuts_fit(VERICAN_SHORT_CUTS "${proven}" ${VERICAN_RTL})
  if(NOT VERICAN_SHORT_CUTS)
    message(STATUS "The RTL is not the one that the simulator's short cuts are proven for: every "
                   "clock is evaluated, which is slower (cmake/short_cuts.cmake)")
  endif()
endif()
find_package(Threads REQUIRED)
# Verilator's run-time library asks whether its atomics are free of locks; clang leaves the answer
# to libatomic, which is part of GCC.
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("#include <atomic>
  int main(int n, char**) { std::atomic<int> a{n}; return a.is_lock_free() ? 0 : 1; }"
  VERICAN_ATOMICS_INLINE)
if(NOT VERICAN_ATOMICS_INLINE)
  set(VERICAN_ATOMIC atomic)
  set(VERICAN_ATOMIC_OPTION -latomic)  # for vericansim.pc
endif()

# The run-time library of all models, once.
add_library(verilated_runtime STATIC "${VERILATOR_ROOT}/include/verilated.cpp"
                                     "${VERILATOR_ROOT}/include/verilated_threads.cpp")
target_include_directories(verilated_runtime SYSTEM PUBLIC "${VERILATOR_ROOT}/include"
                                                           "${VERILATOR_ROOT}/include/vltstd")
target_compile_options(verilated_runtime PRIVATE -w -fno-semantic-interposition)
set_target_properties(verilated_runtime PROPERTIES POSITION_INDEPENDENT_CODE ON)
if(VERICAN_COVERAGE)
  find_program(VERICAN_COVERAGE_PYTHON python3 REQUIRED)
  target_sources(verilated_runtime PRIVATE "${PROJECT_SOURCE_DIR}/cmake/coverage_writer.cpp")
  target_include_directories(verilated_runtime PUBLIC
                             "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cmake>")
endif()
target_link_libraries(verilated_runtime PUBLIC Threads::Threads ${VERICAN_ATOMIC})
if(NOT VERICAN_SHORT_CUTS)
  target_compile_definitions(verilated_runtime PUBLIC VERICAN_PLAIN_EDGES)
endif()

# Speed: no X, no assertions, no waves inside the model (observers read trace_o), and enabled blocks
# stay whole, so that what changes once a bit is skipped in the clocks between; lint is `make
# lint`.
set(VERICAN_VERILATOR_FLAGS --cc -O3 -fno-split --x-assign fast --x-initial fast --no-assert
    --output-split 0 --no-timing -Wno-lint -Wno-style)

function(verican_verilate target)
  cmake_parse_arguments(ARG "ASSERT" "TOP" "PARAMS;REPLACE;FILES" ${ARGN})
  set(assert "")
  if(ARG_ASSERT)
    set(assert --assert)
  endif()
  set(files ${VERICAN_RTL})
  if(ARG_FILES)
    set(files ${ARG_FILES})
  endif()
  foreach(file IN LISTS ARG_REPLACE)
    get_filename_component(name "${file}" NAME)
    list(TRANSFORM files REPLACE "^.*/${name}$" "${file}")
  endforeach()
  set(dir "${CMAKE_CURRENT_BINARY_DIR}/${target}.dir")
  set(all "${dir}/${target}__all.cpp")
  list(TRANSFORM ARG_PARAMS PREPEND "-G" OUTPUT_VARIABLE parameters)
  set(verilated ${files})
  set(transform "${CMAKE_COMMAND}" -E true)
  if(VERICAN_RTL_TRANSFORM)
    set(netlist "${CMAKE_CURRENT_BINARY_DIR}/${target}.transformed.v")
    set(transform "${VERICAN_RTL_TRANSFORM}" "${netlist}" ${ARG_TOP} ${ARG_PARAMS})
    if(ARG_REPLACE)
      list(APPEND transform --keep ${ARG_REPLACE})
    endif()
    list(APPEND transform -- ${files})
    set(verilated "${VERICAN_RTL_DIR}/can_pkg.sv" "${netlist}" ${ARG_REPLACE})
    # All state must lie in the model's root, where sim/node/split_core.hpp looks for changes.
    set(parameters --flatten)
    if(VERICAN_PLAIN_EDGES)
      list(APPEND parameters -Wno-UNOPTFLAT)
    endif()
  endif()
  set(coverage "${CMAKE_COMMAND}" -E true)
  set(coverage_flags "")
  set(coverage_script "")
  if(VERICAN_COVERAGE)
    set(coverage_flags --coverage-line --coverage-toggle)
    set(coverage_script "${PROJECT_SOURCE_DIR}/cmake/coverage_model.py")
    set(coverage "${VERICAN_COVERAGE_PYTHON}" "${coverage_script}" "${dir}" ${target}
                 "${PROJECT_SOURCE_DIR}")
  endif()
  # One source file that includes the others: their number is known only after Verilator has run,
  # and the compiler sees the whole model at once.
  add_custom_command(
    OUTPUT "${all}" "${dir}/${target}.h"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${dir}"
    COMMAND ${transform}
    COMMAND "${VERILATOR}" ${VERICAN_VERILATOR_FLAGS} ${assert} --prefix ${target} --Mdir "${dir}"
            --top-module ${ARG_TOP} ${parameters} ${coverage_flags} ${verilated}
    COMMAND ${coverage}
    COMMAND "${CMAKE_COMMAND}" -DDIR=${dir} -DNAME=${target} -DOUTPUT=${all}
            -DSHORT_CUTS=${VERICAN_SHORT_CUTS} -DASSERT=${ARG_ASSERT}
            -P "${PROJECT_SOURCE_DIR}/cmake/include_all.cmake"
    DEPENDS ${files} "${PROJECT_SOURCE_DIR}/cmake/include_all.cmake" ${VERICAN_RTL_TRANSFORM}
            ${coverage_script}
    COMMENT "Verilating ${ARG_TOP} ${ARG_PARAMS}"
    VERBATIM)
  add_library(${target} STATIC "${all}")
  # Models are 5 % faster by -O1 than by -O2, which also takes longer, over one that counts what is
  # covered five times as long.
  target_compile_options(${target} PRIVATE -w $<$<CONFIG:Release>:-O1>)
  target_include_directories(${target} SYSTEM PUBLIC "${dir}")
  target_link_libraries(${target} PUBLIC verilated_runtime)
endfunction()
