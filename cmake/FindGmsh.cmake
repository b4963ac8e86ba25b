# Find the Gmsh SDK: Debian's libgmsh-dev, an SDK unpacked anywhere (GMSH_ROOT, as a CMake or environment
# variable), or one that brings its own gmshConfig.cmake.
#
#   Gmsh_FOUND, Gmsh_VERSION, Gmsh_INCLUDE_DIR, Gmsh_LIBRARY; the target Gmsh::Gmsh
set(_gmsh_hints ${GMSH_ROOT} ${Gmsh_ROOT} $ENV{GMSH_ROOT} $ENV{Gmsh_ROOT})

find_path(Gmsh_INCLUDE_DIR NAMES gmsh.h HINTS ${_gmsh_hints} PATH_SUFFIXES include)
find_library(Gmsh_LIBRARY NAMES gmsh HINTS ${_gmsh_hints} PATH_SUFFIXES lib lib64)

if(NOT Gmsh_INCLUDE_DIR OR NOT Gmsh_LIBRARY)
  find_package(gmsh CONFIG QUIET HINTS ${_gmsh_hints})
  foreach(_gmsh_target IN ITEMS gmsh::shared gmsh::gmsh gmsh::lib)
    if(TARGET ${_gmsh_target} AND NOT Gmsh_LIBRARY)
      set(_gmsh_config_target ${_gmsh_target})
      get_target_property(_gmsh_include ${_gmsh_target} INTERFACE_INCLUDE_DIRECTORIES)
      if(_gmsh_include)
        list(GET _gmsh_include 0 _gmsh_include)
        set(Gmsh_INCLUDE_DIR "${_gmsh_include}" CACHE PATH "Folder of gmsh.h" FORCE)
      endif()
      set(Gmsh_LIBRARY ${_gmsh_target})
    endif()
  endforeach()
endif()

if(Gmsh_INCLUDE_DIR AND EXISTS "${Gmsh_INCLUDE_DIR}/gmsh.h")
  file(STRINGS "${Gmsh_INCLUDE_DIR}/gmsh.h" _gmsh_define REGEX "define GMSH_API_VERSION +\"")
  string(REGEX REPLACE ".*\"([0-9.]+).*" "\\1" Gmsh_VERSION "${_gmsh_define}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gmsh
  REQUIRED_VARS Gmsh_LIBRARY Gmsh_INCLUDE_DIR
  VERSION_VAR Gmsh_VERSION
  REASON_FAILURE_MESSAGE "install libgmsh-dev, or set GMSH_ROOT to an unpacked Gmsh SDK")

if(Gmsh_FOUND AND NOT TARGET Gmsh::Gmsh)
  if(_gmsh_config_target)
    add_library(Gmsh::Gmsh INTERFACE IMPORTED)
    set_target_properties(Gmsh::Gmsh PROPERTIES INTERFACE_LINK_LIBRARIES ${_gmsh_config_target})
  else()
    add_library(Gmsh::Gmsh UNKNOWN IMPORTED)
    set_target_properties(Gmsh::Gmsh PROPERTIES
      IMPORTED_LOCATION "${Gmsh_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Gmsh_INCLUDE_DIR}")
  endif()
endif()
mark_as_advanced(Gmsh_INCLUDE_DIR Gmsh_LIBRARY)
unset(_gmsh_hints)
unset(_gmsh_define)
