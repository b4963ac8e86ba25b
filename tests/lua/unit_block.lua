-- SPDX-License-Identifier: MIT
-- What tests of decks share that fill a void of a block of N³ cells, 1 long each way, and have CalculiX solve
-- what was joined: local block = dofile(folder .. "unit_block.lua")(check, params.scratch, N). Decks of other
-- shapes are read and solved by it too.
return function(check, scratch, N)
  local block = {}

  -- Whether CalculiX is here.
  block.ccx = os.execute("command -v ccx >/dev/null 2>&1")
  if not block.ccx then print("CalculiX (ccx) is not here: no deck is solved") end

  function block.read(path)
    local file <close> = assert(io.open(path, "rb"))
    return file:read("a")
  end

  -- Whether a cell lies outside a box of cells.
  function block.outside(low, high)
    return function(i, j, k)
      local at = { i, j, k }
      for axis = 1, 3 do
        if at[axis] < low[axis] or at[axis] >= high[axis] then return true end
      end
      return false
    end
  end

  -- The selector of the box's face at one end of an axis.
  function block.face(low, high, axis, at)
    local box = { {}, {} }
    local room = 0.2 / N
    for k = 1, 3 do box[1][k], box[2][k] = low[k] / N - room, high[k] / N + room end
    box[1][axis], box[2][axis] = at / N - room, at / N + room
    return { box = box }
  end

  -- Roles of the faces that are not the block's outside.
  function block.roles(void)
    local function given(at) return at > 0 and at < N end
    local function face(axis, at) return block.face(void.low, void.high, axis, at) end
    local found = { walls = {} }
    if given(void.low[3]) then found.source = face(3, void.low[3]) end
    if given(void.high[3]) then found.target = face(3, void.high[3]) end
    for axis = 1, 2 do
      for _, at in ipairs { void.low[axis], void.high[axis] } do
        if given(at) then table.insert(found.walls, face(axis, at)) end
      end
    end
    return found
  end

  -- Nodes and cells of an Abaqus deck by their numbers, and the sets that its cells are put in.
  function block.deck(text)
    local nodes, cells, sets, into, open = {}, {}, {}, nil, nil
    for line in text:gmatch("[^\n]+") do
      if line:sub(1, 1) == "*" then
        local word = line:match("^%*(%a+)")
        into = word == "NODE" and nodes or word == "ELEMENT" and cells or nil
        if into == cells then sets[#sets + 1] = line:match("ELSET=([%w_]+)") end
      elseif into then
        local numbers = {}
        for word in line:gmatch("[^,%s]+") do numbers[#numbers + 1] = assert(tonumber(word)) end
        if open then
          table.move(numbers, 1, #numbers, #open + 1, open)
        else
          check.that(into[numbers[1]] == nil, "number " .. numbers[1] .. " twice")
          into[numbers[1]] = { table.unpack(numbers, 2) }
        end
        open = into == cells and line:find(",%s*$") and (open or into[numbers[1]]) or nil
      end
    end
    return nodes, cells, sets
  end

  function block.size(list)
    local count = 0
    for _ in pairs(list) do count = count + 1 end
    return count
  end

  local function affine(x, y, z)
    return 0.001 * x + 0.0004 * y - 0.0002 * z, -0.0003 * x + 0.002 * y + 0.0001 * z,
      0.0005 * x - 0.0002 * y - 0.001 * z
  end
  -- Hooke's stresses of the displacement in steel of 210000 and 0.3.
  local function stresses()
    local e = { xx = 0.001, yy = 0.002, zz = -0.001, xy = 0.00005, xz = 0.00015, yz = -0.00005 }
    local lambda, mu = 210000 * 0.3 / (1.3 * 0.4), 210000 / 2.6
    local trace = lambda * (e.xx + e.yy + e.zz)
    return { trace + 2 * mu * e.xx, trace + 2 * mu * e.yy, trace + 2 * mu * e.zz, 2 * mu * e.xy,
      2 * mu * e.xz, 2 * mu * e.yz }
  end

  local function on_block(_, at)
    for axis = 1, 3 do
      if at[axis] < 1e-9 or at[axis] > 1 - 1e-9 then return true end
    end
    return false
  end

  -- Nodes whose displacement is given by an equation, so that none is prescribed there.
  local function dependent_nodes(text)
    local nodes, inside, count = {}, false, nil
    for line in text:gmatch("[^\n]+") do
      if line:sub(1, 1) == "*" then
        if line:sub(2, 2) ~= "*" then inside = line == "*EQUATION" end
      elseif inside then
        if count then nodes[tonumber(line:match("%d+"))] = true end
        count = tonumber(line)
      end
    end
    return nodes
  end

  -- Have the deck solved under an affine displacement of its outside, which is the same stress in every cell.
  -- Its step prints the stresses. outer(node, place) tells what lies outside, that of the block by default.
  -- Returns the number of places they were compared at.
  function block.solve(class, text, nodes, outer)
    outer = outer or on_block
    local name = "solve_" .. class
    local base = scratch .. "/" .. name
    local lines, dependent = { "*STATIC\n*BOUNDARY" }, dependent_nodes(text)
    for tag, at in pairs(nodes) do
      local prescribed = outer(tag, at) and not dependent[tag]
      for axis, u in ipairs(prescribed and { affine(table.unpack(at)) } or {}) do
        lines[#lines + 1] = ("%d, %d, %d, %.12e"):format(tag, axis, axis, u)
      end
    end
    check.write(base .. ".inp", (text:gsub("%*STATIC", table.concat(lines, "\n"))))
    check.that(os.execute(("cd '%s' && ccx %s > %s.log 2>&1"):format(scratch, name, name)))
    local expected, points = stresses(), 0
    for line in block.read(base .. ".dat"):gmatch("[^\n]+") do
      local numbers = {}
      for word in line:gmatch("%S+") do numbers[#numbers + 1] = tonumber(word) end
      if #numbers == 8 then
        points = points + 1
        for s = 1, 6 do check.near(numbers[s + 2], expected[s], 1e-6 * expected[2]) end
      end
    end
    return points
  end

  return block
end
