# With the include directories that a module gets from the build, a header of a lower module compiles and one of a higher
# or unrelated module is not even found.
cmake_minimum_required(VERSION 3.25)

function(expect module header outcome)
  file(STRINGS ${VISIBLE}/${module}.txt directories)
  list(TRANSFORM directories PREPEND -I)
  set(source ${WORK}/probe_${module}.cpp)
  file(WRITE ${source} "#include \"${header}\"\n")
  execute_process(COMMAND ${CXX} -std=c++20 -fsyntax-only ${directories} ${source} RESULT_VARIABLE status
                  ERROR_VARIABLE messages)
  if(outcome STREQUAL "compiles" AND NOT status EQUAL 0)
    message(FATAL_ERROR "${module} should be able to include ${header}:\n${messages}")
  endif()
  if(outcome STREQUAL "is not found" AND NOT messages MATCHES "${header}[^\n]*(No such file|not found)")
    message(FATAL_ERROR "${module} should not be able to include ${header}")
  endif()
endfunction()

expect(mesh qmcf/base/vec.hpp "compiles")
expect(pipeline qmcf/mesh/surface.hpp "compiles")
expect(background qmcf/topology/brep.hpp "compiles")
expect(base qmcf/mesh/surface.hpp "is not found")
expect(io qmcf/topology/brep.hpp "is not found")
expect(topology qmcf/field/cross_field.hpp "is not found")
expect(field qmcf/background/background.hpp "is not found")
expect(quality qmcf/field/cross_field.hpp "is not found")
expect(front qmcf/pipeline/mesh_surface.hpp "is not found")
expect(pipeline qmcf/io/read.hpp "is not found")
