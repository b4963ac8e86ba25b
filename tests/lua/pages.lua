-- SPDX-License-Identifier: MIT
-- Pages: one whole file that asks for nothing, and, in a browser, what is shown, hidden, hovered and clicked.
local check = dofile(arg[0]:match("^(.*/)") .. "check.lua")
local lacuna = require "lacuna"
local params = lacuna.params { lacuna = "", scratch = ".", browser = "" }
local folder = check.empty_folder(params.scratch)

local function read(path)
  local file <close> = assert(io.open(path, "rb"))
  return file:read("a")
end

-- --- the file ----------------------------------------------------------------------------------------------

local plate = lacuna.synthetic.plate { holes = 1, drop = { "wall_1", "wall_2" } }
local void = plate:open_volume { source = "source", target = "target", walls = "auto" }
local mesh = void:sweep { layers = 3, size = 0.25 }
local page = folder .. "/plate.html"
mesh:view(page)
local text = read(page)
check.that(text:sub(-8) == "</html>\n", "the page is whole")
for _, word in ipairs { "http:", "https:", " src=", "url(", "import(", "@import", "fetch(" } do
  check.that(not text:find(word, 1, true), "the page asks for nothing: " .. word)
end
check.that(text:find("default-src 'none'", 1, true), "the page forbids itself the network")
local before = check.files(folder)
check.equal(#before, 1)
mesh:view(page)
check.equal(read(page), text, "the same page again")

check.fails(function() mesh:view(folder .. "/mesh.png") end, ".html", "mesh.png")
check.fails(function() mesh:view(folder .. "/nowhere/mesh.html") end, "nowhere")
check.fails(function() mesh:view() end, "view", "the path of a file to write")
check.fails(function() mesh:view(page, { titel = "x" }) end, "'title'")
check.fails(function() lacuna.view("nothing.step", page) end, "nothing.step")
check.fails(function() lacuna.view("x.msh", page, { show = "cell" }) end, 'did you mean "cells"?')
check.equal(table.concat(check.files(folder)), "plate.html", "what fails leaves nothing behind")
check.equal(read(page), text, "and nothing touched")

-- --- Gmsh --------------------------------------------------------------------------------------------------

mesh:write(folder .. "/plain.msh")
check.that(not check.exists(folder .. "/plain.msh.opt"), "no file that nobody asked for")
mesh:write(folder .. "/shown.msh", { gmsh_options = true })
check.that(read(folder .. "/shown.msh.opt"):find("Mesh.ColorCarousel = 2;", 1, true))
check.equal(read(folder .. "/shown.msh"), read(folder .. "/plain.msh"))
check.fails(function() mesh:write(folder .. "/shown.vtu", { gmsh_options = true }) end, "'gmsh_options'")
for _, name in ipairs { "plain.msh", "shown.msh", "shown.msh.opt" } do os.remove(folder .. "/" .. name) end

if params.lacuna ~= "" then
  mesh:write(folder .. "/plate.msh")
  plate:open_volume({ source = "source", target = "target", walls = "auto" }):close()
  local code, out = check.run(params.lacuna, folder, { "view", "plate.msh" })
  check.equal(code, 0)
  check.that(out:find("plate.msh.view.html", 1, true), out)
  check.that(check.exists(folder .. "/plate.msh.view.html"))
  void:write_facets(folder .. "/plate.stl")
  check.equal((check.run(params.lacuna, folder, { "view", "plate.stl" })), 0)
  check.that(read(folder .. "/plate.stl.view.html") ~= read(folder .. "/plate.msh.view.html"), "two pages")
  os.remove(folder .. "/plate.stl.view.html")
  check.write(folder .. "/v.lua", 'require("lacuna").synthetic.prism():view("a.html")')
  local refused, _, message = check.run(params.lacuna, folder, { "--sandbox", "v.lua" })
  check.equal(refused, 1)
  check.that(message:find("--output-dir", 1, true), message)
  check.that(not check.exists(folder .. "/a.html"))
  check.equal((check.run(params.lacuna, folder, { "--sandbox", "--output-dir", ".", "v.lua" })), 0)
  check.that(check.exists(folder .. "/a.html"))
end

-- --- pictures ----------------------------------------------------------------------------------------------

local picture = folder .. "/plate.png"
local function drawn(options)
  mesh:picture(picture, options)
  local bytes = read(picture)
  check.equal(bytes:sub(1, 8), "\x89PNG\r\n\x1a\n")
  local width, height = (">I4I4"):unpack(bytes, 17)
  return bytes, width, height
end
local plain, wide, high = drawn()
check.equal(wide .. "x" .. high, "1200x900")
check.equal(drawn { view = { 1, -1.6, 0.9 }, colour = "quality", edges = true, legend = true }, plain)
for _, options in ipairs {
  { view = "top" }, { view = { 1, 1, 0 } },
  { colour = "layer" }, { colour = "groups" }, { colour = "origin" },
  { colour = "region" }, { edges = false }, { legend = false }, { layers = { 2, 2 } },
  { title = "A plate" }, { cut = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } },
} do
  check.that(drawn(options) ~= plain, "an option shows")
