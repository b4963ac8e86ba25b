// SPDX-License-Identifier: MIT
// A pre-processor in C++: recipes in two threads at once, their meshes as arrays, an error with its parts.
#include <lacuna/interpreter.h>

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <limits>
#include <thread>
#include <vector>

namespace {

const char* const kRecipe = R"lua(
local lacuna = require "lacuna"
local part = lacuna.synthetic.prism { sides = sides, radius = 20, height = 60, drop = { "wall_1" } }
local void = part:open_volume { source = "source", target = "target", walls = "auto" }
mesh = void:sweep { layers = 12, size = 4 }
nodes, cells, quality = mesh:coordinates(), mesh:cells(), mesh:quality()
)lua";

// The corner of a cube, cut off, which has no ends to sweep between.
const char* const kCorner = R"lua(
local corner = require("lacuna").model()
local o, x, y, z = { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }
for _, points in ipairs { { o, y, x }, { o, x, z }, { x, y, z }, { y, o, z } } do
  corner:add_face { points = points, cells = { { 1, 2, 3 } } }
end
mesh = corner:open_volume {}:sweep { size = 0.2, fallback = "mixed" }
tets = mesh:cells "tet"
)lua";

struct Result {
    std::size_t nodes = 0, hexes = 0;
    double lowest = 0, highest = 0; ///< of z
    bool certified = false;
};

Result mesh_of(int sides)
{
    lacuna::Interpreter recipes;
    recipes.set("sides", std::int64_t{sides});
    recipes.run_string(kRecipe);
    const lacuna::BufferView nodes = recipes.buffer("nodes"), cells = recipes.buffer("cells");
    Result result{nodes.rows, cells.rows, std::numeric_limits<double>::max(), 0, false};
    const auto* at = static_cast<const double*>(nodes.data); // in place: nothing is copied
    for (std::size_t i = 0; i < nodes.rows; ++i) {
        result.lowest = std::min(result.lowest, at[3 * i + 2]);
        result.highest = std::max(result.highest, at[3 * i + 2]);
    }
    result.certified = recipes.get("quality.certified") == lacuna::Value(true);
    return result;
}

/// Tetrahedra that fill the corner; none without the program that makes them, `lacuna-cad`.
std::size_t tets_of_corner()
{
    lacuna::Interpreter recipes;
    try {
        recipes.run_string(kCorner);
    } catch (const lacuna::ScriptError& error) {
        if (error.code() != "cad.no_worker") throw;
        return 0;
    }
    const lacuna::BufferView tets = recipes.buffer("tets"); // four nodes each
    return tets.columns == 4 ? tets.rows : 0;
}

} // namespace

int main()
{
    std::vector<Result> results(2);
    std::thread other([&] { results[1] = mesh_of(6); });
    results[0] = mesh_of(4);
    other.join();
    for (const Result& result : results) {
        std::cout << result.hexes << " hexahedra, " << result.nodes << " nodes, from " << result.lowest
                  << " to " << result.highest << (result.certified ? ", all valid\n" : ", not all valid\n");
        if (!result.certified || result.highest - result.lowest < 59.9) return 1;
    }

    std::cout << tets_of_corner() << " tetrahedra in C++\n";

    lacuna::Interpreter recipes;
    try {
        recipes.run_string("local part = require 'lacuna'.synthetic.prism {}\npart:face(99)");
        return 1;
    } catch (const lacuna::ScriptError& error) {
        std::cout << error.code() << " in line " << error.line << ": " << error.message << '\n';
        for (const lacuna::NamedEntity& entity : error.entities)
            std::cout << "  " << entity.kind << ' ' << entity.tag << '\n';
        return error.line == 2 && !error.entities.empty() ? 0 : 1;
    }
}
