-- SPDX-License-Identifier: MIT
-- lacuna.params: the parameters of a recipe, with the key=value words of the command line applied.
local lacuna, internal = ...

local function fail(...) internal.fail("lua.parameter", "params: " .. string.format(...)) end

-- The word converted to the type of `default`; nil if this is impossible.
local function value_like(default, word)
  local kind = type(default)
  if kind == "string" then return word end
  if kind == "number" then return tonumber(word) end
  if kind == "boolean" and (word == "true" or word == "false") then return word == "true" end
  return nil
end

function lacuna.params(defaults)
  if type(defaults) ~= "table" then
    fail("needs a table { name = default, ... }, found %s", internal.found(defaults))
  end
  local names = {}
  for name in pairs(defaults) do
    if type(name) ~= "string" then fail("every parameter needs a name, found %s", internal.found(name)) end
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
      if #names == 0 then fail("unknown parameter '%s'; this recipe has no parameters", name) end
      fail("unknown parameter '%s'; the nearest is '%s'. The parameters are: %s", name,
           internal.nearest(name, names), table.concat(names, ", "))
    end
    local read = value_like(defaults[name], value)
    if read == nil then
      local kind = type(defaults[name])
      if kind == "table" or kind == "function" then
        fail("parameter '%s' is a %s and cannot be set on the command line", name, kind)
      end
      fail("parameter '%s' must be a %s like its default %s; found \"%s\"", name, kind,
          tostring(defaults[name]), value)
    end
    defaults[name] = read
  end
  return defaults
end
