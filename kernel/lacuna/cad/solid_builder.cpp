// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad/detail/solid_builder.h>

#include <lacuna/cad/detail/edge_shape.h>
#include <lacuna/cad/detail/gmsh_api.h>
#include <lacuna/cad/detail/void_patch.h>
#include <lacuna/closure/void_geometry.h>
#include <lacuna/geometry/newell.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace lacuna::cad {

using namespace topology;

namespace {

/// How exactly splines meet what they stand for, as a part of the diagonal: a hundredth of the tolerance
/// there is by default.
constexpr double kPrecision = 1e-8;
/// Points a filled surface is led through at most, of each inner loop and of the facets: the time it takes
/// grows with their cube.
constexpr std::size_t kLeadingPoints = 40;
/// An inner loop no further from a filled surface than this part of the diagonal divides it.
constexpr double kCloseBy = 1e-3;
/// How closely a shape must be met to be the one it was before it went through a file, as a part of the
/// diagonal.
constexpr double kSame = 1e-7;

bool is_plane(const Model& model, const Face& face)
{
    std::vector<std::vector<Vec3>> rims;
    for (const Loop& loop : face.loops) {
        std::vector<Vec3>& rim = rims.emplace_back();
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Index> chain = use_points(model, use);
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) rim.push_back(model.at(chain[k]));
        }
    }
    const geometry::Plane plane = geometry::newell_plane(rims);
    const auto on_plane = [&](const Vec3& p) {
        return std::abs(geometry::height(plane, p)) <= model.tolerance;
    };
    for (const std::vector<Vec3>& rim : rims)
        if (!std::all_of(rim.begin(), rim.end(), on_plane)) return false;
    for (const Triangle& t : face.triangles)
        for (const Index p : t)
            if (!on_plane(model.at(p))) return false;
    return true;
}

/// The loop round the others first.
std::vector<Loop> outermost_first(const Model& model, std::vector<Loop> loops)
{
    const auto extent = [&](const Loop& loop) {
        Eigen::AlignedBox3d box;
        for (const EdgeUse& use : loop.uses)
            for (const Index p : model[use.edge].points) box.extend(model.at(p));
        return box.diagonal().norm();
    };
    std::stable_sort(loops.begin(), loops.end(),
                     [&](const Loop& a, const Loop& b) { return extent(a) > extent(b); });
    return loops;
}

/// Places of an entity at a few shares of its parameters, which a copy of it has too.
std::vector<Vec3> probes_of(int dim, int tag)
{
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(dim, tag, low, high);
    std::vector<Vec3> places;
    for (const double f : {0.0, 0.23, 0.61, 1.0}) {
        if (dim == 1) {
            places.push_back(curve_points(tag, {low[0] + f * (high[0] - low[0])}).front());
        } else {
            const double g = 0.87 - 0.7 * f;
            places.push_back(
                surface_points(tag, {Vec2(low[0] + f * (high[0] - low[0]), low[1] + g * (high[1] - low[1]))})
                    .front());
        }
    }
    return places;
}

/// What a face or a curve is known by after it went through a file.
struct Fingerprint {
    std::vector<Vec3> probes;
    double area = 0; ///< of a face

    Fingerprint(int dim, int tag) : probes(probes_of(dim, tag))
    {
        if (dim == 2) gmsh::model::occ::getMass(dim, tag, area);
    }
    [[nodiscard]] bool is(const Fingerprint& other, double scale, double diagonal) const
    {
        for (std::size_t i = 0; i < probes.size(); ++i)
            if ((probes[i] * scale - other.probes[i]).norm() > kSame * diagonal * scale) return false;
        return std::abs(area * scale * scale - other.area) <= kSame * diagonal * diagonal * scale * scale;
    }
};

std::vector<int> tags_of(int dim)
{
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dim);
    std::vector<int> tags;
    for (const auto& entity : entities) tags.push_back(entity.second);
    return tags;
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

SolidBuilder::SolidBuilder(Session& session, const GmshModel& scratch, const OpenVolume& volume,
                           std::string workshop)
    : session_(session),
      scratch_(scratch),
      volume_(volume),
      model_(volume.model),
      workshop_(std::move(workshop))
{
    Eigen::AlignedBox3d box;
    for (const Vec3& p : model_.points) box.extend(p);
    precision_ = kPrecision * box.diagonal().norm();
}

// --- given faces ------------------------------------------------------------------------------------

