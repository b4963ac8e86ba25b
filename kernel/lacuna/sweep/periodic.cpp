// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/periodic.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/minimal_frame.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/sweep/detail/member_edge.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/topology/shared/facet_sag.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <set>

namespace lacuna::sweep {

using namespace topology;
using Eigen::Isometry3d;
using surface::FaceNames;

namespace {

/// Rounding error of a rotated point, in steps of the grid. About ten operations are applied to its
/// coordinates.
constexpr double kRounding = 16;

/// A face of a member.
struct MemberFace {
    std::size_t member;
    FaceId face;
};

/// The faces of one side of a pair, and the edges around them.
struct Side {
    std::vector<MemberFace> faces;
    std::vector<MemberEdge> edges;
    std::vector<Vec3> marks;    ///< ends and middles of edges; for closed edges, their centres
    Vec3 centre = Vec3::Zero(); ///< mean point of the edges
    Vec3 normal = Vec3::Zero(); ///< sum of the area vectors
    double area = 0, reach = 0; ///< total area; largest distance of a mark from the centre
};

bool is_equal(const surface::PeriodicPair& a, const surface::PeriodicPair& b)
{
    const auto same = [](const FaceNames& x, const FaceNames& y) {
        return x.tags == y.tags && x.names == y.names;
    };
    return same(a.a, b.a) && same(a.b, b.b) && a.onto.has_value() == b.onto.has_value() &&
           (!a.onto || a.onto->matrix() == b.onto->matrix());
}

/// A requested pair, and the members that request it.
struct Request {
    surface::PeriodicPair pair;
    std::vector<std::size_t> members;
};

std::vector<Request> requests_of(std::span<const AssemblyMember> members)
{
    std::vector<Request> requests;
    for (std::size_t m = 0; m < members.size(); ++m)
        for (const surface::PeriodicPair& pair : members[m].options.periodic) {
            auto found = std::ranges::find_if(requests,
                                              [&](const Request& r) { return is_equal(r.pair, pair); });
            if (found == requests.end()) found = requests.insert(found, {pair, {}});
            if (found->members.empty() || found->members.back() != m) found->members.push_back(m);
        }
    return requests;
}

class Finder {
public:
    Finder(std::span<const AssemblyMember> members, double grid) : members_(members), grid_(grid) {}

    void find(const Request& request, std::size_t pair, std::vector<PeriodicFaces>& found)
    {
        a_ = side_of(request, request.pair.a);
        b_ = side_of(request, request.pair.b);
        tolerance_ = 0;
        for (const Side* side : {&a_, &b_})
            for (const MemberFace& face : side->faces)
                tolerance_ = std::max(tolerance_, model(face).tolerance);
        if (a_.edges.size() != b_.edges.size())
            refuse(formatted("they have {} and {} edges", a_.edges.size(), b_.edges.size()));
        off_ = kInfinity;
        std::optional<Isometry3d> best;
        if (request.pair.onto) {
            if (fits(*request.pair.onto)) best = request.pair.onto;
        } else {
            best = find_motion();
        }
        if (!best)
            refuse(off_ < kInfinity
                       ? formatted("the best motion leaves their edges {:.2g} apart", lacuna::found(off_))
                       : formatted("their areas are {:.6g} and {:.6g}", lacuna::found(a_.area), b_.area));
        if (is_translation(*best)) best->translation() = on_grid(best->translation(), grid_);
        take(*best, pair, found);
    }

private:
    [[nodiscard]] const Model& model(const MemberFace& face) const
    {
        return members_[face.member].volume->model;
    }
    [[nodiscard]] NamedEntity entity(const MemberFace& face) const
    {
        return entity_in(members_[face.member], face.face);
    }

