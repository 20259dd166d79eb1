# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# Compiler settings of every target: C++20, ccache if there is one, warnings, sanitizers.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug" FORCE)
endif()
# Asserts stay on. Verilated models and test programs have options of their own.
set(CMAKE_CXX_FLAGS_RELEASE "-O2")
set(CMAKE_C_FLAGS_RELEASE "-O2")

# A package that is installed anew brings headers that are older than a precompiled one which has
# them: clang would refuse that one, and no rule would make it anew.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # What was compiled with a precompiled header is kept only with these two.
  set(launcher env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${launcher}")
  set(CMAKE_C_COMPILER_LAUNCHER "${launcher}")
endif()

# Either links the hundreds of test programs at least twice as fast as the default; the second is
# part of Debian's binutils.
include(CheckLinkerFlag)
foreach(linker lld gold)
  check_linker_flag(CXX -fuse-ld=${linker} VERICAN_HAS_${linker})
  if(VERICAN_HAS_${linker})
    add_link_options(-fuse-ld=${linker})
    break()
  endif()
endforeach()

option(VERICAN_ASAN "Address and undefined-behaviour sanitizers" OFF)
if(VERICAN_ASAN)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

option(VERICAN_FUZZ "Build the libFuzzer programs of tb/fuzz and nothing else (needs clang)" OFF)

# Warnings for our own sources; Verilated code is not ours to mend.
function(verican_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor)
endfunction()

# verican_runs_once(SOURCE...): to optimise what only reads options and writes results takes longer
# than it ever runs. Not for what users run: the linker may take a template's code from these files.
function(verican_runs_once)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "$<$<CONFIG:Release>:-O0>")
endfunction()

# verican_unity(TARGET [FOLDER...]): the sources of one folder are compiled together, eight at a
# time, because most of a file's time is its headers. So what is local to a file has a name of its
# own in its folder. Files with settings of their own stay alone, and so do those of the FOLDERs.
option(VERICAN_UNITY "Compile the sources of a folder together, eight at a time" ON)
function(verican_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${VERICAN_UNITY} UNITY_BUILD_MODE GROUP)
  if(VERICAN_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Says of each type that is local to a file that it is used outside the one that is compiled.
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_source_file_property(own "${source}" COMPILE_DEFINITIONS)
    if(own OR NOT source MATCHES "^/.*\\.cpp$")
      continue()
    endif()
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    if(folder IN_LIST ARGN)
      continue()
    endif()
    list(APPEND in_${folder} "${source}")
    list(LENGTH in_${folder} count)
    math(EXPR part "(${count} - 1) / 8")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${folder}_${part}")
  endforeach()
endfunction()
