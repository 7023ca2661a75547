if(OFM_BUILD_TESTS)
  add_library(ofm_one_opencv_thread OBJECT ${PROJECT_SOURCE_DIR}/tests/support/one_opencv_thread.cc)
  target_link_libraries(ofm_one_opencv_thread PRIVATE ofm_compiler opencv_core)
endif()

# ofm_add_module(NAME [LINKS ...]) makes the library ofm::NAME of the *.cc in this directory and,
# of its *_test.cc, the test program ofm_NAME_test. LINKS are public: modules above this one in
# OFM_LAYERS, and third-party targets.
function(ofm_add_module name)
  cmake_parse_arguments(ARG "" "" "LINKS;TEST_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cc$")
  list(FILTER tests INCLUDE REGEX "_test\\.cc$")

  if(sources)
    add_library(ofm_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(ofm_${name} PRIVATE $<BUILD_INTERFACE:ofm_compiler>)
  else()
    add_library(ofm_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(ofm::${name} ALIAS ofm_${name})
  set_target_properties(ofm_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(ofm_${name} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(ofm_${name} ${scope} cxx_std_20)
  target_link_libraries(ofm_${name} ${scope} ${ARG_LINKS})
  set_property(GLOBAL APPEND PROPERTY OFM_MODULE_TARGETS ofm_${name})

  if(OFM_BUILD_TESTS AND tests)
    add_executable(ofm_${name}_test ${tests} $<TARGET_OBJECTS:ofm_one_opencv_thread>)
    target_link_libraries(ofm_${name}_test PRIVATE ofm_compiler ofm::${name} ${ARG_TEST_LINKS}
      GTest::gmock GTest::gtest_main $<LINK_ONLY:opencv_core>)
    # clang-tidy is for what is shipped: GoogleTest's macros trip dozens of its checks.
    set_target_properties(ofm_${name}_test PROPERTIES CXX_CLANG_TIDY "")
    target_compile_definitions(ofm_${name}_test PRIVATE
      OFM_SOURCE_DIR="${PROJECT_SOURCE_DIR}" OFM_SHARED_DIR="${PROJECT_SOURCE_DIR}/../shared")
    gtest_discover_tests(ofm_${name}_test DISCOVERY_MODE PRE_TEST PROPERTIES TIMEOUT 600)
  endif()
endfunction()
