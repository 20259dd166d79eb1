# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
#
# verican_missing_tests(GROUP NEEDS): a group of tests is left out, because something is not there
# that it needs. With CI=true in the environment that ends the configuration: there no group may be
# gone unnoticed. Builds of rewritten or counting RTL and those without the page have fewer targets.
function(verican_missing_tests group needs)
  set(kind STATUS)
  if("$ENV{CI}" STREQUAL "true" AND VERICAN_REPORT AND NOT VERICAN_RTL_TRANSFORM
     AND NOT VERICAN_COVERAGE)
    set(kind FATAL_ERROR)
  endif()
  message(${kind} "No tests of ${group}: they need ${needs}")
endfunction()
