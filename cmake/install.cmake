# What `cmake --install` puts where, and the package that find_package(vegard) finds.
include(CMakePackageConfigHelpers)

set(VEGARD_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/vegard)
set(VEGARD_INSTALL_DATADIR ${CMAKE_INSTALL_DATADIR}/vegard/data)

# Two components, which are Debian packages each (package.cmake): the program, and what others build with.
install(TARGETS vegard RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(TARGETS vegard_sim vegard_fit EXPORT vegardTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT vegardTargets NAMESPACE vegard:: DESTINATION ${VEGARD_INSTALL_CMAKEDIR} COMPONENT development)
install(FILES apps/studio/desktop/vegard-studio.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT program)
install(FILES apps/studio/desktop/vegard.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT program)
install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program)

# Under include/vegard, so that #include "sim/render/render.h" reads the same inside and outside. Which they are is read when
# it is installed, as an include may have come since the build was configured.
install(CODE "set(SOURCE_DIR \"${PROJECT_SOURCE_DIR}\")\nset(INCLUDE_DIR \"${CMAKE_INSTALL_INCLUDEDIR}/vegard\")" COMPONENT development)
install(SCRIPT cmake/install_headers_script.cmake COMPONENT development)

# GLOW's tables travel with their licence, or stay behind: what is left is free (NOTICE).
option(VEGARD_INSTALL_GLOW "Install GLOW's emission tables, which have a licence of their own" ON)
if(NOT VEGARD_INSTALL_GLOW)
  set(VEGARD_DATA_NOT_INSTALLED PATTERN "glow" EXCLUDE)
endif()
install(DIRECTORY data/ DESTINATION ${VEGARD_INSTALL_DATADIR} COMPONENT program ${VEGARD_DATA_NOT_INSTALLED})
install(FILES LICENSE NOTICE CITATION.cff CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

configure_package_config_file(cmake/vegardConfig.cmake.in ${PROJECT_BINARY_DIR}/vegardConfig.cmake
                              INSTALL_DESTINATION ${VEGARD_INSTALL_CMAKEDIR}
                              PATH_VARS VEGARD_INSTALL_DATADIR)
# Before 1.0 a minor version may break what was.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/vegardConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/vegardConfig.cmake ${PROJECT_BINARY_DIR}/vegardConfigVersion.cmake
        DESTINATION ${VEGARD_INSTALL_CMAKEDIR} COMPONENT development)
