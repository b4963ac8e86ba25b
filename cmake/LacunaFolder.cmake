# A folder of the kernel is a static library of its own; its links are the edges of the house's plan, so
# what a folder may include is what it links.
#
#   lacuna_folder(<name> SOURCES <file>... [DEPENDS <folder>...] [LINKS <target>...])
function(lacuna_folder name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LINKS" ${ARGN})
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
endfunction()

function(lacuna_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
  # GCC 12 sees overlaps in the standard library's own string copies that are not there.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
endfunction()
