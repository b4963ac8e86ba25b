// SPDX-License-Identifier: MIT
// A host with facets of its own: a box with two walls missing, sealed and filled with hexahedra.
#include <lacuna/core/error.h>
#include <lacuna/fill.h>
#include <lacuna/healing/split_facets.h>

#include <cmath>
#include <iostream>

int main()
try {
    using namespace lacuna;
    healing::FacetSoup box;
    box.points = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 3}, {2, 0, 3}, {2, 1, 3}, {0, 1, 3}};
    box.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}};
    box.triangle_label = {0, 0, 1, 1, 2, 2, 3, 3};

    fill::Request request;
    request.roles.roles = {{FaceId(0)}, {FaceId(1)}, {FaceId(2), FaceId(3)}};
    request.sweep.options.layers.count = 6;
    request.sweep.options.size = [](const Vec3&) { return 0.25; };
    const fill::Filled filled = fill::fill(healing::split_facets(box), request);

    const fill::Volume& volume = filled.volumes.front();
    const quality::Quality& quality = fill::parts(filled).front().quality;
    std::cout << "class " << topology::to_string(volume.classification.value) << ", "
              << volume.closure->void_edges.size() << " void edge, " << volume.closure->void_faces.size()
              << " void faces, " << quality.hexes << " hexes, volume " << quality.volume << '\n';
    const bool right = volume.classification.value == topology::VolumeClass::II &&
                       volume.closure->watertight && volume.closure->void_edges.size() == 1 &&
                       volume.closure->void_faces.size() == 2 && quality.uncertified == 0 &&
                       std::abs(quality.volume - 6) < 1e-9;
    return right ? 0 : 1;
} catch (const lacuna::Error& error) {
    std::cerr << error.code() << ": " << error.what() << '\n';
    return 1;
}
