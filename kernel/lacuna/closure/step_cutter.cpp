// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/step_cutter.h>

#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// A rim projected onto the opposite end.
struct Imprinted {
    std::size_t part = 0;      ///< index of the part of the end whose rim was projected
    FaceId target;             ///< the face of the opposite end on which the projected rim lies
    std::vector<Index> points; ///< points of the model; the first is not repeated at the end
    std::vector<Vec2> flat;    ///< the same points, projected along the sweep
};

class StepCutter {
public:
    StepCutter(const OpenVolume& volume, Role stepped, Steps steps, const RunContext& context)
        : volume_(volume),
          parted_{.volume = volume, .stacked = true},
          builder_(volume.model),
          stepped_(stepped),
          other_(stepped == Role::source ? Role::target : Role::source),
          context_(context),
          steps_(std::move(steps))
    {
    }

    std::vector<StepPiece> run()
    {
        across_.normal = -area_vector_of(volume_.model, volume_.faces(stepped_)).normalized();
        across_.u = across_.normal.unitOrthogonal();
        across_.v = across_.normal.cross(across_.u);
        if (!follow_mesh()) lines_.clear();
        for (const Hanging& hanging : steps_.closed) hang(hanging);
        for (const FaceId face : volume_.faces(other_))
            lines_.empty() ? split(face) : split_along_lines(face);
        builder_.build_loops();
        parted_.volume.model = std::move(builder_).finish();
        return pieces_of(parted_, {"a face below the rim of a step"}, context_);
    }

private:
    const geometry::FacetTree& opposite_tree()
    {
        if (tree_) return *tree_;
        std::vector<Triangle> triangles;
        for (const FaceId face : volume_.faces(other_)) {
            for (std::size_t t = 0; t < volume_.model[face].triangles.size(); ++t) {
                triangles.push_back(volume_.model[face].triangles[t]);
                facet_.emplace_back(face, t);
            }
        }
        return tree_.emplace(volume_.model.points, triangles);
    }

    struct Hit {
        Vec3 place;
        FaceId face;
        Vec2 uv = Vec2::Zero();
        Index node = -1; ///< the corner of the facet that is nearer than `kFollowsFace` of its sides
    };
    /// The place where the line from a point along the sweep first meets the opposite end, or the face `only`
    /// of that end.
    std::optional<Hit> above(const Vec3& p, FaceId only = {})
    {
        geometry::FacetTree::RayHit hit;
        opposite_tree().all_along(p, across_.normal, [&](const geometry::FacetTree::RayHit& other) {
            if ((!only.valid() || facet_[index(other.triangle)].first == only) && other.t < hit.t)
                hit = other;
            return true;
        });
        if (hit.triangle < 0) return std::nullopt;
        const auto& [face, t] = facet_[index(hit.triangle)];
        Hit found{Vec3::Zero(), face};
        for (std::size_t k = 0; k < 3; ++k) {
            found.place += hit.barycentric[static_cast<int>(k)] *
                           volume_.model.at(volume_.model[face].triangles[t][k]);
            if (!volume_.model[face].uv.empty())
                found.uv += hit.barycentric[static_cast<int>(k)] * volume_.model[face].uv[t][k];
            if (hit.barycentric[static_cast<int>(k)] > 1 - kFollowsFace)
                found.node = volume_.model[face].triangles[t][k];
        }
        return found;
    }

    /// If the images of all rims run along sides of the given mesh of the opposite end, away from its border,
    /// take these sides (`lines_`) and their nodes (`node_of_`) instead: the mesh can then be kept.
    bool follow_mesh()
    {
        const Model& model = volume_.model;
        std::set<std::uint64_t> sides;
        std::set<Index> taken; // points on the border, and images
        for (const FaceId face : volume_.faces(other_)) {
            if (!model[face].keeps_nodes || !has_quads_all_over(model[face])) return false;
            for (const Quad& quad : model[face].given_quads)
                for (std::size_t k = 0; k < 4; ++k) sides.insert(edge_key(quad[k], quad[(k + 1) % 4]));
            for (const Loop& loop : border_loops(model, face))
                for (const Index p : loop_points(model, loop.uses)) taken.insert(p);
        }
        for (const Hanging& hanging : steps_.closed) {
            const std::vector<Index> rim = loop_points(model, hanging.rim.uses);
            for (const Index p : rim) {
                const std::optional<Hit> hit = above(model.at(p));
                if (!hit || !taken.insert(hit->node).second) return false;
                node_of_.emplace(p, hit->node);
            }
            for (std::size_t i = 0; i < rim.size(); ++i) {
                const std::uint64_t line = edge_key(node_of_[rim[i]], node_of_[rim[(i + 1) % rim.size()]]);
                if (!sides.contains(line)) return false;
                lines_.insert(line);
            }
        }
        return true;
    }

