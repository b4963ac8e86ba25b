-- SPDX-License-Identifier: MIT
-- Proves the plan of the house: which folder of the kernel may include which, that headers include each other
-- in no circle, who may name Gmsh and Lua, and what the kernel never does (print, end the process).
-- Headers are of three kinds: installed (listed in cmake/installed_headers.cmake), shared between folders of
-- the kernel (shared/), and private (detail/).
--
--   lua5.4 house.lua SOURCE_DIR
--
-- First the rules are tried on wrong samples, each of which must be found out; then on the kernel.

-- A folder may include what it names here and all that those may include. `<lacuna/fill.h>` is of `fill`.
local plan = {
  core = {},
  geometry = { "core" },
  mesh = { "core" },
  quads = { "geometry", "mesh" },
  topology = { "geometry" },
  healing = { "topology" },
  matching = { "topology" },
  closure = { "matching" },
  surface = { "matching", "quads" },
  quality = { "mesh" },
  sweep = { "closure", "surface", "quality" },
  io = { "mesh", "healing" },
  fill = { "sweep", "io" },
  view = { "closure", "io", "quality" },
  team = { "fill" },
  mpi = { "team" },
  cad_protocol = { "core" },
  cad = { "cad_protocol", "closure", "healing", "io", "surface" },
  cad_worker = { "cad_protocol", "geometry" },
}

local function reachable(folder, set)
  set = set or {}
  set[folder] = true
  for _, below in ipairs(plan[folder]) do reachable(below, set) end
  return set
end

