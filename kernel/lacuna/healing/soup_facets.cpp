// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/healing/detail/soup_facets.h>
#include <lacuna/healing/split_facets.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/core/shared/same_corners.h>
#include <lacuna/healing/detail/t_junctions.h>
#include <lacuna/healing/shared/add_facet.h>
#include <lacuna/healing/shared/weld.h>
#include <lacuna/topology/shared/side_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

namespace lacuna::healing {
namespace {

template <std::size_t N>
void check_cells(const FacetSoup& soup, const std::vector<std::array<Index, N>>& cells,
                 const std::vector<int>& labels, const char* kind)
{
    if (!labels.empty() && labels.size() != cells.size()) {
        throw InvalidInput(Message("topology.bad_labels", "there are {} labels for {} {}s",
                                   found(labels.size()), needed(cells.size()), kind)
                               .remedy("give one label for each, or none"));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
        for (const Index p : cells[c]) {
            if (p >= 0 && index(p) < soup.points.size() && soup.points[index(p)].allFinite()) continue;
            throw InvalidInput(
                Message("topology.bad_point", "{} uses point {} of {}, which does not exist or is not finite",
                        NamedEntity{kind, static_cast<long long>(c) + 1}, found(p + 1), soup.points.size())
                    .remedy("check the points and cells"));
        }
    }
}

/// @throw InvalidInput  squared areas of facets, also of those as small as a millionth of the diagonal, would
///         overflow or underflow.
void check_size(const Vec3& low, const Vec3& high, double diagonal)
{
    using Limits = std::numeric_limits<double>;
    const double smallest = kFileAccuracy * diagonal; // the fourth powers of lengths must be numbers
    if (low == high ||
        (smallest > std::pow(Limits::min(), 1. / 4) && diagonal < std::pow(Limits::max(), 1. / 4) / 2))
        return;
    throw InvalidInput(Message("topology.size",
                               "the facets lie between {} and {}: at this size, areas overflow or underflow",
                               place_with_digits(low, 6), place_with_digits(high, 6))
                           .remedy("load with another 'scale'"));
}

/// Weld the points that facets use. The points of `facets` become the welded ones, in the order of the soup.
/// @return  for each point of the soup, its index in `facets`; -1: not used
std::vector<Index> weld_used(const FacetSoup& soup, double tolerance, Facets& facets,
                             const RunContext& context)
{
    std::vector<bool> used(soup.points.size(), false);
    for (const Triangle& t : soup.triangles)
        for (const Index p : t) used[index(p)] = true;
    for (const Quad& q : soup.quads)
        for (const Index p : q) used[index(p)] = true;
    std::vector<Vec3>& points = facets.points;
    points = soup.points;
    std::vector<Index> number = keep_if(points, [&](std::size_t p) { return used[p]; });
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    facets.diagonal = box.diagonal().norm();
    check_size(box.min(), box.max(), facets.diagonal);
    facets.tolerance = tolerance > 0 ? tolerance
                                     : std::max(kFileAccuracy * facets.diagonal, soup.least_tolerance);

    const std::vector<Index> joined = weld(points, facets.tolerance, context);
    for (std::size_t p = 0; p < points.size() && tolerance == 0; ++p)
        facets.joined = std::max(facets.joined, (points[p] - points[index(joined[p])]).norm());
    const std::vector<Index> kept = keep_if(
        points, [&](std::size_t p) { return joined[p] == static_cast<Index>(p); });
    for (Index& p : number)
        if (p >= 0) p = kept[index(joined[index(p)])];
    return number;
}

/// Remove points that no remaining facet uses.
void drop_unused_points(Facets& facets)
{
    std::vector<bool> used(facets.points.size(), false);
    for (const Triangle& t : facets.corner)
        for (const Index p : t) used[index(p)] = true;
    const std::vector<Index> number = keep_if(facets.points, [&](std::size_t p) { return used[p]; });
    for (Triangle& t : facets.corner)
        for (Index& p : t) p = number[index(p)];
    for (Quad& q : facets.quads)
        for (Index& p : q) p = number[index(p)];
}

/// For each cell, whether an earlier cell of the same label has the same corners, in any order.
template <std::size_t N>
std::vector<bool> repeated_cells(std::size_t points, const std::vector<std::array<Index, N>>& cells,
                                 const std::vector<int>& labels)
{
    std::vector<bool> repeated(cells.size(), false);
    const auto each = [&](const auto& visit) {
        for (std::size_t c = 0; c < cells.size(); ++c) {
            Quad corners{-1, -1, -1, -1};
            std::ranges::copy(cells[c], corners.begin());
            visit(corners, c);
        }
    };
    each_with_same_corners(points, each, [&](std::span<const NumberedCell> alike) {
        std::set<int> known;
        for (const auto& [others, cell] : alike)
            repeated[cell] = alike.size() > 1 && !known.insert(labels[cell]).second;
    });
    return repeated;
}

/// Keep the facets for which `stays(f)` is true.
template <class Stays>
void keep_facets(Facets& facets, const Stays& stays)
{
    keep_if(facets.corner, stays);
    keep_if(facets.label, stays);
    keep_if(facets.quad, stays);
}

/// Remove facets and quads that repeat an earlier one. Halves of quads are removed with their quads.
void drop_repeated(Facets& facets)
{
    const std::size_t before = facets.count();
    std::vector<int> quad_label(facets.quads.size(), 0);
    for (std::size_t f = 0; f < before; ++f)
        if (facets.quad[f] >= 0) quad_label[index(facets.quad[f])] = facets.label[f];
    const std::vector<bool> quad_gone = repeated_cells(facets.points.size(), facets.quads, quad_label);
    keep_facets(facets,
                [&](std::size_t f) { return facets.quad[f] < 0 || !quad_gone[index(facets.quad[f])]; });
    const std::vector<bool> repeated = repeated_cells(facets.points.size(), facets.corner, facets.label);
    // A half of a quad stays, even if it repeats a triangle.
    keep_facets(facets, [&](std::size_t f) { return !repeated[f] || facets.quad[f] >= 0; });
    facets.repeated = before - facets.count();
    const std::vector<Index> number = keep_if(facets.quads, [&](std::size_t q) { return !quad_gone[q]; });
    for (Index& quad : facets.quad)
        if (quad >= 0) quad = number[index(quad)];
}

void close_tees(Facets& facets, const RunContext& context)
{
    std::vector<bool> whole(facets.count());
    for (std::size_t f = 0; f < whole.size(); ++f) whole[f] = facets.quad[f] >= 0;
    const std::vector<FacetPiece> pieces = cut_at_t_junctions(facets.points, facets.corner, whole,
                                                              facets.tolerance, context);
    if (pieces.empty()) return;
    const std::vector<int> label = std::move(facets.label);
    const std::vector<Index> quad = std::move(facets.quad);
    facets.corner.clear();
    facets.label.clear();
    facets.quad.clear();
    for (const FacetPiece& piece : pieces) {
        facets.corner.push_back(piece.corner);
        facets.label.push_back(label[index(piece.of)]);
        facets.quad.push_back(quad[index(piece.of)]);
    }
}

/// The point furthest from the median of the coordinates.
Vec3 point_far_from_others(const std::vector<Vec3>& points)
{
    Vec3 middle;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<double> along;
        for (const Vec3& p : points) along.push_back(p[axis]);
        const auto half = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
        std::ranges::nth_element(along, half);
        middle[axis] = *half;
    }
    return *std::ranges::max_element(points, {},
                                     [&](const Vec3& p) { return (p - middle).cwiseAbs().maxCoeff(); });
}

/// Whether the corners of a cell lie at three or more distinct points.
bool has_three_places(const std::vector<Vec3>& points, std::span<const Index> corners)
{
    std::size_t places = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3& here = points[index(corners[k])];
        const auto earlier = corners.first(k);
        places += std::ranges::none_of(earlier, [&](Index p) { return points[index(p)] == here; }) ? 1 : 0;
    }
    return places >= 3;
}

