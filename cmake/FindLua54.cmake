# SPDX-License-Identifier: MIT
# Lua 5.4, the C build (Debian: liblua5.4-dev). CMake's own FindLua may settle for another version.
#
#   Lua54::headers   to compile against; what a module for a stock interpreter needs and no more
#   Lua54::lib       headers and library, for a program that is its own interpreter
find_path(LUA54_INCLUDE_DIR lua.hpp PATH_SUFFIXES lua5.4 lua54 lua-5.4)
find_library(LUA54_LIBRARY NAMES lua5.4 lua54 lua-5.4)

if(LUA54_INCLUDE_DIR)
  file(STRINGS "${LUA54_INCLUDE_DIR}/lua.h" lua54_lines
    REGEX "^#define LUA_VERSION_(MAJOR|MINOR|RELEASE)[ \t]+\"")
  set(LUA54_VERSION "")
  foreach(part IN ITEMS MAJOR MINOR RELEASE)
    if("${lua54_lines}" MATCHES "LUA_VERSION_${part}[ \t]+\"([0-9]+)\"")
      list(APPEND LUA54_VERSION ${CMAKE_MATCH_1})
    endif()
  endforeach()
  list(JOIN LUA54_VERSION "." LUA54_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Lua54
  REQUIRED_VARS LUA54_LIBRARY LUA54_INCLUDE_DIR VERSION_VAR LUA54_VERSION
  REASON_FAILURE_MESSAGE "on Debian it is the package liblua5.4-dev (or build with LACUNA_WITH_LUA=OFF)")

if(Lua54_FOUND AND NOT TARGET Lua54::lib)
  add_library(Lua54::headers INTERFACE IMPORTED GLOBAL)
  target_include_directories(Lua54::headers INTERFACE "${LUA54_INCLUDE_DIR}")
  add_library(Lua54::lib UNKNOWN IMPORTED GLOBAL)
  set_target_properties(Lua54::lib PROPERTIES IMPORTED_LOCATION "${LUA54_LIBRARY}")
  target_link_libraries(Lua54::lib INTERFACE Lua54::headers)
endif()
mark_as_advanced(LUA54_INCLUDE_DIR LUA54_LIBRARY)
