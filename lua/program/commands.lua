-- SPDX-License-Identifier: MIT
-- The commands of the program: command, options, file, ...
local command, json, first, second = ...
local lacuna = require "lacuna"

-- --- JSON --------------------------------------------------------------------------------------------------

local escapes = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }

local function quoted(text)
  return '"' .. text:gsub('[%c"\\]', function(c) return escapes[c] or ("\\u%04x"):format(c:byte()) end) .. '"'
end

local function number(value)
  if math.type(value) == "integer" then return ("%d"):format(value) end
  if value ~= value or value == math.huge or value == -math.huge then return "null" end
  local short = ("%.15g"):format(value)
  return tonumber(short) == value and short or ("%.17g"):format(value)
end

local encode

-- Keys in order, so that the same file gives the same text.
local function object(value)
  local keys, parts = {}, {}
  for key in pairs(value) do keys[#keys + 1] = key end
  table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
  for i, key in ipairs(keys) do parts[i] = quoted(tostring(key)) .. ": " .. encode(value[key]) end
  return "{" .. table.concat(parts, ", ") .. "}"
end

function encode(value)
  local kind = type(value)
  if kind == "number" then return number(value) end
  if kind == "boolean" then return tostring(value) end
  if kind == "string" then return quoted(value) end
  if kind == "nil" then return "null" end
  if kind ~= "table" then return quoted(tostring(value)) end
  if #value == 0 and next(value) ~= nil then return object(value) end
  local parts = {}
  for i = 1, #value do parts[i] = encode(value[i]) end
  return "[" .. table.concat(parts, ", ") .. "]"
end

-- --- the commands ------------------------------------------------------------------------------------------

local commands = {}

function commands.info()
  local model = lacuna.load(first)
  local found, volume = pcall(model.open_volume, model)
  if json then
    local told = model:info()
    told.file = first
    if found then told.class, told.roles = volume.class, volume:describe() end
    if not found then told.roles_refused = volume.message or tostring(volume) end
    return print(encode(told))
  end
  print(model:describe())
  print(found and "likely roles, no sweep was checked:\n" .. volume:describe() or
    "likely roles: none found: " .. volume)
end

function commands.view()
  local page = first:match("[^/]*$") .. ".view.html"
  lacuna.view(first, page)
  print("wrote " .. page .. "; open it in a browser")
end

function commands.check()
  local quality = lacuna.check(first)
  if json then
    local told = {}
    for key, value in pairs(quality) do told[key] = value end
    -- Metrics go by name; their places in the array repeat them.
    local metrics = {}
    for _, metric in ipairs(told.metrics) do metrics[metric.name] = metric end
    told.metrics, told.file = metrics, first
    print(encode(told))
  else
    print(quality)
  end
  if not quality.certified then
    local cells = quality.hexes + quality.wedges
    error(("%s: %d of %d cells are invalid"):format(first, quality.uncertified, cells), 0)
  end
end

function commands.convert()
  local found = lacuna.convert(first, second)
  print(("%s: %d nodes, %d elements"):format(second, found.nodes, found.elements))
end

commands[command]()
