// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/solid_builder.h>

#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/cad_worker/detail/solid_file.h>
#include <lacuna/core/shared/criteria.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>
#include <set>
#include <utility>

namespace lacuna::cad_worker {

using cad_protocol::SolidEdge;
using cad_protocol::SolidFace;
using cad_protocol::SplineCurveData;
using cad_protocol::SplineSurfaceData;

namespace {

/// Points of an entity at a few fixed fractions of its parameter range. A copy of the entity has the same
/// points.
std::vector<Vec3> probes_of(int dim, int tag)
{
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(dim, tag, low, high);
    std::vector<double> params;
    std::vector<Vec2> uv;
    for (const double f : {0.0, 0.23, 0.61, 1.0}) {
        params.push_back(low[0] + f * (high[0] - low[0]));
        const double g = 0.87 - 0.7 * f;
        if (dim == 2) uv.emplace_back(params.back(), low[1] + g * (high[1] - low[1]));
    }
    return dim == 1 ? curve_points(tag, params) : surface_points(tag, uv);
}

/// Features by which a face or curve is recognised after it was copied through a file.
struct Fingerprint {
    std::vector<Vec3> probes;
    double area; ///< area of a face; 0 for a curve

    Fingerprint(int dim, int tag) : probes(probes_of(dim, tag)), area(dim == 2 ? mass_of(2, tag) : 0) {}
    [[nodiscard]] bool is(const Fingerprint& other, double scale, double diagonal) const
    {
        for (std::size_t i = 0; i < probes.size(); ++i)
            if ((probes[i] * scale - other.probes[i]).norm() > kFileAccuracy * diagonal * scale) return false;
        return std::abs(area * scale * scale - other.area) <=
               kFileAccuracy * diagonal * diagonal * scale * scale;
    }
};

std::vector<int> add_points(const std::vector<Vec3>& poles)
{
    std::vector<int> tags;
    for (const Vec3& p : poles) tags.push_back(gmsh::model::occ::addPoint(p.x(), p.y(), p.z()));
    return tags;
}

int add_curve(const SplineCurveData& curve)
{
    return gmsh::model::occ::addBSpline(add_points(curve.poles), -1, curve.axis.degree, {}, curve.axis.knots,
                                        curve.axis.multiplicities);
}

int add_surface(const SplineSurfaceData& surface)
{
    // Keep the points: removing them would take time quadratic in their number, and only the solid is
    // written.
    const std::vector<int> tags = add_points(surface.poles);
    const auto across = std::accumulate(surface.u.multiplicities.begin(), surface.u.multiplicities.end(), 0);
    return gmsh::model::occ::addBSplineSurface(tags, across - surface.u.degree - 1, -1, surface.u.degree,
                                               surface.v.degree, {}, surface.u.knots, surface.v.knots,
                                               surface.u.multiplicities, surface.v.multiplicities);
}

} // namespace

void set_plain_import(Session& session, double scale)
{
    for (const char* off :
         {"Geometry.OCCFixDegenerated", "Geometry.OCCFixSmallEdges", "Geometry.OCCFixSmallFaces",
          "Geometry.OCCSewFaces", "Geometry.OCCMakeSolids", "Geometry.OCCBoundsUseStl",
          "Geometry.OCCExportOnlyVisible", "Geometry.OCCParallel"}) {
        session.set(off, 0);
    }
    session.set("Geometry.OCCAutoFix", 1);
    session.set("Geometry.OCCScaling", scale);
    session.set("Geometry.OCCTargetUnit", std::string{});
}

SolidBuilder::SolidBuilder(std::string subject, SolidFiles files)
    : session_(std::move(subject)), scratch_(session_), files_(std::move(files))
{
}

// --- given faces ------------------------------------------------------------------------------------

/// Copy shapes of a source through a file. This keeps the shapes exact and their shared edges shared.
cad_protocol::BeginSolidReply::Found SolidBuilder::add_source(const CadSource& source,
                                                              const cad_protocol::SolidSource& wanted)
{
    std::map<int, Fingerprint> faces, curves;
    source.model->activate(session_);
    session_.run([&] {
        gmsh::vectorpair shapes;
        gmsh::model::occ::getEntities(shapes);
        const std::set<std::pair<int, int>> there(shapes.begin(), shapes.end());
        for (const int tag : wanted.faces)
            if (there.contains({2, tag})) faces.try_emplace(tag, 2, tag);
        for (const int tag : wanted.curves)
            if (there.contains({1, tag})) curves.try_emplace(tag, 1, tag);
        if (!faces.empty()) gmsh::write(files_.source);
    });
    scratch_.activate(session_);
    Imported& imported = imported_.emplace_back();
    cad_protocol::BeginSolidReply::Found found;
    if (faces.empty()) return found;
    session_.run([&] {
        set_plain_import(session_, source.scale);
        const auto last_tag = [](int dim) {
            const std::vector<int> tags = tags_of(dim);
            return tags.empty() ? 0 : tags.back();
        };
        const int last_face = last_tag(2), last_curve = last_tag(1);
        import_shapes(files_.source, "brep");
        const auto match = [&](int dim, const std::map<int, Fingerprint>& prints, int last) {
            std::vector<int> fresh = tags_of(dim);
            std::erase_if(fresh, [&](int tag) { return tag <= last; });
            std::map<int, int> matched;
            for (const auto& [tag, print] : prints) {
                const auto is = [&, &known = print](int candidate) {
                    return std::binary_search(fresh.begin(), fresh.end(), candidate) &&
                           known.is(Fingerprint(dim, candidate), source.scale, source.diagonal);
                };
                // Usually the copies come in the order of the originals.
                const auto place = is(tag + last) ? std::find(fresh.begin(), fresh.end(), tag + last)
                                                  : std::find_if(fresh.begin(), fresh.end(), is);
                if (place == fresh.end()) {
                    const char* const kind = dim == 2 ? "face" : "curve";
                    throw BackendError(
                        Message("cad.lost",
                                "{} of {} cannot be used in the solid: the copy of the geometry that Open "
                                "CASCADE made lacks this {}",
                                NamedEntity{kind, tag}, source.path, kind)
                            .remedy("repair the {} in the CAD system", kind));
                }
                matched[tag] = *place;
            }
            return matched;
        };
        imported.faces = match(2, faces, last_face);
        imported.curves = match(1, curves, last_curve);
        for (const auto& [tag, own] : imported.faces) found.faces.push_back(tag);
        for (const auto& [tag, own] : imported.curves) {
            std::vector<double> low, high;
            gmsh::model::getParametrizationBounds(1, own, low, high);
            const std::vector<Vec3> at = curve_points(own, {low[0], (low[0] + high[0]) / 2, high[0]});
            found.curve_points.push_back({at[0], at[1], at[2]});
            found.curves.push_back(tag);
        }
    });
    return found;
}

// --- edges ------------------------------------------------------------------------------------------

int SolidBuilder::point(Index p)
{
    const auto [place, fresh] = points_.try_emplace(p, 0);
    if (fresh) {
        const Vec3& at = request_->points.at(index(p));
        place->second = gmsh::model::occ::addPoint(at.x(), at.y(), at.z());
    }
    return place->second;
}

std::vector<int> SolidBuilder::make_curves(const SolidEdge& edge)
{
    if (edge.kind == SolidEdge::exact) return {imported_.at(index(edge.source)).curves.at(edge.curve)};
    if (edge.kind == SolidEdge::spline) return {add_curve(edge.curve_data)};
    std::vector<int> lines;
    for (std::size_t k = 0; k + 1 < edge.points.size(); ++k)
        lines.push_back(gmsh::model::occ::addLine(point(edge.points[k]), point(edge.points[k + 1])));
    return lines;
}

std::vector<int> SolidBuilder::curves_of(Index edge)
{
    const auto [place, fresh] = curves_.try_emplace(edge);
    if (fresh) place->second = make_curves(request_->edges.at(index(edge)));
    return place->second;
}

int SolidBuilder::wire(const std::vector<std::array<Index, 2>>& loop)
{
    std::vector<int> curves;
    for (const auto& [edge, reversed] : loop) {
        const std::vector<int> own = curves_of(edge);
        if (reversed != 0)
            curves.insert(curves.end(), own.rbegin(), own.rend());
        else
            curves.insert(curves.end(), own.begin(), own.end());
    }
    return gmsh::model::occ::addCurveLoop(curves);
}

/// Forget curves and points that Open CASCADE's boolean operations have removed.
void SolidBuilder::forget_removed()
{
    gmsh::vectorpair left;
    gmsh::model::occ::getEntities(left);
    const std::set<std::pair<int, int>> there(left.begin(), left.end());
    std::erase_if(curves_, [&](const auto& edge) {
        return std::any_of(edge.second.begin(), edge.second.end(), [&](int tag) {
            return !there.contains({1, tag});
        });
    });
    std::erase_if(points_, [&](const auto& p) { return !there.contains({0, p.second}); });
}

// --- faces ------------------------------------------------------------------------------------------

/// A plane bounded by several loops. Holes are cut out by boolean operations, because Gmsh's own plane with
/// holes depends on the directions of their curves.
int SolidBuilder::plane(const SolidFace& face)
{
    std::vector<int> parts;
    for (const auto& loop : face.loops) parts.push_back(gmsh::model::occ::addPlaneSurface({wire(loop)}));
    if (parts.size() == 1) return parts.front();
    double wanted = mass_of(2, parts.at(0));
    gmsh::vectorpair holes;
    for (const int part : parts | std::views::drop(1)) {
        wanted -= mass_of(2, part);
        holes.emplace_back(2, part);
    }
    gmsh::vectorpair cut;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::cut({{2, parts.front()}}, holes, cut, map);
    const double area = cut.size() == 1 ? mass_of(2, cut.front().second) : 0;
    if (!(std::abs(area - wanted) <= kFileAccuracy * wanted))
        throw BackendError(Message("cad.plane_failed", "the inner loops could not be cut out of a plane")
                               .remedy("write the facets with write_facets"));
    forget_removed();
    return cut.front().second;
}

/// A smooth surface over the outer loop, through points of the facets and of the inner loops. The inner loops
/// then trim the surface.
int SolidBuilder::filling(const SolidFace& face)
{
    std::vector<int> leading;
    for (const Index p : face.leading) leading.push_back(point(p));
    const int filled = gmsh::model::occ::addSurfaceFilling(wire(face.loops.at(0)), -1, leading);
    if (face.loops.size() == 1) return filled;

    // The inner loops are near the surface, but not exactly on it. Those that split it become edges of it.
    gmsh::vectorpair inner, parts;
    for (std::size_t l = 1; l < face.loops.size(); ++l)
        for (const auto& use : face.loops[l])
            for (const int curve : curves_of(use[0])) inner.emplace_back(1, curve);
    std::vector<gmsh::vectorpair> map;
    session_.set("Geometry.ToleranceBoolean", kVisible * request_->diagonal);
    gmsh::model::occ::fragment({{2, filled}}, inner, parts, map, -1, true, false);
    session_.set("Geometry.ToleranceBoolean", 0.0);
    forget_removed();
    int best = 0;
    double least = kInfinity;
    for (const auto& [dim, tag] : parts) {
        if (dim != 2) continue;
        const double off = std::abs(std::abs(mass_of(2, tag)) - face.area);
        if (off >= least) continue;
        least = off;
        best = tag;
    }
    return best;
}

std::vector<int> SolidBuilder::make_face(const SolidFace& face)
{
    std::vector<int> tags;
    switch (face.kind) {
    case SolidFace::exact:
        return {imported_.at(index(face.source)).faces.at(face.face)};
    case SolidFace::plane:
        return {plane(face)};
    case SolidFace::patches:
        for (const SplineSurfaceData& surface : face.surfaces) tags.push_back(add_surface(surface));
        return tags;
    default:
        return {filling(face)};
    }
}

cad_protocol::MakeSolidReply SolidBuilder::make(const cad_protocol::MakeSolidRequest& request,
                                                const Progress& progress)
{
    request_ = &request;
    scratch_.activate(session_);
    std::vector<int> faces;
    for (std::size_t f = 0; f < request.faces.size(); ++f) {
        const SolidFace& face = request.faces[f];
        try {
            const std::vector<int> tags = session_.run([&] { return make_face(face); });
            faces.insert(faces.end(), tags.begin(), tags.end());
        } catch (const BackendError& error) {
            const Message message("cad.face_failed", "{} cannot be written as a CAD face: {}", face.entity,
                                  error.message().parts());
            throw BackendError(error.message().remedy().empty()
                                   ? message.remedy("write the facets with write_facets")
                                   : message);
        }
        progress(static_cast<double>(f + 1) / static_cast<double>(request.faces.size()));
    }
    return session_.run([&] { return write_solid(session_, faces, request, files_); });
}

} // namespace lacuna::cad_worker