end
check.equal(select(2, drawn { width = 64, height = 32 }), 64)
for _, wrong in ipairs {
  { { cut = { point = { 0, 0, 0 } } }, "a plane" }, { { cut = "x" }, "a plane" },
  { { cut = { point = { 0, 0, 0 }, normal = { 0, 0, 0 } } }, "length 0" },
  { { cut = { point = { -99, 0, 0 }, normal = { 1, 0, 0 } } }, "hides all cells" },
  { { layers = { 1 } }, "two numbers" }, { { layers = { 3, 4, 5 } }, "two numbers" },
  { { layers = { 4, 4 } }, "layers 1 to 3" }, { { layers = { 2, 1 } }, "layers 1 to 3" },
  { { colour = "qality" }, 'did you mean "quality"?' },
} do
  check.fails(function() mesh:picture(picture, wrong[1]) end, "picture:", wrong[2])
end
check.fails(function() mesh:picture(folder .. "/plate.jpg") end, ".png")
void:picture(picture)
plate:picture(picture)
os.remove(picture)

-- --- in a browser ------------------------------------------------------------------------------------------

if params.browser == "" then
  print("skipped: no chromium, so no page is opened")
  return check.done()
end

-- What a script in the page says, a line each, once it has run; any message of the browser's about the page
-- is an error.
local plays = 0
local function play(path, script)
  plays = plays + 1
  local driven = ("%s/played_%d.html"):format(folder, plays)
  local whole = read(path)
  local at = assert(whole:find("</body>", 1, true))
  check.write(driven, whole:sub(1, at - 1) .. [[<script>(async () => {
    const lines = [], say = (...all) => lines.push(all.join(" "));
    const sleep = ms => new Promise(done => setTimeout(done, ms));
    for (let i = 0; i < 1000 && !window.lacunaPage; i++) await sleep(20);
    // The window's place of a pixel that shows side or face `wanted`, by what `of` makes of a side.
    const findPixel = (page, of, wanted) => {
      const box = page.drawing.canvas.getBoundingClientRect();
      const size = [Math.round(box.width), Math.round(box.height)];
      const found = [];
      page.drawing.shown(page.camera, size).forEach((side, i) => {
        if (side < page.drawing.sideCount && of(side) === wanted)
          found.push([box.left + i % size[0] + 0.5, box.top + size[1] - Math.floor(i / size[0]) - 0.5]);
      });
      return found[Math.floor(found.length / 2)];
    };
    const point = (page, kind, at, more) => page.drawing.canvas.dispatchEvent(new PointerEvent(kind,
      { clientX: at[0], clientY: at[1], button: 0, bubbles: true, ...more }));
    try { await (async page => {]] .. script .. [[})(window.lacunaPage); }
    catch (error) { say("error: " + error.message + " " + error.stack); }
    const out = document.createElement("pre");
    out.id = "said";
    out.textContent = lines.join("\n");
    document.body.append(out);
  })()</script>]] .. whole:sub(at))
  local command = ("'%s' --headless=new --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader " ..
      "--user-data-dir='%s/profile' --window-size=1200,800 --virtual-time-budget=60000 " ..
      "--force-prefers-reduced-motion " ..
      "--enable-logging=stderr --dump-dom 'file://%s' 2>'%s.err'"):format(
      params.browser, folder, driven, driven)
  local pipe <close> = assert(io.popen(command))
  local said = pipe:read("a"):match('<pre id="said">(.-)</pre>')
  local log = read(driven .. ".err")
  for line in log:gmatch("[^\n]*CONSOLE[^\n]*") do
    check.that(line:find("GPU stall due to ReadPixels", 1, true), "the console has: " .. line)
  end
  check.that(said, "the page said nothing: " .. log:sub(-400))
  said = said:gsub("&gt;", ">"):gsub("&lt;", "<"):gsub("&quot;", '"'):gsub("&amp;", "&")
  check.that(not said:find("error:", 1, true), said)
  local lines = {}
  for line in (said .. "\n"):gmatch("(.-)\n") do lines[#lines + 1] = line end
  return lines
end

local function absolute(path)
  local pipe <close> = assert(io.popen("realpath '" .. path .. "'"))
  return pipe:read("l")
end
folder = absolute(folder)
page = folder .. "/plate.html"

-- A swept mesh: all that is drawn is the skin; a cut shows whole cells, and what is shown closes round.
local kClosed = [[
  const closed = () => {
    const sides = new Map();
    for (let s = 0; s < page.sideCount; s++) {
      const n = page.sideNodes.subarray(4 * s, 4 * s + 4);
      for (let k = 0; k < 4; k++) {
        const a = n[k], b = n[(k + 1) % 4];
        if (a === b) continue;
        const key = Math.min(a, b) + "-" + Math.max(a, b);
        sides.set(key, (sides.get(key) || 0) + (a < b ? 1 : -1));
      }
    }
    return [...sides.values()].every(x => x === 0);
  };
]]
local said = play(page, kClosed .. [[
  say(page.cellCount, page.sideCount, page.kept, closed());
  page.cut.axis = "x"; page.cut.normal = [1, 0, 0]; page.cut.at = 0.4; page.setCut();
  say(page.kept < page.cellCount && page.kept > 0, closed());
  const low = page.kept;
  page.cut.flip = true; page.setCut();
  say(low + page.kept === page.cellCount, closed());
  page.cut.axis = "off"; page.setCut();
  page.range = [2, 2]; page.recut();
  say(page.kept, closed());
  page.range = [1, 3]; page.recut();
  for (const by of ["layer", "groups", "origin", "quality"]) {
    page.colourBy = by; page.paint();
    say(by, new Set(page.colours.subarray(0, page.sideCount)).size);
  }
  say(page.data.patches.filter(p => p.void).length, page.legend.textContent.length > 0);
  page.flyTo(0);
  for (let i = 0; i < 100 && page.stage.flying; i++) await sleep(50);
  say(page.drawing.topCount, page.quality.worst.length, page.quality.least);
  const { region, c } = page.quality.worst[0];
  say(region.mask[c], Math.hypot(...plus(page.camera.centre, times(page.centreOf(region, c), -1))) < 1e-3);
  page.cut.axis = "off"; page.setCut();
  const at = findPixel(page, side => page.sideCell[side] >= 0, true);
  say(page.over(...at).filter(x => x).join(" | "));
  page.camera.turn(0.3, 0.2); page.stage.change();
  await sleep(100);
  say(document.getElementById("scale").textContent !== "");
]])
check.equal(said[1], ("%d %d %d true"):format(mesh.hexes, 2 * mesh.hexes // 3 + (function()
  local walls = 0
  for _, group in ipairs(mesh:groups()) do
    if group.name:find("^wall:") or group.name:find("^void:") then walls = walls + group.cells end
  end
  return walls
end)(), mesh.hexes))
check.equal(said[2], "true true")
check.equal(said[3], "true true", "the two halves are all cells")
check.equal(said[4], ("%d true"):format(mesh.hexes // 3))
check.equal(said[5], "layer 3")
check.equal(said[6], "groups " .. 7)
check.equal(said[7], "origin 2")
check.that(tonumber(said[8]:match("quality (%d+)")) > 1)
check.equal(said[9], "2 true")
local drawn, worst, least = said[10]:match("(%d+) (%d+) (%S+)")
check.equal(drawn, "12", "the worst cell's twelve sides")
check.equal(worst, "10")
check.near(tonumber(least), mesh:quality().min_scaled_jacobian, 1e-4)
check.equal(said[11], "1 true", "it is kept by the cut, and in the middle")
check.that(said[12]:find("cell ") and said[12]:find("scaled Jacobian") and said[12]:find("layer"), said[12])
check.equal(said[13], "true")

-- Parts that are left out are none that is seen, whatever the view. Of what moves, where drawing takes long,
-- as few sides are drawn as one can wait for, and the coarser skin closes round like the whole.
local fine = lacuna.synthetic.plate { holes = 2 }
    :open_volume { source = "source", target = "target", walls = "auto" }
    :sweep { layers = 3, size = 0.025 }
fine:view(folder .. "/fine.html")
local parted = play(folder .. "/fine.html", [=[
  const D = page.drawing, n = page.sideCount;
  const balanced = sides => {
    const sums = new Map();
    for (let i = 0; i < sides.length; i++) {
      const a = sides[i], b = sides[i % 4 === 3 ? i - 3 : i + 1];
      const key = Math.min(a, b) + "-" + Math.max(a, b);
      if (a !== b) sums.set(key, (sums.get(key) || 0) + (a < b ? 1 : -1));
    }
    return [...sums.values()].every(x => x === 0);
  };
  const cuts = [[0, 0, 1], [1, 0, 0], [0.6, 0.5, 0.4]];
  for (const [i, look] of [[1, -1.6, 0.9], [0, 0, 1], [-1, 0.2, -0.7]].entries()) {
    Object.assign(page.cut, { axis: "view", normal: cuts[i], measured: false, at: 0.6 }); page.setCut();
    page.camera.look(look); page.camera.fit(1);
    if (i === 2) page.camera.zoom(0.2, 0.3, 0.1);
    const parts = D.fineSkin().parts, seen = parts.seen(page.camera, 1.5);
    say(new Set(parts.indices).size === 4 * page.sideCount, parts.indices.length === 6 * page.sideCount,
        sidesIn(seen) < page.sideCount);
    const left = D.shown(page.camera, [600, 400]), one = D.shown(page.camera, [600, 400], [300, 200]);
    const own = parts.seen;
    parts.seen = () => [[0, page.sideCount]];
    D.gl.enable(D.gl.CULL_FACE);
    const all = D.shown(page.camera, [600, 400]);
    D.gl.disable(D.gl.CULL_FACE);
    parts.seen = own;
    say(left.every((side, at) => side === all[at]), one[0] === all[300 + 600 * 200], new Set(all).size > 100);
  }
  page.cut.axis = "off"; page.setCut();
  page.camera.look([1, -1.6, 0.9]); page.camera.fit(1);
  await sleep(1000);
  while (!D.whole) await sleep(10);
  D.slow = true;
  say(n, D.render(page.camera, true), D.coarse.from.length < n / 2, D.coarse.from.length > n / 32);
  for (const halvings of [1, 2, 3]) say(balanced(D.coarseSkin(halvings).sides));
  let drawn = 0;
  const draw = D.draw;
  D.draw = (program, textures, indices, ranges, ...more) => {
    drawn += sidesIn(ranges);
    draw.call(D, program, textures, indices, ranges, ...more);
  };
  D.render(page.camera, true);
  say(drawn <= kMovingSides, drawn > kMovingSides / 16);
  drawn = 0;
  say(D.render(page.camera, false));
  while (!D.whole) await sleep(10);
  say(drawn === sidesIn(D.fineSkin().parts.seen(page.camera, D.size()[0] / D.size()[1])), D.gl.getError());
]=])
for i = 1, 5, 2 do
  check.equal(parted[i], "true true true")
  check.equal(parted[i + 1], "true true true")
end
check.that(parted[7]:find("^%d+ false true true$"), parted[7])
for i = 8, 10 do check.equal(parted[i], "true", "a coarser skin is closed") end
check.equal(parted[11], "true true")
check.equal(parted[12], "true")
check.equal(parted[13], "true 0")

-- The same mesh as a file: as many cells, the same skin, the same groups.
if params.lacuna ~= "" then
  local file = play(folder .. "/plate.msh.view.html", kClosed .. [[
    say(page.cellCount, page.sideCount, page.kept, closed());
    say(page.data.patches.length, page.data.patches.every(p => p.quads > 0));
    page.cut.axis = "y"; page.cut.normal = [0, 1, 0]; page.cut.at = 0.5; page.setCut();
    say(closed(), page.quality.least);
  ]])
  check.equal(file[1], said[1])
  check.equal(file[2], "7 true")
  check.that(file[3]:find("true " .. least, 1, true), file[3])
end

-- Wedges, order 2 and an assembly close round as well.
local function round(name, made)
  made:view(folder .. "/" .. name .. ".html")
  local lines = play(folder .. "/" .. name .. ".html", kClosed .. [[
    say(page.cellCount, closed());
    page.cut.axis = "z"; page.cut.normal = [0, 0, 1]; page.cut.at = 0.6; page.setCut();
    say(page.kept > 0 && page.kept < page.cellCount, closed());
    for (const by of ["layer", "groups", "region"]) { page.colourBy = by; page.paint(); }
    page.flyTo(0);
    for (let i = 0; i < 100 && page.stage.flying; i++) await sleep(50);
    say(page.drawing.topCount);
  ]])
  check.that(lines[1]:find(" true$"), name .. ": " .. lines[1])
  check.equal(lines[2], "true true", name)
  return lines
end
local barrel = lacuna.synthetic.barrel()
local roles = { source = "source", target = "target", walls = "auto" }
local curved = barrel:open_volume(roles):sweep { layers = 3, size = 0.5, order = 2 }
local whole = round("order_2", curved)
check.equal(whole[3], "24")
curved:write(folder .. "/curved.msh")
lacuna.view(folder .. "/curved.msh", folder .. "/curved.html")
local listed = play(folder .. "/curved.html", kClosed .. [[
  say(page.cellCount, closed());
  page.flyTo(0);
  say(page.drawing.topCount, page.quality.least);
]])
check.equal(listed[1], whole[1])
check.near(tonumber(listed[2]:match("24 (%S+)")), curved:quality().min_scaled_jacobian, 1e-4)
round("serendipity",
    barrel:open_volume(roles):sweep { layers = 3, size = 0.5, order = 2, serendipity = true })

local wedges = lacuna.model()
local ring = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }
wedges:add_face { name = "source", keep_mesh = true,
  points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
  cells = { { 1, 3, 2 }, { 1, 4, 3 } } }
for i = 1, 4 do
  local a, b = ring[i], ring[i % 4 + 1]
  wedges:add_face { name = "wall_" .. i, points = { { a[1], a[2], 0 }, { b[1], b[2], 0 }, { b[1], b[2], 1 },
    { a[1], a[2], 1 } }, cells = { { 1, 2, 3, 4 } } }
end
round("wedges", wedges:open_volume({ source = "source", walls = { "wall_1", "wall_2", "wall_3", "wall_4" } })
    :sweep { layers = 4, wedges = true })

local both = lacuna.model()
for _, shift in ipairs { 0, 1 } do
  local low = { { shift, 0, 0 }, { shift + 1, 0, 0 }, { shift + 1, 1, 0 }, { shift, 1, 0 } }
  local high = {}
  for i, p in ipairs(low) do high[i] = { p[1], p[2], 1 } end
  both:add_face { name = "low" .. shift, points = low, cells = { { 1, 4, 3, 2 } } }
  both:add_face { name = "high" .. shift, points = high, cells = { { 1, 2, 3, 4 } } }
end
local left = both:open_volume { source = "low0", target = "high0", name = "left" }
local right = both:open_volume { source = "low1", target = "high1", name = "right" }
check.equal(#round("assembly", lacuna.assembly({ left, right }):sweep { layers = 2, size = 0.5 }), 3)

-- Faces: labels, hover, clicks that make a recipe which runs; names that are no markup.
local hostile = "</script><script>window.hacked = 1</script><img src=x onerror=window.hacked=1>&amp;\\"
local named = lacuna.model()
local box = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 },
  { 0, 0, 1 }, { 2, 0, 1 }, { 2, 1, 1 }, { 0, 1, 1 } }
