-- SPDX-License-Identifier: MIT
-- What the test scripts share: local check = dofile(folder .. "check.lua"). A script ends with check.done().
local check = { count = 0 }

local function where()
  local info = debug.getinfo(3, "Sl")
  return info.short_src .. ":" .. info.currentline
end

function check.that(condition, what)
  check.count = check.count + 1
  if not condition then error(where() .. ": " .. (what or "does not hold"), 0) end
end

function check.equal(found, expected, what)
  check.count = check.count + 1
  if found ~= expected then
    error(("%s: %sexpected %s, found %s"):format(where(), what and what .. ": " or "", tostring(expected),
        tostring(found)), 0)
  end
end

function check.near(found, expected, tolerance)
  check.count = check.count + 1
  if not (math.abs(found - expected) <= tolerance) then
    error(("%s: expected %.17g within %g, found %.17g"):format(where(), expected, tolerance, found), 0)
  end
end

-- Whether all members of families are run; else a script runs some of them.
check.whole = os.getenv "LACUNA_WHOLE_FAMILIES" ~= nil

-- runs() is true for every step-th member of a family, the first among them, or for all.
function check.members_to_run(step)
  local at = -1
  return function()
    at = at + 1
    return check.whole or at % step == 0
  end
end

-- Runs a family of 100 members: those from params.first to params.last, each in a line with the text that run
-- returns; without params.last every seventh member, or all.
function check.family(params, run)
  if params.last < 0 then
    local runs = check.members_to_run(7)
    for number = 0, 99 do
      if runs() then run(number) end
    end
    return check.done()
  end
  for number = params.first, params.last do
    local fine, text = pcall(run, number)
    print(fine and "ok  " or "FAIL", number, text)
  end
end

-- random(low, high) for families: the same numbers on every machine.
function check.random(seed)
  local state = seed
  return function(low, high)
    state = (state * 48271) % 2147483647
    return low + (high - low) * state / 2147483647
  end
end

-- `call` must fail with a string, or an error that prints as one, that contains every one of the words,
-- without patterns.
function check.fails(call, ...)
  check.count = check.count + 1
  local fine, message = pcall(call)
  if fine then error(where() .. ": nothing failed", 0) end
  if type(message) == "table" then
    local whole = type(message.message) == "string" and type(message.entities) == "table"
    if not whole or not tostring(message.code):match("^[%l_]+%.[%l_]+$") then
      error(("%s: no code or no entities: %s"):format(where(), tostring(message)), 0)
    end
    message = tostring(message)
  end
  if type(message) ~= "string" then error(where() .. ": the error is a " .. type(message), 0) end
  for _, word in ipairs { ... } do
    if not message:find(word, 1, true) then
      error(("%s: '%s' is not in the message: %s"):format(where(), word, message), 0)
    end
  end
  return message
end

-- --- the program as a process ------------------------------------------------------------------------------

local function quoted(word) return "'" .. word:gsub("'", "'\\''") .. "'" end

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

function check.write(path, text)
  local file <close> = assert(io.open(path, "wb"))
  file:write(text)
end

function check.exists(path)
  local file <close> = io.open(path, "rb")
  return file ~= nil
end

-- Names of the files in a folder, in order.
function check.files(folder)
  local names = {}
  local list <close> = assert(io.popen("ls -A " .. quoted(folder)))
  for name in list:lines() do names[#names + 1] = name end
  return names
end

function check.empty_folder(folder)
  assert(os.execute("rm -rf " .. quoted(folder) .. " && mkdir -p " .. quoted(folder)))
  return folder
end

-- Run the program in `folder`: exit code, standard output, standard error.
function check.run(program, folder, words, input)
  local command = { "cd", quoted(folder), "&&", "exec", quoted(program) }
  for _, word in ipairs(words) do command[#command + 1] = quoted(word) end
  local out, err, from = os.tmpname(), os.tmpname(), os.tmpname()
  check.write(from, input or "")
  command[#command + 1] = ("<%s >%s 2>%s"):format(quoted(from), quoted(out), quoted(err))
  local _, how, code = os.execute(table.concat(command, " "))
  local stdout, stderr = read(out), read(err)
  for _, path in ipairs { out, err, from } do os.remove(path) end
  return how == "exit" and code or 128 + code, stdout, stderr
end

function check.done()
  assert(check.count > 0, "nothing was checked")
  print(check.count .. " checks")
end

return check
