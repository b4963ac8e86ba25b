// SPDX-License-Identifier: MIT
// fill() makes what a recipe makes, to the bit.
#include "fill/recipe.h"
#include "fill/shapes.h"
#include "support/folder.h"

#include <lacuna/team/shared/tasks.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

using namespace lacuna;
using test::code_of;
using test::Recipe;

namespace {

std::vector<FaceId> faces(const topology::Model& model, const std::vector<std::string>& names)
{
    std::vector<FaceId> found;
    for (const std::string& name : names) {
        const auto face = std::ranges::find(model.faces, name, &topology::Face::name);
        REQUIRE(face != model.faces.end());
        found.emplace_back(static_cast<std::size_t>(face - model.faces.begin()));
    }
    return found;
}

std::string list(const std::vector<std::string>& names)
{
    std::string text = "{ ";
    for (const std::string& name : names) text += '"' + name + "\", ";
    return text + "}";
}

/// Roles by names; all other faces are walls.
struct Named {
    std::vector<std::string> source, target;
};

struct Shape {
    std::string name, part; ///< an expression that makes the model
    Named roles;            ///< none: they are found
    bool full_turn = false;
    bool parts = false; ///< whether it is swept as pieces
};

const std::vector<Shape> kShapes{
    {"block, roles found", "skin(box(2, 2, 3))", {}},
    {"block, named", "skin(box(2, 2, 3))", {{"z0-"}, {"z3+"}}},
    {"two walls missing", "skin(box(2, 2, 3), nil, { ['x2+'] = true, ['y2+'] = true })", {{"z0-"}, {"z3+"}}},
    {"no walls",
     "skin(box(2, 1, 3), nil, { ['x2+'] = true, ['y1+'] = true, ['x0-'] = true, ['y0-'] = true })",
     {{"z0-"}, {"z3+"}}},
    {"target missing", "skin(box(2, 2, 3), nil, { ['z3+'] = true })", {{"z0-"}, {}}},
    {"both ends missing", "skin(box(2, 2, 3), nil, { ['z3+'] = true, ['z0-'] = true })", {}},
    {"sheared", "skin(box(2, 2, 3), function(x, y, z) return { x + z / 3, y + x / 5, z } end)", {}},
    {"bent",
     "skin(box(2, 1, 6), function(x, y, z) return { (x + 2) * math.cos(z / 5), y, "
     "(x + 2) * math.sin(z / 5) } end)",
     {{"z0-"}, {"z6+"}}},
    {"steps", "skin { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 } }", {{"z0-"}, {"z1+", "z2+"}}, false, true},
    {"full turn", "ring(24)", {}, true, true},
};

fill::Request request_of(const Shape& shape, const topology::Model& model)
{
    fill::Request request;
    request.roles.full_turn = shape.full_turn;
    if (shape.roles.source.empty()) return request;
    topology::Roles& roles = request.roles.roles.emplace();
    roles.source = faces(model, shape.roles.source);
    roles.target = faces(model, shape.roles.target);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const FaceId face(f);
        if (std::ranges::find(roles.source, face) == roles.source.end() &&
            std::ranges::find(roles.target, face) == roles.target.end())
            roles.walls.push_back(face);
    }
    return request;
}

/// The same as options of open_volume.
std::string open_options(const Shape& shape, const topology::Model& model, const fill::Request& request)
{
    if (shape.full_turn) return "full_turn = true";
    if (!request.roles.roles) return "";
    std::vector<std::string> walls;
    for (const FaceId face : request.roles.roles->walls) walls.push_back(model[face].name);
    return "source = " + list(shape.roles.source) +
           (shape.roles.target.empty() ? "" : ", target = " + list(shape.roles.target)) +
           ", walls = " + list(walls);
}

} // namespace

