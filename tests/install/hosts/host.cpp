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

// A pyramid over forty sides, which neither a sweep nor pieces fill.
const char* const kPyramid = R"lua(
local pyramid = require("lacuna").model()
local base, cells = {}, {}
for k = 1, 40 do base[k] = { math.cos(2 * math.pi * k / 40), math.sin(2 * math.pi * k / 40), 0 } end
for k = 1, 40 do
  pyramid:add_face { points = { base[k], base[k % 40 + 1], { 0, 0, 1 } }, cells = { { 1, 2, 3 } } }
end
for k = 2, 39 do cells[k - 1] = { 1, k + 1, k } end
pyramid:add_face { points = base, cells = cells }
mesh = pyramid:open_volume {}:sweep { size = 0.2, fallback = "mixed" }
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

/// Tetrahedra that fill the pyramid; none without the program that makes them, `lacuna-cad`.
std::size_t tets_of_pyramid()
{
    lacuna::Interpreter recipes;
    try {
        recipes.run_string(kPyramid);
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

    std::cout << tets_of_pyramid() << " tetrahedra in C++\n";

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
