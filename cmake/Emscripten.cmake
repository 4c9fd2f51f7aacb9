# Toolchain file of the wasm preset: finds the Emscripten that is on the PATH (an emsdk's or the distribution's) and hands
# over to its own toolchain file.
find_program(QMCF_EM_CONFIG em-config)
if(NOT QMCF_EM_CONFIG)
  message(FATAL_ERROR "Emscripten not found: put emcc of an emsdk on the PATH, or apt-get install emscripten")
endif()
execute_process(COMMAND ${QMCF_EM_CONFIG} EMSCRIPTEN_ROOT OUTPUT_VARIABLE QMCF_EMSCRIPTEN_ROOT
                OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
include(${QMCF_EMSCRIPTEN_ROOT}/cmake/Modules/Platform/Emscripten.cmake)
