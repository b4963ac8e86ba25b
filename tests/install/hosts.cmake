# Install all but the kernel, then build and run each host against what is installed, moved to another place
# first: nothing of the build may be needed.
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
file(REMOVE_RECURSE "${WORK_DIR}")
set(components library library_dev program lua python)
if(CAD)
  list(APPEND components cad)
endif()
foreach(component IN LISTS components)
  run("installing ${component}" ${CMAKE_COMMAND} --install "${BUILD_DIR}" --prefix "${WORK_DIR}/first"
    --component ${component})
endforeach()
file(RENAME "${WORK_DIR}/first" "${WORK_DIR}/prefix")
set(prefix "${WORK_DIR}/prefix")

# What the manual prints of them is theirs.
file(READ "${HOSTS_DIR}/../../../docs/hosts.md" page)
set(hosts "")
foreach(host IN ITEMS host.cpp host.c CMakeLists.txt)
  file(READ "${HOSTS_DIR}/${host}" text)
  string(APPEND hosts "${text}")
endforeach()
string(REGEX MATCHALL "\n```[a-z]+\n" begins "${page}")
list(LENGTH begins count)
if(count EQUAL 0)
  message(FATAL_ERROR "docs/hosts.md has no block of code")
endif()
foreach(begin IN LISTS begins)
  string(FIND "${page}" "${begin}" at)
  string(LENGTH "${begin}" length)
  math(EXPR at "${at} + ${length}")
  string(SUBSTRING "${page}" ${at} -1 page)
  string(FIND "${page}" "\n```\n" end)
  string(SUBSTRING "${page}" 0 ${end} block)
  string(FIND "${hosts}" "${block}" found)
  if(found EQUAL -1 AND NOT begin STREQUAL "\n```sh\n") # commands are no part of a host
    message(FATAL_ERROR "a block of docs/hosts.md is in no host:\n${block}")
  endif()
  math(EXPR end "${end} + 5") # behind its last line
  string(SUBSTRING "${page}" ${end} -1 page)
endforeach()

# The C++ and the C host, by find_package.
run("configuring the hosts" ${CMAKE_COMMAND} -S "${HOSTS_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_PREFIX_PATH=${prefix}" "-DCMAKE_C_COMPILER=${C_COMPILER}" "-DCMAKE_CXX_COMPILER=${CXX_COMPILER}"
  "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" "-DCMAKE_C_FLAGS=${CXX_FLAGS}" -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=TRUE -DCMAKE_DISABLE_FIND_PACKAGE_Gmsh=TRUE)
run("building the hosts" ${CMAKE_COMMAND} --build "${WORK_DIR}/build")
foreach(host IN ITEMS host_cpp host_c)
  run("${host}" "${WORK_DIR}/build/${host}")
  message("${output}")
  if(CAD AND NOT output MATCHES "\n[1-9][0-9]+ tetrahedra in C")
    message(FATAL_ERROR "${host} made no tetrahedra")
  endif()
endforeach()
run("ldd" ldd "${WORK_DIR}/build/host_cpp")
if(output MATCHES "gmsh" OR NOT output MATCHES "${prefix}/lib")
  message(FATAL_ERROR "the host is linked with Gmsh, or not with what is installed:\n${output}")
endif()

# What the library shows: its own names and no other's.
file(GLOB_RECURSE library "${prefix}/*/liblacuna.so")
list(GET library 0 library)
run("nm" nm -D --defined-only -C "${library}")
string(REGEX MATCHALL "[^\n]+" symbols "${output}")
list(FILTER symbols EXCLUDE REGEX " (lacuna_[a-z_]+|luaopen_lacuna|lacuna::(Interpreter|Message)::.*)$")
list(FILTER symbols EXCLUDE REGEX " (typeinfo|typeinfo name|vtable) for lacuna::[A-Za-z]+$")
if(symbols)
  message(FATAL_ERROR "the library shows more than its own: ${symbols}")
endif()

# The C host again, by pkg-config.
if(PKG_CONFIG)
  file(GLOB_RECURSE pc "${prefix}/*/lacuna.pc")
  cmake_path(GET pc PARENT_PATH pc_folder)
  set(ENV{PKG_CONFIG_PATH} "${pc_folder}")
  run("pkg-config" ${PKG_CONFIG} --cflags --libs lacuna)
  string(STRIP "${output}" flags)
  separate_arguments(flags UNIX_COMMAND "${flags} ${CXX_FLAGS}")
  cmake_path(GET library PARENT_PATH library_folder)
  run("compiling by pkg-config" ${C_COMPILER} "${HOSTS_DIR}/host.c" -o "${WORK_DIR}/by_pkg_config" ${flags}
    "-Wl,-rpath,${library_folder}")
  run("the C host by pkg-config" "${WORK_DIR}/by_pkg_config")
endif()

# Python, where no sanitizer has to be loaded before it.
if(PYTHON AND NOT CXX_FLAGS MATCHES "sanitize")
  set(ENV{PYTHONPATH} "${prefix}/lib/python3/dist-packages")
  set(ENV{LACUNA_LIBRARY} "${library}")
  run("the Python package" "${PYTHON}" -c "import lacuna; print(lacuna.synthetic.prism(sides=5).describe())")
  message("${output}")
endif()

# The module in a stock interpreter, the program and its manual page.
file(GLOB_RECURSE module "${prefix}/*/lacuna.so")
list(FILTER module INCLUDE REGEX "/lua/5.4/lacuna.so$")
if(LUA AND NOT CXX_FLAGS MATCHES "sanitize")
  set(ENV{LUA_CPATH} "${module}")
  run("the module" "${LUA}" -e "print(require('lacuna').synthetic.prism {}:describe())")
endif()
run("the program" "${prefix}/bin/lacuna" --help)
foreach(file IN ITEMS share/man/man1/lacuna.1 share/lacuna/lacuna.d.lua
    share/bash-completion/completions/lacuna share/zsh/vendor-completions/_lacuna
    share/fish/vendor_completions.d/lacuna.fish)
  if(NOT EXISTS "${prefix}/${file}")
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