/// A source's shapes come over by a file, which keeps them to the bit and edges shared.
SolidBuilder::Imported SolidBuilder::import_source(const CadSource& source, const Wanted& wanted)
{
    const std::string file = workshop_ + "/source.brep";
    std::map<int, Fingerprint> faces, curves;
    source.model->activate(session_);
    session_.run([&] {
        // Gmsh's own kernel has faces too, which no CAD file can hold.
        gmsh::vectorpair shapes;
        gmsh::model::occ::getEntities(shapes);
        const std::set<std::pair<int, int>> there(shapes.begin(), shapes.end());
        for (const int tag : wanted.faces)
            if (there.contains({2, tag})) faces.try_emplace(tag, 2, tag);
        for (const int tag : wanted.curves)
            if (there.contains({1, tag})) curves.try_emplace(tag, 1, tag);
        if (!faces.empty()) gmsh::write(file);
    });
    scratch_.activate(session_);
    if (faces.empty()) return {};
    return session_.run([&] {
        set_plain_import(session_, source.scale);
        const std::vector<int> faces_before = tags_of(2), curves_before = tags_of(1);
        gmsh::vectorpair all;
        gmsh::model::occ::importShapes(file, all, false, "brep");
        gmsh::model::occ::synchronize();
        const auto match = [&](int dim, const std::map<int, Fingerprint>& prints,
                               const std::vector<int>& before) {
            std::vector<int> fresh = tags_of(dim);
            std::erase_if(fresh,
                          [&](int tag) { return std::binary_search(before.begin(), before.end(), tag); });
            const int shift = before.empty() ? 0 : before.back();
            std::map<int, int> found;
            for (const auto& [tag, print] : prints) {
                const auto is = [&, &known = print](int candidate) {
                    return std::binary_search(fresh.begin(), fresh.end(), candidate) &&
                           known.is(Fingerprint(dim, candidate), source.scale, source.diagonal);
                };
                // As a rule they come in the same order.
                const auto place = is(tag + shift) ? std::find(fresh.begin(), fresh.end(), tag + shift)
                                                   : std::find_if(fresh.begin(), fresh.end(), is);
                if (place == fresh.end())
                    throw BackendError(
                        "cad.lost", (dim == 2 ? "face " : "curve ") + std::to_string(tag) + " of " +
                                        source.path +
                                        " got lost on its way through a file; repair it in the CAD system");
                found[tag] = *place;
            }
            return found;
        };
        return Imported{match(2, faces, faces_before), match(1, curves, curves_before)};
    });
}

void SolidBuilder::import_sources()
{
    std::map<const CadSource*, Wanted> wanted;
    std::vector<const CadSource*> order; // of the faces, not of addresses
    for (const Face& face : model_.faces) {
        const auto* surface = dynamic_cast<const CadSurface*>(face.surface.get());
        if (surface == nullptr) continue;
        const auto [place, fresh] = wanted.try_emplace(surface->source().get());
        place->second.faces.push_back(surface->tag());
        if (fresh) order.push_back(place->first);
    }
    for (const Edge& edge : model_.edges) {
        const auto* curve = dynamic_cast<const CadCurve*>(edge.curve.get());
        if (curve == nullptr) continue;
        const auto place = wanted.find(curve->source().get());
        if (place != wanted.end()) place->second.curves.push_back(curve->tag());
    }
    for (const CadSource* source : order) imported_[source] = import_source(*source, wanted[source]);
}

/// The face's surface in the scratch model; 0 where it has facets alone.
int SolidBuilder::exact_face(const Face& face) const
{
    const auto* surface = dynamic_cast<const CadSurface*>(face.surface.get());
    if (surface == nullptr) return 0;
    const auto& faces = imported_.at(surface->source().get()).faces;
    const auto found = faces.find(surface->tag());
    return found != faces.end() ? found->second : 0;
}

// --- edges ------------------------------------------------------------------------------------------

int SolidBuilder::point(Index p)
{
    const auto [place, fresh] = points_.try_emplace(p, 0);
    if (fresh)
        place->second = gmsh::model::occ::addPoint(model_.at(p).x(), model_.at(p).y(), model_.at(p).z());
    return place->second;
}

