# A folder of the kernel is a static library of its own; its links are the edges of the house's plan, so
# what a folder may include is what it links.
#
#   lacuna_folder(<name> SOURCES <file>... [DEPENDS <folder>...] [LINKS <target>...] [APART <file>...])
function(lacuna_folder name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LINKS;APART" ${ARGN})
  add_library(lacuna_${name} STATIC ${arg_SOURCES})
  add_library(lacuna::${name} ALIAS lacuna_${name})
  set_target_properties(lacuna_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(lacuna_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/kernel> $<INSTALL_INTERFACE:include>)
  target_compile_features(lacuna_${name} PUBLIC cxx_std_20)
  target_link_libraries(lacuna_${name} PUBLIC ${arg_LINKS})
  foreach(folder IN LISTS arg_DEPENDS)
    target_link_libraries(lacuna_${name} PUBLIC lacuna::${folder})
  endforeach()
  lacuna_warnings(lacuna_${name})
  lacuna_precompile(lacuna_${name} FROM lacuna_core)
  lacuna_compile_together(lacuna_${name} APART ${arg_APART})
endfunction()

# Sources whose inner loops run four at a time, which a square root that sets an error number and comparisons
# that trap would stop. No product is fused with a sum: wider vectors change no bit.
function(lacuna_vector_sources)
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
      COMPILE_OPTIONS "-fno-math-errno;-fno-trapping-math;-ffp-contract=off")
  endif()
endfunction()

# With LACUNA_PRECOMPILE, the headers that nearly all sources include (Eigen's, the standard's, our errors)
# are read once for all targets that are compiled alike, which spares a build a quarter of its time: the first
# of them makes what the others take. MORE: other headers than those.
#
#   lacuna_precompile(<target> FROM <first target> [MORE <header>...])
function(lacuna_precompile target)
  cmake_parse_arguments(arg "" "FROM" "MORE" ${ARGN})
  if(NOT LACUNA_PRECOMPILE)
    return()
  endif()
  if(target STREQUAL arg_FROM)
    target_precompile_headers(${target} PRIVATE <Eigen/Core> <Eigen/Geometry>
      <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <numbers> <numeric>
      <optional> <ranges> <set> <span> <string> <string_view> <unordered_map> <utility> <variant> <vector>
      <lacuna/core/error.h> <lacuna/core/ids.h> ${arg_MORE})
  else()
    target_precompile_headers(${target} REUSE_FROM ${arg_FROM})
  endif()
  # The compiler then collects its garbage less often: 6 % less processor time, for up to 1 GB of memory.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE --param=ggc-min-heapsize=1000000)
  endif()
  # GCC 12 sees bounds that are passed in string copies which come out of a precompiled header.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

# With LACUNA_PRECOMPILE, the sources of a target are compiled some at a time, which spares a third of what is
# left. APART: those that use a name otherwise than another source of the target does.
#
#   lacuna_compile_together(<target> [APART <file>...])
function(lacuna_compile_together target)
  cmake_parse_arguments(arg "" "" "APART" ${ARGN})
  if(NOT LACUNA_PRECOMPILE)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  set_source_files_properties(${arg_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(lacuna_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
  # GCC 12 sees overlaps in the standard library's own string copies that are not there.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()
