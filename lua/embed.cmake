# SPDX-License-Identifier: MIT
# Turn Lua files into one C++ file with the array kNAMEChunks:
#   cmake -DNAME=Embedded -DOUT=x.cpp "-DSOURCES=a.lua;b.lua" -P embed.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../cmake/LacunaLiteral.cmake")

set(text "// Made by lua/embed.cmake from the files named below.\n#include \"bindings/embedded.h\"\n\n")
string(APPEND text "namespace lacuna::lua {\n\nconst EmbeddedChunk k${NAME}Chunks[] = {\n")
foreach(source IN LISTS SOURCES)
  get_filename_component(name "${source}" NAME_WE)
  file(READ "${source}" body)
  string(APPEND text "    {\"${name}\",\n")
  lacuna_append_literal(text body)
  string(APPEND text "},\n")
endforeach()
string(APPEND text "};\nconst std::size_t k${NAME}ChunkCount = std::size(k${NAME}Chunks);\n\n}\n")
file(WRITE "${OUT}" "${text}")
