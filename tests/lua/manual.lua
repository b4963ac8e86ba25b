-- SPDX-License-Identifier: MIT
-- The stub, the reference and the program name the same options, and the same defaults.
local folder = arg[0]:match("^(.*/)")
local check = dofile(folder .. "check.lua")
local lacuna = require "lacuna"

local function read(path)
  local file <close> = assert(io.open(path))
  return file:read("a")
end

-- --- what the stub says ------------------------------------------------------------------------------------

local stub, class = {}, nil
for line in read(folder .. "../../lua/lacuna.d.lua"):gmatch("[^\n]+") do
  local name, base = line:match("^%-%-%-@class lacuna%.(%w+):? ?l?a?c?u?n?a?%.?(%w*)")
  if name then
    class = { fields = {}, base = base ~= "" and base or nil }
    stub[name] = class
  elseif not line:match("^%-%-%-") then
    class = nil
  end
  local field, rest = line:match("^%-%-%-@field ([%w_]+)%?? (.*)$")
  if field and class then class.fields[field] = rest end
end
local function fields_of(name)
  local all = {}
  while name do
    for field, rest in pairs(assert(stub[name], name).fields) do all[field] = rest end
    name = stub[name].base
  end
  return all
end

-- --- what the program takes --------------------------------------------------------------------------------

local function prism() return lacuna.synthetic.prism() end
local function volume()
  return prism():open_volume { source = "source", target = "target", walls = "auto" }
end
local mesh = volume():sweep { layers = 1, size = 1 }
local both = lacuna.assembly({ volume() }):sweep { layers = 1, size = 1 }
local quads = prism():quads { size = 1 }
local calls = {
  { "LoadOptions", function(o) lacuna.load("nowhere.step", o) end },
  { "ModelOptions", lacuna.model },
  { "FaceFromOptions", function(o) prism():face_from(o) end },
  { "NewFace", function(o) lacuna.model():add_face(o) end },
  { "Selector", function(o) prism():faces(o) end },
  { "Roles", function(o) prism():open_volume(o) end },
  { "MatchOptions", function(o) volume():match(o) end },
  { "CloseOptions", function(o) volume():close(o) end },
  { "SweepOptions", function(o) volume():sweep(o) end },
  { "Layers", function(o) volume():sweep { layers = o } end },
  { "WriteOptions", function(o) mesh:write("x.msh", o) end },
  { "ConvertOptions", function(o) lacuna.convert("x.msh", "y.msh", o) end },
  { "WriteOptions", function(o) both:write("x.msh", o) end },
  { "PageOptions", function(o) prism():view("x.html", o) end },
  { "PageOptions", function(o) volume():view("x.html", o) end },
  { "PageOptions", function(o) mesh:view("x.html", o) end },
  { "PageOptions", function(o) both:view("x.html", o) end },
  { "ViewOptions", function(o) lacuna.view("x.step", "x.html", o) end },
  { "FileOptions", function(o) lacuna.picture("x.step", "x.png", o) end },
  { "FacePictureOptions", function(o) prism():picture("x.png", o) end },
  { "FacePictureOptions", function(o) volume():picture("x.png", o) end },
  { "PictureOptions", function(o) mesh:picture("x.png", o) end },
  { "PictureOptions", function(o) both:picture("x.png", o) end },
  { "QuadsOptions", function(o) prism():quads(o) end },
  { "QuadsWriteOptions", function(o) quads:write("x.msh", o) end },
  { "PageOptions", function(o) quads:view("x.html", o) end },
  { "FacePictureOptions", function(o) quads:picture("x.png", o) end },
  { "CopyOptions", function(o) mesh:copy(o) end },
  { "PatternOptions", function(o) mesh:pattern(o) end },
}
local reference = read(folder .. "../../docs/reference.md")
for _, call in ipairs(calls) do
  local message = check.fails(function() call[2] { no_such_key = 1 } end, "'no_such_key'", "The keys are:")
  local taken = {}
  for key in message:match("The keys are: ([^%[]*)"):gmatch("[%w_]+") do taken[key] = true end
  local fields = fields_of(call[1])
  for field in pairs(fields) do
    check.that(taken[field], call[1] .. "." .. field .. " of the stub is no option")
    check.that(reference:find("`[^`\n]*%f[%w_]" .. field .. "%f[^%w_][^`\n]*`"),
        call[1] .. "." .. field .. " is not in the reference")
  end
  for key in pairs(taken) do
    check.that(fields[key] or key:match("^%d+$"), call[1] .. "." .. key .. " is not in the stub")
  end
  -- A default that the stub has is in a row of the reference that begins with the option.
  for field, rest in pairs(fields) do
    local default = rest:match("default (%-?[%d%.]+e?%-?%d*)") or rest:match("default (true)")
        or rest:match("default (false)") or rest:match('default "(%w+)"')
    local found = default == nil
    for line in reference:gmatch("[^\n]+") do
      if line:find("^|[^|]*`" .. field .. "`") and default then
        found = found or line:find(default, 1, true)
      end
    end
    check.that(found,
        ("%s.%s: no row of the reference has the default %s"):format(call[1], field, default))
  end