/// The curve an edge is all of, in the scratch model; 0 where there is none.
int SolidBuilder::exact_curve(const Edge& edge) const
{
    const auto* curve = dynamic_cast<const CadCurve*>(edge.curve.get());
    if (curve == nullptr || edge.params.size() < 2) return 0;
    const auto source = imported_.find(curve->source().get());
    if (source == imported_.end()) return 0;
    const auto tag = source->second.curves.find(curve->tag());
    if (tag == source->second.curves.end()) return 0;
    // Scaling may have changed the curve's parameters, so ends and middle tell.
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(1, tag->second, low, high);
    const std::vector<Vec3> whole = curve_points(tag->second, {low[0], (low[0] + high[0]) / 2, high[0]});
    const double first = edge.params.front(), last = edge.params.back();
    const std::array<double, 3> params{first, (first + last) / 2, last};
    std::array<Vec3, 3> own;
    curve->evaluate(params, own);
    scratch_.activate(session_); // the curve's own model has become the current one
    const auto near = [&](std::size_t a, std::size_t b) {
        return (own[a] - whole[b]).norm() <= 10 * precision_;
    };
    const bool same = near(1, 1) && ((near(0, 0) && near(2, 2)) || (near(0, 2) && near(2, 0)));
    return same ? tag->second : 0;
}

int SolidBuilder::add_curve(const SplineCurve& curve)
{
    std::vector<int> tags;
    for (const Vec3& p : curve.poles) tags.push_back(gmsh::model::occ::addPoint(p.x(), p.y(), p.z()));
    return gmsh::model::occ::addBSpline(tags, -1, curve.axis.degree, {}, curve.axis.knots,
                                        curve.axis.multiplicities);
}

std::vector<int> SolidBuilder::make_curves(EdgeId id)
{
    const Edge& edge = model_[id];
    if (const int curve = exact_curve(edge); curve > 0) return {curve};
    const EdgeShape shape(model_, id);
    scratch_.activate(session_);
    if (shape.is_straight())
        return {gmsh::model::occ::addLine(point(edge.points.front()), point(edge.points.back()))};
    if (shape.is_polyline()) {
        std::vector<int> lines;
        for (std::size_t k = 0; k + 1 < edge.points.size(); ++k)
            lines.push_back(gmsh::model::occ::addLine(point(edge.points[k]), point(edge.points[k + 1])));
        return lines;
    }
    const SplineCurve spline = approximate([&](std::span<const double> at) { return shape.at(at); },
                                           precision_);
    scratch_.activate(session_);
    return {add_curve(spline)};
}

std::vector<int> SolidBuilder::curves_of(EdgeId edge)
{
    const auto [place, fresh] = curves_.try_emplace(edge);
    if (fresh) {
        place->second = make_curves(edge);
        gmsh::model::occ::synchronize();
    }
    return place->second;
}

int SolidBuilder::wire(const Loop& loop)
{
    std::vector<int> curves;
    for (const EdgeUse& use : loop.uses) {
        const std::vector<int> own = curves_of(use.edge);
        if (use.reversed)
            curves.insert(curves.end(), own.rbegin(), own.rend());
        else
            curves.insert(curves.end(), own.begin(), own.end());
    }
    return gmsh::model::occ::addCurveLoop(curves);
}

/// Open CASCADE's booleans take away curves and points that nothing holds any more.
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

/// Holes are cut out: Gmsh's own planes with holes depend on which way the holes' curves happen to run.
int SolidBuilder::plane(FaceId id)
{
    // Without seams, which mean nothing in a plane.
    std::vector<Loop> walks;
    for (const Rim& rim : rims(model_, {id})) walks.push_back({rim.uses});
    const std::vector<Loop> loops = outermost_first(model_, std::move(walks));
    std::vector<int> parts;
    for (const Loop& loop : loops) parts.push_back(gmsh::model::occ::addPlaneSurface({wire(loop)}));
    if (parts.size() == 1) return parts.front();
    double wanted = 0;
    gmsh::vectorpair holes;
    for (const int part : parts) {
        double area = 0;
        gmsh::model::occ::getMass(2, part, area);
        wanted += part == parts.front() ? area : -area;
        if (part != parts.front()) holes.emplace_back(2, part);
    }
    gmsh::vectorpair cut;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::cut({{2, parts.front()}}, holes, cut, map);
    double area = 0;
    if (cut.size() == 1) gmsh::model::occ::getMass(2, cut.front().second, area);
    if (!(std::abs(area - wanted) <= 1e-6 * wanted))
        throw BackendError("cad.plane_failed", "a plane could not be cut out along its inner loops");
    forget_removed();
    return cut.front().second;
}

