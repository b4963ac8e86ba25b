// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/follow_rows.h>

#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/surface/shared/projector.h>

namespace lacuna::surface {

using namespace topology;

namespace {

/// The known rows of the walls; each is a section of the volume.
struct Rows {
    std::vector<std::vector<Vec3>> points; ///< for each row, the points of all known columns
    std::vector<Vec3> areas;               ///< Newell vectors of each row's linking surfaces
};

Rows known_rows(const std::vector<WallMesh>& meshes, std::span<const LinkingNodes> nodes,
                const std::vector<FollowedPanel>& followed, std::size_t layers)
{
    Rows rows;
    rows.points.resize(layers + 1);
    rows.areas.assign(layers + 1, Vec3::Zero());
    for (std::size_t b = 0; b < meshes.size(); ++b) {
        const std::size_t n = nodes[b].source_at.size();
        std::vector<bool> known(n, true);
        for (const FollowedPanel& panel : followed) {
            for (std::size_t i = panel.first + 1; panel.link == b && i < panel.last; ++i) known[i] = false;
        }
        for (std::size_t k = 0; k <= layers; ++k) {
            std::vector<Vec3> loop;
            for (std::size_t i = 0; i < n; ++i) {
                if (known[i]) loop.push_back(meshes[b].points[k * n + i]);
            }
            rows.areas[k] += geometry::newell_vector(loop);
            rows.points[k].insert(rows.points[k].end(), loop.begin(), loop.end());
        }
    }
    return rows;
}

} // namespace

void follow_rows(std::vector<WallMesh>& meshes, const Model& model, std::span<const LinkingNodes> nodes,
                 const std::vector<FollowedPanel>& followed, std::size_t layers, bool onto_faces,
                 const RunContext& context)
{
    const Rows rows = known_rows(meshes, nodes, followed, layers);
    for (std::size_t k = 1; k < layers; ++k) {
        const double t = static_cast<double>(k) / static_cast<double>(layers);
        const geometry::AffineFit up = geometry::fit_affine(rows.points.front(), rows.points[k],
                                                            rows.areas.front(), rows.areas[k]);
        const geometry::AffineFit down = geometry::fit_affine(rows.points.back(), rows.points[k],
                                                              rows.areas.back(), rows.areas[k]);
        for (const FollowedPanel& panel : followed) {
            std::vector<Vec3>& points = meshes[panel.link].points;
            const std::size_t n = nodes[panel.link].source_at.size();
            const auto led = [&](std::size_t i) {
                return Vec3((1 - t) * up(points[i % n]) + t * down(points[layers * n + i % n]));
            };
            const Vec3 left = points[k * n + panel.first % n] - led(panel.first);
            const Vec3 right = points[k * n + panel.last % n] - led(panel.last);
            for (std::size_t i = panel.first + 1; i < panel.last; ++i) {
                const double s = static_cast<double>(i - panel.first) /
                                 static_cast<double>(panel.last - panel.first);
                points[k * n + i] = led(i) + (1 - s) * left + s * right;
            }
        }
    }
    if (!onto_faces) return;
    for (const FollowedPanel& panel : followed) {
        std::vector<Vec3>& points = meshes[panel.link].points;
        const std::size_t n = nodes[panel.link].source_at.size();
        std::vector<Vec3> inside;
        for (std::size_t k = 1; k < layers; ++k) {
            for (std::size_t i = panel.first + 1; i < panel.last; ++i) inside.push_back(points[k * n + i]);
        }
        if (inside.empty()) continue;
        Projector(model, {panel.face}).project(inside, context);
        std::size_t next = 0;
        for (std::size_t k = 1; k < layers; ++k) {
            for (std::size_t i = panel.first + 1; i < panel.last; ++i) points[k * n + i] = inside[next++];
        }
    }
}

} // namespace lacuna::surface