    [[nodiscard]] Side side_of(const Request& request, const FaceNames& names) const
    {
        Side side;
        for (const std::size_t m : request.members) {
            const OpenVolume& volume = *members_[m].volume;
            FaceNames known = names;
            std::erase_if(known.tags, [&](int tag) { return !surface::has_face(volume, tag); });
            std::erase_if(known.names, [&](const auto& name) { return !surface::has_face(volume, name); });
            std::set<EdgeId> edges;
            for (const FaceId face : surface::faces_named(volume, known, "periodic")) {
                side.faces.push_back({m, face});
                side.normal += face_area_vector(volume.model, face);
                side.area += face_area(volume.model, face);
                edges.merge(rim_edges(volume.model, face));
            }
            for (const EdgeId edge : edges) side.edges.push_back(member_edge(volume.model, m, edge));
        }
        if (side.faces.empty())
            throw InvalidInput(Message("sweep.periodic_faces",
                                       "sweep: option 'periodic' names faces that no swept volume has")
                                   .remedy("volume:tree() lists the faces of a volume"));
        double length = 0;
        for (const MemberEdge& edge : side.edges) {
            side.centre += edge.length * edge.centre;
            length += edge.length;
            side.marks.push_back(edge.closed ? edge.centre : edge.middle);
            if (!edge.closed) side.marks.insert(side.marks.end(), {edge.from, edge.to});
        }
        if (length > 0) side.centre /= length;
        for (const Vec3& p : side.marks) side.reach = std::max(side.reach, (p - side.centre).norm());
        return side;
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw InvalidInput(Message("sweep.periodic_faces",
                                   "periodic: {} and {} are not equal under a translation or rotation: {}",
                                   entity(a_.faces.front()), entity(b_.faces.front()), why)
                               .remedy("name faces of the same shape, or give 'translate' or 'rotate'"));
    }

    /// For each edge of the first side, the index of its image on the second side. Empty if an edge has no
    /// image.
    std::vector<std::size_t> images(const Isometry3d& onto)
    {
        std::vector<std::size_t> image;
        double off = 0;
        for (const MemberEdge& edge : a_.edges) {
            const MemberEdge moved = member_edge(members_[edge.member].volume->model, edge.member, edge.edge,
                                                 onto);
            const auto same = std::ranges::find_if(
                b_.edges, [&](const MemberEdge& other) { return is_same(moved, other, tolerance_); });
            if (same != b_.edges.end()) {
                image.push_back(static_cast<std::size_t>(same - b_.edges.begin()));
                continue;
            }
            double least = kInfinity;
            for (const MemberEdge& other : b_.edges)
                least = std::min(least, (moved.centre - other.centre).norm() +
                                            std::abs(moved.length - other.length));
            off = std::max(off, least);
        }
        if (image.size() == a_.edges.size()) return image;
        off_ = std::min(off_, off);
        return {};
    }
    bool fits(const Isometry3d& onto) { return !images(onto).empty(); }

    std::optional<Isometry3d> find_motion()
    {
        Isometry3d shift = Isometry3d::Identity();
        shift.translation() = b_.centre - a_.centre;
        if (const auto exact = refined(shift, false)) return exact;
        std::optional<Isometry3d> best;
        for (const Isometry3d& turn : rotations()) {
            const auto exact = refined(turn, true);
            if (exact && (!best || is_less(*exact, *best))) best = exact;
        }
        return best;
    }

    /// Whether motion `a` has a smaller angle than `b` or, with equal angles, a smaller shift along the axis.
    static bool is_less(const Isometry3d& a, const Isometry3d& b)
    {
        const Eigen::AngleAxisd x(a.linear()), y(b.linear());
        if (std::abs(x.angle() - y.angle()) > kFileAccuracy) return x.angle() < y.angle();
        return std::abs(x.axis().dot(a.translation())) < std::abs(y.axis().dot(b.translation()));
    }

    /// The rotations that move the centre of the first side to the centre of the second, and the normal of
    /// the first side to the reversed normal of the second.
    [[nodiscard]] std::vector<Isometry3d> rotations() const
    {
        std::vector<Isometry3d> found;
        if (a_.marks.empty() || !(a_.normal.norm() > kRoundoff * a_.area) ||
            !(b_.normal.norm() > kRoundoff * b_.area))
            return found;
        const Vec3 from = a_.normal.normalized(), to = -b_.normal.normalized();
        const Eigen::Matrix3d tilt = geometry::least_turn(from, to);
        const auto add = [&](const Eigen::Matrix3d& turn) {
            Isometry3d motion = Isometry3d::Identity();
            motion.linear() = turn;
            motion.translation() = b_.centre - turn * a_.centre;
            found.push_back(motion);
        };
        add(tilt);
        // Both sides have an axis: the normal through the centre. Rotate the mark that is farthest from the
        // first axis to each mark that is equally far from the other axis.
        const auto across = [](const Vec3& p, const Vec3& centre, const Vec3& normal) {
            return Vec3(p - centre - normal * normal.dot(p - centre));
        };
        const auto size = [&](const Vec3& p) { return across(p, a_.centre, from).norm(); };
        const Vec3& mark = *std::ranges::max_element(a_.marks, {}, size);
        const Vec3 arm = tilt * across(mark, a_.centre, from);
        for (const Vec3& p : b_.marks) {
            const Vec3 other = across(p, b_.centre, to);
            if (std::abs(other.norm() - arm.norm()) > kAlikeSizes * a_.reach) continue;
            const double turn = std::atan2(to.dot(arm.cross(other)), arm.dot(other));
            add(Eigen::AngleAxisd(turn, to).toRotationMatrix() * tilt);
        }
        return found;
    }

