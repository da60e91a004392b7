# SPDX-License-Identifier: Apache-2.0
# Libraries of others, so that installed targets (cmake/TheatronDevelopment.cmake) find them on another machine, too.

# theatron_pkg_config(NAME module...): the target PkgConfig::THEATRON_NAME of these modules of pkg-config.
macro(theatron_pkg_config name)
  pkg_check_modules(THEATRON_${name} REQUIRED IMPORTED_TARGET ${ARGN})
  set_property(GLOBAL PROPERTY THEATRON_PKG_CONFIG_${name} ${ARGN})
endmacro()

# theatron_outside_libraries(RESULT library...): the same libraries; a file that find_library() gave is linked by its place
# in this build, and by its name from an installed target.
function(theatron_outside_libraries result)
  set(libraries)
  foreach(library ${ARGN})
    if(IS_ABSOLUTE ${library})
      get_filename_component(name ${library} NAME_WE)
      string(REGEX REPLACE "^lib" "" name ${name})
      list(APPEND libraries $<BUILD_INTERFACE:${library}> $<INSTALL_INTERFACE:${name}>)
    else()
      list(APPEND libraries ${library})
    endif()
  endforeach()
  set(${result} ${libraries} PARENT_SCOPE)
endfunction()
