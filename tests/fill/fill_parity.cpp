// SPDX-License-Identifier: MIT
// A file filled by a recipe and by fill(): the meshes must be the same to the bit, or the errors one.
//
//   fill_parity FILE [source=1,2] [target=3] [walls=4,5] [faces=1,2] [layers=8] [size=0.5]
#include "fill/recipe.h"

#include <lacuna/cad/load.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>

using namespace lacuna;

namespace {

std::vector<FaceId> by_tag(const topology::Model& model, const std::string& tags)
{
    std::vector<FaceId> found;
    std::istringstream in(tags);
    for (std::string tag; std::getline(in, tag, ',');) {
        const auto face = std::ranges::find(model.faces, std::stoi(tag), &topology::Face::tag);
        if (face == model.faces.end()) throw InvalidInput("test.no_face", "there is no face {}", tag);
        found.emplace_back(static_cast<std::size_t>(face - model.faces.begin()));
    }
    return found;
}

} // namespace

int main(int argc, char** argv)
try {
    std::map<std::string, std::string> words;
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        words[word.substr(0, word.find('='))] = word.substr(word.find('=') + 1);
    }
    test::Recipe recipe;
    recipe.run("part = lacuna.load [[" + std::string(argc > 1 ? argv[1] : "") + "]]");
    const auto part = recipe.object<lua::ModelState>("part");
    const topology::Model& model = part->model;
    fill::Request request;
    request.decks = part->decks;
    request.scale = part->scale;
    std::string roles, options;
    for (const char* name : {"source", "target", "walls", "faces"}) {
        if (!words.contains(name)) continue;
        roles += std::string(name) + " = { " + words[name] + " }, ";
        const std::vector<FaceId> faces = by_tag(model, words[name]);
        if (std::string(name) == "faces") {
            request.roles.faces = faces;
            continue;
        }
        if (!request.roles.roles) request.roles.roles.emplace();
        (name[0] == 's'   ? request.roles.roles->source
         : name[0] == 't' ? request.roles.roles->target
                          : request.roles.roles->walls) = faces;
    }
    sweep::SweepOptions& sweep = request.sweep.options;
    sweep.quad_mesher = cad::recombine;
    if (words.contains("layers")) {
        sweep.layers.count = std::stoi(words["layers"]);
        options += "layers = " + words["layers"] + ", ";
    }
    if (words.contains("size")) {
        const double size = std::stod(words["size"]);
        sweep.size = [size](const Vec3&) { return size; };
        options += "size = " + words["size"] + ", ";
    }
    const std::string by_recipe = recipe.code_of("mesh = part:open_volume { " + roles + " }:sweep { " +
                                                 options + " }");
    std::string difference;
    const std::string by_fill = test::code_of([&] {
        const fill::Filled filled = fill::fill(model, request);
        if (by_recipe.empty()) difference = test::difference(recipe, filled);
    });
    if (by_recipe != by_fill) difference = "error '" + by_recipe + "' and '" + by_fill + "'";
    std::cout << (difference.empty() ? by_fill.empty() ? "same mesh" : "same error " + by_fill
                                     : "DIFFERENT: " + difference)
              << '\n';
    return difference.empty() ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
}
