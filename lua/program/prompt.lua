-- SPDX-License-Identifier: MIT
-- Evaluation of a line at the prompt: runs it, prints the results, completes words, and shows help. The help
-- texts are read from the stub of the language server, so that each call is described in one place only.
local stub, prompt, debug = ...

lacuna = require "lacuna"

-- --- the stub, read ------------------------------------------------------------------------------------

-- classes["lacuna.SweepOptions"] = { doc =, fields = { { name, type, doc } } }
-- calls = { { owner = "Volume", name = "sweep", text =, doc =, options = "lacuna.SweepOptions" } }
local classes, calls = {}, {}
do
  local doc, class, params, field_before = {}, nil, {}, nil
  for line in (stub .. "\n"):gmatch("(.-)\n") do
    local name = line:match("^%-%-%-@class%s+([%w_.]+)")
    local field, rest = line:match("^%-%-%-@field%s+([%w_]+%??)%s+(.*)$")
    local param, kind = line:match("^%-%-%-@param%s+([%w_]+%??)%s+(.*)$")
    local owner, call, arguments = line:match("^function%s+([%w_]+)[.:]([%w_]+)(%b())")
    if name then
      class = { name = name, doc = table.concat(doc, "\n"), fields = {} }
      classes[name], doc = class, {}
    elseif field and class then
      class.fields[#class.fields + 1] = { name = field:gsub("%?$", ""), text = rest }
      field_before = class.fields[#class.fields]
      goto continue
    elseif param then
      params[#params + 1] = { name = param, text = kind }
    elseif owner then
      local entry = { owner = owner, name = call, params = params, doc = table.concat(doc, "\n"),
        text = line:match("^function%s+([%w_.:]+)") .. arguments }
      for _, each in ipairs(params) do
        for _, kind in ipairs { "lacuna%.%w+Options", "lacuna%.Roles", "lacuna%.Selector" } do
          entry.options = entry.options or each.text:match(kind)
        end
      end
      calls[#calls + 1] = entry
      doc, params, class = {}, {}, nil
    elseif line:match("^%-%-%-@return") then
      params.returns = line:match("^%-%-%-@return%s+(.*)$")
    elseif field_before and line:match("^%-%-%-[^@|]") then  -- the field's text goes on
      field_before.text = field_before.text .. " " .. line:match("^%-%-%-%s?(.*)$")
      goto continue
    elseif line:match("^%-%-%-[^@|]") then
      doc[#doc + 1] = line:match("^%-%-%-%s?(.*)$")
    elseif line == "" then
      doc, params = {}, {}
    end
    field_before = nil
    ::continue::
  end
end

-- The options class of a call, by the name of the call; the first one if several owners have it. Some calls
-- declare their options in place: { sides?: integer, radius?: number }.
local function options_of(name)
  for _, call in ipairs(calls) do
    if call.name == name and call.options then return classes[call.options] end
    for _, param in ipairs(call.name == name and call.params or {}) do
      local fields = {}
      for key, kind in param.text:gmatch("[{,]%s*([%a_][%w_]*)%??:%s*([^,}]+)") do
        fields[#fields + 1] = { name = key, text = kind }
      end
      if #fields > 0 then return { fields = fields } end
    end
  end
end

-- --- help ----------------------------------------------------------------------------------------------

local overview = [[
lacuna.load "part.step"            a Model; model:describe() lists its faces
model:open_volume { source = 12, target = 31, walls = { 4, 5 } }
                                   a Volume; without roles, they are detected
volume:close()                     generates the missing faces; sweep calls it if you did not
volume:sweep { layers = 12, size = 2 }
                                   a Mesh; print(mesh:quality()), mesh:write "part.msh"

help "sweep"                       a call and its options
help "Volume"                      the calls and fields of a class
help "size"                        an option, in all calls that have it
help(mesh)                         the calls and fields of an object
Tab completes fields, calls, options and, in quotes, file names; exit leaves.]]

local function add_options(lines, class)
  if not class or #class.fields == 0 then return end
  lines[#lines + 1] = ""
  for _, field in ipairs(class.fields) do
    lines[#lines + 1] = ("  %-20s %s"):format(field.name, field.text)
  end
end

local function add_call(lines, call)
  if #lines > 0 then lines[#lines + 1] = "" end
  lines[#lines + 1] = call.text .. (call.params.returns and "  -> " .. call.params.returns or "")
  if call.doc ~= "" then lines[#lines + 1] = call.doc end
  for _, param in ipairs(call.params) do
    lines[#lines + 1] = ("  %-20s %s"):format(param.name, param.text)
  end
  add_options(lines, call.options and classes[call.options])
end

local function add_class(lines, word)
  local class = classes["lacuna." .. word]
  if class then
    if class.doc ~= "" then lines[#lines + 1] = class.doc end
    add_options(lines, class)
  end
  for _, call in ipairs(calls) do
    if call.owner == word then lines[#lines + 1] = "  " .. call.text end
  end
end

local function nearest_word(word)
  local best, least = nil, math.huge
  local function try(name)
    -- Number of equal letters at equal positions: enough to recognise a typing error.
    local same = 0
    for i = 1, math.min(#name, #word) do
      if name:sub(i, i):lower() == word:sub(i, i):lower() then same = same + 1 end
    end
    local distance = math.max(#name, #word) - same
    if distance < least then best, least = name, distance end
  end
  for _, call in ipairs(calls) do try(call.name) end
  return best
end

local function help_on(word)
  local lines = {}
  for _, call in ipairs(calls) do
    local full = call.text:match("^[^(]+")
    if call.name == word or full == word or full:gsub(":", ".") == word then
      add_call(lines, call)
    end
  end
  add_class(lines, word)
  if #lines == 0 then
    for _, call in ipairs(calls) do
      for _, field in ipairs(call.options and classes[call.options].fields or {}) do
        if field.name == word then lines[#lines + 1] = ("%s: %s  %s"):format(call.text, word, field.text) end
      end
    end
  end
  if #lines == 0 then return ('there is no "%s"; the nearest is "%s"'):format(word, nearest_word(word)) end
  return table.concat(lines, "\n")
end

local function name_of(value)
  if value == lacuna then return "lacuna" end
  if value == lacuna.synthetic then return "synthetic" end
  local meta = debug.getmetatable(value)
  if type(value) == "userdata" and meta and meta.__name then return meta.__name end
  if type(value) == "function" then
    for _, owner in ipairs { lacuna, lacuna.synthetic } do
      for name, found in pairs(owner) do if found == value then return name end end
    end
    for _, call in ipairs(calls) do
      local class = debug.getregistry()[call.owner]
      if type(class) == "table" and type(class.methods) == "table" and class.methods[call.name] == value then
        return call.name
      end
    end
  end
end

help = setmetatable({}, {
  __tostring = function() return overview end,
  __call = function(_, what)
    if what == nil then return print(overview) end
    local word = type(what) == "string" and what or name_of(what)
    print(word and help_on(word) or "a " .. type(what) .. " of your own: " .. tostring(what))
  end,
})

-- --- showing what came out -----------------------------------------------------------------------------

local most_entries, most_depth = 20, 3  -- limits for printing tables, so that they fit a screen

local function key_text(key)
  if type(key) == "string" and key:match("^[%a_][%w_]*$") then return key end
  return "[" .. (type(key) == "string" and ("%q"):format(key) or tostring(key)) .. "]"
end

local show

local function show_table(value, depth, seen)
  if seen[value] then return "{ itself }" end
  if depth == 0 then return next(value) == nil and "{}" or "{ ... }" end
  seen[value] = true
  local parts, count = {}, #value
  local keys = {}
  for key in pairs(value) do
    if not (math.type(key) == "integer" and key >= 1 and key <= count) then keys[#keys + 1] = key end
  end
  table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
  local total = count + #keys
  for i = 1, math.min(count, most_entries) do parts[#parts + 1] = show(value[i], depth - 1, seen) end
  for _, key in ipairs(keys) do
    if #parts >= most_entries then break end
    parts[#parts + 1] = key_text(key) .. " = " .. show(value[key], depth - 1, seen)
  end
  seen[value] = nil
  if total > #parts then parts[#parts + 1] = ("... %d more"):format(total - #parts) end
  if #parts == 0 then return "{}" end
  local line = "{ " .. table.concat(parts, ", ") .. " }"
  if #line <= 76 and not line:find("\n") then return line end
  for i, part in ipairs(parts) do parts[i] = "  " .. part:gsub("\n", "\n  ") end
  return "{\n" .. table.concat(parts, ",\n") .. "\n}"
end

function show(value, depth, seen)
  if type(value) == "string" then return ("%q"):format(value):gsub("\\\n", "\\n") end
  local meta = debug.getmetatable(value)
  if type(value) == "table" and not (meta and meta.__tostring) then return show_table(value, depth, seen) end
  return tostring(value)
end

local function print_all(...)
  local count = select("#", ...)
  if count == 0 then return end
  local shown = table.pack(...)
  for i = 1, count do
    if type(shown[i]) ~= "string" then shown[i] = show(shown[i], most_depth, {}) end
  end
  print(table.unpack(shown, 1, count))
end

-- Whether a line leaves the prompt: exit or quit, unless the user has defined a variable of that name.
function prompt.leaves(line)
  local word = line:match("^%s*(%a+)%s*%(?%s*%)?%s*;?%s*$")
  return (word == "exit" or word == "quit") and rawget(_G, word) == nil
end

-- Returns true if the statement is incomplete, unless `last` says that there is no further line.
function prompt.run(text, last)
  local chunk, lacks = load("return " .. text, "=prompt", "t")
  if not chunk then
    local message
    chunk, message = load(text, "=prompt", "t")
    local unfinished = not chunk and (message:match("near <eof>$") or lacks:match("near <eof>$"))
    if unfinished and not last then return true end
    if not chunk then error(message, 0) end
  end
  print_all(chunk())
end

-- --- completion ----------------------------------------------------------------------------------------

-- The value of a dotted path, found without calling metamethods.
local function value_at(path)
  local value = _G
  for name in path:gmatch("[%w_]+") do
    if type(value) ~= "table" then return nil end
    value = rawget(value, name)
  end
  return value
end

local function names_in(value)
  local names = {}
  local function add(list) for name in pairs(list or {}) do names[#names + 1] = name end end
  local meta = debug.getmetatable(value)
  if type(value) == "table" then add(value) end
  if type(value) == "userdata" and meta then add(meta.methods) add(meta.fields) end
  if type(value) == "string" then add(string) end
  return names
end

-- The call whose table of options is open at the end of `typed`, and where an open string begins.
local function open_call(typed)
  local opened = {}
  local quote, from
  for i = 1, #typed do
    local c = typed:sub(i, i)
    if quote then
      if c == quote then quote = nil end
    elseif c == '"' or c == "'" then quote, from = c, i
    elseif c == "{" then opened[#opened + 1] = i
    elseif c == "}" then opened[#opened] = nil end
  end
  if quote then return nil, from end
  if #opened == 0 then return nil end
  local before = typed:sub(1, opened[#opened] - 1)
  return before:match("([%w_]+)%s*%(?%s*$") or before:match("([%w_]+)%s*%([^()]*,%s*$")
end

local keywords = { "and", "break", "do", "else", "elseif", "end", "false", "for", "function", "if", "in",
  "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while" }

-- Completions of `word`, the end of `typed`, one per line; or the position in `typed` where a path begins.
function prompt.complete(typed, word)
  local owner, start = word:match("^(.*[.:])([%w_]*)$")
  local found, names, tail = {}, nil, ""
  local _, quote = open_call(typed)
  if quote and not typed:sub(1, quote - 1):match("help%s*%(?%s*$") then return quote end
  if quote then
    owner, start, names = "", word, {}
    for _, call in ipairs(calls) do names[#names + 1] = call.name end
    for name in pairs(classes) do names[#names + 1] = name:match("[^.]+$") end
  elseif owner then
    names = names_in(value_at(owner))
  else
    owner, start = "", word
    local call = open_call(typed:sub(1, #typed - #word))
    local class = call and options_of(call)
    names = {}
    -- A key is at the beginning of the table or after a comma.
    if class and typed:sub(1, #typed - #word):match("[{,]%s*$") then
      for _, field in ipairs(class.fields) do names[#names + 1] = field.name end
      tail = " = "
    else
      for name in pairs(_G) do names[#names + 1] = name end
      table.move(keywords, 1, #keywords, #names + 1, names)
    end
  end
  local known = {}
  for _, name in ipairs(names) do
    if type(name) == "string" and name:sub(1, #start) == start and not known[name] then
      known[name] = true
      found[#found + 1] = owner .. name .. tail
    end
  end
  table.sort(found)
  return table.concat(found, "\n")
end
