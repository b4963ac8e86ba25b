// SPDX-License-Identifier: MIT
#include <lacuna/closure/steps.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/geometry/predicates.h>
#include <lacuna/geometry/triangulate.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// How many facets of a target's part say which part of the source it lies over.
constexpr std::size_t kVotes = 50;

/// Walls that join two parts of the stepped end.
struct Riser {
    std::size_t low = 0, high = 0; ///< parts of the end, the higher one nearer to the other end
    std::vector<FaceId> walls;
    std::vector<Rim> rims; ///< closed walks along the upper part's edges at these walls
};

/// A rim laid onto the opposite end.
struct Imprinted {
    std::size_t riser = 0;
    FaceId target;             ///< the face it lies on
    std::vector<Index> points; ///< of the model, the first not repeated
    std::vector<Vec2> flat;    ///< the same seen along the sweep
    std::vector<FaceId> curtain;
};

class StepCutter {
public:
    StepCutter(const OpenVolume& volume, Role stepped, const RunContext& context)
        : volume_(volume),
          model_(volume.model),
          stepped_(stepped),
          other_(stepped == Role::source ? Role::target : Role::source),
          context_(context)
    {
    }

    std::vector<StepPiece> run()
    {
        ends_ = connected_parts(model_, volume_.faces(stepped_));
        if (volume_.faces(other_).empty())
            refuse("the steps at " + name_of(model_, ends_[1].front()) +
                   " are cut towards the opposite end, which is missing; give its face");
        Vec3 area = Vec3::Zero();
        for (const FaceId face : volume_.faces(stepped_)) area += face_area_vector(model_, face);
        along_ = -area.normalized();
        right_ = along_.unitOrthogonal();
        up_ = along_.cross(right_);
        find_risers();
        for (std::size_t r = 0; r < risers_.size(); ++r) hang(r);
        for (const FaceId face : volume_.faces(other_)) split(face);
        build_loops(model_);
        return pieces();
    }

private:
    [[noreturn]] void refuse(const std::string& why) const { throw NotSweepable("closure.steps", why); }

    [[nodiscard]] Vec2 flat(const Vec3& p) const { return {p.dot(right_), p.dot(up_)}; }

    void find_risers()
    {
        const std::vector<std::vector<FaceUse>> uses = edge_uses(model_);
        std::vector<std::size_t> part_of(model_.faces.size(), ends_.size());
        for (std::size_t p = 0; p < ends_.size(); ++p) {
            for (const FaceId face : ends_[p]) part_of[face.index()] = p;
        }
        for (const std::vector<FaceId>& walls : connected_parts(model_, volume_.faces(Role::wall))) {
            std::set<std::size_t> touched;
            FaceId opposite;
            for (const FaceId wall : walls) {
                for (const Loop& loop : model_[wall].loops) {
                    for (const EdgeUse& use : loop.uses) {
                        for (const FaceUse& user : uses[use.edge.index()]) {
                            if (part_of[user.face.index()] < ends_.size())
                                touched.insert(part_of[user.face.index()]);
                            if (volume_.role[user.face.index()] == other_) opposite = user.face;
                        }
                    }
                }
            }
            if (touched.size() < 2) {
                other_walls_.emplace_back(walls, touched.empty() ? ends_.size() : *touched.begin());
                continue;
            }
            if (touched.size() > 2 || opposite.valid()) {
                refuse("the walls round the step at " + name_of(model_, ends_[*touched.rbegin()].front()) +
                       (opposite.valid() ? " go on to " + name_of(model_, opposite)
                                         : " join " + std::to_string(touched.size()) + " parts of the end") +
                       ", so no face hangs from a closed rim there");
            }
            add_riser(walls, touched, uses, part_of);
        }
    }