    /// Split a face of the opposite end along `lines_`. Its parts keep their quads.
    void split_along_lines(FaceId id)
    {
        std::vector<Face> parts = parts_along(volume_.model[id], lines_, volume_.model.points.size());
        builder_[id] = std::move(parts.front());
        std::move(parts.begin() + 1, parts.end(), std::back_inserter(builder_.faces));
        parted_.volume.role.resize(parted_.volume.role.size() + parts.size() - 1, other_);
    }

    /// Extrude void faces from a rim to the opposite end.
    void hang(const Hanging& hanging)
    {
        const Rim& rim = hanging.rim;
        check_cancelled(context_);
        Imprinted image;
        image.part = hanging.part;
        std::map<Index, Index> above_of; // by point of the rim: its image on the opposite end
        const auto lift = [&](Index p) {
            if (!lines_.empty()) return node_of_.at(p);
            const auto known = above_of.find(p);
            if (known != above_of.end()) return known->second;
            const Vec3 from = builder_.at(p);
            const std::optional<Hit> hit = above(from);
            if (!hit || (image.target.valid() && hit->face != image.target)) {
                const NamedEntity step = entity_of(builder_, steps_.parts[hanging.part].front());
                if (!hit)
                    throw NotSweepable(
                        Message(
                            "closure.steps",
                            "the rim of the step at {} is not everywhere opposite to a face of the other end",
                            step)
                            .remedy("cut the volume with cut{{ plane = … }}"));
                throw NotSweepable(
                    Message("closure.steps", "the rim of the step at {} is opposite to two faces, {} and {}",
                            step, entity_of(builder_, image.target), entity_of(builder_, hit->face))
                        .remedy("give the opposite end there as one face"));
            }
            image.target = hit->face;
            const auto made = static_cast<Index>(builder_.points.size());
            builder_.points.push_back(hit->place);
            uv_.emplace(made, hit->uv);
            above_of.emplace(p, made);
            return made;
        };
        std::map<VertexId, VertexId> vertex_above;
        std::set<VertexId> lined;
        const auto vertex = [&](VertexId v) {
            const auto known = vertex_above.find(v);
            if (known != vertex_above.end()) return known->second;
            return vertex_above.emplace(v, builder_.add_void_vertex(lift(builder_[v].point))).first->second;
        };
        const auto side_line = [&](VertexId v) {
            if (!lined.insert(v).second) return;
            const VertexId above = vertex(v);
            builder_.add_void_edge(v, above, {builder_[v].point, builder_[above].point});
        };
        for (const EdgeUse& use : rim.uses) {
            const std::vector<Index> low = use_points(builder_, use);
            std::vector<Index> high;
            for (const Index p : low) high.push_back(lift(p));
            const VertexId from = use_from(builder_, use), to = use_to(builder_, use);
            // From a rim that is one closed edge, a ring face with two loops is extruded; from any other rim,
            // one face per edge.
            const bool closed = rim.uses.size() == 1;
            const EdgeId top = builder_.add_void_edge(vertex(from), vertex(to), high);
            if (!closed) {
                side_line(from);
                side_line(to);
            }
            parted_.partitions.push_back({builder_.add_void_face(Geometry::transfinite), {use, {top, true}}});
            parted_.volume.role.push_back(Role::wall);
            Face& face = builder_.faces.back();
            for (std::size_t i = 0; i + 1 < low.size(); ++i) {
                face.triangles.push_back({low[i], low[i + 1], high[i + 1]});
                face.triangles.push_back({low[i], high[i + 1], high[i]});
            }
            image.points.insert(image.points.end(), high.begin(), high.end() - 1);
        }
        image.flat = flat_places(across_, places_at(builder_, image.points));
        images_.push_back(std::move(image));
    }

