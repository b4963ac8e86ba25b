// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/branches.h>

#include <lacuna/closure/detail/branch_mouths.h>
#include <lacuna/closure/detail/connecting_tubes.h>
#include <lacuna/closure/detail/full_turn.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/detail/pieces.h>
#include <lacuna/closure/detail/void_entities.h>
#include <lacuna/closure/shared/cut.h>
#include <lacuna/closure/shared/round_rims.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/spread.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>
#include <lacuna/topology/shared/facet_area.h>
#include <lacuna/topology/shared/joined_faces.h>
#include <lacuna/topology/shared/section.h>
#include <lacuna/topology/shared/side_points.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace lacuna::closure {

using namespace topology;

namespace {

/// If a plane along the main body passes an edge inside the main body's end at less than this share of the
/// widest mouth's width, the plane is moved onto the edge, so that no sliver is left. On a wall, the plane
/// makes no line within this distance of an edge along the axis. A higher value moves the planes further from
/// the centres of their mouths.
constexpr double kBeside = 0.1;

/// The tube of a branch at its mouth.
struct Tube {
    Vec3 middle = Vec3::Zero();  ///< of the mouth
    Vec3 outward = Vec3::Zero(); ///< normal of the mouth
    Vec3 way = Vec3::Zero();     ///< direction of the tube, away from the main body
    double radius = 0;           ///< from the tube's axis through the middle of the mouth
};

/// Extent of a mouth along a direction.
struct Reach {
    double low = kInfinity, high = -low;
};

class BranchCutter {
public:
    /// @param lined  tags of walls that planes along their main body have split; run() adds to them
    BranchCutter(const OpenVolume& volume, Branching found, std::set<int>& lined, const RunContext& context)
        : volume_(volume), found_(std::move(found)), context_(context), lined_(lined)
    {
    }

    std::vector<StepPiece> run()
    {
        const std::size_t host = found_.mouths.front().host;
        std::vector<const Mouth*> mouths;
        for (const Mouth& mouth : found_.mouths)
            if (mouth.host == host) mouths.push_back(&mouth);
        set_axis(*mouths.front());
        if (!is_lined(host)) {
            const std::vector<geometry::Plane> planes = planes_along(mouths);
            if (!planes.empty()) return with_lines(planes);
        }
        std::ranges::sort(mouths, {}, [&](const Mouth* mouth) { return reach(*mouth).low; });
        // Mouths whose ranges along the axis overlap form one junction.
        double high = reach(*mouths.front()).high;
        std::size_t count = 1;
        for (; count < mouths.size() && reach(*mouths[count]).low <= high + volume_.model.tolerance; ++count)
            high = std::max(high, reach(*mouths[count]).high);
        mouths.resize(count);
        for (const Mouth* mouth : mouths)
            if (mouth->beyond.empty()) refuse_beyond(*mouth); // a fillet faces the main body in any case
        if (count == 1 && found_.ends[mouths.front()->branch].size() < 2) {
            const std::vector<double> heights = sides_across(*mouths.front());
            if (!heights.empty()) return part_at(heights);
        }
        return fork(mouths);
    }

private:
    /// Whether planes along a main body have split its walls, perhaps when another branch was cut off.
    [[nodiscard]] bool is_lined(std::size_t host) const
    {
        return std::ranges::any_of(found_.faces[host], [&](FaceId face) {
            return volume_.role[face.index()] == Role::wall && volume_.model[face].origin == Origin::given &&
                   lined_.contains(volume_.model[face].tag);
        });
    }

    [[noreturn]] void refuse(const Mouth& mouth, const std::string& why) const
    {
        const Reach own = reach(mouth);
        throw NotSweepable(
            Message("closure.branches", "the branch of {} on {} cannot be cut automatically: {}",
                    wall_entity(mouth, mouth.branch), wall_entity(mouth, mouth.host), why)
                .remedy("cut by planes of normal {{{:.3g}, {:.3g}, {:.3g}}} on both sides of the branch's "
                        "mouth, which extends from {} to {}",
                        axis_.x(), axis_.y(), axis_.z(), place_with_digits(on_axis(own.low), 4),
                        place_with_digits(on_axis(own.high), 4)));
    }

