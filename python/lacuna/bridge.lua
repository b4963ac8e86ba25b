-- SPDX-License-Identifier: MIT
-- The far end of Python's calls: reads one request, makes the call, writes the answer.
--
-- Both are strings of tagged values, so that a call of any arguments is three calls of the C interface.
-- Objects of Lacuna stay here and go by number. The twin of this file is `_wire.py`.
local lacuna = require "lacuna"
local unpack, pack = string.unpack, string.pack

local objects = {}  -- by number
local numbers = {}  -- by object
local shares = {}   -- by number: how many objects of Python stand for it
local made = {}     -- numbers that went into the answer that is being written
local last = 0

-- --- reading -----------------------------------------------------------------------------------------------

local value_at

-- A block of numbers, row by row: an array of numbers, or of rows.
local function block_at(text, at)
  local format, rows, columns
  format, rows, columns, at = unpack("<s1i8i8", text, at)
  local list = {}
  if columns == 0 then
    for i = 1, rows do list[i], at = unpack(format, text, at) end
  else
    local row_format = "<" .. format:sub(2):rep(columns)
    for i = 1, rows do
      local row = { unpack(row_format, text, at) }
      at = row[columns + 1]
      row[columns + 1] = nil
      list[i] = row
    end
  end
  return list, at
end

-- The words of a selector that found nothing, in the metatable of its empty array.
local FOUND_NOTHING = "lacuna.found_nothing"

local readers = {
  N = function(_, at) return nil, at end,
  T = function(_, at) return true, at end,
  F = function(_, at) return false, at end,
  i = function(text, at) return unpack("<i8", text, at) end,
  d = function(text, at) return unpack("<d", text, at) end,
  s = function(text, at) return unpack("<s8", text, at) end,
  a = block_at,
  o = function(text, at)
    local number
    number, at = unpack("<i8", text, at)
    return objects[number], at
  end,
  f = function(text, at)
    local number
    number, at = unpack("<i8", text, at)
    return function(...) return lacuna_python.host(number, ...) end, at
  end,
  E = function(text, at)
    local words
    words, at = value_at(text, at)
    return setmetatable({}, { [FOUND_NOTHING] = words }), at
  end,
  ["["] = function(text, at)
    local count, list
    count, at = unpack("<i8", text, at)
    list = {}
    for i = 1, count do list[i], at = value_at(text, at) end
    return list, at
  end,
  ["{"] = function(text, at)
    local count, map, key
    count, at = unpack("<i8", text, at)
    map = {}
    for _ = 1, count do
      key, at = value_at(text, at)
      map[key], at = value_at(text, at)
    end
    return map, at
  end,
}

function value_at(text, at) return readers[text:sub(at, at)](text, at + 1) end

-- --- writing -----------------------------------------------------------------------------------------------

local put

local function put_object(out, object, class)
  local number = numbers[object]
  if not number then
    last = last + 1
    number = last
    objects[number], numbers[object], shares[number] = object, number, 0
  end
  shares[number] = shares[number] + 1
  made[#made + 1] = number
  out[#out + 1] = pack("<c1i8s8", "o", number, class)
end

local function put_table(out, value)
  local class = getmetatable(value)
  if class == "Quality" then return put_object(out, value, class) end
  local words = type(class) == "table" and class[FOUND_NOTHING]
  if words then
    out[#out + 1] = "E"
    return put(out, words)
  end
  local count, pairs_at, others = #value, #out + 1, 0
  out[pairs_at] = ""
  for i = 1, count do put(out, value[i]) end
  for key, item in next, value do
    if not (math.type(key) == "integer" and key >= 1 and key <= count) then
      put(out, key)
      put(out, item)
      others = others + 1
    end
  end
  out[pairs_at] = pack("<c1i8i8", class == "Report" and "R" or "t", count, others)
end

function put(out, value)
  local kind = math.type(value) or type(value)
  if kind == "nil" then out[#out + 1] = "N"
  elseif kind == "boolean" then out[#out + 1] = value and "T" or "F"
  elseif kind == "integer" then out[#out + 1] = pack("<c1i8", "i", value)
  elseif kind == "float" then out[#out + 1] = pack("<c1d", "d", value)
  elseif kind == "string" then out[#out + 1] = pack("<c1s8", "s", value)
  elseif kind == "table" then put_table(out, value)
  else put_object(out, value, debug.getmetatable(value).__name)
  end
end

-- --- calls -------------------------------------------------------------------------------------------------

local calls = {}

function calls.method(object, name, ...) return object[name](object, ...) end
function calls.field(object, name) return object[name] end
function calls.text(object) return tostring(object) end
function calls.equal(a, b) return a == b end

-- A function of the module, such as "load" or "synthetic.prism", or a field of it.
function calls.module(path, ...)
  local value = lacuna
  for name in path:gmatch "[^.]+" do value = value[name] end
  if type(value) ~= "function" then return value end
  return value(...)
end

-- Objects are closed at once: Lua knows nothing of the memory behind them.
local function release(number)
  shares[number] = shares[number] - 1
  if shares[number] > 0 then return end
  local object = objects[number]
  objects[number], numbers[object], shares[number] = nil, nil, nil
  if type(object) == "userdata" then
    local _ <close> = object
    if debug.getmetatable(object).__name == "Face" then return end
  end
  collectgarbage()
end

-- The answer: a letter, then the results or the error.
local function answer(done, ...)
  local out = { done and "k" or "e" }
  local count = select("#", ...)
  out[2] = pack("<i8", count)
  for i = 1, count do put(out, (select(i, ...))) end
  return table.concat(out)
end

lacuna_python = {
  objects = objects,
  call = function()
    made = {}
    local request = lacuna_python.request
    lacuna_python.request = nil
    local count, at = unpack("<i8", request)
    local values = {}
    for i = 1, count do values[i], at = value_at(request, at) end
    lacuna_python.answer = answer(pcall(calls[values[1]], table.unpack(values, 2, count)))
  end,
  release = release,
  -- The call was stopped: before it took its request, or before its answer was taken.
  forget = function()
    if not lacuna_python.request then
      for _, number in ipairs(made) do release(number) end
    end
    lacuna_python.request, made = nil, {}
  end,
}