    /// Split a face of the opposite end along the rims projected onto it.
    void split(FaceId id)
    {
        std::vector<Imprinted*> own;
        for (Imprinted& image : images_)
            if (image.target == id) own.push_back(&image);
        if (own.empty()) return;
        if (builder_[id].keeps_nodes) {
            throw NotSweepable(
                Message("topology.splits_mesh", "the outline of the step at {} crosses the given mesh of {}",
                        entity_of(builder_, steps_.parts[own.front()->part].front()), entity_of(builder_, id))
                    .remedy("load with keep_mesh = false, or cut the volume along lines of "
                            "the mesh with cut{{ plane = … }}"));
        }
        // The loops of the face, then the projected rims. Each region lies inside one loop and outside the
        // loops directly within this loop.
        struct Ring {
            std::vector<Index> points;
            std::vector<Vec2> flat;
        };
        std::vector<Ring> rings;
        for (const Loop& loop : border_loops(builder_, id)) {
            std::vector<Index> points = loop_points(builder_, loop.uses);
            std::vector<Vec2> flat = flat_places(across_, places_at(builder_, points));
            rings.push_back({std::move(points), std::move(flat)});
        }
        const std::size_t given = rings.size();
        for (const Imprinted* image : own) rings.push_back({image->points, image->flat});
        const auto depth_in = [&](std::size_t inner, std::size_t outer) {
            return inner != outer && geometry::encloses(rings[outer].flat, rings[inner].flat);
        };
        std::vector<std::size_t> parents(rings.size(), rings.size());
        for (std::size_t i = 0; i < rings.size(); ++i) {
            std::size_t& best = parents[i];
            for (std::size_t o = 0; o < rings.size(); ++o)
                if (depth_in(i, o) && (best == rings.size() || depth_in(o, best))) best = o;
        }

        const Face before = builder_[id];
        const Vec3 area = face_area_vector(builder_, id);
        const bool turned = area.dot(across_.normal) < 0;
        bool first = true;
        for (std::size_t outer = 0; outer < rings.size(); ++outer) {
            // The inside of a hole of the face is not a region.
            if (outer < given && parents[outer] != rings.size()) continue;
            Outline outline;
            outline.add_loop(rings[outer].flat, rings[outer].points);
            for (std::size_t i = 0; i < rings.size(); ++i)
                if (parents[i] == outer) outline.add_loop(rings[i].flat, rings[i].points);
            const auto made = attempt<InvalidInput>([&] {
                return geometry::triangulate(outline.flat, outline.loops,
                                             {.interior_points = before.kind != "plane"}, context_);
            });
            if (!made) { // its error names loops, not faces
                throw NotSweepable(Message("closure.steps",
                                           "{} cannot be split along the projected outlines of the steps",
                                           entity_of(builder_, id))
                                       .remedy("cut the volume with cut{{ plane = … }}")
                                       .attempt(*made.why));
            }
            Face face = before;
            face.triangles.clear();
            face.uv.clear();
            face.given_quads.clear();
            const auto first_made = static_cast<Index>(builder_.points.size());
            VoidFilling filling = filling_of(builder_, outline, *made, [&](std::size_t p) {
                const std::optional<Hit> hit = above(geometry::from_plane(across_, made->points[p], lowest()),
                                                     id);
                if (!hit)
                    throw NotSweepable(Message("closure.steps",
                                               "{} folds back along the sweep direction and cannot be cut",
                                               entity_of(builder_, id))
                                           .remedy("cut the volume with cut{{ plane = … }}"));
                uv_.insert_or_assign(first_made + static_cast<Index>(p - outline.flat.size()), hit->uv);
                return hit->place;
            });
            builder_.points.insert(builder_.points.end(), filling.points.begin(), filling.points.end());
            face.triangles = std::move(filling.triangles);
            if (turned)
                for (Triangle& t : face.triangles) std::swap(t[1], t[2]);
            if (before.surface) set_uv(before, face);
            if (first) {
                builder_[id] = std::move(face);
            } else {
                builder_.faces.push_back(std::move(face));
                parted_.volume.role.push_back(other_);
            }
            first = false;
        }
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (parents[given + i] == rings.size())
                throw NotSweepable(Message("closure.steps",
                                           "the rim of the step at {}, projected along the sweep, leaves {}",
                                           entity_of(builder_, steps_.parts[own[i]->part].front()),
                                           entity_of(builder_, id))
                                       .remedy("cut the volume with cut{{ plane = … }}"));
        }
    }

    /// A height along the sweep below the whole volume.
    [[nodiscard]] double lowest() const
    {
        double least = kInfinity;
        for (const Vec3& p : volume_.model.points) least = std::min(least, p.dot(across_.normal));
        return least - volume_.model.diagonal;
    }

    /// Set the surface parameters of the facets' corners. Projected points get the parameters found by
    /// projection; points of the face's loops keep those of the old facets.
    void set_uv(const Face& before, Face& face) const
    {
        std::map<Index, Vec2> known(uv_.begin(), uv_.end());
        for (std::size_t t = 0; t < before.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) known.emplace(before.triangles[t][k], before.uv[t][k]);
        }
        for (const Triangle& t : face.triangles)
            face.uv.push_back({known.at(t[0]), known.at(t[1]), known.at(t[2])});
    }

    const OpenVolume& volume_;
    PartedVolume parted_; ///< holds the roles; its model is set from `builder_` at the end
    ModelBuilder builder_;
    Role stepped_, other_;
    const RunContext& context_;
    Steps steps_;            ///< steps of the stepped end
    geometry::Plane across_; ///< plane across the sweep; its normal is the direction to the other end
    std::vector<Imprinted> images_;
    std::map<Index, Index> node_of_; ///< by point of a rim: the node of the opposite mesh that is its image
    std::unordered_set<std::uint64_t> lines_; ///< sides of the opposite mesh that are images of the rims
    /// Surface parameters of points projected onto the opposite end.
    std::map<Index, Vec2> uv_;
    std::optional<geometry::FacetTree> tree_;           ///< facets of the original opposite end
    std::vector<std::pair<FaceId, std::size_t>> facet_; ///< by triangle of the tree: its face, and its index
                                                        ///< among the face's triangles
};

} // namespace

std::vector<StepPiece> cut_below_rims(const OpenVolume& volume, Role stepped, Steps steps,
                                      const RunContext& context)
{
    return StepCutter(volume, stepped, std::move(steps), context).run();
}

} // namespace lacuna::closure
