# SPDX-License-Identifier: Apache-2.0
# `cmake --install BUILD --component development`: the libraries that examples/ use, with all that these need, their headers, and what
# find_package(Theatron) and `pkg-config --static theatron` read. Libraries with sanitizers or CUDA are not for other programs.
# No Debian package has this part, and `cmake --install` without a component leaves it out: what the headers declare changes with
# any version.
if(THEATRON_SANITIZE OR THEATRON_CUDA)
  return()
endif()
include(CMakePackageConfigHelpers)
block()
  # Libraries that find_package() found, as TARGET|ARGUMENTS OF find_package()|MODULE OF pkg-config OR FLAG OF THE LINKER; the
  # last is empty for headers alone in a usual folder.
  set(found_packages
    "Boost::headers|Boost 1.81|"
    "BZip2::BZip2|BZip2|-lbz2"
    "Eigen3::Eigen|Eigen3 NO_MODULE|eigen3"
    "nlohmann_json::nlohmann_json|nlohmann_json 3|nlohmann_json"
    "OpenSSL::Crypto|OpenSSL|libcrypto"
    "OpenSSL::SSL|OpenSSL|libssl"
    "PNG::PNG|PNG|libpng"
    "Threads::Threads|Threads|-pthread"
    "ZLIB::ZLIB|ZLIB|zlib")

  # All modules that those of examples/ link.
  set(modules)
  set(outside)
  set(definitions)
  set(open theatron_capture theatron_client theatron_files theatron_host theatron_publish theatron_viewer)
  while(open)
    list(POP_FRONT open module)
    if(module IN_LIST modules)
      continue()
    endif()
    list(APPEND modules ${module})
    get_target_property(defined ${module} INTERFACE_COMPILE_DEFINITIONS)
    if(defined)
      list(APPEND definitions ${defined})
    endif()
    get_target_property(libraries ${module} INTERFACE_LINK_LIBRARIES)
    if(NOT libraries)
      continue()
    endif()
    foreach(library ${libraries})
      if(library MATCHES "^theatron_")
        list(APPEND open ${library})
      elseif(library MATCHES "^\\$<INSTALL_INTERFACE:(.*)>$")
        list(APPEND outside ${CMAKE_MATCH_1})
      elseif(NOT library MATCHES "BUILD_INTERFACE")
        list(APPEND outside ${library})
      endif()
    endforeach()
  endwhile()
  list(REMOVE_DUPLICATES outside)

  # Those libraries of others, for both kinds of file.
  set(dependencies)
  set(pkg_config_modules)
  set(flags)
  foreach(library ${outside})
    set(row ${found_packages})
    list(FILTER row INCLUDE REGEX "^${library}\\|")
    if(row)
      string(REGEX REPLACE "^[^|]*\\|([^|]*)\\|.*" "find_dependency(\\1)\n" dependency ${row})
      list(APPEND dependencies ${dependency})
      string(REGEX REPLACE ".*\\|" "" other ${row})
      if(other MATCHES "^-")
        list(APPEND flags ${other})
      else()
        list(APPEND pkg_config_modules ${other})
      endif()
    elseif(library MATCHES "^PkgConfig::(THEATRON_(.*))$")
      get_property(names GLOBAL PROPERTY THEATRON_PKG_CONFIG_${CMAKE_MATCH_2})
      list(APPEND pkg_config_modules ${names})
      list(JOIN names " " names)
      list(APPEND dependencies "theatron_find_modules(${CMAKE_MATCH_1} ${names})\n")
    elseif(library MATCHES "::")
      message(FATAL_ERROR "cmake/TheatronDevelopment.cmake does not say how an installed Theatron finds ${library}.")
    else()
      list(APPEND flags -l${library})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES dependencies)
  list(REMOVE_DUPLICATES pkg_config_modules)
  string(CONCAT THEATRON_DEPENDENCIES ${dependencies})
  list(JOIN pkg_config_modules ", " THEATRON_PKG_CONFIG_MODULES)
  list(JOIN flags " " THEATRON_PRIVATE_FLAGS)
  list(TRANSFORM definitions PREPEND -D)
  list(JOIN definitions " " THEATRON_DEFINITIONS)

  # A static library stands before those that it needs: the reverse of the order in which they are built.
  get_property(in_order GLOBAL PROPERTY THEATRON_MODULES_IN_ORDER)
  list(REVERSE in_order)
  set(THEATRON_LIBRARY_FLAGS)
  foreach(module ${in_order})
    get_target_property(type ${module} TYPE)
    if(module IN_LIST modules AND type STREQUAL "STATIC_LIBRARY")
      string(APPEND THEATRON_LIBRARY_FLAGS " -l${module}")
    endif()
  endforeach()

  set(headers ${CMAKE_INSTALL_INCLUDEDIR}/theatron)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/Theatron)
  target_compile_features(theatron_base INTERFACE cxx_std_20)
  foreach(module ${modules})
    string(REGEX REPLACE "^theatron_" "" name ${module})
    set_target_properties(${module} PROPERTIES EXPORT_NAME ${name})
    install(DIRECTORY ${CMAKE_SOURCE_DIR}/src/${name} DESTINATION ${headers} COMPONENT development EXCLUDE_FROM_ALL
      FILES_MATCHING PATTERN "*.h" PATTERN "*.inc"
      PATTERN "*-inl.h" EXCLUDE PATTERN "*_test.h" EXCLUDE PATTERN "test_*.h" EXCLUDE PATTERN "*_testing.h" EXCLUDE
      PATTERN "*_fuzz.h" EXCLUDE PATTERN pictures EXCLUDE PATTERN shaders EXCLUDE)
  endforeach()
  install(TARGETS ${modules} EXPORT TheatronTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development EXCLUDE_FROM_ALL
    INCLUDES DESTINATION ${headers})
  install(EXPORT TheatronTargets NAMESPACE Theatron:: DESTINATION ${package} COMPONENT development EXCLUDE_FROM_ALL)

  configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/TheatronConfig.cmake.in ${CMAKE_BINARY_DIR}/TheatronConfig.cmake
    INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/TheatronConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/TheatronConfig.cmake ${CMAKE_BINARY_DIR}/TheatronConfigVersion.cmake
    DESTINATION ${package} COMPONENT development EXCLUDE_FROM_ALL)

  # Below the folder that pkg-config found the file in, so that the whole can be moved.
  file(RELATIVE_PATH THEATRON_PREFIX /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  string(REGEX REPLACE "/$" "" THEATRON_PREFIX ${THEATRON_PREFIX})
  configure_file(${CMAKE_SOURCE_DIR}/cmake/theatron.pc.in ${CMAKE_BINARY_DIR}/theatron.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/theatron.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development EXCLUDE_FROM_ALL)
endblock()