int SolidBuilder::add_surface(const SplineSurface& surface)
{
    // The points stay: to take them away again costs time with their square, and what is written is the solid
    // alone.
    std::vector<int> tags;
    for (const Vec3& p : surface.poles) tags.push_back(gmsh::model::occ::addPoint(p.x(), p.y(), p.z()));
    return gmsh::model::occ::addBSplineSurface(
        tags, static_cast<int>(surface.u.poles()), -1, surface.u.degree, surface.v.degree, {},
        surface.u.knots, surface.v.knots, surface.u.multiplicities, surface.v.multiplicities);
}

std::vector<int> SolidBuilder::patches(FaceId face, const std::vector<std::vector<EdgeUse>>& sides)
{
    const std::vector<SplineSurface> surfaces = void_patches(model_, model_[face], sides, precision_);
    scratch_.activate(session_);
    std::vector<int> tags;
    for (const SplineSurface& surface : surfaces) tags.push_back(add_surface(surface));
    return tags;
}

/// A smooth surface over the outer loop, led through points of the facets and of inner loops, which divide
/// it.
int SolidBuilder::filling(FaceId id)
{
    const Face& face = model_[id];
    const std::vector<Loop> loops = outermost_first(model_, face.loops);
    std::set<Index> taken;
    std::vector<int> leading;
    const auto lead = [&](const std::vector<Index>& points) {
        const std::size_t step = points.size() / kLeadingPoints + 1;
        for (std::size_t i = 0; i < points.size(); i += step) leading.push_back(point(points[i]));
    };
    for (std::size_t l = 0; l < loops.size(); ++l) {
        std::vector<Index> on_loop;
        for (const EdgeUse& use : loops[l].uses)
            for (const Index p : model_[use.edge].points)
                if (taken.insert(p).second) on_loop.push_back(p);
        if (l > 0) lead(on_loop);
    }
    std::vector<Index> inside;
    for (const Triangle& t : face.triangles)
        for (const Index p : t)
            if (taken.insert(p).second) inside.push_back(p);
    lead(inside);
    const int filled = gmsh::model::occ::addSurfaceFilling(wire(loops.front()), -1, leading);
    if (loops.size() == 1) return filled;

    // The inner loops are close to the surface, not on it; where they divide it they become its edges.
    gmsh::vectorpair inner, parts;
    for (std::size_t l = 1; l < loops.size(); ++l)
        for (const EdgeUse& use : loops[l].uses)
            for (const int curve : curves_of(use.edge)) inner.emplace_back(1, curve);
    std::vector<gmsh::vectorpair> map;
    session_.set("Geometry.ToleranceBoolean", kCloseBy * model_.diagonal);
    gmsh::model::occ::fragment({{2, filled}}, inner, parts, map, -1, true, false);
    session_.set("Geometry.ToleranceBoolean", 0.0);
    forget_removed();
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [dim, tag] : parts) {
        double area = 0;
        if (dim == 2) gmsh::model::occ::getMass(2, tag, area);
        const double off = std::abs(std::abs(area) - face_area(model_, id));
        if (dim != 2 || off >= least) continue;
        least = off;
        best = tag;
    }
    return best;
}

std::vector<int> SolidBuilder::make_face(FaceId id, Built& built)
{
    const Face& face = model_[id];
    if (const int exact = exact_face(face); exact > 0) return {exact};
    const bool made = face.origin == Origin::made_void;
    if (is_plane(model_, face)) {
        built.planes += made ? 1 : 0;
        return {plane(id)};
    }
    if (!made) {
        throw InvalidInput("cad.facets_alone",
                           name_of(model_, id) +
                               " is bent and has facets alone, no exact surface a CAD file could hold; "
                               "write the volume with write_facets (.stl, .msh, .obj)");
    }
    ++built.fitted;
    const auto sides = face.loops.size() == 1 ? closure::logical_sides(volume_, face.loops.front())
                                              : std::vector<std::vector<EdgeUse>>{};
    if (!sides.empty()) return patches(id, sides);
    return {filling(id)};
}

SolidBuilder::Built SolidBuilder::build(const RunContext& context)
{
    import_sources();
    Built built;
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
        check_cancelled(context);
        scratch_.activate(session_);
        std::vector<int> tags;
        try {
            tags = session_.run([&] { return make_face(FaceId(f), built); });
        } catch (const BackendError& error) {
            throw BackendError("cad.face_failed",
                               name_of(model_, FaceId(f)) + " could not be made: " + error.what());
        }
        built.faces.insert(built.faces.end(), tags.begin(), tags.end());
        if (context.progress)
            context.progress("write_cad",
                             static_cast<double>(f + 1) / static_cast<double>(model_.faces.size()));
    }
    return built;
}

} // namespace lacuna::cad
