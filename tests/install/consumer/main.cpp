// SPDX-License-Identifier: MIT
// A host with facets of its own: a box with two walls missing, sealed and filled with hexahedra.
#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <cmath>
#include <iostream>

int main()
{
    namespace healing = lacuna::healing;
    namespace topology = lacuna::topology;
    try {
        healing::FacetSoup box;
        box.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
        box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                         {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}};
        box.triangle_label = {0, 0, 1, 1, 2, 2, 3, 3};
        box.label_name = {"floor", "lid", "front", "right"};
        const topology::Model model = healing::split_facets(box);

        topology::Roles roles;
        for (std::size_t i = 0; i < model.faces.size(); ++i) {
            const std::string& name = model.faces[i].name;
            auto& list = name == "floor" ? roles.source : name == "lid" ? roles.target : roles.walls;
            list.emplace_back(i);
        }
        topology::OpenVolume space = topology::open_volume(model, roles);
        const auto class_found = topology::classify(space).value;

        const auto closure = lacuna::closure::close(space, lacuna::matching::match(space));
        lacuna::sweep::SweepOptions options;
        options.layers.count = 6;
        options.size = [](const lacuna::Vec3&) { return 0.25; };
        const auto swept = lacuna::sweep::sweep(space, options);
        const auto quality = lacuna::quality::measure(swept.mesh);

        std::cout << "class " << topology::to_string(class_found) << ", " << closure.void_edges.size()
                  << " void edge, " << closure.void_faces.size() << " void faces, " << quality.hexes
                  << " hexes, volume " << quality.volume << '\n';
        const bool right = class_found == topology::VolumeClass::II && closure.watertight &&
                           closure.void_edges.size() == 1 && closure.void_faces.size() == 2 &&
                           quality.uncertified == 0 && std::abs(quality.volume - 6) < 1e-9;
        return right ? 0 : 1;
    } catch (const lacuna::Error& error) {
        std::cerr << error.code() << ": " << error.what() << '\n';
        return 1;
    }
}
