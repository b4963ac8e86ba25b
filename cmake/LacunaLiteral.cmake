# SPDX-License-Identifier: MIT

# Append the text of one variable to C++ source in another, as a string literal. One literal may hold no more
# than 64 KiB everywhere; pieces of 8 KiB are joined by the compiler.
function(lacuna_append_literal source_variable text_variable)
  string(LENGTH "${${text_variable}}" length)
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${${text_variable}}" ${at} 8192 piece)
    string(APPEND ${source_variable} "R\"embedded(${piece})embedded\"\n")
    math(EXPR at "${at} + 8192")
  endwhile()
  set(${source_variable} "${${source_variable}}" PARENT_SCOPE)
endfunction()