/// @throw InvalidInput  no facet is left after welding, or, with the default tolerance, more facets collapsed
///         than are left. The default tolerance depends on the extent of all points: a single stray point, or
///         two distant parts, can make the tolerance larger than the facets.
/// @param given  the user's tolerance; 0: none was given.
void check_left(const FacetSoup& soup, const Facets& facets, double given)
{
    if (facets.count() > 0 && (given > 0 || facets.shrunk <= facets.count())) return;
    if (given > 0)
        throw InvalidInput(Message("topology.no_facets",
                                   "every facet is smaller than the tolerance of {:.4g}",
                                   found(facets.tolerance))
                               .remedy("give a smaller tolerance"));
    Message message = facets.count() == 0
                          ? Message("topology.no_facets",
                                    "every facet is smaller than the tolerance of {:.4g}, which is derived "
                                    "from the extent of all points",
                                    found(facets.tolerance))
                          : Message("topology.small_facets",
                                    "{} facets are smaller than the tolerance of {:.4g}, which is derived "
                                    "from the extent of all points; only {} are larger",
                                    found(facets.shrunk), found(facets.tolerance), facets.count());
    throw InvalidInput(std::move(message).remedy(
        "remove the point at {} if it is not part of the shape, or give a tolerance",
        place_with_digits(point_far_from_others(soup.points), 4)));
}

