# SPDX-License-Identifier: Apache-2.0
# web_sources.txt: a number for the content of all sources of the browser client. The program has one beside it, the packed
# page has one in it; a host compares them (src/host/page.h).
#
# As a script with FOLDER, LIST and OUTPUT: writes OUTPUT from the files of FOLDER that LIST names.
if(CMAKE_SCRIPT_MODE_FILE)
  file(STRINGS ${LIST} files)
  set(all "")
  foreach(file ${files})
    file(SHA256 ${FOLDER}/${file} hash)
    string(APPEND all "${file} ${hash}\n")
  endforeach()
  string(SHA256 number "${all}")
  file(WRITE ${OUTPUT} "${number}\n")
  return()
endif()

# theatron_web_sources(TARGET): makes web_sources.txt in the current binary folder.
function(theatron_web_sources target)
  get_property(folders GLOBAL PROPERTY THEATRON_WEB_FOLDERS)
  set(files "")
  foreach(folder ${folders})
    file(GLOB some CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${folder}/*.cpp ${folder}/*.h ${folder}/*.fbs)
    list(APPEND files ${some})
  endforeach()
  file(GLOB_RECURSE own CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/apps/web/*)
  list(APPEND files ${own})
  list(FILTER files EXCLUDE REGEX "_(native|test|bench|fuzz)\\.(cpp|h)$")
  list(SORT files)
  list(JOIN files "\n" lines)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/web_sources.list)
  file(CONFIGURE OUTPUT ${list} CONTENT "${lines}\n")
  list(TRANSFORM files PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
  add_custom_command(
    OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/web_sources.txt
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_SOURCE_DIR} -DLIST=${list} -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/web_sources.txt
            -P ${CMAKE_SOURCE_DIR}/cmake/WebSources.cmake
    DEPENDS ${paths} ${list}
    VERBATIM)
  add_custom_target(${target} DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/web_sources.txt)
endfunction()
