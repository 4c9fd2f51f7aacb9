# Header-only libraries from the system, each as an interface target, found the same way natively and under Emscripten
# (whose find_package ignores the host). Emscripten must never see the whole of /usr/include, so the one directory that
# is needed is linked into the build tree.

# qmcf_header_library(name HEADER path/of/header.hpp PACKAGE debian-package [SUBDIR eigen3])
function(qmcf_header_library name)
  cmake_parse_arguments(arg "" "HEADER;PACKAGE;SUBDIR" "" ${ARGN})
  find_path(QMCF_${name}_ROOT NAMES ${arg_HEADER} PATHS /usr/include /usr/local/include PATH_SUFFIXES "${arg_SUBDIR}"
            NO_CMAKE_FIND_ROOT_PATH)
  if(NOT QMCF_${name}_ROOT)
    message(FATAL_ERROR "${arg_HEADER} not found: apt-get install ${arg_PACKAGE}")
  endif()
  string(REGEX REPLACE "/.*" "" top ${arg_HEADER})
  set(links ${CMAKE_BINARY_DIR}/include-${name})
  file(MAKE_DIRECTORY ${links})
  file(CREATE_LINK ${QMCF_${name}_ROOT}/${top} ${links}/${top} SYMBOLIC)
  if(EXISTS ${QMCF_${name}_ROOT}/unsupported AND name STREQUAL "eigen")
    file(CREATE_LINK ${QMCF_${name}_ROOT}/unsupported ${links}/unsupported SYMBOLIC)
  endif()
  add_library(qmcf_${name} INTERFACE)
  add_library(qmcf::${name} ALIAS qmcf_${name})
  target_include_directories(qmcf_${name} SYSTEM INTERFACE ${links})
endfunction()

qmcf_header_library(eigen HEADER Eigen/Core PACKAGE libeigen3-dev SUBDIR eigen3)
# The same operations in the same order on every platform: no packet maths. No exceptions, so that wasm can do without.
target_compile_definitions(qmcf_eigen INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)
qmcf_header_library(json HEADER nlohmann/json.hpp PACKAGE nlohmann-json3-dev)
qmcf_header_library(fast_float HEADER fast_float/fast_float.h PACKAGE libfast-float-dev)
if(NOT EMSCRIPTEN)
  qmcf_header_library(cli11 HEADER CLI/CLI.hpp PACKAGE libcli11-dev)
endif()
# The system's threads; WebAssembly is built without.
add_library(qmcf_threads INTERFACE)
if(NOT EMSCRIPTEN)
  find_package(Threads REQUIRED)
  target_link_libraries(qmcf_threads INTERFACE Threads::Threads)
endif()