TEST_CASE("fill() makes the mesh of a recipe, of every class, with roles found and named, cut or whole")
{
    for (const Shape& shape : kShapes) {
        CAPTURE(shape.name);
        Recipe recipe(test::kShapes);
        recipe.run("part = " + shape.part + "\npart:describe()"); // which brings it up to date
        const auto model = recipe.object<lua::ModelState>("part");
        fill::Request request = request_of(shape, model->model);
        request.roles.name = "void";
        request.roles.material = "steel";
        request.sweep.options.size = [](const Vec3&) { return 0.5; };
        request.sweep.options.layers.count = 6;
        recipe.run("volume = part:open_volume { " + open_options(shape, model->model, request) +
                   (shape.full_turn || request.roles.roles ? ", " : "") +
                   "name = 'void', material = 'steel' }");
        recipe.run("mesh = volume:sweep { size = 0.5, layers = 6 }");
        const fill::Filled filled = fill::fill(model->model, request);
        CHECK(test::difference(recipe, filled) == "");
        CHECK((std::get_if<fill::FilledParts>(&filled.mesh) != nullptr) == shape.parts);
        // The volume is what the recipe's is: sealed, unless it was cut.
        const auto volume = recipe.object<lua::VolumeState>("volume");
        REQUIRE(filled.volumes.size() == 1);
        CHECK(filled.volumes[0].closure.has_value() == volume->closure.has_value());
        CHECK(filled.volumes[0].volume.model.faces.size() == volume->volume.model.faces.size());
    }
}

TEST_CASE("where the likeliest sweep cannot keep an interval, fill() takes the other that the recipe takes")
{
    Recipe recipe(test::kShapes);
    recipe.run("part = skin(box(4, 3, 2))\npart:describe()");
    const auto model = recipe.object<lua::ModelState>("part");
    int turned = 0;
    for (int edge = 1; edge <= 12; ++edge) {
        CAPTURE(edge);
        fill::Request request;
        sweep::SweepOptions& options = request.sweep.options;
        options.size = [](const Vec3&) { return 1.0; };
        options.layers.count = 3;
        surface::Interval& interval = options.intervals.emplace_back();
        interval.of = surface::Interval::Of::edge;
        interval.edge = edge;
        interval.count = 5;
        recipe.run("mesh = part:open_volume {}:sweep { layers = 3, size = 1, intervals = { { " +
                   std::to_string(edge) + ", 5 } } }");
        const fill::Filled filled = fill::fill(model->model, request);
        CHECK(test::difference(recipe, filled) == "");
        const std::vector<std::string>& report = fill::parts(filled).front().report;
        if (report.front().starts_with("roles: swept")) ++turned;
    }
    CHECK(turned == 4);
}

TEST_CASE("assemblies of volumes and meshes are swept alike, with names, left out or not")
{
    Recipe recipe(test::kShapes);
    recipe.run(R"(
        local function void(name, part) return part:open_volume { name = name } end
        local function up(h) return function(x, y, z) return { x, y, z + h } end end
        low = void("low", skin(box(2, 2, 2)))
        high = void("high", skin(box(2, 2, 2), up(2)))
        steep = void("steep", skin(box(2, 2, 2), function(x, y, z) return { x, y, z * (1 + x) / 3 - 2 } end))
        kept = skin(box(2, 2, 2), up(4)):open_volume { name = "kept" }:sweep { size = 1, layers = 2 })");
    const std::vector<const char*> names{"low", "high", "steep"};
    std::vector<fill::Volume> volumes;
    for (const char* name : names) volumes.push_back(*recipe.object<lua::VolumeState>(name));
    const auto kept = recipe.object<lua::MeshState>("kept");

    std::vector<fill::Member> members(4);
    for (std::size_t v = 0; v < 3; ++v) {
        members[v].volume = &volumes[v];
        members[v].options.size = [](const Vec3&) { return 1.0; };
    }
    members[2].options.fallback = sweep::Fallback::leave_out;
    members[2].options.min_scaled_jacobian = 0.999;
    members[3].mesh = kept.get();
    recipe.run("mesh = lacuna.assembly { low, high, steep, kept }:sweep { size = 1, "
               "[steep] = { fallback = 'leave_out', min_scaled_jacobian = 0.999 } }");
    const fill::Filled filled = fill::sweep(members);
    CHECK(test::difference(recipe, filled) == "");
    const auto& mesh = std::get<fill::FilledParts>(filled.mesh);
    REQUIRE(mesh.left_out.size() == 1);
    CHECK(mesh.left_out[0].region == "steep");
    CHECK(mesh.regions.size() == 3);
    REQUIRE(filled.volumes.size() == 3);
    CHECK(filled.volumes[0].closure);

    // A face that an option names must be in that volume, or in one of all.
    members[0].options.boundary_layers.push_back({{{}, {"z9+"}}, 0.1});
    CHECK(code_of([&] { fill::sweep(members); }) == "surface.no_such_face");
    CHECK(recipe.code_of("lacuna.assembly { low, high }:sweep { size = 1, "
                         "[low] = { boundary_layers = { walls = 'z9+', first = 0.1 } } }") ==
          "surface.no_such_face");
}

