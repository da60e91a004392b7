# SPDX-License-Identifier: Apache-2.0
# One folder, one library, its tests and fuzz targets found by file name.

# The optimised build's unit tests are part of `make test` only of these modules: they have kernels for several
# instruction sets, of which a sanitizer build has one; statistics over many images, which a sanitizer build leaves out;
# limits of memory and system calls, which sanitizers exceed; or hours of made-up time. The unit tests of the other
# modules run once, with sanitizers.
set(THEATRON_OPTIMISED_TESTS capture cases codec filter geometry image registration sandbox send simulation
  synthetic video voice world)

# theatron_unit_test(NAME TARGET [ENVIRONMENT variable=value...])
#
# A test that runs the program TARGET in the repository's root, in sanitizer builds with the lists of what
# is not reported (each entry with its reason). It counts as skipped where every test in it is. Its label is
# `unit`, and also `once` in a build where `make test` leaves it out; the target unit_tests builds it there.
function(theatron_unit_test name target)
  cmake_parse_arguments(T "" "" "ENVIRONMENT" ${ARGN})
  add_test(NAME ${name} COMMAND ${target} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  if(THEATRON_SANITIZE)
    set(lists ${CMAKE_SOURCE_DIR}/tests/sanitizers)
    # Clang 14 takes a block of thread-local storage for one of glibc 2.19 if it begins 16 bytes into a page,
    # reads its size from what stands before it, and the leak check at the end then reads wild addresses.
    list(APPEND T_ENVIRONMENT "ASAN_OPTIONS=intercept_tls_get_addr=0"
      "LSAN_OPTIONS=suppressions=${lists}/leaks.txt" "UBSAN_OPTIONS=print_stacktrace=1"
      "TSAN_OPTIONS=suppressions=${lists}/threads.txt:second_deadlock_stack=1")
  endif()
  set(labels unit)
  if(NOT THEATRON_SANITIZE AND NOT THEATRON_MODULES AND NOT name IN_LIST THEATRON_OPTIMISED_TESTS)
    list(APPEND labels once)
    set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  endif()
  set_tests_properties(${name} PROPERTIES
    LABELS "${labels}"
    ENVIRONMENT "${T_ENVIRONMENT}"
    SKIP_REGULAR_EXPRESSION "\\[  PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\]")
  set_property(GLOBAL APPEND PROPERTY THEATRON_UNIT_TESTS ${target})
endfunction()

# theatron_module(NAME [WEB] [PURE] [FOLDERS folder...] [NATIVE file...] [DEPENDS module...]
#                 [NATIVE_DEPENDS module...] [LINK library...])
#
# Builds theatron_NAME from the .cpp files of the current folder and of FOLDERS in it. Files that end in _test.cpp become one
# test program, each _fuzz.cpp a fuzz target of its own. DEPENDS names the other modules that this one
# may include; tools/check_includes.py reads it too. WEB: also built with em++ (others are left out
# there). PURE: no exceptions. LINK: outside libraries. A file that ends in _native.cpp is left out of
# the web build, one that ends in _web.cpp of the native build. NATIVE: further sources that are left
# out of the web build, NATIVE_DEPENDS: modules that only native sources include.
function(theatron_module name)
  cmake_parse_arguments(M "WEB;PURE" "" "FOLDERS;NATIVE;DEPENDS;NATIVE_DEPENDS;LINK" ${ARGN})
  list(TRANSFORM M_FOLDERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE folders)
  list(PREPEND folders ${CMAKE_CURRENT_SOURCE_DIR})
  if(M_WEB)
    set_property(GLOBAL APPEND PROPERTY THEATRON_WEB_FOLDERS ${folders})
  elseif(EMSCRIPTEN)
    return()
  endif()

  set(patterns ${folders})
  list(TRANSFORM patterns APPEND /*.cpp)
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  set(tests ${sources})
  set(fuzzers ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER fuzzers INCLUDE REGEX "_fuzz\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_(test|fuzz|bench)\\.cpp$")
  if(EMSCRIPTEN)
    list(FILTER sources EXCLUDE REGEX "_native\\.cpp$")
    list(TRANSFORM M_NATIVE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    list(REMOVE_ITEM sources ${M_NATIVE} "")
  else()
    list(FILTER sources EXCLUDE REGEX "_web\\.cpp$")
  endif()

  set(library theatron_${name})
  set(kind PUBLIC)
  if(sources)
    add_library(${library} STATIC ${sources})
    if(M_PURE)
      target_compile_options(${library} PRIVATE -fno-exceptions)
    endif()
  else()
    add_library(${library} INTERFACE)
    set(kind INTERFACE)
  endif()
  add_library(Theatron::${name} ALIAS ${library})
  set_property(GLOBAL APPEND PROPERTY THEATRON_MODULES_IN_ORDER ${library})
  target_include_directories(${library} ${kind} $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/src>)
  theatron_compile_together(${library} ${sources})
  if(NOT EMSCRIPTEN)
    list(APPEND M_DEPENDS ${M_NATIVE_DEPENDS})
  endif()
  list(TRANSFORM M_DEPENDS PREPEND theatron_ OUTPUT_VARIABLE modules)
  theatron_outside_libraries(links ${M_LINK})
  target_link_libraries(${library} ${kind} ${modules} ${links})

  if(EMSCRIPTEN OR NOT THEATRON_TESTS)
    return()
  endif()
  if(tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${library} theatron_testing GTest::gmock GTest::gtest_main Threads::Threads)
    theatron_compile_together(${name}_test ${tests})
    theatron_unit_test(${name} ${name}_test)
  endif()
  if(THEATRON_FUZZ)
    foreach(fuzzer ${fuzzers})
      get_filename_component(target ${fuzzer} NAME_WE)
      add_executable(${target} ${fuzzer})
      target_link_libraries(${target} PRIVATE ${library} -fsanitize=fuzzer)
      set_property(GLOBAL APPEND PROPERTY THEATRON_FUZZERS ${target})
    endforeach()
  endif()
endfunction()

# theatron_program_library(NAME DEPENDS module... [LINK library...] [WITHOUT file...])
#
# theatron_NAME from the .cpp files of a program's folder, without main.cpp, *_main.cpp, tests, and the files WITHOUT. Includes are
# those of its own folder and "MODULE/…" of DEPENDS, which tools/check_includes.py compares.
function(theatron_program_library name)
  cmake_parse_arguments(M "" "" "DEPENDS;LINK;WITHOUT" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  list(FILTER sources EXCLUDE REGEX "(_test|/main|_main)\\.cpp$")
  list(TRANSFORM M_WITHOUT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${M_WITHOUT} "")
  add_library(theatron_${name} STATIC ${sources})
  theatron_compile_together(theatron_${name} ${sources})
  target_include_directories(theatron_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/apps)
  list(TRANSFORM M_DEPENDS PREPEND theatron_ OUTPUT_VARIABLE modules)
  target_link_libraries(theatron_${name} PUBLIC ${modules} ${M_LINK})
endfunction()
