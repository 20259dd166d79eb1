# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# What `cmake --install` installs: the tool, the libraries with their headers, CMake package and
# pkg-config files (docs/install.md), the driver's sources, the RTL and what belongs to it. Each
# part is an install component of its own: tool, sim, systemc, driver, python, rtl, doc. Nothing in
# an installed tree knows where it lies.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(VERICAN_CMAKE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/verican")
set(VERICAN_DATA_DIR "${CMAKE_INSTALL_DATADIR}/verican")
foreach(dir LIBDIR INCLUDEDIR DATADIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${dir}}")
    message(FATAL_ERROR "CMAKE_INSTALL_${dir} is ${CMAKE_INSTALL_${dir}}: it must be relative to "
                        "the prefix, so that an installed tree can be moved")
  endif()
endforeach()
file(RELATIVE_PATH VERICAN_PREFIX_OF_PC "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/p")
string(REGEX REPLACE "/$" "" VERICAN_PREFIX_OF_PC "${VERICAN_PREFIX_OF_PC}")

# verican_install_library(<component> <target> <pc file> <include dir, or several>): the archive,
# its exported target verican::<component>, and its pkg-config file cmake/<pc file>.pc.in.
function(verican_install_library component target pc)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
  foreach(dir IN LISTS ARGN)
    target_include_directories(${target} INTERFACE "$<INSTALL_INTERFACE:${dir}>")
  endforeach()
  install(TARGETS ${target} EXPORT verican-${component}
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT ${component})
  install(EXPORT verican-${component} NAMESPACE verican:: FILE verican-${component}.cmake
          DESTINATION "${VERICAN_CMAKE_DIR}" COMPONENT ${component})
  configure_file("${PROJECT_SOURCE_DIR}/cmake/${pc}.pc.in" "${PROJECT_BINARY_DIR}/${pc}.pc" @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/${pc}.pc"
          DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${component})
  # Every component is a package: the same files, whichever are installed.
  install(FILES "${PROJECT_BINARY_DIR}/verican-config.cmake"
                "${PROJECT_BINARY_DIR}/verican-config-version.cmake"
          DESTINATION "${VERICAN_CMAKE_DIR}" COMPONENT ${component})
endfunction()

configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/verican-config.cmake.in"
  "${PROJECT_BINARY_DIR}/verican-config.cmake" INSTALL_DESTINATION "${VERICAN_CMAKE_DIR}"
  PATH_VARS VERICAN_DATA_DIR NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file("${PROJECT_BINARY_DIR}/verican-config-version.cmake"
  COMPATIBILITY SameMinorVersion)

# The simulator. Its headers are those of its folders, but for what only its own sources include
# (Verilated classes, YAML) and for the peer of Linux's driver.
set(include_dir "${CMAKE_INSTALL_INCLUDEDIR}/vericansim")
verican_install_library(sim vericansim vericansim "${include_dir}" "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sim/" DESTINATION "${include_dir}" COMPONENT sim
  FILES_MATCHING PATTERN "*.hpp"
  PATTERN "cli" EXCLUDE PATTERN "bridge" EXCLUDE PATTERN "linux" EXCLUDE
  PATTERN "timesync" EXCLUDE
  PATTERN "systemc" EXCLUDE PATTERN "page" EXCLUDE
  PATTERN "python" EXCLUDE PATTERN "hollow" EXCLUDE
  PATTERN "model_context.hpp" EXCLUDE PATTERN "split_core.hpp" EXCLUDE
  PATTERN "quiet_engine.hpp" EXCLUDE PATTERN "transmit_scan.hpp" EXCLUDE
  PATTERN "byte_store.hpp" EXCLUDE PATTERN "timed_engine.hpp" EXCLUDE
  PATTERN "host_image.hpp" EXCLUDE PATTERN "tick_rest.hpp" EXCLUDE
  PATTERN "engine_place.hpp" EXCLUDE
  PATTERN "engine_judge.hpp" EXCLUDE PATTERN "engine_level.hpp" EXCLUDE
  PATTERN "engine_count.hpp" EXCLUDE
  PATTERN "engine_edge.hpp" EXCLUDE PATTERN "port_block.hpp" EXCLUDE
  PATTERN "model_edge.hpp" EXCLUDE PATTERN "model_pins.hpp" EXCLUDE
  PATTERN "rtl_node_of.hpp" EXCLUDE
  PATTERN "bus_node_of.hpp" EXCLUDE PATTERN "bus_pins.hpp" EXCLUDE
  PATTERN "yaml_value.hpp" EXCLUDE PATTERN "scenario_parts.hpp" EXCLUDE
  PATTERN "scenario_remote_parts.hpp" EXCLUDE
  PATTERN "paper_bench.hpp" EXCLUDE)
install(FILES "${PROJECT_SOURCE_DIR}/sw/driver/include/verican/verican_regs.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/verican" COMPONENT sim)

