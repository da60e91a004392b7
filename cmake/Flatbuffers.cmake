# SPDX-License-Identifier: Apache-2.0
# FlatBuffers headers and the schema compiler, for native and web builds.

find_program(FLATC flatc REQUIRED)
find_path(FLATBUFFERS_INCLUDE flatbuffers/flatbuffers.h PATHS /usr/include REQUIRED NO_CMAKE_FIND_ROOT_PATH)

if(NOT TARGET theatron_flatbuffers)
  add_library(theatron_flatbuffers INTERFACE)
  if(EMSCRIPTEN)
    # Only this folder of the system's headers: the others belong to another C library.
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/include)
    file(CREATE_LINK ${FLATBUFFERS_INCLUDE}/flatbuffers ${CMAKE_BINARY_DIR}/include/flatbuffers SYMBOLIC)
    target_include_directories(theatron_flatbuffers SYSTEM INTERFACE ${CMAKE_BINARY_DIR}/include)
  else()
    target_include_directories(theatron_flatbuffers SYSTEM INTERFACE ${FLATBUFFERS_INCLUDE})
  endif()
endif()

# theatron_flatbuffers(SCHEMA TARGET): makes SCHEMA_generated.h in the current binary folder.
function(theatron_flatbuffers schema target)
  get_filename_component(name ${schema} NAME_WE)
  set(header ${CMAKE_CURRENT_BINARY_DIR}/${name}_generated.h)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${FLATC} --cpp --scoped-enums -o ${CMAKE_CURRENT_BINARY_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${schema}
    DEPENDS ${schema})
  add_custom_target(${target} DEPENDS ${header})
  set_property(GLOBAL APPEND PROPERTY THEATRON_GENERATED ${target})
endfunction()
