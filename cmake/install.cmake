# SPDX-License-Identifier: BSD-3-Clause
# `cmake --install`: the program, the libraries with their headers, and what find_package(tessera) needs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS tessera RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(PROGRAMS scripts/tessera-run DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS tessera_flags tessera_render tessera_scheduler tessera_io tessera_mpi EXPORT tessera_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(room render scheduler io)
  install(DIRECTORY src/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tessera FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT tessera_targets NAMESPACE tessera:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)

configure_package_config_file(cmake/tesseraConfig.cmake.in ${PROJECT_BINARY_DIR}/tesseraConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tesseraConfig.cmake ${PROJECT_BINARY_DIR}/tesseraConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
