// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/quads_asked.h>

#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

using Facet = std::array<Vec3, 3>;
using Segment = std::array<Vec3, 2>;

Vec3 middle(const Facet& f) { return (f[0] + f[1] + f[2]) / 3; }
Vec3 middle(const Segment& s) { return (s[0] + s[1]) / 2; }

/// Number of quads with sides of length `h` on a facet, and of sides of length `h` on a segment.
double asked_by(double h, const Facet& f) { return (f[1] - f[0]).cross(f[2] - f[0]).norm() / 2 / (h * h); }
double asked_by(double h, const Segment& s) { return (s[1] - s[0]).norm() / h; }

/// Whether a side of the largest size on a facet or segment is accepted where the size is smallest, according
/// to the sizes at the corners and the midpoint.
template <std::size_t n>
bool is_even(const std::array<Vec3, n>& part, const SizeField& size, double in_middle)
{
    double least = in_middle, most = in_middle;
    for (const Vec3& p : part) {
        const double here = size(p);
        least = std::min(least, here);
        most = std::max(most, here);
    }
    return most <= quads::kLongestOfSize * least;
}

/// Number of quads on a facet, or of sides on a segment, that a size field requires. The facet or segment is
/// subdivided until each part is as short as the size, or the size is uniform on it. Counting stops just
/// above `most`.
template <std::size_t n>
double asked_on(const std::array<Vec3, n>& whole, const SizeField& size, double most)
{
    double asked = 0;
    std::vector<std::array<Vec3, n>> parts{whole};
    while (!parts.empty() && asked <= most) {
        const std::array<Vec3, n> part = parts.back();
        parts.pop_back();
        const double here = size(middle(part));
        const auto side = [&](std::size_t i) { return (part[(i + 1) % n] - part[i]).norm(); };
        std::size_t k = 0;
        for (std::size_t i = 1; i < n; ++i)
            if (side(i) > side(k)) k = i;
        if (side(k) <= here || is_even(part, size, here)) {
            asked += asked_by(here, part);
            continue;
        }
        for (const std::size_t end : {k, (k + 1) % n}) {
            parts.push_back(part);
            parts.back()[end] = (part[k] + part[(k + 1) % n]) / 2;
        }
    }
    return asked;
}

double sides_round(const Model& model, FaceId face, const SizeField& size, double most)
{
    double sides = 0;
    for (const EdgeUse& use : uses_of(model[face])) {
        const std::vector<Index>& points = model[use.edge].points;
        for (std::size_t i = 0; i + 1 < points.size() && sides <= most; ++i)
            sides += asked_on(Segment{model.at(points[i]), model.at(points[i + 1])}, size, most);
    }
    return sides;
}

} // namespace

bool asks_for_more(const OpenVolume& volume, const SizeField& size, double most)
{
    const Model& model = volume.model;
    double all = 0;
    for (const FaceId face : volume.faces(Role::source)) {
        double quads = 0;
        for (const Triangle& t : model[face].triangles)
            quads += asked_on(Facet{model.at(t[0]), model.at(t[1]), model.at(t[2])}, size,
                              most - all - quads);
        if (const auto corners = four_corners(model, face)) {
            const auto sides = static_cast<double>(corners->size());
            const double along = sides_round(model, face, size, sides * std::sqrt(most)) / sides;
            quads = std::max(quads, along * along);
        }
        all += quads;
        if (all > most) return true;
    }
    return false;
}

} // namespace lacuna::surface
