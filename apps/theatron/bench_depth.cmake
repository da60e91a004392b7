# SPDX-License-Identifier: Apache-2.0
# The depth benchmark, with JPEG-LS and FFV1 as yardsticks where their libraries are installed.
add_library(theatron_bench_depth STATIC bench_depth.cpp bench_yardsticks.cpp)
find_package(nlohmann_json REQUIRED)
target_link_libraries(theatron_bench_depth PUBLIC theatron_codec nlohmann_json::nlohmann_json PRIVATE zstd)

pkg_check_modules(CHARLS IMPORTED_TARGET charls)
if(CHARLS_FOUND)
  target_link_libraries(theatron_bench_depth PRIVATE PkgConfig::CHARLS)
  target_compile_definitions(theatron_bench_depth PRIVATE THEATRON_BENCH_CHARLS=1)
endif()
pkg_check_modules(AVCODEC IMPORTED_TARGET libavcodec libavutil)
if(AVCODEC_FOUND)
  target_link_libraries(theatron_bench_depth PRIVATE PkgConfig::AVCODEC)
  target_compile_definitions(theatron_bench_depth PRIVATE THEATRON_BENCH_FFV1=1)
endif()
