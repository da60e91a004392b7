# SPDX-License-Identifier: Apache-2.0
# GCC parses the headers below once for the modules of an optimised build, instead of a second or two for each source.
# The builds with clang and with em++ parse them anew, so those find a source that misses an include.

set(THEATRON_PRECOMPILED_HEADERS <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <condition_variable>
  <cstdint> <cstdio> <cstring> <deque> <filesystem> <fstream> <functional> <map> <memory> <mutex> <numbers> <optional>
  <random> <ranges> <set> <span> <sstream> <string> <string_view> <thread> <tuple> <unordered_map> <utility> <variant>
  <vector>)

# GCC takes precompiled headers only where the options for exceptions are the same: modules that are PURE have others.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT CMAKE_CROSSCOMPILING)
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled_headers.cpp CONTENT "// It carries the precompiled headers.\n")
  foreach(headers theatron_headers theatron_pure_headers)
    add_library(${headers} STATIC EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled_headers.cpp)
    target_precompile_headers(${headers} PRIVATE ${THEATRON_PRECOMPILED_HEADERS})
  endforeach()
  target_precompile_headers(theatron_headers PRIVATE <nlohmann/json.hpp>)
  target_compile_options(theatron_pure_headers PRIVATE -fno-exceptions)
endif()

# theatron_use_precompiled_headers(TARGET HEADERS): HEADERS is theatron_headers or theatron_pure_headers.
function(theatron_use_precompiled_headers target headers)
  if(TARGET ${headers})
    target_precompile_headers(${target} REUSE_FROM ${headers})
    # ccache asks for it.
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fpch-preprocess>)
  endif()
endfunction()