-- Comments and string literals blanked out, lines kept, so that prose may say "printf".
local function code_of(text)
  local out, at = {}, 1
  local function keep_lines(part) return (part:gsub("[^\n]", " ")) end
  while at <= #text do
    local from = text:find("[/\"']", at)
    if not from then out[#out + 1] = text:sub(at); break end
    out[#out + 1] = text:sub(at, from - 1)
    local to
    local two = text:sub(from, from + 1)
    if two == "//" then to = (text:find("\n", from, true) or #text + 1) - 1
    elseif two == "/*" then to = select(2, text:find("*/", from + 2, true)) or #text
    elseif text:sub(from - 1, from) == 'R"' then
      local mark = text:match("^([^%(]*)%(", from + 1)
      to = select(2, text:find(")" .. mark .. '"', from, true)) or #text
    elseif text:sub(from, from) == '"' then
      to = from + 1
      while to <= #text and text:sub(to, to) ~= '"' do to = to + (text:sub(to, to) == "\\" and 2 or 1) end
    elseif text:sub(from, from) == "'" and not text:sub(from - 1, from - 1):match("%x") then  -- not 1'000'000
      to = from + 1
      while to <= #text and text:sub(to, to) ~= "'" do to = to + (text:sub(to, to) == "\\" and 2 or 1) end
    else
      out[#out + 1] = text:sub(from, from)
      at = from + 1
      goto continue
    end
    out[#out + 1] = keep_lines(text:sub(from, to))
    at = to + 1
    ::continue::
  end
  return table.concat(out)
end

local forbidden = { "cout", "cerr", "clog", "printf", "fprintf", "vprintf", "puts", "fputs", "putchar",
                    "perror",
                    "abort", "exit", "_Exit", "quick_exit", "terminate" }

-- Folders whose headers are of no kind: programs and parts that are built only on demand.
local apart = { cad_worker = true, mpi = true }

-- "installed", "shared" or "private"; nil: of no kind.
local function kind_of(header, installed)
  if header:match("/shared/") then return "shared" end
  if header:match("/detail/") then return "private" end
  return installed[header:gsub("^lacuna/", "")] and "installed" or nil
end

-- What is wrong with one file of the kernel, as sentences.
local function faults(folder, path, text, installed)
  local found = {}
  local function fault(line, what) found[#found + 1] = ("%s:%d: %s"):format(path, line, what) end

  local licence = folder == "cad_worker" and "GPL-2.0-or-later" or "MIT"
  if not text:match("^// SPDX%-License%-Identifier: " .. licence:gsub("[%.%-]", "%%%0") .. "\n") then
    fault(1, "the first line does not name the licence " .. licence)
  end
  if path:match("%.h$") and not text:match("\n#pragma once\n") then
    fault(1, "a header without #pragma once")
  end

  if (path:match("/detail/") or path:match("/shared/")) and not path:match("%.h$") then
    fault(1, path:match("/(%a+)/[^/]+$") .. "/ holds headers alone")
  end
  local of_a_kind = path:match("%.h$") and not apart[folder]
  local kind = of_a_kind and kind_of(path:match("kernel/(lacuna/.+)$") or path, installed)
  if of_a_kind and not kind then
    fault(1, "a header that is neither installed nor in shared/ or detail/")
  end

  local allowed = reachable(folder)
  local number = 0
  for line in (text .. "\n"):gmatch("(.-)\n") do
    number = number + 1
    local include = line:match('^%s*#%s*include%s*[<"]([^>"]+)[>"]')
    if include then
      local other = include:match("^lacuna/([^/]+)/") or include:match("^lacuna/([^/]+)%.h$")
      if other and not plan[other] then
        fault(number, ("includes <%s>, and the plan has no folder %s"):format(include, other))
      elseif other and not allowed[other] then
        fault(number, ("%s includes <%s>, which is not below it"):format(folder, include))
      elseif other and other ~= folder and include:match("^lacuna/[^/]+/detail/") then
        fault(number, ("includes <%s>, which is internal to %s"):format(include, other))
      elseif kind == "installed" and other and kind_of(include, installed) ~= "installed" then
        fault(number, ("an installed header includes <%s>, which is not installed"):format(include))
      elseif kind == "shared" and include:match("/detail/") then
        fault(number, ("a shared header includes <%s>, which is private"):format(include))
      elseif include:match("^%.%.") then
        fault(number, ("includes \"%s\": say <lacuna/folder/file.h>"):format(include))
      end
      local base = include:match("[^/]+$")
      if base:match("^gmsh[%w_]*%.h") and folder ~= "cad_worker" then
        fault(number, "only cad_worker/ may include " .. include)
      end
      if base == "mpi.h" and folder ~= "mpi" then fault(number, "only mpi/ may include " .. include) end
      if base:match("^lua.*%.hp*$") or base:match("^lauxlib%.h") or base == "lualib.h" then
        fault(number, "only lua/ may include " .. include)
      end
      if base == "iostream" and folder ~= "cad_worker" then
        fault(number, "the kernel does not print: no <iostream>")
      end
    end
  end

  number = 0
  for line in (code_of(text) .. "\n"):gmatch("(.-)\n") do
    number = number + 1
    -- Gmsh prints on its own; cad_worker/ may turn the stream aside, which is not printing.
    if folder == "cad_worker" then line = line:gsub("cout%.rdbuf%f[^%w_]", "") end
    for before, word in line:gmatch("(.?)%f[%w_]([%a_][%w_]*)") do
      for _, bad in ipairs(forbidden) do
        if word == bad and before ~= "." then
          fault(number, "the kernel does not print or end the process: " .. word)
        end
      end
    end
  end
  return found
end

-- The rules, tried: every wrong sample must be found out and the right ones let through.
local mit, gpl = "// SPDX-License-Identifier: MIT\n", "// SPDX-License-Identifier: GPL-2.0-or-later\n"
local samples = {
  { "core", mit .. "#include <lacuna/geometry/newell.h>\n", "not below it" },
  { "mesh", mit .. "#include <lacuna/topology/model.h>\n", "not below it" },
  { "io", mit .. "#include <lacuna/cad/load.h>\n", "not below it" },
  { "io", mit .. "#include <lacuna/nowhere/x.h>\n", "no folder nowhere" },
  { "io", mit .. "#include <gmsh.h>\n", "only cad_worker/" },
  { "cad", mit .. "#include <gmsh.h>\n", "only cad_worker/" },
  { "cad", mit .. "#include <lacuna/cad_worker/session.h>\n", "not below it" },
  { "core", mit .. "#include <lacuna/cad_worker/session.h>\n", "not below it" },
  { "team", mit .. "#include <mpi.h>\n", "only mpi/" },
  { "mpi", mit .. "#include <mpi.h>\n#include <lacuna/core/team.h>\n" },
  { "io", mit .. "#include <lacuna/team/shared/tasks.h>\n", "not below it" },
  { "sweep", mit .. "#include <lacuna/fill.h>\n", "not below it" },
  { "fill", mit .. "#include <lacuna/fill.h>\n#include <lacuna/io/deck.h>\n" },
  { "cad_worker", gpl .. "#include <lua5.4/lauxlib.h>\n", "only lua/" },
  { "cad_worker", mit .. "#include <gmsh.h>\n", "licence GPL" },
  { "cad", gpl, "licence MIT" },
  { "core", gpl, "licence MIT" },
  { "core", mit .. "void f() { std::cout << 1; }\n", "cout" },
  { "core", mit .. 'void f() { printf("x"); }\n', "printf" },
  { "core", mit .. "void f() { std::abort(); }\n", "abort" },
  { "core", mit .. "int big = 1'000'000; void f() { exit(1); }\n", "exit" },
  { "cad_worker", gpl .. "auto* old = std::cout.rdbuf(mine);\nvoid f() { std::cout << 1; }\n",
      "sample.cpp:3" },
  { "cad_worker", gpl .. "auto* old = std::cout.rdbuf(mine);\n" },
  { "sweep", mit .. "#include <lacuna/core/types.h>\n#include <lacuna/closure/close.h>\n" },
  { "sweep", mit .. "#include <lacuna/surface/detail/linking_map.h>\n", "internal to surface" },
  { "surface", mit .. "#include <lacuna/surface/detail/linking_map.h>\n" },
  { "surface", mit .. "#pragma once\n#include <lacuna/surface/detail/linking_map.h>\n", "not installed",
      "lacuna/surface/requests.h" },
  { "surface", mit .. "#pragma once\n#include <lacuna/surface/shared/walls.h>\n", "not installed",
      "lacuna/surface/requests.h" },
  { "surface", mit .. "#pragma once\n#include <lacuna/surface/detail/linking_map.h>\n", "which is private",
      "lacuna/surface/shared/walls.h" },
  { "surface", mit .. "#pragma once\n#include <lacuna/surface/requests.h>\n", nil,
      "lacuna/surface/shared/walls.h" },
  { "surface", mit .. "#pragma once\n", "neither installed nor", "lacuna/surface/walls.h" },
  { "cad_worker", gpl .. "#pragma once\n", nil, "lacuna/cad_worker/session.h" },
  { "surface", mit .. "int f() { return 1; }\n", "headers alone", "lacuna/surface/detail/linking_map.cpp" },
  { "cad_worker", gpl .. "#include <gmsh.h>\n#include <lacuna/geometry/shared/delaunay.h>\n" },
  { "core", mit .. '// exit, printf and abort in prose\nauto s = "printf \\" exit";\n'
      .. 'std::snprintf(b, 1, "abort");\n' },
}
local wrong = 0
for number, sample in ipairs(samples) do
  local found = table.concat(faults(sample[1], sample[4] or "sample.cpp", sample[2],
      { ["surface/requests.h"] = true }), "\n")
  local good = sample[3] and found:find(sample[3], 1, true) or not sample[3] and found == ""
  if not good then
    wrong = wrong + 1
    print(("sample %d: expected %s, found: %s"):format(number, sample[3] or "no fault", found))
  end
end

-- A circle of includes, from a table of what each header includes: the headers on it, or nil.
local function circle(includes)
  local state, found = {}, nil
  local function visit(header, trail)
    state[header] = "open"
    trail[#trail + 1] = header
    for _, other in ipairs(includes[header] or {}) do
      if state[other] == "open" then found = found or table.concat(trail, " -> ") .. " -> " .. other
      elseif not state[other] then visit(other, trail) end
    end
    trail[#trail] = nil
    state[header] = "done"
  end
  for header in pairs(includes) do
    if not state[header] then visit(header, {}) end
  end
  return found
end
if not circle { a = { "b" }, b = { "c" }, c = { "a" } } or circle { a = { "b", "c" }, b = { "c" } } then
  wrong = wrong + 1
  print("a circle of includes is not told from a tree")
end

-- The kernel.
local includes = {}
local root = assert(arg[1], "usage: house.lua SOURCE_DIR")
local installed, lengths = {}, {}
do
  local file <close> = assert(io.open(root .. "/cmake/installed_headers.cmake"))
  for header in file:read("a"):gsub("#[^\n]*", ""):gmatch("%f[%w_][%w_/]+%.h") do installed[header] = true end
end
for header in pairs(installed) do
  local file <close> = assert(io.open(root .. "/kernel/lacuna/" .. header))
  local lines = 0
  for _ in file:lines() do lines = lines + 1 end
  lengths[#lengths + 1] = lines
  lengths.sum = (lengths.sum or 0) + lines
end
table.sort(lengths)
for _, rule in ipairs {
  { "headers", #lengths, 50 }, { "lines in half of them", lengths[(#lengths + 1) // 2], 80 },
  { "lines in the longest", lengths[#lengths], 220 }, { "lines in all", lengths.sum, 5000 },
} do
  if rule[2] > rule[3] then
    wrong = wrong + 1
    print(("installed headers: %d %s, %d at most"):format(rule[2], rule[1], rule[3]))
  end
end
local files = 0
-- The one search of a sweep: `mesh_candidate()` makes cells, and `Search` alone calls it. Errors of the
-- project are caught to try something else, or to say more, in no more places than these; the number may only
-- fall.
local made, caught, most_caught = 0, 0, 32
local list = assert(io.popen(
    ("find '%s/kernel/lacuna' -name '*.h' -o -name '*.cpp' | LC_ALL=C sort"):format(root)))
for path in list:lines() do
  local folder = path:match("/kernel/lacuna/([^/]+)/[^/]+$") or path:match("/kernel/lacuna/([^/]+)%.h$")
      or path:match("/kernel/lacuna/([^/]+)/detail/[^/]+$")
      or path:match("/kernel/lacuna/([^/]+)/shared/[^/]+$")
  if not folder or not plan[folder] then
    wrong = wrong + 1
    print(path .. ": the plan has no folder for it")
  else
    local file <close> = assert(io.open(path))
    local text = file:read("a")
    if path:match("%.h$") then
      local header = path:match("/kernel/(lacuna/.+)$")
      includes[header] = {}
      for include in text:gmatch("#include <(lacuna/[^>]+)>") do table.insert(includes[header], include) end
    end
    for _, fault in ipairs(faults(folder, path, text, installed)) do
      wrong = wrong + 1
      print(fault)
    end
    local code = code_of(text)
    made = made + select(2, code:gsub("%f[%w_]mesh_candidate%(", ""))
    if folder ~= "fill" and not folder:match("^cad") then
      for kind in code:gmatch("catch %(const (%w+)&") do
        if ("Error NotSweepable NotClosed InvalidInput BackendError "):find(kind .. " ", 1, true) then
          caught = caught + 1
        end
      end
    end
    files = files + 1
  end
end
list:close()
local round = circle(includes)
if round then wrong = wrong + 1; print("headers include each other in a circle: " .. round) end
if made ~= 2 then
  wrong = wrong + 1
  print(("mesh_candidate() has %d callers, 1 wanted"):format(made - 1))
end
if caught > most_caught then
  wrong = wrong + 1
  print(("errors of the project are caught in %d places, %d at most"):format(caught, most_caught))
end
-- What the top level holds; test runs must leave nothing that is then committed.
local top = {}
for name in ([[.ci .clang-format .clang-tidy .editorconfig .gitignore ARCHITECTURE.md CHANGELOG.md
    CMakeLists.txt CMakePresets.json CONTRIBUTING.md LICENSE LICENSES README.md benchmarks cmake docs hosts
    kernel lua mkdocs.yml python scripts tests]]):gmatch "%S+" do
  top[name] = true
end
local tracked = assert(io.popen("git -C '" .. root .. "' ls-files 2>/dev/null"))
for path in tracked:lines() do
  if not top[path:match "^[^/]+"] then
    wrong = wrong + 1
    print(path .. ": the top level has no place for it")
  end
end
tracked:close()
if files == 0 then wrong = wrong + 1; print("no file found under " .. root .. "/kernel/lacuna") end
print(("%d files, %d faults"):format(files, wrong))
os.exit(wrong == 0)
