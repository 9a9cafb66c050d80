# `cmake --install`: the program, the libraries, their headers, and a package for find_package(hexfield).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY HEXFIELD_MODULES)
set(targets hexfield_flags)
foreach(module ${modules})
  list(APPEND targets hexfield_${module})
endforeach()
set_target_properties(hexfield_flags PROPERTIES EXPORT_NAME flags)
install(TARGETS ${targets} EXPORT hexfield_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/hexfield DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hexfield)
install(EXPORT hexfield_targets NAMESPACE hexfield:: FILE hexfieldTargets.cmake DESTINATION ${package})
configure_package_config_file(cmake/hexfieldConfig.cmake.in ${PROJECT_BINARY_DIR}/hexfieldConfig.cmake
  INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hexfieldConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hexfieldConfig.cmake ${PROJECT_BINARY_DIR}/hexfieldConfigVersion.cmake
  cmake/dependencies.cmake DESTINATION ${package})