    void add_riser(const std::vector<FaceId>& walls, const std::set<std::size_t>& parts,
                   const std::vector<std::vector<FaceUse>>& uses, const std::vector<std::size_t>& part_of)
    {
        std::map<std::size_t, std::set<EdgeId>> rim;
        std::map<std::size_t, std::pair<double, std::size_t>> height;
        for (const FaceId wall : walls) {
            for (const Loop& loop : model_[wall].loops) {
                for (const EdgeUse& use : loop.uses) {
                    for (const FaceUse& user : uses[use.edge.index()]) {
                        const std::size_t part = part_of[user.face.index()];
                        if (part == ends_.size()) continue;
                        rim[part].insert(use.edge);
                        for (const Index p : model_[use.edge].points) {
                            height[part].first += model_.at(p).dot(along_);
                            ++height[part].second;
                        }
                    }
                }
            }
        }
        const auto mean = [&](std::size_t p) {
            return height.at(p).first / static_cast<double>(height.at(p).second);
        };
        Riser riser{*parts.begin(), *parts.rbegin(), walls, {}};
        if (mean(riser.low) > mean(riser.high)) std::swap(riser.low, riser.high);
        for (Rim& walk : topology::rims(model_, ends_[riser.high])) {
            const auto at_riser = std::ranges::count_if(
                walk.uses, [&](const EdgeUse& use) { return rim.at(riser.high).contains(use.edge); });
            if (at_riser == 0) continue;
            if (at_riser != static_cast<long>(walk.uses.size())) {
                refuse("the rim of the step at " + name_of(model_, ends_[riser.high].front()) +
                       " meets other walls too, so no face hangs from a closed rim there");
            }
            riser.rims.push_back(std::move(walk));
        }
        risers_.push_back(std::move(riser));
    }

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
    };
    /// Where the line through a point along the sweep meets the opposite end.
    std::optional<Hit> above(const Vec3& p)
    {
        const auto hit = opposite_tree().first_along(p, along_);
        if (hit.triangle < 0) return std::nullopt;
        const auto& [face, t] = facet_[index(hit.triangle)];
        Hit found{Vec3::Zero(), face};
        for (std::size_t k = 0; k < 3; ++k) {
            found.place += hit.barycentric[static_cast<int>(k)] *
                           volume_.model.at(volume_.model[face].triangles[t][k]);
            if (!volume_.model[face].uv.empty())
                found.uv += hit.barycentric[static_cast<int>(k)] * volume_.model[face].uv[t][k];
        }
        return found;
    }

    /// Faces from the riser's upper rims to the opposite end.
    void hang(std::size_t r)
    {
        for (const Rim& rim : risers_[r].rims) {
            check_cancelled(context_);
            Imprinted image;
            image.riser = r;
            std::map<Index, Index> above_of; // of each point of the rim
            const auto lift = [&](Index p) {
                const auto known = above_of.find(p);
                if (known != above_of.end()) return known->second;
                const Vec3 from = model_.at(p);
                const std::optional<Hit> hit = above(from);
                if (!hit || (image.target.valid() && hit->face != image.target)) {
                    refuse("the rim of the step at " + name_of(model_, ends_[risers_[r].high].front()) +
                           (hit ? " lies below " + name_of(model_, image.target) + " and " +
                                      name_of(model_, hit->face) + ": give the opposite end there as one face"
                                : " does not lie below the opposite end everywhere"));
                }
                image.target = hit->face;
                const auto made = static_cast<Index>(model_.points.size());
                model_.points.push_back(hit->place);
                uv_.emplace(made, hit->uv);
                above_of.emplace(p, made);
                return made;
            };
            std::map<VertexId, VertexId> vertex_above;
            std::map<VertexId, EdgeId> line;
            const auto vertex = [&](VertexId v) {
                const auto known = vertex_above.find(v);
                if (known != vertex_above.end()) return known->second;
                return vertex_above.emplace(v, add_void_vertex(model_, lift(model_[v].point))).first->second;
            };
            const auto side_line = [&](VertexId v) {
                if (line.contains(v)) return;
                const VertexId top = vertex(v);
                line.emplace(v, add_void_edge(model_, v, top, {model_[v].point, model_[top].point}));
            };
            for (const EdgeUse& use : rim.uses) {
                const std::vector<Index> low = use_points(model_, use);
                std::vector<Index> high;
                for (const Index p : low) high.push_back(lift(p));
                const VertexId from = use_from(model_, use), to = use_to(model_, use);
                // A closed rim hangs as a ring of two loops, others as one face a side.
                const bool closed = rim.uses.size() == 1;
                add_void_edge(model_, vertex(from), vertex(to), high);
                if (!closed) {
                    side_line(from);
                    side_line(to);
                }
                image.curtain.push_back(add_void_face(model_, Geometry::transfinite));
                Face& face = model_.faces.back();
                for (std::size_t i = 0; i + 1 < low.size(); ++i) {
                    face.triangles.push_back({low[i], low[i + 1], high[i + 1]});
                    face.triangles.push_back({low[i], high[i + 1], high[i]});
                }
                image.points.insert(image.points.end(), high.begin(), high.end() - 1);
            }
            for (const Index p : image.points) image.flat.push_back(flat(model_.at(p)));
            images_.push_back(std::move(image));
        }
    }

    /// Cut a face of the opposite end along the rims laid onto it.
    void split(FaceId id)
    {
        std::vector<const Imprinted*> own;
        for (const Imprinted& image : images_)
            if (image.target == id) own.push_back(&image);
        if (own.empty()) {
            regions_.push_back(id);
            return;
        }
        // All loops, the face's own first; each region lies within one and outside those right within it.
        struct Ring {
            std::vector<Index> points;
            std::vector<Vec2> flat;
        };
        std::vector<Ring> rings;
        for (const Loop& loop : border_loops(model_, id)) {
            Ring& ring = rings.emplace_back();
            for (const EdgeUse& use : loop.uses) {
                const std::vector<Index> points = use_points(model_, use);
                ring.points.insert(ring.points.end(), points.begin(), points.end() - 1);
            }
            for (const Index p : ring.points) ring.flat.push_back(flat(model_.at(p)));
        }
        const std::size_t given = rings.size();
        for (const Imprinted* image : own) rings.push_back({image->points, image->flat});
        const auto depth_in = [&](std::size_t inner, std::size_t outer) {
            return inner != outer && geometry::lies_inside(rings[outer].flat, rings[inner].flat.front());
        };
        const auto parent = [&](std::size_t ring) {
            std::size_t best = rings.size();
            for (std::size_t o = 0; o < rings.size(); ++o) {
                if (!depth_in(ring, o)) continue;
                if (best == rings.size() || depth_in(o, best)) best = o;
            }
            return best;
        };
        std::vector<std::size_t> parents;
        for (std::size_t i = 0; i < rings.size(); ++i) parents.push_back(parent(i));

        const Face before = model_[id];
        const Vec3 area = face_area_vector(model_, id);
        const bool turned = area.dot(along_) < 0;
        bool first = true;
        for (std::size_t outer = 0; outer < rings.size(); ++outer) {
            // A hole of the face bounds no region of its own.
            if (outer < given && parents[outer] != rings.size()) continue;
            std::vector<std::vector<Index>> loops;
            std::vector<Vec2> flat_points;
            std::vector<Index> points;
            const auto add = [&](const Ring& ring) {
                std::vector<Index>& loop = loops.emplace_back();
                for (std::size_t i = 0; i < ring.points.size(); ++i) {
                    loop.push_back(static_cast<Index>(points.size()));
                    points.push_back(ring.points[i]);
                    flat_points.push_back(ring.flat[i]);
                }
            };
            add(rings[outer]);
            for (std::size_t i = 0; i < rings.size(); ++i)
                if (parents[i] == outer) add(rings[i]);
            geometry::TriangulateOptions options;
            options.interior_points = before.kind != "plane";
            const geometry::Triangulation made = geometry::triangulate(flat_points, loops, options, context_);
            Face face = before;
            face.triangles.clear();
            face.uv.clear();
            face.given_quads.clear();
            face.keeps_nodes = false;
            std::vector<Vec2> uv;
            for (std::size_t p = 0; p < made.points.size(); ++p) {
                if (p >= points.size()) {
                    points.push_back(static_cast<Index>(model_.points.size()));
                    const Vec3 from = made.points[p].x() * right_ + made.points[p].y() * up_ + far_back();
                    const std::optional<Hit> hit = above(from);
                    if (!hit)
                        refuse(name_of(model_, id) + " folds back as seen along the sweep, and is not cut");
                    model_.points.push_back(hit->place);
                    uv_.insert_or_assign(points.back(), hit->uv);
                }
            }
            for (const Triangle& t : made.triangles) {
                Triangle corner{points[index(t[0])], points[index(t[1])], points[index(t[2])]};
                if (turned) std::swap(corner[1], corner[2]);
                face.triangles.push_back(corner);
            }
            if (before.surface) set_uv(before, face);
            if (first) {
                regions_.push_back(id);
                model_[id] = std::move(face);
            } else {
                regions_.emplace_back(model_.faces.size());
                model_.faces.push_back(std::move(face));
            }
            first = false;
        }
    }

    [[nodiscard]] Vec3 far_back() const
    {
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& p : volume_.model.points) least = std::min(least, p.dot(along_));
        return (least - volume_.model.diagonal) * along_;
    }

    /// Surface parameters of the corners: those found on the way, and at the old rim those of its old facets.
    void set_uv(const Face& before, Face& face) const
    {
        std::map<Index, Vec2> known(uv_.begin(), uv_.end());
        for (std::size_t t = 0; t < before.triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) known.emplace(before.triangles[t][k], before.uv[t][k]);
        }
        for (const Triangle& t : face.triangles)
            face.uv.push_back({known.at(t[0]), known.at(t[1]), known.at(t[2])});
    }

    std::vector<StepPiece> pieces()
    {
        // Which part of the stepped end each region of the other lies over.
        std::vector<Triangle> triangles;
        std::vector<std::size_t> part;
        for (std::size_t p = 0; p < ends_.size(); ++p) {
            for (const FaceId face : ends_[p]) {
                triangles.insert(triangles.end(), model_[face].triangles.begin(),
                                 model_[face].triangles.end());
                part.resize(triangles.size(), p);
            }
        }
        const geometry::FacetTree ends(model_.points, triangles);
        std::vector<Roles> roles(ends_.size());
        std::vector<std::vector<FaceId>> opposite(ends_.size());
        for (const FaceId region : regions_) {
            std::map<std::size_t, double> votes;
            const std::vector<Triangle>& facets = model_[region].triangles;
            const std::size_t step = std::max<std::size_t>(1, facets.size() / kVotes);
            for (std::size_t t = 0; t < facets.size(); t += step) {
                const Vec3 &a = model_.at(facets[t][0]), &b = model_.at(facets[t][1]),
                           &c = model_.at(facets[t][2]);
                const auto hit = ends.first_along((a + b + c) / 3, -along_);
                if (hit.triangle >= 0) votes[part[index(hit.triangle)]] += (b - a).cross(c - a).norm();
            }
            if (votes.empty()) refuse(name_of(model_, region) + " lies over no part of the stepped end");
            opposite[std::ranges::max_element(votes, {}, [](const auto& v) { return v.second; })->first]
                .push_back(region);
        }
        std::vector<std::vector<FaceId>> walls(ends_.size());
        const auto give = [&](std::size_t p, const std::vector<FaceId>& faces) {
            walls[p].insert(walls[p].end(), faces.begin(), faces.end());
        };
        for (const Riser& riser : risers_) give(riser.low, riser.walls);
        for (const Imprinted& image : images_) {
            give(risers_[image.riser].low, image.curtain);
            give(risers_[image.riser].high, image.curtain);
        }
        for (const auto& [faces, p] : other_walls_)
            give(p < ends_.size() ? p : part_beside(faces, opposite), faces);
        std::vector<StepPiece> result;
        for (std::size_t p = 0; p < ends_.size(); ++p) {
            if (opposite[p].empty())
                refuse("nothing of the opposite end lies over " + name_of(model_, ends_[p].front()) +
                       ", seen along the sweep");
            Roles own{ends_[p], opposite[p], walls[p]};
            if (stepped_ == Role::target) std::swap(own.source, own.target);
            result.push_back({open_volume(model_, own, context_), level_of(p)});
        }
        std::ranges::stable_sort(result, {}, &StepPiece::level);
        return result;
    }

    /// How many steps lead up to a part.
    [[nodiscard]] int level_of(std::size_t part) const
    {
        int level = 0;
        for (std::size_t at = part; level <= static_cast<int>(risers_.size()); ++level) {
            const auto below = std::ranges::find(risers_, at, &Riser::high);
            if (below == risers_.end()) break;
            at = below->low;
        }
        return level;
    }

    /// The piece of walls that touch the opposite end alone.
    std::size_t part_beside(const std::vector<FaceId>& faces,
                            const std::vector<std::vector<FaceId>>& opposite) const
    {
        const std::vector<std::vector<FaceUse>> uses = edge_uses(model_);
        for (const FaceId face : faces) {
            for (const Loop& loop : model_[face].loops) {
                for (const EdgeUse& use : loop.uses) {
                    for (const FaceUse& user : uses[use.edge.index()]) {
                        for (std::size_t p = 0; p < opposite.size(); ++p)
                            if (std::ranges::find(opposite[p], user.face) != opposite[p].end()) return p;
                    }
                }
            }
        }
        refuse(name_of(model_, faces.front()) + " touches neither end");
    }

    const OpenVolume& volume_;
    Model model_;
    Role stepped_, other_;
    const RunContext& context_;
    std::vector<std::vector<FaceId>> ends_; ///< parts that hang together, of the stepped end
    Vec3 along_ = Vec3::Zero(), right_ = Vec3::Zero(), up_ = Vec3::Zero();
    std::vector<Riser> risers_;
    std::vector<std::pair<std::vector<FaceId>, std::size_t>> other_walls_; ///< and the part they touch
    std::vector<Imprinted> images_;
    std::vector<FaceId> regions_;                       ///< of the opposite end, after the cuts
    std::map<Index, Vec2> uv_;                          ///< of points laid onto the opposite end
    std::optional<geometry::FacetTree> tree_;           ///< of the opposite end as it came
    std::vector<std::pair<FaceId, std::size_t>> facet_; ///< of each triangle of the tree
};

} // namespace

bool has_steps(const OpenVolume& volume)
{
    for (const Role end : {Role::source, Role::target}) {
        const std::vector<FaceId> faces = volume.faces(end);
        if (faces.size() > 1 && connected_parts(volume.model, faces).size() > 1) return true;
    }
    return false;
}

std::vector<StepPiece> cut_steps(const OpenVolume& volume, const RunContext& context)
{
    const auto parts = [&](Role end) {
        const std::vector<FaceId> faces = volume.faces(end);
        return faces.empty() ? 0 : connected_parts(volume.model, faces).size();
    };
    const std::size_t sources = parts(Role::source), targets = parts(Role::target);
    if (sources <= 1 && targets <= 1) return {{volume, 0}};
    if (sources > 1 && targets > 1) {
        throw NotSweepable("closure.steps", "the source lies at " + std::to_string(sources) +
                                                " heights and the target at " + std::to_string(targets) +
                                                "; steps at one end alone are cut: make two volumes of it");
    }
    return StepCutter(volume, sources > 1 ? Role::source : Role::target, context).run();
}

} // namespace lacuna::closure