Facets welded(const FacetSoup& soup, double tolerance, const RunContext& context)
{
    if (soup.triangles.empty() && soup.quads.empty()) {
        throw InvalidInput(Message("topology.no_facets", "there are no facets to make faces of")
                               .remedy("give triangles or quads"));
    }
    check_cells(soup, soup.triangles, soup.triangle_label, "triangle");
    check_cells(soup, soup.quads, soup.quad_label, "quad");
    Facets facets;
    const std::size_t most = soup.triangles.size() + 2 * soup.quads.size();
    facets.corner.reserve(most);
    facets.label.reserve(most);
    facets.quad.reserve(most);
    const std::vector<Index> number = weld_used(soup, tolerance, facets, context);
    const auto add = [&](const Triangle& t, int label, Index quad) {
        if (topology::repeats(t)) return;
        facets.corner.push_back(t);
        facets.label.push_back(label);
        facets.quad.push_back(quad);
    };
    const auto count_if_shrunk = [&](std::span<const Index> given, std::size_t facets_before) {
        if (facets.count() == facets_before && has_three_places(soup.points, given)) ++facets.shrunk;
    };
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const Triangle& given = soup.triangles[t];
        const std::size_t before = facets.count();
        add({number[index(given[0])], number[index(given[1])], number[index(given[2])]},
            soup.triangle_label.empty() ? 0 : soup.triangle_label[t], -1);
        count_if_shrunk(given, before);
    }
    for (std::size_t c = 0; c < soup.quads.size(); ++c) {
        Quad q;
        for (std::size_t k = 0; k < 4; ++k) q[k] = number[index(soup.quads[c][k])];
        const int label = soup.quad_label.empty() ? 0 : soup.quad_label[c];
        const bool whole = !topology::repeats(q);
        const auto halves = halves_of(facets.points, q);
        const std::size_t before = facets.count();
        for (const Triangle& half : halves)
            add(half, label, whole ? static_cast<Index>(facets.quads.size()) : -1);
        if (whole) facets.quads.push_back(q);
        count_if_shrunk(soup.quads[c], before);
    }
    check_left(soup, facets, tolerance);
    drop_unused_points(facets);
    return facets;
}

} // namespace

std::array<Triangle, 2> halves_of(const std::vector<Vec3>& points, const Quad& q)
{
    const std::array<std::array<Triangle, 2>, 2> choices{
        {{{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}}, {{{q[1], q[2], q[3]}, {q[1], q[3], q[0]}}}}};
    const Vec3 normal = area_vector(points, choices[0][0]) + area_vector(points, choices[0][1]);
    std::array<double, 2> worst;
    for (std::size_t c = 0; c < 2; ++c) {
        worst[c] = std::numeric_limits<double>::max();
        for (const Triangle& t : choices[c]) {
            double sides = 0;
            for (std::size_t k = 0; k < 3; ++k)
                sides += (points[index(t[k])] - points[index(t[(k + 1) % 3])]).squaredNorm();
            worst[c] = std::min(worst[c], area_vector(points, t).dot(normal) / sides);
        }
    }
    return choices[worst[1] > worst[0] ? 1 : 0];
}

void add_facet(FacetSoup& soup, std::span<const Index> corners, int label)
{
    (corners.size() == 3 ? soup.triangle_label : soup.quad_label).push_back(label);
    if (corners.size() == 3)
        soup.triangles.push_back({corners[0], corners[1], corners[2]});
    else
        soup.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
}

Vec3 area_vector(const std::vector<Vec3>& points, const Triangle& t)
{
    const Vec3& a = points[index(t[0])];
    return (points[index(t[1])] - a).cross(points[index(t[2])] - a) / 2;
}

Facets facets_of(const FacetSoup& soup, double tolerance, const RunContext& context)
{
    Facets facets = welded(soup, tolerance, context);
    check_cancelled(context);
    drop_repeated(facets);
    check_cancelled(context);
    close_tees(facets, context);
    return facets;
}

} // namespace lacuna::healing
