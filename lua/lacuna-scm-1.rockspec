rockspec_format = "3.0"
package = "lacuna"
version = "scm-1"
source = { url = "git+file://." }  -- luarocks make lua/lacuna-scm-1.rockspec, in the clone
description = {
  summary = "Swept hexahedra for open volumes",
  detailed = [[
Meshes open volumes with hexahedra: it generates the missing faces, then sweeps the volume.
CAD files are read by the program lacuna-cad; the environment variable LACUNA_CAD gives its path.]],
  license = "MIT",
}
dependencies = { "lua >= 5.4, < 5.5" }
external_dependencies = { EIGEN = { header = "eigen3/Eigen/src/Core/util/Macros.h" } }
-- Only the module is installed: luarocks would take other installed files for Lua modules.
build = {
  type = "command",
  build_command = "cmake -S . -B build.luarocks -DCMAKE_BUILD_TYPE=Release -DLACUNA_WITH_CAD=OFF "
      .. "-DLACUNA_BUILD_TESTS=OFF -DLACUNA_BUILD_BENCHMARKS=OFF '-DLACUNA_LUA_MODULE_DIR=$(LIBDIR)' "
      .. "'-DLUA54_INCLUDE_DIR=$(LUA_INCDIR)' && cmake --build build.luarocks --target lacuna_module",
  install_command = "cmake --install build.luarocks --component lua --prefix '$(PREFIX)'",
}