    [[nodiscard]] NamedEntity wall_entity(const Mouth& mouth, std::size_t region) const
    {
        return entity_of(volume_.model, wall_at(mouth, region));
    }

    /// The point of the axis at a height along it.
    [[nodiscard]] Vec3 on_axis(double height) const
    {
        return centre_ + (height - centre_.dot(axis_)) * axis_;
    }

    /// Whether a face has an edge of a mouth.
    [[nodiscard]] bool is_at(const Mouth& mouth, FaceId face) const
    {
        return std::ranges::any_of(uses_of(volume_.model[face]), [&](const EdgeUse& use) {
            return std::ranges::find(mouth.edges, use.edge) != mouth.edges.end();
        });
    }

    /// Refuse a branch that reaches beyond the side of the main body, so that an end of the branch lies next
    /// to the mouth.
    void refuse_beyond(const Mouth& mouth) const
    {
        const Model& model = volume_.model;
        const Vec3 outward = way_out(mouth);
        for (const FaceId face : found_.faces[mouth.branch]) {
            const double facing = std::abs(face_area_vector(model, face).dot(outward));
            if (!is_at(mouth, face) || facing <= kContinues * face_area(model, face)) continue;
            throw NotSweepable(
                Message("closure.branches",
                        "the branch of {} on {} reaches beyond the side of the main body, because "
                        "the normal of {}, next to the branch's mouth, points along the branch",
                        wall_entity(mouth, mouth.branch), wall_entity(mouth, mouth.host),
                        entity_of(model, face))
                    .remedy("move the branch towards the middle, or make it narrower"));
        }
    }

    [[nodiscard]] FaceId wall_at(const Mouth& mouth, std::size_t region) const
    {
        const std::vector<FaceId>& faces = found_.faces[region];
        const auto wall = std::ranges::find_if(faces, [&](FaceId face) { return is_at(mouth, face); });
        return wall != faces.end() ? *wall : faces.front();
    }

    /// The direction in which a branch leaves its mouth.
    [[nodiscard]] Vec3 way_out(const Mouth& mouth) const
    {
        const std::vector<Vec3> rim = rim_places(mouth);
        const Vec3 normal = geometry::newell_vector(rim).normalized();
        Vec3 far = Vec3::Zero();
        for (const FaceId face : found_.faces[mouth.branch]) far += face_centroid(volume_.model, face);
        far /= static_cast<double>(found_.faces[mouth.branch].size());
        return (far - geometry::centre_of_ring(rim)).dot(normal) < 0 ? Vec3(-normal) : normal;
    }

    /// The tube of a branch. Its direction is that across the normals of its facets near the mouth.
    [[nodiscard]] Tube tube_of(const Mouth& mouth) const
    {
        const std::vector<Vec3> rim = rim_places(mouth);
        Tube tube{geometry::centre_of_ring(rim), way_out(mouth)};
        double wide = 0;
        for (const Vec3& p : rim) wide = std::max(wide, (p - tube.middle).norm());
        std::vector<Vec3> normals;
        std::vector<double> areas;
        for (const FaceId face : found_.faces[mouth.branch]) {
            if (plane_of(volume_.model, face)) continue; // an end
            for (const Triangle& t : volume_.model[face].triangles) {
                const Vec3 area = facet_area_vector(volume_.model, t);
                if (!(area.norm() > 0) || (volume_.model.at(t[0]) - tube.middle).norm() > 2 * wide) continue;
                normals.push_back(area.normalized());
                areas.push_back(area.norm());
            }
        }
        tube.way = normals.empty() ? tube.outward
                                   : Vec3(geometry::spread_about(Vec3::Zero(), normals, areas).axis.col(0));
        if (tube.way.dot(tube.outward) < 0) tube.way = -tube.way;
        const Vec3 across = (axis_ - axis_.dot(tube.way) * tube.way).stableNormalized();
        for (const Vec3& p : rim)
            tube.radius = std::max(tube.radius, std::abs((p - tube.middle).dot(across)));
        return tube;
    }