for i, quad in ipairs { { 1, 4, 3, 2 }, { 5, 6, 7, 8 }, { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 4, 8, 7 } } do
  local points = {}
  for k, n in ipairs(quad) do points[k] = box[n] end
  named:add_face { name = i == 2 and hostile or nil, points = points, cells = { { 1, 2, 3, 4 } } }
end
local faces = folder .. "/faces.html"
named:view(faces, { title = hostile .. '" onload="window.hacked = 1\'' })
check.that(not read(faces):find("<script>window.hacked", 1, true), "a title is never markup")
named:view(faces, { title = hostile })
check.that(not read(faces):find("<script>window.hacked", 1, true), "a name is never markup")
local clicks = play(faces, [=[
  const click = at => { point(page, "pointerdown", at); point(page, "pointerup", at); };
  const of = side => page.data.faces[page.faceOf[side]].tag;
  say(window.hacked === undefined, document.title === page.data.faces[1].name, document.images.length);
  page.camera.look([1, -1, 1]); page.camera.fit(1); page.moved(true);
  say([...document.querySelectorAll("#labels div")].map(x => x.textContent.slice(0, 3)).sort().join(","));
  say(page.state.textContent);
  click(findPixel(page, of, 2));
  page.roleChoice.set("walls");
  click(findPixel(page, of, 3));
  click(findPixel(page, of, 4));
  say(page.recipe.value.replace(/\n/g, "|"));
  say(page.state.textContent);
  click(findPixel(page, of, 4));
  say(page.recipe.value.replace(/\n/g, "|"));
  say(page.over(...findPixel(page, of, 2)).filter(x => x).slice(1).join("|"));
  const tip = document.getElementById("tip");
  point(page, "pointermove", findPixel(page, of, 3));
  await sleep(500);
  say(tip.style.display, tip.textContent.startsWith("face 3"));
  point(page, "pointermove", [2, 2]);
  await sleep(500);
  say(tip.style.display);
  window.dispatchEvent(new KeyboardEvent("keydown", { key: "2" }));
  say(page.chosenRole);
]=])
check.equal(clicks[1], "true true 0", "nothing of a name was run")
check.equal(clicks[2], "2 <,3,4")
check.equal(clicks[3], "4 edges of one face alone.")
check.equal(clicks[4], "local void = model:open_volume {|  source = { 2 },|  walls = { 3, 4 },|}")
check.that(clicks[5]:find("^The chosen faces leave %d+ free edges and 1 vertex of an end without a wall"),
    clicks[5])
