// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/coincident_faces.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/geometry/shared/facet_tree.h>

#include <algorithm>
#include <vector>

namespace lacuna::healing {

namespace {

/// Sample points of a face: corners and centres of its facets, projected on its exact surface if it has one.
struct Samples {
    std::vector<Vec3> points;
    double sagitta = 0; ///< largest distance from the samples on the facets to the surface [model length]
};

Samples samples_of(const topology::Model& model, const topology::Face& face, const RunContext& context)
{
    Samples samples;
    std::vector<Vec2> uv;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        const Triangle& f = face.triangles[t];
        for (const Index p : f) samples.points.push_back(model.at(p));
        samples.points.push_back((model.at(f[0]) + model.at(f[1]) + model.at(f[2])) / 3);
        if (!face.surface) continue;
        uv.insert(uv.end(), face.uv[t].begin(), face.uv[t].end());
        uv.push_back((face.uv[t][0] + face.uv[t][1] + face.uv[t][2]) / 3);
    }
    if (!face.surface) return samples;
    const std::vector<Vec3> before = samples.points;
    face.surface->project(samples.points, uv, context);
    for (std::size_t i = 0; i < before.size(); ++i)
        samples.sagitta = std::max(samples.sagitta, (before[i] - samples.points[i]).norm());
    return samples;
}

/// Whether the samples are within `reach` of the facets and, if the face has an exact surface, within the
/// tolerance of that surface.
bool lie_on(const Samples& samples, const topology::Model& model, const topology::Face& face, double reach,
            double tolerance, const RunContext& context)
{
    const geometry::FacetTree tree(model.points, face.triangles);
    std::vector<Vec2> uv;
    for (const Vec3& p : samples.points) {
        const auto hit = tree.closest(p, reach * reach);
        if (hit.triangle < 0) return false;
        if (!face.surface) continue;
        const auto& corner = face.uv[static_cast<std::size_t>(hit.triangle)];
        uv.push_back(hit.barycentric[0] * corner[0] + hit.barycentric[1] * corner[1] +
                     hit.barycentric[2] * corner[2]);
    }
    if (!face.surface) return true;
    std::vector<Vec3> at = samples.points;
    face.surface->project(at, uv, context);
    for (std::size_t i = 0; i < at.size(); ++i)
        if ((at[i] - samples.points[i]).norm() > tolerance) return false;
    return true;
}

} // namespace

bool faces_coincide(const topology::Model& model, const topology::Face& a, const topology::Face& b,
                    double tolerance, const RunContext& context)
{
    const bool exact = a.surface && b.surface && a.uv.size() == a.triangles.size() &&
                       b.uv.size() == b.triangles.size();
    if (!exact && (a.surface || b.surface)) {
        // Only one face has a usable exact surface: compare the facets of both.
        topology::Face plain_a = a;
        topology::Face plain_b = b;
        plain_a.surface = plain_b.surface = nullptr;
        return faces_coincide(model, plain_a, plain_b, tolerance, context);
    }
    check_cancelled(context);
    const auto coincide = attempt<BackendError>([&] {
        const Samples of_a = samples_of(model, a, context);
        const Samples of_b = samples_of(model, b, context);
        const double reach = tolerance + 2 * (of_a.sagitta + of_b.sagitta);
        return lie_on(of_a, model, b, reach, tolerance, context) &&
               lie_on(of_b, model, a, reach, tolerance, context);
    });
    return coincide.value.value_or(false); // it is unknown if a projection failed
}

} // namespace lacuna::healing
