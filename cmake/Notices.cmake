# SPDX-License-Identifier: Apache-2.0
# theatron_notices(FILE [TEXT text] PACKAGES package...)
#
# Writes FILE: the licence of Theatron, TEXT, and the notices of Debian packages whose code becomes part of a
# program (headers, static libraries, fonts), from the copyright files that the packages install. A shared
# library comes with its own package and is not named here. A missing file is remarked on, and ends the configuration
# of a build for packages (THEATRON_TESTS is off).
function(theatron_notices file)
  # TEXT has semicolons, at which ${ARGN} would cut it.
  cmake_parse_arguments(PARSE_ARGV 1 N "" "TEXT" "PACKAGES")
  set(notices "Theatron, copyright 2026 the Theatron authors, Apache License 2.0\n")
  string(APPEND notices "It contains parts of the works below, under the terms that follow each name.\n${N_TEXT}")
  foreach(package ${N_PACKAGES})
    set(copyright /usr/share/doc/${package}/copyright)
    if(EXISTS ${copyright})
      file(READ ${copyright} text)
    else()
      set(text "The package ${package} installed no ${copyright} where this program was built.\n")
      if(THEATRON_TESTS)
        message(WARNING "${copyright} is missing: a binary without it may not be shipped")
      else()
        message(SEND_ERROR "${copyright} is missing: a binary without it may not be shipped")
      endif()
    endif()
    string(APPEND notices "\n== ${package}\n\n${text}")
  endforeach()
  # For the software bill of materials (packaging/sbom.py).
  list(JOIN N_PACKAGES "\n" names)
  file(WRITE ${file}.packages "${names}\n")
  # An equal file stays untouched, so that nothing is compiled again.
  file(WRITE ${file}.new "${notices}")
  file(COPY_FILE ${file}.new ${file} ONLY_IF_DIFFERENT)
endfunction()