    /// Improve a motion by a fit: the ends and centres of edges are fitted to those of their images under the
    /// given motion. Empty if the result does not map all edges.
    std::optional<Isometry3d> refined(Isometry3d motion, bool turns)
    {
        std::vector<std::size_t> image = rough_images(motion);
        if (image.empty()) return std::nullopt;
        std::vector<std::array<Vec3, 2>> points;
        for (std::size_t e = 0; e < image.size(); ++e) {
            const MemberEdge &own = a_.edges[e], &other = b_.edges[image[e]];
            if (own.closed) {
                points.push_back({own.centre, other.centre});
                continue;
            }
            const bool along = (motion * own.from - other.from).norm() <
                               (motion * own.from - other.to).norm();
            points.push_back({own.from, along ? other.from : other.to});
            points.push_back({own.to, along ? other.to : other.from});
        }
        if (!turns) {
            // The difference of two vertices is more often exact than the difference of two means.
            motion.translation() = points.front()[1] - points.front()[0];
        } else {
            // If all points lie on one line or coincide, they do not determine the rotation. Points along the
            // normals do.
            const Vec3 tip = a_.reach * a_.normal.normalized(), other = -b_.reach * b_.normal.normalized();
            points.push_back({a_.centre + tip, b_.centre + other});
            points.push_back({a_.centre - tip, b_.centre - other});
            // With fewer points, the fit would not be more accurate than the given motion.
            if (points.size() > 4) {
                std::vector<Vec3> from, to;
                for (const auto& [before, after] : points) {
                    from.push_back(before);
                    to.push_back(after);
                }
                const geometry::RigidFit fit = geometry::fit_rigid(from, to, false);
                motion.linear() = fit.rotation;
                motion.translation() = fit.translation;
            }
        }
        if (!fits(motion)) return std::nullopt;
        return motion;
    }
    /// As `images()`, with a larger tolerance for a motion that is not exact yet.
    std::vector<std::size_t> rough_images(const Isometry3d& motion)
    {
        const double exact = tolerance_;
        tolerance_ += kAlikeSizes * a_.reach;
        std::vector<std::size_t> image = images(motion);
        tolerance_ = exact;
        return image;
    }

    /// Pair the faces by their edges, and check that their facets coincide.
    void take(const Isometry3d& onto, std::size_t pair, std::vector<PeriodicFaces>& found)
    {
        for (const MemberFace& face : a_.faces) {
            PeriodicFaces one{face.member, 0, face.face, {}, onto, {}, pair};
            const std::vector<MemberEdge> own = edges_of(face, onto);
            const MemberFace* nearest = nullptr;
            double least = kInfinity;
            for (const MemberFace& other : b_.faces) {
                const double apart = (onto * face_centroid(model(face), face.face) -
                                      face_centroid(model(other), other.face))
                                         .norm();
                auto edges = same_edges(own, edges_of(other, Isometry3d::Identity()));
                if (edges.empty() || apart >= least) continue;
                nearest = &other, least = apart;
                one.edges = std::move(edges);
            }
            if (nearest == nullptr) refuse(formatted("{} has no image", entity(face)));
            one.b = nearest->member;
            one.face_b = nearest->face;
            compare(face, *nearest, onto);
            found.push_back(std::move(one));
        }
        if (b_.faces.size() != a_.faces.size())
            refuse(formatted("they are {} and {} faces", a_.faces.size(), b_.faces.size()));
    }

    [[nodiscard]] std::vector<MemberEdge> edges_of(const MemberFace& face, const Isometry3d& by) const
    {
        std::vector<MemberEdge> read;
        for (const EdgeId edge : rim_edges(model(face), face.face))
            read.push_back(member_edge(model(face), face.member, edge, by));
        return read;
    }
    /// The corresponding edges of two faces, in pairs. Empty if some edge has no counterpart.
    [[nodiscard]] std::vector<std::pair<EdgeId, EdgeId>> same_edges(const std::vector<MemberEdge>& a,
                                                                    const std::vector<MemberEdge>& b) const
    {
        if (a.size() != b.size()) return {};
        std::vector<std::pair<EdgeId, EdgeId>> pairs;
        for (const MemberEdge& own : a) {
            const auto same = std::ranges::find_if(
                b, [&](const MemberEdge& other) { return is_same(own, other, tolerance_); });
            if (same == b.end()) return {};
            pairs.emplace_back(own.edge, same->edge);
        }
        return pairs;
    }

