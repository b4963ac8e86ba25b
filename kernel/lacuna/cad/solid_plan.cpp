// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/solid_plan.h>

#include <lacuna/cad/detail/edge_shape.h>
#include <lacuna/cad/detail/void_patch.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/swept_surface.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace lacuna::cad {

using namespace topology;
using namespace cad_protocol;

namespace {

/// Limit on the interpolation points of a filled surface: for each inner loop, and for the facets. The cost
/// grows with the cube of the number of points.
constexpr std::size_t kLeadingPoints = 40;

/// The surface that an edge sweeps: one spline surface, or one for each segment of a polyline.
std::vector<SplineSurfaceData> swept_patches(const geometry::SweptSurface& surface, double precision)
{
    const std::vector<double>& params = surface.params();
    const auto [low, high] = surface.heights();
    // Allow at least one interval for each row of facets. A full turn has 72 rows, and a path may have any
    // number of turns.
    const std::size_t most = std::max(kMostIntervals, surface.motion()->rows.size());
    std::vector<SplineSurfaceData> patches;
    const std::size_t step = surface.has_kinks() ? 1 : params.size() - 1;
    for (std::size_t i = 0; i + 1 < params.size(); i += step) {
        const double from = params[i], to = params[i + step];
        patches.push_back(approximate(
            [&](std::span<const double> u, std::span<const double> v) {
                std::vector<Vec2> uv;
                for (const double y : v)
                    for (const double x : u)
                        uv.emplace_back((1 - x) * from + x * to, (1 - y) * low + y * high);
                return surface.at(uv);
            },
            precision, most));
    }
    return patches;
}

bool is_plane(const Model& model, const Face& face)
{
    std::vector<std::vector<Vec3>> rims;
    for (const Loop& loop : face.loops) rims.push_back(loop_places(model, loop.uses));
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

/// Sort loops so that the outer loop comes first.
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

class Planner {
public:
    Planner(const OpenVolume& volume, const SolidSources& sources, const BeginSolidReply& found,
            const RunContext& context)
        : volume_(volume), model_(volume.model), context_(context), edge_at_(model_.edges.size(), -1)
    {
        Eigen::AlignedBox3d box;
        for (const Vec3& p : model_.points) box.extend(p);
        precision_ = kSamePlace * box.diagonal().norm();
        // The shapes that a known motion makes are exact, so that splines through them may be, too.
        motion_precision_ = kRoundoff * box.diagonal().norm();
        plan_.request.points = model_.points;
        plan_.request.diagonal = model_.diagonal;
        for (std::size_t s = 0; s < sources.order.size(); ++s) {
            Source& source = source_[sources.order[s]];
            source.number = static_cast<Index>(s);
            const BeginSolidReply::Found& own = found.sources[s];
            source.faces.insert(own.faces.begin(), own.faces.end());
            for (std::size_t c = 0; c < own.curves.size(); ++c)
                source.curves[own.curves[c]] = own.curve_points[c];
        }
    }

    SolidPlan run()
    {
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            check_cancelled(context_);
            try {
                SolidFace made = plan(FaceId(f));
                // A CAD face that was divided into several faces is written once.
                if (made.kind != SolidFace::exact || written_.insert({made.source, made.face}).second)
                    plan_.request.faces.push_back(std::move(made));
            } catch (const BackendError& error) {
                const Message message("cad.face_failed", "{} cannot be written as a CAD face: {}",
                                      entity_of(model_, FaceId(f)), error.message().parts());
                throw BackendError(error.message().remedy().empty()
                                       ? message.remedy("write the facets with write_facets")
                                       : message);
            }
        }
        return std::move(plan_);
    }

private:
    struct Source {
        Index number = 0;
        std::set<std::int32_t> faces;
        std::map<std::int32_t, std::array<Vec3, 3>> curves;
    };

    // --- edges ------------------------------------------------------------------------------------------

    /// Make the edge an exact curve if it covers the whole curve of the source.
    bool exact_curve(const Edge& edge, SolidEdge& made) const
    {
        const auto* curve = dynamic_cast<const CadCurve*>(edge.curve.get());
        if (curve == nullptr || edge.params.size() < 2) return false;
        const auto source = source_.find(curve->source.get());
        if (source == source_.end()) return false;
        const auto known = source->second.curves.find(curve->tag);
        if (known == source->second.curves.end()) return false;
        // Scaling may have changed the parameters of the curve, so compare its end points and middle.
        const double first = edge.params.front(), last = edge.params.back();
        const std::array<double, 3> params{first, (first + last) / 2, last};
        std::array<Vec3, 3> own;
        curve->evaluate(params, own, context_);
        const auto near = [&](std::size_t a, std::size_t b) {
            return (own[a] - known->second[b]).norm() <= 10 * precision_;
        };
        if (!near(1, 1) || !((near(0, 0) && near(2, 2)) || (near(0, 2) && near(2, 0)))) return false;
        made.kind = SolidEdge::exact;
        made.source = source->second.number;
        made.curve = curve->tag;
        return true;
    }

    SolidEdge make_edge(EdgeId id) const
    {
        const Edge& edge = model_[id];
        SolidEdge made;
        if (exact_curve(edge, made)) return made;
        const EdgeShape shape(model_, id);
        if (shape.is_straight()) {
            made.points = {edge.points.front(), edge.points.back()};
        } else if (shape.is_polyline()) {
            made.points = edge.points;
        } else {
            made.kind = SolidEdge::spline;
            const double precision = edge.origin == Origin::made_void && edge.curve ? motion_precision_
                                                                                    : precision_;
            made.curve_data = approximate([&](std::span<const double> at) { return shape.at(at); }, precision,
                                          std::max(kMostIntervals, edge.points.size()));
        }
        return made;
    }

    std::vector<std::array<Index, 2>> wire(const Loop& loop)
    {
        std::vector<std::array<Index, 2>> uses;
        for (const EdgeUse& use : loop.uses) {
            Index& at = edge_at_[use.edge.index()];
            if (at < 0) {
                plan_.request.edges.push_back(make_edge(use.edge));
                at = static_cast<Index>(plan_.request.edges.size() - 1);
            }
            uses.push_back({at, use.reversed ? 1 : 0});
        }
        return uses;
    }

    // --- faces ------------------------------------------------------------------------------------------

    /// A smooth surface over the outer loop, through points of the facets and of the inner loops. The inner
    /// loops then trim the surface.
    SolidFace filling(FaceId id, SolidFace made)
    {
        made.kind = SolidFace::filling;
        made.area = face_area(model_, id);
        const Face& face = model_[id];
        const std::vector<Loop> loops = outermost_first(model_, face.loops);
        std::set<Index> taken;
        const auto lead = [&](const std::vector<Index>& points) {
            const std::size_t step = points.size() / kLeadingPoints + 1;
            for (std::size_t i = 0; i < points.size(); i += step) made.leading.push_back(points[i]);
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
        for (const Loop& loop : loops) made.loops.push_back(wire(loop));
        return made;
    }

    SolidFace plan(FaceId id)
    {
        const Face& face = model_[id];
        SolidFace made;
        made.entity = entity_of(model_, id);
        const auto* surface = dynamic_cast<const CadSurface*>(face.surface.get());
        const Source* source = surface == nullptr ? nullptr : &source_.at(surface->source.get());
        if (source != nullptr && source->faces.contains(surface->tag)) {
            made.kind = SolidFace::exact;
            made.source = source->number;
            made.face = surface->tag;
            return made;
        }
        const bool is_void = face.origin == Origin::made_void;
        if (is_plane(model_, face)) {
            plan_.planes += is_void ? 1 : 0;
            // Seams are dropped: they have no meaning in a plane.
            for (const Loop& loop : outermost_first(model_, border_loops(model_, id)))
                made.loops.push_back(wire(loop));
            return made;
        }
        if (!is_void) {
            throw InvalidInput(Message("cad.facets_alone",
                                       "{} is curved and has only facets, no exact surface for a CAD file",
                                       made.entity)
                                   .remedy("write the volume with write_facets (.stl, .msh, .obj)"));
        }
        ++plan_.fitted;
        if (const auto* swept = dynamic_cast<const geometry::SweptSurface*>(face.surface.get())) {
            made.kind = SolidFace::patches;
            made.surfaces = swept_patches(*swept, motion_precision_);
            return made;
        }
        const auto sides = face.loops.size() == 1 ? closure::logical_sides(volume_, face.loops.front())
                                                  : std::vector<std::vector<EdgeUse>>{};
        if (sides.empty()) return filling(id, made);
        made.kind = SolidFace::patches;
        made.surfaces = void_patches(model_, face, sides, precision_);
        return made;
    }

    const OpenVolume& volume_;
    const Model& model_;
    const RunContext& context_;
    double precision_ = 0, motion_precision_ = 0;
    std::map<const CadSource*, Source> source_;
    std::set<std::pair<Index, std::int32_t>> written_; ///< sources and faces in the plan
    std::vector<Index> edge_at_; ///< position in the plan of each edge of the model; -1: not added yet
    SolidPlan plan_;
};

/// Load all sources into one process.
void hold_in_one(SolidSources& sources, const RunContext& context)
{
    if (sources.order.empty()) return;
    sources.worker = sources.order.front()->worker();
    const bool together = std::all_of(
        sources.order.begin(), sources.order.end(),
        [&](const CadSource* source) { return source->worker() == sources.worker; });
    if (!sources.worker || !together)
        sources.worker = Worker::current(&context, sources.order.front()->path());
    for (std::size_t s = 0; s < sources.order.size(); ++s)
        sources.wanted[s].model = sources.order[s]->handle_in(sources.worker, context);
}

} // namespace

SolidSources sources_of(const Model& model, const RunContext& context)
{
    SolidSources sources;
    const auto place_of = [&](const CadSource* source) {
        return static_cast<std::size_t>(std::find(sources.order.begin(), sources.order.end(), source) -
                                        sources.order.begin());
    };
    for (const Face& face : model.faces) {
        const auto* surface = dynamic_cast<const CadSurface*>(face.surface.get());
        if (surface == nullptr) continue;
        const CadSource* source = surface->source.get();
        const std::size_t place = place_of(source);
        if (place == sources.order.size()) {
            sources.order.push_back(source);
            sources.wanted.emplace_back();
        }
        sources.wanted[place].faces.push_back(surface->tag);
    }
    for (const Edge& edge : model.edges) {
        const auto* curve = dynamic_cast<const CadCurve*>(edge.curve.get());
        if (curve == nullptr) continue;
        const std::size_t place = place_of(curve->source.get());
        if (place < sources.order.size()) sources.wanted[place].curves.push_back(curve->tag);
    }
    hold_in_one(sources, context);
    return sources;
}

SolidPlan plan_solid(const OpenVolume& volume, const SolidSources& sources, const BeginSolidReply& found,
                     const RunContext& context)
{
    return Planner(volume, sources, found, context).run();
}

} // namespace lacuna::cad
