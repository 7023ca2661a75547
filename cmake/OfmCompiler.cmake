# Language standard, warnings and instrumentation, applied to every target through ofm_compiler.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(OFM_CCACHE ccache)
if(OFM_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${OFM_CCACHE})
endif()

add_library(ofm_compiler INTERFACE)
# Two runs must give the same bytes: no fused multiply-add that differs between call sites.
target_compile_options(ofm_compiler INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
  -Woverloaded-virtual -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  target_compile_options(ofm_compiler INTERFACE -Wthread-safety)
endif()
if(OFM_WARNINGS_AS_ERRORS)
  target_compile_options(ofm_compiler INTERFACE -Werror)
endif()
if(OFM_SANITIZE)
  target_compile_options(ofm_compiler INTERFACE -fsanitize=${OFM_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)  # undefined behaviour fails a test, as the other reports do
  target_link_options(ofm_compiler INTERFACE -fsanitize=${OFM_SANITIZE})
endif()
if(OFM_COVERAGE)
  target_compile_options(ofm_compiler INTERFACE --coverage)
  target_link_options(ofm_compiler INTERFACE --coverage)
endif()
