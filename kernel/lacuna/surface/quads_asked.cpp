// SPDX-License-Identifier: MIT
#include <lacuna/surface/quads_asked.h>

#include <lacuna/surface/detail/face_sides.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Sizes on a facet or a side that differ by this factor at most are one. A choice, not a measurement.
constexpr double kOneSize = 1.5;
/// What is no longer than so many sizes is not halved.
constexpr double kFewSides = 2;

using Facet = std::array<Vec3, 3>;
using Segment = std::array<Vec3, 2>;

double area(const Facet& f) { return (f[1] - f[0]).cross(f[2] - f[0]).norm() / 2; }

/// Whether a size is one on a facet or segment, by its corners and its middle.
template <std::size_t n>
bool is_even(const std::array<Vec3, n>& part, const SizeField& size, double middle)
{
    double least = middle, most = middle;
    for (const Vec3& p : part) {
        least = std::min(least, size(p));
        most = std::max(most, size(p));
    }
    return most <= kOneSize * least;
}

/// Quads that a size asks for on a facet; no more than just over `most` are counted.
double quads_on(const Facet& whole, const SizeField& size, double most)
{
    double quads = 0;
    std::vector<Facet> parts{whole};
    while (!parts.empty() && quads <= most) {
        const Facet part = parts.back();
        parts.pop_back();
        const double here = size((part[0] + part[1] + part[2]) / 3);
        std::size_t k = 0;
        const auto side = [&](std::size_t i) { return (part[(i + 1) % 3] - part[i]).norm(); };
        for (const std::size_t i : {1, 2})
            if (side(i) > side(k)) k = i;
        if (side(k) <= kFewSides * here || is_even(part, size, here)) {
            quads += area(part) / (here * here);
            continue;
        }
        const Vec3 middle = (part[k] + part[(k + 1) % 3]) / 2;
        for (const std::size_t end : {k, (k + 1) % 3}) {
            parts.push_back(part);
            parts.back()[end] = middle;
        }
    }
    return quads;
}

/// Sides that a size asks for on a segment; no more than just over `most` are counted.
double sides_on(const Segment& whole, const SizeField& size, double most)
{
    double sides = 0;
    std::vector<Segment> parts{whole};
    while (!parts.empty() && sides <= most) {
        const Segment part = parts.back();
        parts.pop_back();
        const Vec3 middle = (part[0] + part[1]) / 2;
        const double here = size(middle), length = (part[1] - part[0]).norm();
        if (length <= kFewSides * here || is_even(part, size, here)) {
            sides += length / here;
            continue;
        }
        parts.push_back({part[0], middle});
        parts.push_back({middle, part[1]});
    }
    return sides;
}

double sides_round(const Model& model, FaceId face, const SizeField& size, double most)
{
    double sides = 0;
    for (const Loop& loop : model[face].loops) {
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Index>& points = model[use.edge].points;
            for (std::size_t i = 0; i + 1 < points.size() && sides <= most; ++i)
                sides += sides_on({model.at(points[i]), model.at(points[i + 1])}, size, most);
        }
    }
    return sides;
}

} // namespace

bool asks_for_more(const OpenVolume& volume, const SizeField& size, double most)
{
    constexpr double kSides = 4; ///< of a face that a grid fills
    const Model& model = volume.model;
    double all = 0;
    for (const FaceId face : volume.faces(Role::source)) {
        double quads = 0;
        for (const Triangle& t : model[face].triangles)
            quads += quads_on({model.at(t[0]), model.at(t[1]), model.at(t[2])}, size, most - all - quads);
        if (four_corners(model, face)) {
            const double along = sides_round(model, face, size, kSides * std::sqrt(most)) / kSides;
            quads = std::max(quads, along * along);
        }
        all += quads;
        if (all > most) return true;
    }
    return false;
}

} // namespace lacuna::surface
