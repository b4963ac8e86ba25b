# Install, configure the consumer against the installed package, build it, run it.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

file(REMOVE_RECURSE "${WORK_DIR}")
run("installing" ${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix" --component kernel)

file(GLOB_RECURSE installed "${WORK_DIR}/prefix/*.h" "${WORK_DIR}/prefix/*.cmake")
foreach(path IN LISTS installed)
  file(STRINGS "${path}" leaks REGEX "#include <gmsh|${BUILD_DIR}")
  if(path MATCHES "/lacuna/cad_worker/" OR leaks)
    message(FATAL_ERROR "${path} needs Gmsh or the build folder: ${leaks}")
  endif()
endforeach()

run("configuring the consumer" ${CMAKE_COMMAND} -S "${CONSUMER_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}"
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_FIND_PACKAGE_Gmsh=TRUE)
run("building the consumer" ${CMAKE_COMMAND} --build "${WORK_DIR}/build")
run("the consumer" "${WORK_DIR}/build/consumer")
message("${output}")
run("ldd" ldd "${WORK_DIR}/build/consumer")
if(output MATCHES "gmsh")
  message(FATAL_ERROR "the consumer is linked with Gmsh:\n${output}")
endif()