if(TARGET vericansystemc)
  verican_install_library(systemc vericansystemc vericansystemc "${include_dir}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/sim/systemc" DESTINATION "${include_dir}"
          COMPONENT systemc FILES_MATCHING PATTERN "*.hpp")
endif()

# The driver: for programs of the host as a library, for a microcontroller as sources.
verican_install_library(driver verican_driver verican-driver "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/driver/include/verican"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT driver)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/driver/src" "${PROJECT_SOURCE_DIR}/sw/driver/include"
        DESTINATION "${VERICAN_DATA_DIR}/driver" COMPONENT driver)

# The clients of the node without a processor, in C and Python, and the golden vectors.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/remote" DESTINATION "${VERICAN_DATA_DIR}"
        COMPONENT driver FILES_MATCHING PATTERN "*.[ch]" PATTERN "*.py" PATTERN "vectors.yaml"
        PATTERN "__pycache__" EXCLUDE)

# For firmware on the simulated board: start-up code, vectors, linker script, semihosting.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/firmware/common"
        DESTINATION "${VERICAN_DATA_DIR}/firmware" COMPONENT driver)

# The port of CANopenNode, its object dictionaries and its example; CANopenNode is the user's own.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/canopennode" DESTINATION "${VERICAN_DATA_DIR}"
        USE_SOURCE_PERMISSIONS COMPONENT driver)

# Headers with which NXP's SDK, the user's own, drives the core.
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sw/mcux" DESTINATION "${VERICAN_DATA_DIR}"
        COMPONENT driver)

if(TARGET verican)
  install(TARGETS verican RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tool)
endif()
# The tool's helpers in Python; programs that link the library find them beside themselves or by
# VERICAN_PYTHON_DIR (sim/trace/python_helper.hpp).
install(DIRECTORY "${PROJECT_SOURCE_DIR}/sim/python" DESTINATION "${VERICAN_DATA_DIR}"
        COMPONENT tool FILES_MATCHING PATTERN "*.py")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/examples" DESTINATION "${VERICAN_DATA_DIR}"
        USE_SOURCE_PERMISSIONS COMPONENT doc
        REGEX "/examples/systemc/CMakeLists.txt$" EXCLUDE)  # for the project's own build
# The firmware of mixed.yaml, and the example with the place where that is installed.
install(FILES "${VERICAN_FIRMWARE_DIR}/ping.elf" "${VERICAN_FIRMWARE_DIR}/pong.elf"
        DESTINATION "${VERICAN_DATA_DIR}/firmware" COMPONENT doc)
install(CODE "
  set(example \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${VERICAN_DATA_DIR}/examples/mixed.yaml\")
  file(READ \"\${example}\" text)
  string(REPLACE \"../build/release/firmware/\" \"../firmware/\" text \"\${text}\")
  file(WRITE \"\${example}\" \"\${text}\")" COMPONENT doc)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/rtl" DESTINATION "${VERICAN_DATA_DIR}" COMPONENT rtl)
install(FILES "${PROJECT_SOURCE_DIR}/sw/verican.svd" DESTINATION "${VERICAN_DATA_DIR}"
        COMPONENT rtl)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/verican"
        COMPONENT doc)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md"
              "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/verican" COMPONENT doc)

# Links of the pages lead to what is installed, once all of it is there.
set(VERICAN_DOC_PLACES
  "sim=${include_dir}" "rtl=${VERICAN_DATA_DIR}/rtl" "examples=${VERICAN_DATA_DIR}/examples"
  "sw/driver=${VERICAN_DATA_DIR}/driver" "sw/canopennode=${VERICAN_DATA_DIR}/canopennode"
  "sw/remote=${VERICAN_DATA_DIR}/remote" "sw/mcux=${VERICAN_DATA_DIR}/mcux"
  "sw/firmware/common=${VERICAN_DATA_DIR}/firmware/common"
  "sw/verican.svd=${VERICAN_DATA_DIR}/verican.svd")
list(TRANSFORM VERICAN_DOC_PLACES REPLACE "=" "=\${root}/")
list(JOIN VERICAN_DOC_PLACES "\" \"" doc_places)
install(CODE "
  set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  execute_process(COMMAND \"${VERICAN_PYTHON3}\" \"${PROJECT_SOURCE_DIR}/cmake/installed_docs.py\"
    \"${PROJECT_SOURCE_DIR}\" \"\${root}/${CMAKE_INSTALL_DATADIR}/doc/verican\" \"${doc_places}\"
    COMMAND_ERROR_IS_FATAL ANY)" COMPONENT doc)

# All that must be built before `cmake --install`.
add_custom_target(installable)
foreach(target verican vericansim vericansystemc verican_driver verican_python firmware)
  if(TARGET ${target})
    add_dependencies(installable ${target})
  endif()
endforeach()
