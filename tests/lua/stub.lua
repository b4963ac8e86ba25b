-- SPDX-License-Identifier: MIT
-- The stub of the language server, the registered fields and option keys, and the reference, against each
-- other.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local root = arg[0]:match("^(.*/)") .. "../../"

local function read(path)
  local file <close> = assert(io.open(root .. path))
  return file:read("a")
end

-- --- what the stub says ------------------------------------------------------------------------------------

local fields, parents = {}, {}  -- fields[class][name] = text
do
  local class, last
  for line in (read "lua/lacuna.d.lua" .. "\n"):gmatch("(.-)\n") do
    local name, parent = line:match("^%-%-%-@class%s+lacuna%.(%w+):?%s*([%w.]*)")
    local field, text = line:match("^%-%-%-@field%s+([%w_]+)%??%s+(.*)$")
    if name then
      class, last = name, nil
      fields[class], parents[class] = {}, parent:match("lacuna%.(%w+)")
    elseif field and class then
      fields[class][field], last = text, field
    elseif last and line:match("^%-%-%-[^@|]") then
      fields[class][last] = fields[class][last] .. " " .. line:sub(4)
    elseif not line:match("^%-%-%-") then
      if not line:match("^local ") then class = nil end
      last = nil
    end
  end
end

local function stub_fields(class)
  local all = {}
  while class do
    for name, text in pairs(assert(fields[class], class)) do all[name] = text end
    class = parents[class]
  end
  return all
end

local function names(set)
  local list = {}
  for name in pairs(set) do list[#list + 1] = name end
  table.sort(list)
  return table.concat(list, ", ")
end

-- --- fields of objects -------------------------------------------------------------------------------------

local prism = lacuna.synthetic.prism { sides = 4 }
local function open()
  return prism:open_volume { source = "source", target = "target", walls = "auto" }
end
local volume = open()
local mesh = volume:sweep { layers = 2, size = 0.5 }
local assembly = lacuna.assembly { open() }
local objects = { Model = prism, Face = prism:faces()[1], Volume = volume, Mesh = mesh, Assembly = assembly,
  AssemblyMesh = assembly:sweep { layers = 2, size = 0.5 }, Buffer = mesh:cells() }
for class, object in pairs(objects) do
  check.equal(names(debug.getmetatable(object).fields), names(stub_fields(class)), "fields of " .. class)
end

-- --- keys of options: what a call with an unknown one lists ------------------------------------------------

local function keys_of(call)
  local fine, message = pcall(call)
  check.that(not fine, "an unknown option was taken")
  local list = tostring(message):match("The keys are: ([%w_, ]+)")
  check.that(list, tostring(message))
  local keys = {}
  for key in list:gmatch("[%w_]+") do keys[key] = true end
  return keys
end

local wrong = { no_such_option = 1 }
local calls = {  -- class of the stub, call
  { "LoadOptions", function() lacuna.load("x.stl", wrong) end },
  { "ModelOptions", function() lacuna.model(wrong) end },
  { "NewFace", function() lacuna.model():add_face(wrong) end },
  { "Selector", function() prism:faces(wrong) end },
  { "Roles", function() prism:open_volume(wrong) end },
  { "FaceFromOptions", function() prism:face_from(wrong) end },
  { "MatchOptions", function() open():match(wrong) end },
  { "CloseOptions", function() open():close(wrong) end },
  { "SweepOptions", function() open():sweep(wrong) end },
  { "WriteOptions", function() mesh:write("x.msh", wrong) end },
  { "ConvertOptions", function() lacuna.convert("x.msh", "y.msh", wrong) end },
  { "Layers", function() open():sweep { layers = wrong } end },
}
for _, call in ipairs(calls) do
  check.equal(names(keys_of(call[2])), names(stub_fields(call[1])), "keys of " .. call[1])
end

-- Those of the ready-made volumes stand in the stub in place: { sides?: integer, ... }.
local stub = read "lua/lacuna.d.lua"
for name, make in pairs(lacuna.synthetic) do
  local text = stub:match("%-%-%-@param options%? (%b{})\n%-%-%-@return lacuna.Model\n" ..
    "function synthetic%." .. name)
  check.that(text, name)
  local known = {}
  for key in text:gmatch("([%w_]+)%?:") do known[key] = true end
  check.equal(names(keys_of(function() make(wrong) end)), names(known), "synthetic." .. name)
end

-- --- defaults: where stub and reference both say one -------------------------------------------------------

-- Sections of the reference whose tables are of a class of the stub, by their headings' words.
local sections = { ["Options of `load`"] = "LoadOptions", ["Options of `face_from`"] = "FaceFromOptions",
  ["Options of `add_face`"] = "NewFace", ["Naming faces"] = "Selector", ["Roles"] = "Roles",
  ["Matching"] = "MatchOptions", ["Closing"] = "CloseOptions", ["Sweeping"] = "SweepOptions",
  ["`mesh:write`"] = "WriteOptions", ["`lacuna.convert`"] = "ConvertOptions" }

-- A number, a word in quotes, true or false at the beginning; nil for a sentence.
local function plain(text)
  local word = text and text:gsub("[`*]", ""):match("^%s*(.-)%s*$"):match("^([^;,%s]+)")
  if not word then return nil end
  if word == "true" or word == "false" or word:match('^".*"$') then return word end
  return tonumber(word)
end

local compared, class, columns = 0, nil, nil
for line in (read "docs/reference.md"):gmatch("(.-)\n") do
  local heading = line:match("^#+%s+(.*)$")
  if heading then class, columns = sections[heading], nil end
  if columns and not line:match("^|") then class, columns = nil, nil end  -- further tables are of one option
  if class and line:match("^|") then
    local cells = {}
    for cell in line:gmatch("|([^|]*)") do cells[#cells + 1] = cell:match("^%s*(.-)%s*$") end
    if cells[1] == "key" or cells[1] == "option" then
      columns = {}
      for i, title in ipairs(cells) do columns[title] = i end
    elseif columns and columns.default then
      for key in cells[1]:gmatch("`([%a_][%w_]*)`") do
        local told = plain(cells[columns.default])
        local text = stub_fields(class)[key]
        check.that(text, ("%s of the reference is no option of %s"):format(key, class))
        local stubbed = plain(text:match("default:? ([^;]*)"))
        if told ~= nil and stubbed ~= nil then
          compared = compared + 1
          check.equal(stubbed, told, ("default of %s in %s"):format(key, class))
        end
      end
    end
  end
end
check.that(compared >= 5, compared .. " defaults compared")

check.done()
