# SPDX-License-Identifier: Apache-2.0
# Language, warnings, sanitizers: what holds for every target.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

set(THEATRON_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, for example address,undefined")
set(THEATRON_MODULES "" CACHE STRING "Only these modules of src, in the order of their dependencies, and no programs")
option(THEATRON_TESTS "Build tests, benchmarks and examples, too; OFF: the program alone" ON)
option(THEATRON_FUZZ "Build the libFuzzer targets (needs clang)" OFF)
option(THEATRON_CUDA "Build the CUDA kernels (needs nvcc)" OFF)

find_program(CCACHE ccache)
if(CCACHE)
  # Paths below the base are kept as relative ones, so every clone finds what another has compiled.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1)
  if(THEATRON_SANITIZE)
    list(APPEND launcher CCACHE_EXTRAFILES=${CMAKE_SOURCE_DIR}/cmake/sanitizer_ignorelist.txt)
  endif()
  if(EMSCRIPTEN)
    # It does not know em++ by its name.
    list(APPEND launcher CCACHE_COMPILERTYPE=clang)
  endif()
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher} ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher} ${CCACHE})
endif()

add_compile_options(-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 reports overlapping copies inside std::string where there are none (its bug 105651).
  add_compile_options(-Wno-restrict)
  # GCC collects its garbage less often, which takes a twentieth of its time from it and gives it half a gigabyte.
  add_compile_options(--param=ggc-min-heapsize=700000)
endif()
if(THEATRON_SANITIZE)
  # Assertions are part of what these builds check, also the fuzz targets, which are optimised.
  add_compile_options(-fsanitize=${THEATRON_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -UNDEBUG)
  add_link_options(-fsanitize=${THEATRON_SANITIZE})
  # Linking 80 programs with the sanitizers' code takes the usual linker several times as long.
  find_program(THEATRON_LLD ld.lld)
  if(THEATRON_LLD AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_link_options(-fuse-ld=lld)
  endif()
  # The thread sanitizer must see every access.
  if(NOT THEATRON_SANITIZE MATCHES "thread")
    # Ninja compiles in the build folder. With a path of one clone, ccache would find nothing of another's.
    file(RELATIVE_PATH ignorelist ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR}/cmake/sanitizer_ignorelist.txt)
    add_compile_options(-fsanitize-ignorelist=${ignorelist})
  endif()
elseif(NOT EMSCRIPTEN)
  # The program reads bytes of strangers: an error that a check can still catch ends it instead of being used.
  add_compile_options(-fstack-protector-strong "$<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
  add_link_options(-Wl,-z,relro,-z,now)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  include(CheckPIESupported)
  check_pie_supported()
endif()
if(NOT EMSCRIPTEN)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
endif()
if(THEATRON_FUZZ)
  # Coverage everywhere, the fuzzer's main only in the fuzz targets.
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

if(THEATRON_CUDA)
  include(CheckLanguage)
  check_language(CUDA)
  if(NOT CMAKE_CUDA_COMPILER)
    message(FATAL_ERROR "THEATRON_CUDA is on, but no nvcc answers: install the CUDA toolkit or use the release preset.")
  endif()
  set(CMAKE_CUDA_FLAGS "${CMAKE_CUDA_FLAGS} -std=c++20")
  enable_language(CUDA)
endif()

if(NOT EMSCRIPTEN)
  find_package(Threads REQUIRED)
  if(THEATRON_TESTS)
    find_package(GTest REQUIRED)
  endif()
  find_package(PkgConfig REQUIRED)
endif()

if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  # Vectors whose length the compiler does not know cannot be members of a class; NEON's can.
  # GCC makes constructors for the machine's plain instruction set: it must be Highway's.
  add_compile_options(-march=armv8-a+crypto)
  add_compile_definitions("HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endif()

if(EMSCRIPTEN)
  add_compile_options(-fwasm-exceptions -msimd128)
  add_link_options(-fwasm-exceptions)
endif()
