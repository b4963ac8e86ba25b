# SPDX-License-Identifier: MIT
# Turn Lua files into one C++ file with the array kNAMEChunks:
#   cmake -DNAME=Embedded -DOUT=x.cpp "-DSOURCES=a.lua;b.lua" -P embed.cmake
set(text "// Made by lua/embed.cmake from the files named below.\n#include \"bindings/embedded.h\"\n\n")
string(APPEND text "namespace lacuna::lua {\n\nconst EmbeddedChunk k${NAME}Chunks[] = {\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(name "${source}" NAME_WE)
  file(READ "${source}" body)
  string(LENGTH "${body}" length)
  string(APPEND text "    {\"${name}\",\n")
  # One string literal may hold no more than 64 KiB everywhere; pieces of 8 KiB are joined by the compiler.
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${body}" ${at} 8192 piece)
    string(APPEND text "R\"lua_source(${piece})lua_source\"\n")
    math(EXPR at "${at} + 8192")
  endwhile()
  string(APPEND text "},\n")
endforeach()
string(APPEND text "};\nconst std::size_t k${NAME}ChunkCount = std::size(k${NAME}Chunks);\n\n}\n")
file(WRITE "${OUT}" "${text}")
