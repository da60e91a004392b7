# SPDX-License-Identifier: Apache-2.0
# Libraries that Debian has for this machine alone, compiled for the web build from their own sources, which
# tools/library_sources.sh puts into libraries/. Each is a target only where its sources are there. The properties
# THEATRON_WEB_LICENCES and THEATRON_WEB_MISSING have the notices of those that are in the page, and the names of the others.
#
# theatron_web_library(NAME FOLDER LICENCE file INCLUDE folder... SOURCES pattern... [EXCLUDE regex] [ALONE regex]
#                      [DEFINITIONS name=value...])
#
# All sources of a folder are compiled as one, for em++ takes a while to start; those that match ALONE by themselves.
function(theatron_web_library name folder)
  cmake_parse_arguments(L "" "EXCLUDE;ALONE;LICENCE" "INCLUDE;SOURCES;DEFINITIONS" ${ARGN})
  set(place ${CMAKE_SOURCE_DIR}/libraries/${folder})
  if(NOT EXISTS ${place})
    message(STATUS "The page is built without ${folder}: tools/library_sources.sh could not fetch its sources.")
    set_property(GLOBAL APPEND PROPERTY THEATRON_WEB_MISSING ${folder})
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY THEATRON_WEB_LICENCES ${place}/${L_LICENCE})
  list(TRANSFORM L_SOURCES PREPEND ${place}/)
  file(GLOB sources ${L_SOURCES})
  if(L_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX "${L_EXCLUDE}")
  endif()
  add_library(${name} STATIC ${sources})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${sources})
    file(RELATIVE_PATH group ${place} ${source})
    get_filename_component(group "${group}" DIRECTORY)
    string(MAKE_C_IDENTIFIER ${group} group)
    if(NOT L_ALONE OR NOT source MATCHES "${L_ALONE}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
  list(TRANSFORM L_INCLUDE PREPEND ${place}/)
  list(POP_FRONT L_INCLUDE public)
  target_include_directories(${name} SYSTEM PUBLIC ${public} PRIVATE ${L_INCLUDE})
  target_compile_definitions(${name} PRIVATE ${L_DEFINITIONS})
  target_compile_options(${name} PRIVATE -w)  # its warnings are its authors' business
endfunction()

if(EMSCRIPTEN)
  # The page only decodes depth.
  theatron_web_library(web_zstd libzstd LICENCE LICENSE INCLUDE lib SOURCES lib/common/*.c lib/decompress/*.c
    DEFINITIONS ZSTD_DISABLE_ASM=1 ZSTD_LEGACY_SUPPORT=0 ZSTD_TRACE=0)
  theatron_web_library(web_lz4 lz4 LICENCE lib/LICENSE INCLUDE lib SOURCES lib/lz4.c)
  theatron_web_library(web_opus opus LICENCE COPYING INCLUDE include . celt silk silk/float
    SOURCES src/*.c celt/*.c silk/*.c silk/float/*.c
    EXCLUDE "_(demo|compare)\\.c$|multistream|projection|mapping" ALONE "celt_(en|de)coder"
    DEFINITIONS OPUS_BUILD VAR_ARRAYS FLOAT_APPROX HAVE_LRINT HAVE_LRINTF PACKAGE_VERSION="Debian")
endif()
