# SPDX-License-Identifier: MIT
foreach(binary IN LISTS BINARIES)
  execute_process(COMMAND ldd "${binary}" OUTPUT_VARIABLE libraries COMMAND_ERROR_IS_FATAL ANY)
  if(libraries MATCHES "gmsh|TKernel")
    message(FATAL_ERROR "${binary} is linked with Gmsh or Open CASCADE:\n${libraries}")
  endif()
endforeach()