check.equal(clicks[6], "local void = model:open_volume {|  source = { 2 },|  walls = { 3 },|}")
check.that(clicks[7]:find("area 2", 1, true) and clicks[7]:find("next to 3, 4, 5", 1, true), clicks[7])
check.equal(clicks[8], "block true", "the pointer shows what a face is")
check.equal(clicks[9], "none")
check.equal(clicks[10], "target")

-- What model:info() tells of faces the page tells: the pointer shows it, cavities and gaps are there to be
-- picked, and what a pick says runs.
local drilled = lacuna.synthetic.plate { holes = 2 }
local told = drilled:info()
drilled:view(folder .. "/drilled.html")
local picks = play(folder .. "/drilled.html", [=[
  say(page.data.faces.map(face => [face.tag, face.use, face.neighbours.join(" "), face.low, face.high,
    face.radius].join(";")).join("|"));
  say(page.cavityButtons.map(button => button.textContent).join("|"));
  page.role[0] = "source"; page.paint();
  page.cavityButtons[1].dispatchEvent(new MouseEvent("mouseenter"));
  page.cavityButtons[1].click();
  say(page.recipe.value.replace(/\n/g, "|"));
  say(page.state.textContent);
  const bore = page.data.cavities[1].faces[0];
  const of = side => page.data.faces[page.faceOf[side]].tag;
  page.camera.look([0.3, -0.2, 1]); page.camera.fit(1);
  say(page.over(...findPixel(page, of, bore)).filter(x => x).join("|"));
  page.roleChoice.set("walls");
  page.role[page.data.faces.findIndex(face => face.tag === bore)] = "faces";
  const at = findPixel(page, of, 2);
  point(page, "pointerdown", at); point(page, "pointerup", at);
  say(page.recipe.value.replace(/\n/g, "|"), page.gapButtons === undefined);
]=])
local rows = {}
for i, face in ipairs(told.faces) do
  local function numbers(list) return table.concat(list, " ") end
  rows[i] = table.concat({ face.tag, face.use, numbers(face.neighbours) }, ";")
