// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/mean_outline.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/signed_area.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/morph.h>
#include <lacuna/sweep/detail/rim.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Interior angle at b [0, 2 π); the region lies to the left of a, b, c.
double inner_angle(const Vec2& a, const Vec2& b, const Vec2& c)
{
    const Vec2 in = b - a, out = c - b;
    return std::numbers::pi - std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
}

/// Both rims in the plane of the source's rim, and their mean.
struct FlatRims {
    Vec3 origin, x, y;
    std::vector<Vec2> low, high, mean;

    [[nodiscard]] Vec2 flat(const Vec3& p) const { return {(p - origin).dot(x), (p - origin).dot(y)}; }
    [[nodiscard]] Vec3 lifted(const Vec2& p) const { return origin + p.x() * x + p.y() * y; }
};

FlatRims flat_rims(const mesh::QuadMesh& source, const RimColumns& columns)
{
    const std::span<const Vec3> low = columns.row(0), high = columns.row(columns.layers);
    FlatRims rims;
    const Vec3 normal = rim_area(low, rim_sides(source, columns)).stableNormalized();
    rims.origin = geometry::mean_point(low);
    rims.x = normal.unitOrthogonal();
    rims.y = normal.cross(rims.x);
    const geometry::RigidFit back = geometry::fit_rigid(high, low, true);
    for (std::size_t k = 0; k < low.size(); ++k) {
        rims.low.push_back(rims.flat(low[k]));
        rims.high.push_back(rims.flat(back(high[k])));
        rims.mean.emplace_back((rims.low.back() + rims.high.back()) / 2);
    }
    return rims;
}

/// Move nodes of a loop inward where the quads that the ends need at a node do not fit into the angle of the
/// mean outline.
void draw_in(const std::vector<Index>& loop, FlatRims& rims)
{
    const std::size_t n = loop.size();
    const std::vector<Vec2> mean = rims.mean;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t a = index(loop[(i + n - 1) % n]), b = index(loop[i]), c = index(loop[(i + 1) % n]);
        const double larger = std::max(inner_angle(rims.low[a], rims.low[b], rims.low[c]),
                                       inner_angle(rims.high[a], rims.high[b], rims.high[c]));
        // In a wider corner than this, a quad would be poor.
        const double quads = std::ceil(larger / (std::numbers::pi - std::asin(kPoorQuad)));
        // The quads need 90° each, and may lack less than a crease.
        const double wanted = quads * kRightAngle - kCreaseAngle * kDegree;
        if (inner_angle(mean[a], mean[b], mean[c]) >= wanted || wanted >= std::numbers::pi) continue;
        const Vec2 chord = mean[c] - mean[a];
        const Vec2 outward(chord.y(), -chord.x());
        rims.mean[b] = (mean[a] + mean[c]) / 2 + outward / (2 * std::tan(wanted / 2));
    }
}

std::vector<Vec2> outline_of(const std::vector<Vec2>& points, const std::vector<Index>& loop)
{
    std::vector<Vec2> outline;
    for (const Index p : loop) outline.push_back(points[index(p)]);
    return outline;
}

} // namespace

surface::SourceMesh laid_between(const OpenVolume& volume, surface::SourceMesh source,
                                 const RimColumns& columns, const surface::SizeField& size,
                                 const quads::PlanarQuadMesher& mesher, const RunContext& context)
{
    const std::vector<FaceId> faces = volume.faces(Role::source);
    // The region consists of the rim nodes only, in the order of the columns.
    FlatRims rims = flat_rims(source.quads, columns);
    quads::PlanarRegion region;
    double largest = 0;
    for (const std::vector<Index>& loop : source.quads.loops) {
        draw_in(loop, rims);
        const double area = geometry::signed_area(outline_of(rims.low, loop));
        region.loops.push_back(loop);
        if (area <= largest) continue;
        largest = area;
        std::swap(region.loops.front(), region.loops.back());
    }
    region.points = rims.mean;
    region.size = [&](const Vec2& p) { return size(rims.lifted(p)); };
    const std::vector<Vec2> outer = outline_of(region.points, region.loops.front());
    const auto is_hole = [&](const std::vector<Index>& loop) {
        const std::vector<Vec2> outline = outline_of(region.points, loop);
        return geometry::signed_area(outline) < 0 && geometry::encloses(outer, outline);
    };
    // The rims of a tube coincide in its section.
    if (geometry::find_crossing(region.points, region.loops) ||
        !std::all_of(region.loops.begin() + 1, region.loops.end(), is_hole))
        throw NotSweepable(Message("sweep.mean_outline", "the source cannot be meshed in a plane, because "
                                                         "the mean of both ends' outlines crosses itself")
                               .remedy("cut the volume between source and target"));
    const quads::PlanarQuads filling = mesher(region, context);

    mesh::QuadMesh flat;
    for (const Vec2& p : filling.points) flat.nodes.push_back(rims.lifted(p));
    flat.quads = filling.quads;
    flat.loops = source.quads.loops;
    RimColumns back;
    back.layers = 1;
    back.rim = columns.rim;
    for (const Index node : back.rim) back.points.push_back(flat.nodes[index(node)]);
    const std::span<const Vec3> low = columns.row(0);
    back.points.insert(back.points.end(), low.begin(), low.end());
    const surface::Projector projector(volume.model, faces);
    Morphed morphed = morph(
        flat, back, [&](std::span<Vec3> points) { projector.project(points, context); }, context);
    flat.nodes = std::move(morphed.nodes);
    flat.face.assign(flat.quads.size(), static_cast<Index>(faces.front().index()));
    source.quads = std::move(flat);
    source.rows.clear();
    source.notes = {formatted("{}: paved between the outlines of both ends, {} quads",
                              entity_of(volume.model, faces.front()), source.quads.quads.size())};
    return source;
}

} // namespace lacuna::sweep