    /// Check that the corners of each face's facets lie on the other face, within the sag of both.
    void compare(const MemberFace& a, const MemberFace& b, const Isometry3d& onto) const
    {
        const Face &face_a = model(a)[a.face], &face_b = model(b)[b.face];
        const double limit = tolerance_ + facet_sag(model(a), face_a) + facet_sag(model(b), face_b);
        const auto check = [&](const MemberFace& of, const Face& own, const MemberFace& on, const Face& other,
                               const Isometry3d& by) {
            const geometry::FacetTree tree(model(on).points, other.triangles);
            for (const Triangle& triangle : own.triangles)
                for (const Index corner : triangle) {
                    const auto hit = tree.closest(by * model(of).at(corner));
                    if (hit.distance2 > limit * limit)
                        refuse(formatted("inside they are {:.2g} apart",
                                         lacuna::found(std::sqrt(hit.distance2))));
                }
        };
        check(a, face_a, b, face_b, onto);
        check(b, face_b, a, face_a, onto.inverse());
    }

    std::span<const AssemblyMember> members_;
    double grid_, tolerance_ = 0;
    Side a_, b_;
    double off_ = kInfinity; ///< largest misfit of edges under the best motion so far
};

} // namespace

std::vector<PeriodicFaces> periodic_faces(std::span<const AssemblyMember> members, double grid,
                                          const RunContext& context)
{
    std::vector<PeriodicFaces> found;
    Finder finder(members, grid);
    const std::vector<Request> requests = requests_of(members);
    for (std::size_t r = 0; r < requests.size(); ++r) {
        check_cancelled(context);
        finder.find(requests[r], r, found);
    }
    return found;
}

double grid_of(std::span<const AssemblyMember> members)
{
    double largest = 0;
    for (const AssemblyMember& member : members)
        for (const Vec3& p : member.volume->model.points)
            largest = std::max(largest, p.cwiseAbs().maxCoeff());
    int exponent = 0;
    std::frexp(largest, &exponent);
    // Reserve three more bits than the coordinates need: two for values up to four times the coordinates, and
    // one for halves.
    return std::ldexp(1.0, exponent + 3 - std::numeric_limits<double>::digits);
}

void tie_points(std::vector<Vec3>& places, const std::vector<char>& fixed, std::span<const Tie> ties,
                double grid)
{
    struct Way {
        std::size_t from, to;
        Isometry3d onto;
    };
    std::vector<std::vector<Way>> next(places.size());
    for (const Tie& tie : ties) {
        next[tie.from].push_back({tie.from, tie.to, *tie.onto});
        next[tie.to].push_back({tie.to, tie.from, tie.onto->inverse()});
    }
    const bool lattice = std::ranges::all_of(ties, [](const Tie& tie) { return is_translation(*tie.onto); });
    std::vector<char> done = fixed;
    const auto follow = [&](std::size_t first) {
        // Follow translations before rotations, because translations are exact.
        std::deque<const Way*> left;
        const auto add = [&](std::size_t from) {
            for (const Way& way : next[from]) {
                if (done[way.to] != 0) continue;
                if (is_translation(way.onto))
                    left.push_front(&way);
                else
                    left.push_back(&way);
            }
        };
        for (add(first); !left.empty();) {
            const Way& way = *left.front();
            left.pop_front();
            if (done[way.to] != 0) continue;
            done[way.to] = 1;
            const Vec3 moved = way.onto * places[way.from];
            // Keep a rotated position that differs only by rounding. The nodes of edges may have been rotated
            // in another order before, and neighbours must have bit-identical nodes.
            if (is_translation(way.onto) || (moved - places[way.to]).norm() > kRounding * grid)
                places[way.to] = moved;
            add(way.to);
        }
    };
    for (std::size_t i = 0; i < places.size(); ++i)
        if (fixed[i] != 0) follow(i);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (done[i] != 0 || next[i].empty()) continue;
        done[i] = 1;
        if (lattice) places[i] = on_grid(places[i], grid);
        follow(i);
    }
}

} // namespace lacuna::sweep