end

-- --- fields of objects, and keys that the stub has in place ------------------------------------------------

local function names(set)
  local list = {}
  for name in pairs(set) do list[#list + 1] = name end
  table.sort(list)
  return table.concat(list, ", ")
end

local objects = { Model = prism(), Face = prism():faces()[1], Volume = volume(), Mesh = mesh,
  Assembly = lacuna.assembly { volume() }, AssemblyMesh = both, QuadMesh = quads, Buffer = mesh:cells() }
for name, object in pairs(objects) do
  check.equal(names(debug.getmetatable(object).fields), names(fields_of(name)), "fields of " .. name)
end

local text = read(folder .. "../../lua/lacuna.d.lua")
for name, make in pairs(lacuna.synthetic) do
  local keys = text:match("%-%-%-@param options%? (%b{})\n%-%-%-@return lacuna.Model\n" ..
    "function synthetic%." .. name)
  local known, taken = {}, {}
  check.that(keys, name)
  for key in keys:gmatch("([%w_]+)%?:") do known[key] = true end
  local message = check.fails(function() make { no_such_key = 1 } end, "The keys are:")
  for key in message:match("The keys are: ([^%[]*)"):gmatch("[%w_]+") do taken[key] = true end
  check.equal(names(taken), names(known), "synthetic." .. name)
end

-- --- what is promised and not there yet: the reference lists every word that is refused --------------------

local function first_refused(call) return not pcall(call) end
local promised = {
  along = function() prism():open_volume { source = "source", along = { vector = { 0, 0, 1 } } } end,
  ['class = "0"'] = function()
    prism():open_volume { source = "source", along = { vector = { 0, 0, 1 } }, class = "0" }
  end,
  fill_to = function()
    prism():open_volume { source = "source", walls = "auto", fill_to = { { 0, 0, 0.5 }, { 0, 0, 1 } } }
  end,
  quads = function() return prism().quads end,
  split_interface = function() return assert(lacuna.split_interface) end,
  auto = function() volume():cut { auto = true } end,
  ['fallback = "mixed"'] = function() volume():sweep { size = 1, fallback = "mixed" } end,
  seconds = function() volume():sweep { size = 1, seconds = 1 } end,
  periodic = function() volume():sweep { size = 1, periodic = {} } end,
  copy = function() return mesh.copy end,
  pattern = function() return mesh.pattern end,
  pyramids = function() return mesh.pyramids end,
  tets = function() return mesh.tets end,
  unit = function()
    local _, message = pcall(lacuna.load, "nowhere.stl", { unit = "mm" })
    if tostring(message):find("unknown option 'unit'", 1, true) then error(message) end
  end,
  [".k"] = function() mesh:write "x.k" end,
  [".feb"] = function() mesh:write "x.feb" end,
  [".med"] = function() mesh:write "x.med" end,
  polyMesh = function() mesh:write "polyMesh" end,
}
local listed = {}
for row in reference:match("\n## Not yet\n.-\n\n(|.-)\n\n"):gmatch("[^\n]+") do
  for word in row:match("^|([^|]*)|"):gmatch("`([^`]+)`") do listed[word] = true end
end
check.that(next(listed), "the reference has a list of what is not there yet")
for word, call in pairs(promised) do
  check.equal(first_refused(call), listed[word] == true, word .. ": refused, and listed as not there yet")
end
for word in pairs(listed) do check.that(promised[word], word .. " is listed, and was not promised") end

check.done()
