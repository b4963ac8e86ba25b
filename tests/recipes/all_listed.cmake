# A recipe that is no test is an error.
file(GLOB found RELATIVE "${FOLDER}" "${FOLDER}/*.lua")
foreach(recipe IN LISTS RECIPES)
  list(REMOVE_ITEM found ${recipe}.lua)
endforeach()
if(found)
  message(FATAL_ERROR "not in tests/recipes/CMakeLists.txt: ${found}")
endif()
