# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Which compiler, before project(): clang where it is installed, because it compiles the tests three
# times as fast as g++. CC and CXX, -DCMAKE_CXX_COMPILER, a toolchain file and a project around this
# one go before.
if(NOT PROJECT_NAME AND NOT CMAKE_TOOLCHAIN_FILE AND NOT CMAKE_C_COMPILER
   AND NOT CMAKE_CXX_COMPILER AND NOT DEFINED ENV{CC} AND NOT DEFINED ENV{CXX})
  find_program(VERICAN_CLANG clang)
  find_program(VERICAN_CLANGXX clang++)
  if(VERICAN_CLANG AND VERICAN_CLANGXX)  # one without the other is no compiler of both languages
    set(CMAKE_C_COMPILER "${VERICAN_CLANG}")
    set(CMAKE_CXX_COMPILER "${VERICAN_CLANGXX}")
  endif()
endif()