    /// Set the main body's axis: the direction from end to end, without its component along the branch. A
    /// body with steps has more than two ends; its axis is the normal of its source.
    void set_axis(const Mouth& mouth)
    {
        centre_ = geometry::centre_of_ring(rim_places(mouth));
        const Vec3 outward = way_out(mouth);
        const std::vector<Vec3>& ends = found_.ends[mouth.host];
        Vec3 way = ends.back() - ends.front();
        if (ends.size() != 2) {
            way.setZero();
            for (const FaceId face : found_.faces[mouth.host])
                if (volume_.role[face.index()] == Role::source) way += face_area_vector(volume_.model, face);
        }
        const Vec3 square = way - way.dot(outward) * outward;
        axis_ = square.norm() > 0 ? Vec3(square.normalized()) : Vec3(outward.unitOrthogonal());
        if (ends.size() != 2 && !(square.norm() > kAlongAxis * way.norm()))
            refuse(mouth, formatted("the main body has {} ends, so its direction is ambiguous", ends.size()));
    }

    /// Planes along the main body: one through the centre of each mouth, and one through the middle of each
    /// edge between two faces of an end of the main body. Empty if one plane suffices, because all branches
    /// leave to one side.
    [[nodiscard]] std::vector<geometry::Plane> planes_along(const std::vector<const Mouth*>& mouths) const
    {
        const Model& model = volume_.model;
        // End points of the edges between two faces of an end of the main body.
        std::vector<std::array<Vec3, 2>> across;
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
            const bool inner = uses.size() == 2 && uses[0].face != uses[1].face &&
                               std::ranges::all_of(uses, [&](const FaceUse& use) {
                                   return found_.region[use.face.index()] == mouths.front()->host &&
                                          volume_.role[use.face.index()] != Role::wall;
                               });
            if (!inner) continue;
            across.push_back(
                {model.at(model.edges[e].points.front()), model.at(model.edges[e].points.back())});
        }
        std::vector<geometry::Plane> planes;
        const auto add = [&](Vec3 place, const Vec3& normal) {
            const Vec3 square = normal - normal.dot(axis_) * axis_;
            if (!(square.norm() > kAlongAxis * normal.norm())) return;
            Vec3 n = square.normalized();
            const bool known = std::ranges::any_of(planes, [&](const geometry::Plane& plane) {
                return std::abs(plane.normal.dot(n)) > std::cos(kCreaseAngle * kDegree);
            });
            if (known) return;
            // Let the plane pass through an edge of the end that is near, so that no sliver is left beside
            // the edge.
            for (const auto& [a, b] : across) {
                const auto is_near = [&](const Vec3& p) {
                    return std::abs((p - place).dot(n)) <= kBeside * width();
                };
                const Vec3 turned = axis_.cross(b - a);
                if (is_near(a) && is_near(b) && turned.norm() > kAlongAxis * (b - a).norm())
                    n = turned.normalized();
                if (is_near(a) || is_near(b)) place = is_near(a) ? a : b;
            }
            planes.push_back(geometry::plane_across(place, n));
        };
        for (const Mouth* mouth : mouths) {
            const Vec3 aside = axis_.cross(way_out(*mouth)).normalized();
            const std::vector<Vec3> rim = rim_places(*mouth);
            const auto [low, high] = std::ranges::minmax_element(rim, {},
                                                                 [&](const Vec3& p) { return p.dot(aside); });
            add((*low + *high) / 2, aside);
        }
        for (const auto& [a, b] : across) add((a + b) / 2, b - a);
        if (planes.size() < 2) planes.clear();
        return planes;
    }

    /// Split the walls of the main body by planes along its axis, then cut off the branches. If mouths lie on
    /// several sides, the two ends of a piece have rims that are bent differently. The new wall edges
    /// determine which vertices of these rims correspond.
    std::vector<StepPiece> with_lines(const std::vector<geometry::Plane>& planes)
    {
        OpenVolume lined = volume_;
        std::vector<FaceId> walls = found_.faces[found_.mouths.front().host];
        std::erase_if(walls, [&](FaceId face) { return volume_.role[face.index()] != Role::wall; });
        for (const geometry::Plane& plane : planes) {
            ModelBuilder model(std::move(lined.model));
            std::vector<SectionWalk> walks = section_walks(model, walls, plane, model.tolerance);
            std::erase_if(walks, [&](const SectionWalk& walk) {
                return is_beside_line(model, walls, walk, plane, kBeside * width());
            });
            const WalkImprint made = imprint_walks(model, walks, plane, model.tolerance, context_);
            lined.model = std::move(model).finish();
            for (std::size_t f = lined.role.size(); f < made.parent.size(); ++f) {
                lined.role.push_back(lined.role[made.parent[f].index()]);
                if (std::ranges::find(walls, made.parent[f]) != walls.end()) walls.emplace_back(f);
            }
        }
        for (const FaceId wall : walls) lined_.insert(lined.model[wall].tag);
        return BranchCutter(lined, find_mouths(lined, context_), lined_, context_).run();
    }