end
local shown = 0
for row in (picks[1] .. "|"):gmatch("(.-)|") do
  shown = shown + 1
  check.equal(row:sub(1, #rows[shown] + 1), rows[shown] .. ";")
  local radius = tonumber(row:match(";([^;]*)$"))
  check.that((radius == nil) == (told.faces[shown].radius == nil), row)
  if radius then check.near(radius, told.faces[shown].radius, 1e-9) end
end
check.equal(shown, #told.faces)
local bore = told.cavities[2]
check.that(
    picks[2]:find("|bore, faces " .. table.concat(bore.faces, ", ") .. "  likely class V, volume", 1, true),
    picks[2])
check.equal(picks[3],
    ("local void = model:open_volume {|  faces = { %s },|}"):format(table.concat(bore.faces, ", ")),
    "roles chosen before are gone")
check.equal(picks[4], "The chosen faces leave 2 free edges and 0 vertices of the ends without a wall.")
check.that(picks[5]:find("cylinder of radius", 1, true) and picks[5]:find("|axis (", 1, true) and
    picks[5]:find("|box (", 1, true) and picks[5]:find("|bore", 1, true), picks[5])
check.equal(picks[6], "local void = model:open_volume {|  walls = { 2 },|} true",
    "a role takes the place of faces without roles")
check.write(folder .. "/pick.lua", 'local model = require("lacuna").synthetic.plate { holes = 2 }\n' ..
    picks[3]:gsub("|", "\n") .. "\nprint(void.class)\n")
if params.lacuna ~= "" then
  local code, out, err = check.run(params.lacuna, folder, { "pick.lua" })
  check.equal(code .. out, "0V\n", err)
end

local apart = folder .. "/apart.stl"
local side = "facet normal 0 0 0\nouter loop\n%s\nendloop\nendfacet\n"
local function square(x)
  local function corner(dx, y) return ("vertex %.17g %d 0"):format(x + dx, y) end
  return side:format(corner(0, 0) .. "\n" .. corner(1, 0) .. "\n" .. corner(1, 1)) ..
      side:format(corner(0, 0) .. "\n" .. corner(1, 1) .. "\n" .. corner(0, 1))
end
check.write(apart, "solid a\n" .. square(0) .. square(1.001) .. "endsolid a\n")
local loose = lacuna.load(apart)
local gap = loose:info().gaps[1]
loose:view(folder .. "/apart.html")
local sewn = play(folder .. "/apart.html", [[
  say(page.gapButtons.length, page.gapButtons[0].textContent);
  page.gapButtons[0].dispatchEvent(new MouseEvent("mouseenter"));
  page.gapButtons[0].click();
  say(page.recipe.value);
  page.gapButtons[0].click();
  say(page.recipe.value === "");
]])
check.equal(sewn[1], ("1 edges %d and %d  at most 0.001 apart; tolerance = %s sews them"):format(
    gap.edge, gap.other, gap.tolerance))
local load_line = sewn[2]:match("^local model = (.*)$")
check.that(load_line, sewn[2])
check.equal(#load("local lacuna = ... return " .. load_line)(lacuna):info().gaps, 0, "it sews them")
check.equal(sewn[3], "true")

-- A file's page says how to load it, and what it says runs.
if params.lacuna ~= "" then
  void:write_facets(folder .. "/it's a plate.stl")
  check.equal((check.run(params.lacuna, folder, { "view", "it's a plate.stl" })), 0)
  local loads = play(folder .. "/it's a plate.stl.view.html", [[
    page.role = page.data.faces.map(face =>
      face.normal[2] > 0.9 ? "source" : face.normal[2] < -0.9 ? "target" : "walls");
    page.paint();
    say(page.recipe.value.replace(/\n/g, "|"));
  ]])
  check.write(folder .. "/made.lua", loads[1]:gsub("|", "\n") .. "\nprint(void.class)\n")
  local code, out, err = check.run(params.lacuna, folder, { "made.lua" })
  check.equal(code, 0, err)
  check.that(out:find("^Mesh of %d+ hexes, .*\t0%.%d+\nclosed\n$"), out)
  check.that(check.exists(folder .. "/it's a plate.msh"), "the recipe ends with a mesh")
end

-- A seam is no free edge: its face is on both sides of it.
if lacuna.gmsh_version ~= "none" then
  check.write(folder .. "/pin.geo", 'SetFactory("OpenCASCADE");\nCylinder(1) = {0, 0, 0, 0, 0, 2, 1};\n')
  lacuna.load(folder .. "/pin.geo"):view(folder .. "/pin.html")
  local pin = play(folder .. "/pin.html", [=[
    say(page.data.edges.length, page.state.textContent);
    say(page.over(...findPixel(page, side => page.data.faces[page.faceOf[side]].kind, "cylinder")).join("|"));
  ]=])
  check.equal(pin[1], "3 No free edge: the faces form a closed skin.")
  check.that(pin[2]:find("radius 1|", 1, true) and pin[2]:find("3 edges, 1 loop|", 1, true), pin[2])
end

-- A volume, sealed: void faces are told apart and are no part of the recipe.
void:view(folder .. "/volume.html")
local sealed = play(folder .. "/volume.html", [[
  say(page.data.faces.filter(face => face.void).length, page.wallFree.length, page.state.textContent);
  say(page.recipe.value.split("\n").length, page.colours.some(c => c >>> 24 & 16));
]])
check.equal(sealed[1],
    "2 0 The chosen faces leave 0 free edges and 0 vertices of the ends without a wall.")
check.equal(sealed[2], "5 true")

check.done()
