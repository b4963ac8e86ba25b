# SPDX-License-Identifier: MIT
# Join the style sheets and the scripts of the page:
#   cmake -DOUT=x.cpp "-DSOURCES=a.css;b.js" -P embed_page.cmake
include("${CMAKE_CURRENT_LIST_DIR}/../../../cmake/LacunaLiteral.cmake")

set(text "// Made by embed_page.cmake from the files in page/.\n")
string(APPEND text "#include <lacuna/view/detail/page_texts.h>\n\n")
string(APPEND text "namespace lacuna::view {\n")
foreach(kind IN ITEMS css js)
  set(body "")
  foreach(source IN LISTS SOURCES)
    if(source MATCHES "\\.${kind}$")
      file(READ "${source}" part)
      string(APPEND body "${part}")
    endif()
  endforeach()
  string(APPEND text "\nconst std::string_view kPage_${kind} =\n")
  lacuna_append_literal(text body)
  string(APPEND text ";\n")
endforeach()
string(APPEND text "\n} // namespace lacuna::view\n")
file(WRITE "${OUT}" "${text}")