    /// Width of the widest mouth.
    [[nodiscard]] double width() const
    {
        double wide = 0;
        for (const Mouth& mouth : found_.mouths) {
            const std::vector<Vec3> rim = places(volume_.model, mouth.edges);
            for (const Vec3& p : rim) wide = std::max(wide, (p - rim.front()).norm());
        }
        return wide;
    }

    /// Whether an edge of the walls, parallel to the axis, is near the middle of a section line.
    [[nodiscard]] bool is_beside_line(const Model& model, const std::vector<FaceId>& walls,
                                      const SectionWalk& walk, const geometry::Plane& plane,
                                      double near) const
    {
        const Vec3 middle = geometry::from_plane(plane,
                                                 place_of(model, walk.places[walk.places.size() / 2], plane));
        for (const EdgeId edge : edges_of(model, walls)) {
            const std::vector<Index>& points = model[edge].points;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const Vec3 &a = model.at(points[i]), &b = model.at(points[i + 1]);
                if (std::abs((b - a).dot(axis_)) < kOneCurve * (b - a).norm()) continue;
                const double f = std::clamp(fraction_along(middle, a, b), 0.0, 1.0);
                if ((middle - ((1 - f) * a + f * b)).norm() <= near) return true;
            }
        }
        return false;
    }

    /// Points round a mouth, in order.
    [[nodiscard]] std::vector<Vec3> rim_places(const Mouth& mouth) const
    {
        const Model& model = volume_.model;
        return loop_places(
            model, walk_of(model, found_.faces[mouth.branch], {mouth.edges.begin(), mouth.edges.end()}));
    }

    /// The rim of some faces that runs along the given edges.
    static std::vector<EdgeUse> walk_of(const Model& model, const std::vector<FaceId>& faces,
                                        const std::set<EdgeId>& edges)
    {
        for (const Rim& rim : rims(model, faces))
            if (edges.contains(rim.uses.front().edge)) return rim.uses;
        return {};
    }

    [[nodiscard]] Reach reach(const Mouth& mouth) const
    {
        Reach result;
        for (const Vec3& p : places(volume_.model, mouth.edges)) {
            result.low = std::min(result.low, p.dot(axis_));
            result.high = std::max(result.high, p.dot(axis_));
        }
        return result;
    }

    /// Heights along the axis of the two flat walls of the branch at a mouth that are perpendicular to the
    /// axis, such as those of a square duct on a flat wall. Empty unless there are two. The part of the main
    /// body between these heights is swept along the axis together with the duct; the two walls of the duct
    /// are parts of its ends.
    [[nodiscard]] std::vector<double> sides_across(const Mouth& mouth) const
    {
        const Model& model = volume_.model;
        const Reach own = reach(mouth);
        std::vector<double> heights;
        for (const double height : {own.low, own.high}) {
            const bool any = std::ranges::any_of(found_.faces[mouth.branch], [&](FaceId face) {
                return is_at(mouth, face) && std::ranges::all_of(corners_of(model[face]), [&](Index p) {
                           return std::abs(model.at(p).dot(axis_) - height) <= model.tolerance;
                       });
            });
            if (any) heights.push_back(height);
        }
        return heights.size() == 2 ? heights : std::vector<double>{};
    }

    std::vector<StepPiece> part_at(const std::vector<double>& heights)
    {
        std::vector<StepPiece> pieces{{volume_, 0}};
        for (const double height : heights) {
            const geometry::Plane plane = geometry::plane_across(on_axis(height), axis_);
            pieces = cut_each(std::move(pieces), plane,
                              [&](const OpenVolume& piece) { return cut_by_plane(piece, plane, context_); });
        }
        return pieces;
    }

    static Vec2 place_of(const Model& model, const SectionPlace& place, const geometry::Plane& plane)
    {
        return geometry::to_plane(plane, place_at(model, place, plane));
    }

    /// Section lines across the main body: first those from mouth to mouth, then the closed lines (holes)
    /// inside the region that these bound.
    [[nodiscard]] std::vector<SectionWalk> walks_across(const std::vector<const Mouth*>& mouths,
                                                        const geometry::Plane& plane) const
    {
        const Mouth& mouth = *mouths.front();
        std::vector<SectionWalk> walks = section_walks(volume_.model, found_.faces[mouth.host], plane,
                                                       volume_.model.tolerance);
        const auto rest = std::ranges::stable_partition(walks,
                                                        [](const SectionWalk& walk) { return !walk.closed; });
        const auto open = static_cast<std::size_t>(rest.begin() - walks.begin());
        if (open != mouths.size())
            refuse(mouth, open < mouths.size() ? "no wall of the main body lies opposite"
                                               : "walls of the main body are missing opposite");
        // Keep the closed lines inside the region that the open lines bound.
        std::vector<std::vector<Vec2>> loops(1);
        for (std::size_t w = 0; w < walks.size(); ++w) {
            if (w >= open) loops.emplace_back();
            for (const SectionPlace& place : walks[w].places)
                loops.back().push_back(place_of(volume_.model, place, plane));
        }
        std::vector<SectionWalk> own(walks.begin(), rest.begin());
        for (const std::vector<std::size_t>& region : regions_of(loops)) {
            if (std::ranges::find(region, std::size_t{0}) == region.end()) continue;
            for (const std::size_t l : region)
                if (l != 0) own.push_back(walks[open + l - 1]);
        }
        return own;
    }

    /// Add the cut faces. At each mouth they meet in a dip (`add_dip()`): two faces run from the dip to the
    /// halves of the mouth, and one face runs across the main body between the dips.
    std::vector<StepPiece> fork(const std::vector<const Mouth*>& mouths)
    {
        check_cancelled(context_);
        Vec3 centre = Vec3::Zero();
        std::vector<Tube> tubes;
        for (const Mouth* mouth : mouths) {
            // Where the branch's axis is one radius of the branch below the mouth, the faces bisect the
            // angles between the branch and the main body, but a plane there meets the mouth near its tip.
            // Halfway, cells are best: 24 laterals of 45 and 60 degrees, mean of the least scaled Jacobians
            // 0.32, at the mouth's centre 0.28, at that place 0.27.
            const Tube& tube = tubes.emplace_back(tube_of(*mouth));
            const double steep = tube.way.dot(tube.outward);
            const double below = steep > kAlongAxis ? tube.radius / (2 * steep) : 0;
            centre += (tube.middle - below * tube.way) / static_cast<double>(mouths.size());
        }
        const geometry::Plane plane = geometry::plane_across(centre, axis_);
        PartedVolume parted{volume_};
        OpenVolume& work = parted.volume;
        const std::vector<SectionWalk> walks = walks_across(mouths, plane);
        const WalkImprint made = imprint(work, walks, plane, context_);
        Model& model = work.model;
        std::vector<FaceId> host;
        for (std::size_t f = 0; f < made.parent.size(); ++f)
            if (found_.region[made.parent[f].index()] == mouths.front()->host) host.emplace_back(f);

        Partition middle;
        // By the vertex at which a section line ends: the dip that continues the line.
        std::map<VertexId, EdgeUse> onward;
        for (std::size_t m = 0; m < mouths.size(); ++m) {
            const Mouth* mouth = mouths[m];
            // The void faces of earlier mouths come after the faces of the skin.
            std::vector<FaceId> branch;
            for (std::size_t f = 0; f < made.parent.size(); ++f)
                if (found_.region[made.parent[f].index()] == mouth->branch) branch.emplace_back(f);
            std::array<std::vector<EdgeUse>, 2>
                halves; // the half behind the plane, then the half in front of it; oriented as in the branch
            for (const EdgeUse& use : mouth_walk(model, branch, host)) {
                double sum = 0;
                for (const Index p : model[use.edge].points) sum += geometry::height(plane, model.at(p));
                halves[sum < 0 ? 0 : 1].push_back(use);
            }
            const EdgeId dip = add_dip(model, *mouth, tubes[m], plane, order(model, *mouth, halves));
            onward[model[dip].from] = {dip, false};
            onward[model[dip].to] = {dip, true};
            for (const std::vector<EdgeUse>& half : halves) {
                Partition partition;
                for (const EdgeUse& use : half) partition.behind.push_back({use.edge, !use.reversed});
                Loop loop{half};
                loop.uses.push_back({dip, use_to(model, half.back()) != model[dip].from});
                const std::string name = partition_name(model);
                VoidFilling filling = fill_cut(work, {loop}, {name}, context_);
                filling.name = name;
                partition.face = add_void_face(work, std::move(filling), Role::wall);
                parted.partitions.push_back(partition);
            }
        }
        std::vector<std::vector<EdgeUse>> rings(1);
        std::vector<char> seen(made.lines.size(), 0);
        for (std::size_t w = 0; seen[w] == 0;) {
            seen[w] = 1;
            rings.front().insert(rings.front().end(), made.lines[w].begin(), made.lines[w].end());
            const auto across = onward.find(use_to(model, made.lines[w].back()));
            if (across == onward.end())
                refuse(*mouths.front(), "walls of the main body are missing opposite");
            rings.front().push_back(across->second);
            const VertexId start = use_to(model, across->second);
            for (std::size_t next = 0; next < mouths.size(); ++next)
                if (use_from(model, made.lines[next].front()) == start) w = next;
        }
        for (std::size_t l = 0; l < made.lines.size(); ++l) {
            if (l >= mouths.size()) rings.push_back(made.lines[l]);
            middle.behind.insert(middle.behind.end(), made.lines[l].begin(), made.lines[l].end());
        }
        std::vector<std::vector<Vec2>> flat;
        for (const std::vector<EdgeUse>& ring : rings)
            flat.push_back(flat_places(plane, loop_places(model, ring)));
        std::vector<std::vector<EdgeUse>> ordered;
        const std::vector<std::size_t> outer_first = regions_of(flat).front();
        for (const std::size_t ring : outer_first) ordered.push_back(rings[ring]);
        middle.face = add_partition(model, ordered, plane, partition_name(model), context_);
        work.role.push_back(Role::wall);
        parted.partitions.insert(parted.partitions.begin(), middle);
        model = with_loops(std::move(model));
        return pieces_of(
            parted, {"the cut at the branch of ", {wall_entity(*mouths.front(), mouths.front()->branch)}},
            context_);
    }

    /// The common rim of the branch and the main body.
    static std::vector<EdgeUse> mouth_walk(const Model& model, const std::vector<FaceId>& branch,
                                           const std::vector<FaceId>& host)
    {
        return walk_of(model, branch, rim_edges(model, host));
    }

    /// Order the edges of each half of a mouth so that they form a chain.
    /// @return  the vertices where the first half begins and ends.
    [[nodiscard]] std::pair<VertexId, VertexId> order(const Model& model, const Mouth& mouth,
                                                      std::array<std::vector<EdgeUse>, 2>& halves) const
    {
        const auto is_chain = [&](const std::vector<EdgeUse>& half) {
            for (std::size_t i = 0; i + 1 < half.size(); ++i)
                if (use_to(model, half[i]) != use_from(model, half[i + 1])) return false;
            return !half.empty();
        };
        for (std::vector<EdgeUse>& half : halves) {
            for (std::size_t turn = 0; turn < half.size() && !is_chain(half); ++turn)
                std::ranges::rotate(half, half.begin() + 1);
        }
        if (!is_chain(halves[0]) || !is_chain(halves[1]) ||
            use_to(model, halves[0].back()) != use_from(model, halves[1].front()))
            refuse(mouth, "the plane across the main body must cross its mouth in two places");
        return {use_from(model, halves[0].front()), use_to(model, halves[0].back())};
    }

    /// Add the dip: a parabola across the mouth into the main body. Its lowest point lies one radius of
    /// the branch below the mouth, but at most halfway to the opposite wall: for equal tubes on the axis.
    EdgeId add_dip(Model& model, const Mouth& mouth, const Tube& tube, const geometry::Plane& plane,
                   std::pair<VertexId, VertexId> ends)
    {
        const auto [from, to] = ends;
        const Vec3& outward = tube.outward;
        const Vec3 a = model.at(model[from].point), b = model.at(model[to].point);
        const std::vector<Vec3> around = places(volume_.model, mouth.edges);
        const auto off_plane = [&](const Vec3& p) { return std::abs(geometry::height(plane, p)); };
        const double top = std::ranges::max_element(around, {}, off_plane)->dot(outward);
        const double rim = ((a + b) / 2).dot(outward);
        const std::vector<Triangle> facets = facets_of(volume_.model, found_.faces[mouth.host]);
        const Vec3 start = (a + b) / 2 + (std::min(rim, top) - rim) * outward;
        const double down = geometry::FacetTree(volume_.model.points, facets).first_along(start, -outward).t;
        double lowest = top - tube.radius;
        if (std::isfinite(down)) lowest = std::max(lowest, top - (top - start.dot(outward) + down) / 2);
        const double deep = std::max(0.0, rim - lowest);
        std::vector<Vec3> between;
        for (int i = 1; i < kChords && deep > kChords * model.tolerance; ++i) {
            const double u = 2.0 * i / kChords - 1;
            between.emplace_back((a + b) / 2 + u * (b - a) / 2 - deep * (1 - u * u) * outward);
        }
        return add_void_edge_through(model, from, to, between);
    }

    const OpenVolume& volume_;
    Branching found_;
    const RunContext& context_;
    std::set<int>& lined_;
    /// Centre of the first mouth, and direction of the main body's axis.
    Vec3 centre_ = Vec3::Zero(), axis_ = Vec3::Zero();
};

