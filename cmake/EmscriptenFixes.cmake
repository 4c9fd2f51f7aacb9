# What Emscripten, from 3.1.6 on, needs to build with any Node. Here and not in the toolchain file, so that
# `emcmake cmake --preset wasm` has it too.

# emcmake sets a flag that newer versions of Node refuse.
find_program(QMCF_NODE NAMES node nodejs REQUIRED NO_CMAKE_FIND_ROOT_PATH)
set(CMAKE_CROSSCOMPILING_EMULATOR ${QMCF_NODE})

# Debian keeps the JavaScript packages that emcc needs (acorn) where only its own Node looks.
if(EXISTS /usr/share/nodejs/acorn)
  set(CMAKE_CXX_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)
endif()

# Nothing in the library throws; leaving exceptions out saves a fifth of the size.
add_compile_options(-fno-exceptions)
