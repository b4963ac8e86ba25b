rockspec_format = "3.0"
package = "lacuna"
version = "scm-1"
source = { url = "git+file://." }  -- luarocks make lua/lacuna-scm-1.rockspec, in the clone
description = {
  summary = "Swept hexahedra for open volumes",
  detailed = [[
Fills open volumes with hexahedra: takes the faces there are, makes those that are missing, and sweeps.
CAD files are read by the program lacuna-cad, which the environment variable LACUNA_CAD names.]],
  license = "MIT",
}
dependencies = { "lua >= 5.4, < 5.5" }
external_dependencies = { EIGEN = { header = "eigen3/Eigen/src/Core/util/Macros.h" } }
build = {
  type = "cmake",
  variables = {
    CMAKE_BUILD_TYPE = "Release",
    CMAKE_INSTALL_PREFIX = "$(PREFIX)",
    LACUNA_LUA_MODULE_DIR = "$(LIBDIR)",
    LUA54_INCLUDE_DIR = "$(LUA_INCDIR)",
    LACUNA_BUILD_TESTS = "OFF",
    LACUNA_BUILD_BENCHMARKS = "OFF",
    LACUNA_WITH_CAD = "OFF",
  },
}