/// Make one face of each smooth junction and the tubes of the main body, whose layers need not follow the
/// lines between them.
OpenVolume with_junctions_joined(OpenVolume volume, const Branching& found, const RunContext& context)
{
    geometry::UnionFind joined(volume.model.faces.size());
    for (const auto& [junction, tube] : found.passed) joined.unite_least(junction.index(), tube.index());
    join_faces(volume, std::move(joined), context);
    return volume;
}

std::vector<StepPiece> cut_branches(const OpenVolume& volume, std::set<int>& lined, const RunContext& context)
{
    Branching found = find_mouths(volume, context);
    if (found.mouths.empty()) return {{.volume = volume}};
    if (const std::vector<StepPiece> parts = cut_connecting_tubes(volume, found, context); !parts.empty()) {
        std::vector<StepPiece> result;
        for (const StepPiece& part : parts)
            std::ranges::move(cut_branches(part.volume, lined, context), std::back_inserter(result));
        return result;
    }
    if (!found.passed.empty())
        return cut_branches(with_junctions_joined(volume, found, context), lined, context);
    std::vector<StepPiece> result;
    for (const StepPiece& piece : BranchCutter(volume, std::move(found), lined, context).run()) {
        for (StepPiece& own : cut_branches(piece.volume, lined, context)) result.push_back(std::move(own));
    }
    return result;
}

} // namespace

bool has_branches(const OpenVolume& volume, const RunContext& context)
{
    return !find_mouths(volume, context).mouths.empty();
}

std::vector<StepPiece> cut_branches(const OpenVolume& volume, const RunContext& context)
{
    std::set<int> lined;
    return cut_branches(volume, lined, context);
}

bool has_pieces(const OpenVolume& volume, const RunContext& context)
{
    return volume.full_turn || has_steps(volume, context) || has_branches(volume, context);
}

std::vector<StepPiece> cut_into_pieces(const OpenVolume& volume, const RunContext& context)
{
    if (volume.full_turn) return cut_full_turn(volume, context);
    std::vector<StepPiece> result;
    for (const StepPiece& arm : cut_branches(volume, context)) {
        for (StepPiece& piece : cut_steps(arm.volume, context)) result.push_back(std::move(piece));
    }
    // Rounds are divided only if there is a single piece, because two pieces must not divide a round that
    // they share.
    if (result.size() == 1) split_round_rims(result.front().volume, RoundsOf::walls, context);
    std::ranges::stable_sort(result, {}, &StepPiece::level);
    return result;
}

} // namespace lacuna::closure
