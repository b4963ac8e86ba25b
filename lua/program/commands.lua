-- SPDX-License-Identifier: MIT
-- The commands of the program. Arguments: command, whether its own option is set, files, key=value words.
local command, option, first, second = ...
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

-- Sort keys, so that the same file gives the same text.
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
  if option then
    local told = model:info()
    told.file = first
    if found then told.class, told.roles = volume.class, volume:describe() end
    if not found then told.roles_refused = volume.message or tostring(volume) end
    return print(encode(told))
  end
  print(model:describe())
  print(found and "likely roles (not checked by a sweep):\n" .. volume:describe() or
    "no likely roles: " .. volume)
  if not found and model:info().closed_parts == 0 then
    print "to sweep a source alone (class 0): open_volume{ source = …, along = { vector = { x, y, z } } }"
  end
end

function commands.view()
  local page = first:match("[^/]*$") .. ".view.html"
  local shown = lacuna.view(first, page, { show = option and "faces" or "auto" })
  print("wrote " .. page .. "; open it in a browser")
  if shown == "cells" then print("it shows cells; use --faces to show faces, for filling voids") end
end

function commands.check()
  local quality = lacuna.check(first)
  if quality.quads then -- no solids
    if option then
      quality.file = first
      return print(encode(quality))
    end
    local text = "%d quads, %d triangles, area %.6g; scaled Jacobian: %.3g at least, %.3g on average"
    return print(text:format(quality.quads, quality.triangles, quality.area, quality.min_scaled_jacobian,
      quality.mean_scaled_jacobian))
  end
  if option then
    local told = {}
    for key, value in pairs(quality) do told[key] = value end
    -- Index metrics by name.
    local metrics = {}
    for _, metric in ipairs(told.metrics) do metrics[metric.name] = metric end
    told.metrics, told.file = metrics, first
    print(encode(told))
  else
    print(quality)
  end
  if not quality.certified then
    local cells = quality.hexes + quality.wedges + quality.pyramids + quality.tets
    error(("%s: %d of %d cells are invalid"):format(first, quality.uncertified, cells), 0)
  end
end

function commands.convert()
  local found = lacuna.convert(first, second)
  print(("%s: %d nodes, %d elements"):format(second, found.nodes, found.elements))
end

-- --- picture and fill --------------------------------------------------------------------------------------

local function words(text)
  local set = {}
  for word in text:gmatch "%S+" do set[word] = true end
  return set
end

-- The calls that take a key; all others are of volume:sweep.
local calls = {
  load = words "tolerance feature_angle keep_mesh keep_noise scale unit cad_seconds cad_megabytes",
  open_volume = words "source target walls faces reading full_turn along fill_to class name material glued",
  write = words([[version binary groups quality element orientation with without renumber first_node
    first_cell gmsh_options interfaces partitions ghosts]]),
}

local function call_of(key)
  for call, keys in pairs(calls) do
    if keys[key] then return call end
  end
  return "sweep"
end

-- A value as it is typed: a number, true, false, a table of Lua, a list with commas, or else a string.
local function value_of(key, text)
  if tonumber(text) then return tonumber(text) end
  if text == "true" or text == "false" then return text == "true" end
  if text:find "^{" then
    local read, why = load("return " .. text, "=" .. key, "t", {})
    return read and read() or error(("%s=%s is not a table: %s"):format(key, text, why), 0)
  end
  if not text:find "," then return text end
  local list = {}
  for each in text:gmatch "[^,]+" do list[#list + 1] = tonumber(each) or each end
  return list
end

-- Put key=value words into the tables that `table_of` names, and other words into `files`.
local function options_of(list, files, table_of)
  for _, word in ipairs(list) do
    local key, text = word:match "^([%a_][%w_]*)=(.*)$"
    if not key then
      files[#files + 1] = word
    else
      local call = table_of(key)
      local before, value = call[key], value_of(key, text)
      -- A shell makes two words of faces={3,4}: faces=3 faces=4.
      if before ~= nil then
        if type(before) ~= "table" then before = { before } end
        before[#before + 1], value = value, before
      end
      call[key] = value
    end
  end
end

function commands.picture(...)
  local files, options = {}, {}
  options_of({ ... }, files, function() return options end)
  if files[1] then error(("picture draws one file, but %s is one more"):format(files[1]), 0) end
  local shown = lacuna.picture(first, second, options)
  print(("wrote %s: the %s of %s"):format(second, shown, first))
end

-- The bodies of a model that is nothing else: no face is open, and no body lies inside another one.
local function bodies_alone(model)
  if #model.regions < 2 or #model:info().free_edges > 0 then return {} end
  local apart, bodies = pcall(model.bodies, model)
  if not apart and bodies.code ~= "topology.bodies_overlap" then error(bodies, 0) end
  return apart and bodies or {}
end

function commands.fill(...)
  local options = { load = {}, open_volume = {}, sweep = {}, write = {} }
  local files = { first, second }
  options_of({ ... }, files, function(key) return options[call_of(key)] end)
  local output = table.remove(files)
  local model = lacuna.load(files, options.load)
  if options.write.with == true then options.write.with = model end
  local bodies = next(options.open_volume) == nil and bodies_alone(model) or {}
  local volume = #bodies > 1 and lacuna.assembly(bodies)
    or model:open_volume(next(options.open_volume) and options.open_volume or nil)
  local mesh = volume:sweep(options.sweep)
  mesh:write(output, options.write)
  print(mesh:quality())
end

-- List the parameters of the recipe `first`. The first function of lacuna that the recipe calls must be
-- lacuna.params. That call ends the run, by calling `second`.
function commands.parameters()
  local params = lacuna.params
  local function stop()
    second()
    while true do end  -- until the hook ends the run, which no pcall of the recipe can catch
  end
  local function stopping(owner, prefix)
    for name, value in pairs(owner) do
      if type(value) == "function" then
        owner[name] = function()
          print(("%s calls %s%s before lacuna.params; call lacuna.params first to list parameters")
              :format(first, prefix, name))
          stop()
        end
      end
    end
  end
  stopping(lacuna.synthetic, "lacuna.synthetic.")
  stopping(lacuna, "lacuna.")
  function lacuna.params(defaults)
    params(defaults)  -- raises an error if this is not a table of defaults
    local names, lines, widest = {}, {}, 0
    for name in pairs(defaults) do names[#names + 1] = name end
    table.sort(names)
    for i, name in ipairs(names) do
      local kind = type(defaults[name])
      local simple = kind == "number" or kind == "string" or kind == "boolean"
      lines[i] = ("  %s=%s"):format(name, simple and tostring(defaults[name]) or "...")
      widest = math.max(widest, #lines[i])
      names[i] = kind .. (simple and "" or ", cannot be set on the command line")
    end
    for i, line in ipairs(lines) do lines[i] = line .. (" "):rep(widest + 2 - #line) .. names[i] end
    print(("usage: lacuna %s [key=value ...]\n\nparameters and their defaults:\n%s"):format(first,
        #lines > 0 and table.concat(lines, "\n") or "  none"))
    stop()
  end
end

commands[command](select(5, ...))
