# SPDX-License-Identifier: Apache-2.0
# `cmake --install BUILD [--prefix PREFIX] [--component NAME]`: where everything goes, by the FHS.
#
#   program  bin/theatron, manual pages, completion of bash and zsh
#   page     the browser client, share/theatron/page; the program finds it from its own place (src/host/page.h)
#   desktop  menu entry, kinds of files, icon, MetaInfo
#   server   units, user, folders, devices of cameras, AppArmor profile, examples of configurations; for the prefix /usr,
#            where the unit has its program
#   doc      docs/
#   python   the package for Python, where it was made (apps/python/CMakeLists.txt); only with --component python
#   development  libraries and headers for other programs (cmake/TheatronDevelopment.cmake); only with --component development
include(GNUInstallDirs)
set(THEATRON_PAGE ${CMAKE_SOURCE_DIR}/build/web/apps/web/page CACHE PATH "The browser client that is installed: packed by the web preset")

set(packaging ${CMAKE_SOURCE_DIR}/packaging)

install(TARGETS theatron RUNTIME COMPONENT program)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/apps/theatron/study_report DESTINATION ${CMAKE_INSTALL_DATADIR}/theatron COMPONENT program FILES_MATCHING PATTERN "*.py")
# Where the target `sbom` was built, as for packages.
install(FILES ${CMAKE_BINARY_DIR}/theatron.spdx.json DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program OPTIONAL)
if(NOT CMAKE_CROSSCOMPILING)
  install(DIRECTORY ${THEATRON_MANUAL}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES ${THEATRON_MANUAL}/theatron.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME theatron
    COMPONENT program)
  install(FILES ${THEATRON_MANUAL}/_theatron DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
endif()

# The program compares web_sources.txt of both, so a page of other sources is told.
install(FILES ${CMAKE_BINARY_DIR}/apps/theatron/web_sources.txt DESTINATION ${CMAKE_INSTALL_DATADIR}/theatron COMPONENT page)
install(DIRECTORY ${THEATRON_PAGE}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/theatron/page COMPONENT page OPTIONAL)
install(CODE "if(NOT EXISTS \"${THEATRON_PAGE}/files.txt\")
  message(WARNING \"There is no browser client in ${THEATRON_PAGE}, so none is installed: build it with the web preset.\")
endif()" COMPONENT page)

install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc PATTERN changes EXCLUDE)
# The pages have links to these, too.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc PATTERN __pycache__ EXCLUDE)
foreach(page README.md CHANGELOG.md SECURITY.md CONTRIBUTING.md LICENSE)
  install(FILES ${CMAKE_SOURCE_DIR}/${page} DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
endforeach()

install(FILES ${packaging}/theatron.desktop ${packaging}/theatron-link.desktop ${packaging}/theatron-view.desktop
  DESTINATION ${CMAKE_INSTALL_DATADIR}/applications
  COMPONENT desktop)
install(FILES ${packaging}/theatron.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT desktop)
install(FILES ${packaging}/theatron.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT desktop)
install(FILES ${packaging}/theatron.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT desktop)

install(FILES ${packaging}/theatron-host@.service DESTINATION lib/systemd/system COMPONENT server)
install(FILES ${packaging}/theatron-or-screen.service DESTINATION lib/systemd/user COMPONENT server)
install(PROGRAMS ${packaging}/theatron-acme-hook DESTINATION ${CMAKE_INSTALL_DATADIR}/theatron RENAME acme-hook COMPONENT server)
install(PROGRAMS ${packaging}/theatron-restart-hosts DESTINATION ${CMAKE_INSTALL_DATADIR}/theatron RENAME restart-hosts COMPONENT server)
install(FILES ${packaging}/theatron.sysusers DESTINATION lib/sysusers.d RENAME theatron.conf COMPONENT server)
install(FILES ${packaging}/theatron.tmpfiles DESTINATION lib/tmpfiles.d RENAME theatron.conf COMPONENT server)
install(FILES ${packaging}/theatron.rules DESTINATION lib/udev/rules.d RENAME 60-theatron.rules COMPONENT server)
install(FILES ${packaging}/theatron-host.apparmor DESTINATION ${CMAKE_INSTALL_SYSCONFDIR}/apparmor.d RENAME theatron-host
  COMPONENT server)
install(FILES ${packaging}/operating-room.conf ${packaging}/cameras.conf ${packaging}/low-port.conf
  DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/theatron-server/examples COMPONENT server)