TEST_CASE("order 2 keeps the middle nodes of the deck that a model came from")
{
    const std::string scratch = (std::filesystem::temp_directory_path() / "lacuna_fill_order_2.msh").string();
    Recipe recipe(test::kShapes);
    recipe.run("skin(box(2, 2, 2), function(x, y, z) return { x + z * z / 9, y, z } end)"
               ":open_volume {}:sweep { size = 1, layers = 2, order = 2 }:write '" +
               scratch + "'");
    recipe.run("part = lacuna.load '" + scratch +
               "'\n"
               "mesh = part:open_volume {}:sweep { order = 2, size = 1 }");
    const auto model = recipe.object<lua::ModelState>("part");
    REQUIRE(model->decks.size() == 1);
    fill::Request request;
    request.decks = model->decks;
    request.scale = model->scale;
    request.sweep.options.order = 2;
    request.sweep.options.size = [](const Vec3&) { return 1.0; };
    CHECK(test::difference(recipe, fill::fill(model->model, request)) == "");
    std::filesystem::remove(scratch);
}

TEST_CASE("layers made as they are written are those of sweep_to")
{
    const auto folder = std::filesystem::temp_directory_path();
    const std::string by_recipe = (folder / "lacuna_fill_a.msh").string(),
                      by_fill = (folder / "lacuna_fill_b.msh").string();
    Recipe recipe(test::kShapes);
    recipe.run("part = skin(box(2, 2, 3))\n"
               "report = part:open_volume {}:sweep_to('" +
               by_recipe +
               "', { size = 0.25, layers = 12 })\n"
               "assert(report.streamed and report.layers == 12 and report.seconds.closing)");
    const auto model = recipe.object<lua::ModelState>("part");
    fill::Request request;
    request.sweep.options.layered = true;
    request.sweep.options.layers.count = 12;
    request.sweep.options.size = [](const Vec3&) { return 0.25; };
    const fill::Filled filled = fill::fill(model->model, request);
    const sweep::Swept& swept = fill::parts(filled).front();
    REQUIRE(swept.layers);
    team::LayeredFile file;
    file.quality = {quality::Metric::scaled_jacobian};
    team::write_layered({swept.mesh, *swept.layers}, *swept.plan, by_fill, file, nullptr, {});
    CHECK(test::bytes_of(by_recipe).size() > 1000);
    CHECK(test::bytes_of(by_recipe) == test::bytes_of(by_fill));
    std::filesystem::remove(by_recipe);
    std::filesystem::remove(by_fill);
}

TEST_CASE("regions, groups, nodes and cells of parts are those of the recipe's mesh")
{
    Recipe recipe(test::kShapes);
    recipe.run(
        "part = ring(24)\nmesh = part:open_volume { full_turn = true, name = 'ring' }:sweep { layers = 24 }");
    fill::Request request;
    request.roles.full_turn = true;
    request.roles.name = "ring";
    request.sweep.options.layers.count = 24;
    const fill::Filled filled = fill::fill(recipe.object<lua::ModelState>("part")->model, request);
    const auto& mesh = std::get<fill::FilledParts>(filled.mesh);
    const std::vector<fill::Region> regions = fill::regions(mesh);
    REQUIRE(regions.size() == 1);
    CHECK(regions[0].name == "ring");
    CHECK(regions[0].layers == 24);
    CHECK(regions[0].fidelity.volume == doctest::Approx(fill::fidelity(mesh).volume));
    CHECK(recipe.text("mesh.layers.ring .. ' ' .. #mesh.regions") == "24 1");
    for (const fill::Group& group : fill::groups(mesh))
        CHECK(recipe.text("(function() for _, g in ipairs(mesh:groups()) do if g.name == '" + group.name +
                          "' then return g.dim .. ' ' .. g.cells end end end)()") ==
              std::to_string(group.dim) + " " + std::to_string(group.cells));
    const fill::WholeCells whole = fill::whole_cells(mesh);
    CHECK(fill::measure(whole).uncertified == 0);
    for (std::size_t c = 0; c < whole.hexes.size(); c += 7)
        CHECK(std::ranges::equal(fill::cell(mesh, mesh::CellShape::hex8, c), whole.hexes[c]));
    for (std::size_t n = 0; n < whole.nodes.size(); n += 11)
        CHECK(fill::node(mesh, n) == whole.nodes[n]);
}
