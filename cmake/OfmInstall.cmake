# `cmake --install` puts the program, the libraries, the headers and a package file in place:
# find_package(ofm_slam) then gives ofm::base … ofm::pipeline.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ofm_slam)

get_property(modules GLOBAL PROPERTY OFM_MODULE_TARGETS)
install(TARGETS ${modules} EXPORT ofm_slamTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ofm DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h")
install(EXPORT ofm_slamTargets NAMESPACE ofm:: DESTINATION ${package_dir})
if(TARGET ofm-slam)
  install(TARGETS ofm-slam RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET man_page)
  install(FILES ${PROJECT_BINARY_DIR}/ofm-slam.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/completions/ofm-slam.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ofm-slam)
if(EXISTS ${PROJECT_SOURCE_DIR}/configs)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/ofm-slam)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR})

# A consumer needs the packages that OfmDependencies.cmake asks for, less those of tests and
# benchmarks: taken from there, so that the two lists cannot differ.
file(STRINGS ${CMAKE_CURRENT_LIST_DIR}/OfmDependencies.cmake dependencies
  REGEX "^find_package\\(.*REQUIRED")
list(TRANSFORM dependencies REPLACE "^find_package" "find_dependency")
list(TRANSFORM dependencies REPLACE " REQUIRED" "")
list(JOIN dependencies "\n" OFM_FIND_DEPENDENCIES)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/ofm_slamConfig.cmake.in
  ${PROJECT_BINARY_DIR}/ofm_slamConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ofm_slamConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ofm_slamConfig.cmake
  ${PROJECT_BINARY_DIR}/ofm_slamConfigVersion.cmake DESTINATION ${package_dir})
