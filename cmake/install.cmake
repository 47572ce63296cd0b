# SPDX-License-Identifier: BSD-3-Clause
# Installs the program, the library with its headers, and what find_package(abradem) reads; packs a .deb.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

target_compile_features(abradem PUBLIC cxx_std_20)  # the headers need it too

install(TARGETS abradem EXPORT abradem
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT abradem
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT abradem
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET abradem_cli)
  install(TARGETS abradem_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT abradem)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/abradem DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT abradem
        FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/abradem)
install(EXPORT abradem NAMESPACE abradem:: FILE abradem-targets.cmake DESTINATION ${config_dir} COMPONENT abradem)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/abradem-config.cmake.in
                              ${PROJECT_BINARY_DIR}/generated/abradem-config.cmake
                              INSTALL_DESTINATION ${config_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/abradem-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/abradem-config.cmake
              ${PROJECT_BINARY_DIR}/generated/abradem-config-version.cmake
        DESTINATION ${config_dir} COMPONENT abradem)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT abradem RENAME copyright)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
              ${PROJECT_SOURCE_DIR}/CITATION.cff
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT abradem)
if(EXISTS ${PROJECT_SOURCE_DIR}/cases)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/cases/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/cases COMPONENT abradem
          FILES_MATCHING PATTERN "*.toml" PATTERN "*.json")
endif()

if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME abradem)
  set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_PACKAGE_CONTACT "The Abradem authors")
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # what the program links
  # What find_package(abradem) needs besides; whoever only runs the program can do without.
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake, libfmt-dev, libmuparser-dev, zlib1g-dev")
  include(CPack)
endif()
