-- SPDX-License-Identifier: MIT
-- lacuna.params: a recipe's parameters, with the words key=value of the command line laid over them.
local lacuna, internal = ...

local function fail(...) internal.fail("lua.parameter", "params: " .. string.format(...)) end

-- The word as a value of the same type as `default`; nil where it is none.
local function value_like(default, word)
  local kind = type(default)
  if kind == "string" then return word end
  if kind == "number" then return tonumber(word) end
  if kind == "boolean" and (word == "true" or word == "false") then return word == "true" end
  return nil
end

function lacuna.params(defaults)
  if type(defaults) ~= "table" then
    fail("a table { name = default, ... } is wanted, found %s", internal.found(defaults))
  end
  local names = {}
  for name in pairs(defaults) do
    if type(name) ~= "string" then fail("every parameter has a name, found %s", internal.found(name)) end
    names[#names + 1] = name
  end
  table.sort(names)
  internal.used_params()
  local words = type(arg) == "table" and arg or {}
  for _, word in ipairs(words) do
    local name, value = tostring(word):match("^([%a_][%w_]*)=(.*)$")
    if not name then
      fail("'%s' on the command line is not of the form key=value", word)
    elseif defaults[name] == nil then
      if #names == 0 then fail("unknown parameter '%s'; this recipe has none", name) end
      fail("unknown parameter '%s'; the nearest is '%s'. The parameters are: %s", name,
           internal.nearest(name, names), table.concat(names, ", "))
    end
    local read = value_like(defaults[name], value)
    if read == nil then
      local kind = type(defaults[name])
      if kind == "table" or kind == "function" then
        fail("parameter '%s' is a %s, which the command line cannot give", name, kind)
      end
      fail("parameter '%s' must be a %s, as its default %s; found \"%s\"", name, kind,
          tostring(defaults[name]), value)
    end
    defaults[name] = read
  end
  return defaults
end
