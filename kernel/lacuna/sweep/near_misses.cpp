// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/near_misses.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/projector.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/gaps.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Two faces are a near miss only if at least this share of the area within four windows is within one
/// window. The share is a quarter between faces that diverge linearly, and a half between faces that curve
/// away from a contact.
constexpr double kStaysNear = 0.6;
/// A smaller share of a face, or of an edge, does not count, neither as near the other member nor as apart
/// from it. Near the other member, a smaller part counts if its mean width exceeds the window or, along an
/// edge, if it is longer than `kAround` windows.
constexpr double kPart = 0.05;

/// Vertices of a face's rim, without the start points of closed edges.
std::vector<Vec3> corners_of(const Model& model, FaceId face)
{
    std::vector<Vec3> corners;
    for (const EdgeId id : rim_edges(model, face)) {
        const Edge& edge = model[id];
        if (edge.from == edge.to) continue;
        corners.push_back(model.at(model[edge.from].point));
        corners.push_back(model.at(model[edge.to].point));
    }
    return corners;
}

/// Whether two faces have a common edge, within a tolerance.
bool have_common_edge(const Model& a, FaceId face_a, const Model& b, FaceId face_b, double tolerance)
{
    for (const EdgeId e : rim_edges(a, face_a)) {
        const std::vector<Vec3> p = surface::edge_line(a, e);
        const double slack = tolerance + geometry::sag(p);
        for (const EdgeId f : rim_edges(b, face_b)) {
            const std::vector<Vec3> q = surface::edge_line(b, f);
            const auto near = [&](const Vec3& u, const Vec3& v) { return (u - v).norm() <= slack; };
            if (!(near(p.front(), q.front()) && near(p.back(), q.back())) &&
                !(near(p.front(), q.back()) && near(p.back(), q.front())))
                continue;
            const auto middle = [](const std::vector<Vec3>& line) {
                const std::vector<double> arc = geometry::arc_lengths(line);
                return geometry::point_at(line, arc, arc.back() / 2);
            };
            if (near(middle(p), middle(q))) return true;
        }
    }
    return false;
}

/// Finds the near misses of a pair of members.
class PairSearch {
public:
    PairSearch(std::span<const AssemblyMember> members, std::span<const std::vector<double>> sag,
               const NearPair& pair, const std::vector<std::vector<bool>>& shared)
        : pair_(pair), one_(members[pair.a]), other_(members[pair.b]), sag_(sag), shared_(shared)
    {
    }

    void find_faces(const FacesInCommon& common, std::vector<NearMiss>& found)
    {
        for (const auto& [faces, overlap] : pair_.overlaps) {
            if (shared_[pair_.a][faces.first.index()] || shared_[pair_.b][faces.second.index()] ||
                !stays_near(faces, overlap))
                continue;
            const auto is_these = [&, &faces = faces](const PartlyShared& part) {
                return part.faces.a == pair_.a && part.faces.b == pair_.b &&
                       Faces(part.faces.face_a, part.faces.face_b) == faces;
            };
            if (std::ranges::any_of(common.partly, is_these)) {
                refuse_parted(faces, overlap);
                continue;
            }
            NearMiss miss{pair_.a, pair_.b, faces.first, faces.second, std::nullopt};
            miss.least = overlap.least;
            miss.reach_in = overlap.depth > overlap.gap;
            miss.width = std::max(overlap.depth, overlap.gap);
            miss.area = overlap.a.within;
            describe(miss);
            const bool hinged = overlap.least <= pair_.tolerance && !is_curved(faces) &&
                                have_common_edge(one_.volume->model, faces.first, other_.volume->model,
                                                 faces.second, pair_.tolerance);
            if (hinged)
                throw InvalidInput(message_of(miss, "assembly.crack",
                                              ". They share an edge, along which the mesh would crack"));
            if (miss.reach_in && overlap.depth > limit_of(faces))
                throw InvalidInput(
                    message_of(miss, "assembly.overlap", ". Volumes of an assembly may touch, not overlap"));
            near_.insert(faces);
            found.push_back(std::move(miss));
        }
    }

    /// Find edges of either member that run close to faces of the other.
    void find_edges(std::vector<NearMiss>& found, const RunContext& context)
    {
        find_edges(pair_.a, one_, pair_.b, other_, found, context);
        find_edges(pair_.b, other_, pair_.a, one_, found, context);
    }

private:
    using Faces = std::pair<FaceId, FaceId>;

    [[nodiscard]] double limit_of(const Faces& faces) const
    {
        return pair_.tolerance + sag_[pair_.a][faces.first.index()] + sag_[pair_.b][faces.second.index()];
    }
    [[nodiscard]] bool is_curved(const Faces& faces) const { return limit_of(faces) > pair_.tolerance; }

    [[nodiscard]] bool stays_near(const Faces& faces, const FaceOverlap& overlap) const
    {
        // Faces that share only an edge are near each other over an area of rounding errors.
        if (!(overlap.a.within >= kStaysNear * overlap.a.around) ||
            !(overlap.a.within > pair_.tolerance * pair_.tolerance))
            return false;
        if (overlap.a.within > pair_.window * overlap.box.diagonal().norm()) return true;
        return overlap.a.within >= kPart * face_area(one_.volume->model, faces.first) ||
               overlap.b.within >= kPart * face_area(other_.volume->model, faces.second);
    }

    /// Refuse two faces that coincide in part and are slightly apart elsewhere.
    void refuse_parted(const Faces& faces, const FaceOverlap& overlap) const
    {
        if (is_curved(faces) || overlap.a.within - overlap.a.on <= kPart * overlap.a.within) return;
        const double width = std::max(overlap.gap, overlap.depth);
        throw InvalidInput(Message("assembly.crack",
                                   "{} of {} and {} of {} coincide in part and are up to {:.2g} apart "
                                   "elsewhere, at {}, so the two meshes would leave a crack",
                                   entity_in(one_, faces.first), one_.region, entity_in(other_, faces.second),
                                   other_.region, found(width), place_in_short(overlap.box.center()))
                               .remedy("give both models tolerance = {:.2g}", needed(joining(faces, width))));
    }

    [[nodiscard]] double joining(const Faces& faces, double width) const
    {
        const Model &a = one_.volume->model, &b = other_.volume->model;
        const auto overlap = pair_.overlaps.find(faces);
        const bool whole = overlap != pair_.overlaps.end() &&
                           overlap->second.a.within >= (1 - kPart) * face_area(a, faces.first) &&
                           overlap->second.b.within >= (1 - kPart) * face_area(b, faces.second);
        // The corners of parts that were split off faces were moved onto the other face and then along its
        // rim, each time within the tolerance.
        return joining_tolerance(a, std::max(whole ? width : std::numbers::sqrt2 * width,
                                             corners_apart(a, faces.first, b, faces.second, width)));
    }

    void describe(NearMiss& miss) const
    {
        const Faces faces{miss.face_a, miss.face_b};
        miss.tag_a = one_.volume->model[miss.face_a].tag;
        miss.tag_b = other_.volume->model[miss.face_b].tag;
        miss.tolerance = joining(faces, miss.width);
        if (miss.edge) miss.edge_tag = (miss.edge_of == miss.a ? one_ : other_).volume->model[*miss.edge].tag;
        miss.message = message_of(miss, "assembly.near_miss", "");
    }

    /// @param more  text that is appended to the message.
    [[nodiscard]] Message message_of(const NearMiss& miss, const char* code, const char* more) const
    {
        const bool of_b = miss.edge && miss.edge_of == miss.b;
        const AssemblyMember &first = of_b ? other_ : one_, &second = of_b ? one_ : other_;
        return Message(code,
                       "{} of {} and {} of {} {} {:.2g} over {} of {:.2g} and share no nodes there; the "
                       "tolerance is "
                       "{:.2g}{}",
                       miss.edge ? entity_in(first, *miss.edge) : entity_in(first, miss.face_a), first.region,
                       entity_in(second, of_b ? miss.face_a : miss.face_b), second.region,
                       miss.reach_in ? "reach into each other by up to" : "come within", found(miss.width),
                       miss.edge ? "a length" : "an area", miss.edge ? miss.length : miss.area,
                       pair_.tolerance, more)
            .remedy("to join them give both models tolerance = {:.2g}", needed(miss.tolerance));
    }

    void find_edges(std::size_t own, const AssemblyMember& of, std::size_t there, const AssemblyMember& at,
                    std::vector<NearMiss>& found, const RunContext& context)
    {
        const Model &model = of.volume->model, &other = at.volume->model;
        const surface::FacetSet facets = surface::facet_set(other, all_faces(other));
        std::optional<geometry::FacetTree> tree;
        Eigen::AlignedBox3d box;
        for (const Vec3& p : other.points) box.extend(p);
        const double around = kAround * pair_.window;
        box.min().array() -= around;
        box.max().array() += around;
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            check_cancelled(context);
            const std::span<const FaceUse> uses = model.uses_of_edge(EdgeId(e));
            const std::vector<Vec3> line = surface::edge_line(model, EdgeId(e));
            Eigen::AlignedBox3d own_box;
            for (const Vec3& p : line) own_box.extend(p);
            if (!box.intersects(own_box) || uses.empty()) continue;
            const bool taken = std::ranges::any_of(uses, [&](const FaceUse& use) {
                return shared_[own][use.face.index()] || is_near(own, use.face);
            });
            if (taken) continue;
            if (!tree) tree.emplace(other.points, facets.triangles);
            const std::vector<double> arc = geometry::arc_lengths(line);
            const double sag = geometry::sag(line);
            double within = 0, most = 0, all = 0, least = kInfinity;
            FaceId nearest;
            for (int i = 0; i < kFineChords; ++i) {
                const Vec3 p = geometry::point_at(line, arc, arc.back() * (i + 0.5) / kFineChords);
                const auto hit = tree->closest(p, around * around);
                if (hit.triangle < 0) continue;
                const FaceId face = facets.face[index(hit.triangle)];
                const double distance = std::sqrt(hit.distance2);
                all += arc.back() / kFineChords;
                if (distance > pair_.window || shared_[there][face.index()] ||
                    distance <= pair_.tolerance + sag + sag_[there][face.index()])
                    continue;
                within += arc.back() / kFineChords;
                if (distance < least) nearest = face;
                least = std::min(least, distance);
                most = std::max(most, distance);
            }
            if (!(within > 0) || within < kStaysNear * all ||
                (within < kAround * pair_.window && within < kPart * arc.back()))
                continue;
            const FaceId face = uses.front().face;
            const bool of_a = own == pair_.a;
            NearMiss miss{pair_.a, pair_.b, of_a ? face : nearest, of_a ? nearest : face, EdgeId(e)};
            miss.edge_of = own;
            miss.least = least;
            miss.width = most;
            miss.length = within;
            describe(miss);
            found.push_back(std::move(miss));
        }
    }

    /// Whether a face of a member is in a near miss with a face of the other member.
    [[nodiscard]] bool is_near(std::size_t member, FaceId face) const
    {
        return std::ranges::any_of(near_, [&](const Faces& faces) {
            return (member == pair_.a ? faces.first : faces.second) == face;
        });
    }

    const NearPair& pair_;
    const AssemblyMember &one_, &other_;
    std::span<const std::vector<double>> sag_;
    /// For each face of each member, whether it is shared with some member.
    const std::vector<std::vector<bool>>& shared_;
    std::set<Faces> near_;
};

} // namespace

double pair_tolerance(const AssemblyMember& a, const AssemblyMember& b)
{
    return std::max(a.volume->model.tolerance, b.volume->model.tolerance);
}

double near_window(const AssemblyMember& a, const AssemblyMember& b)
{
    const double tolerance = pair_tolerance(a, b);
    const double smaller = std::min(a.volume->model.diagonal, b.volume->model.diagonal);
    // CAD kernels leave gaps up to a share kVisible of a model, whose tolerance is kFileAccuracy by default.
    // A gap wider than half of the largest tolerance that a model can have is intended.
    return std::max(tolerance, std::min(kVisible / kFileAccuracy * tolerance, kMostTolerance / 2 * smaller));
}

double corners_apart(const Model& a, FaceId face_a, const Model& b, FaceId face_b, double at_least)
{
    double apart = 0;
    const std::vector<Vec3> own = corners_of(a, face_a), others = corners_of(b, face_b);
    const auto add = [&](const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
        for (const Vec3& p : from) {
            double nearest = kInfinity;
            for (const Vec3& q : to) nearest = std::min(nearest, (p - q).norm());
            // At corners of 30°, vertices are nearly four times as far apart as the sides.
            if (nearest <= kAround * at_least) apart = std::max(apart, nearest);
        }
    };
    add(own, others);
    add(others, own);
    return apart;
}

double joining_tolerance(const Model& model, double width)
{
    Gap gap;
    gap.width = width;
    return sewing_tolerance(model, gap);
}

std::vector<NearMiss> near_misses(std::span<const AssemblyMember> members,
                                  std::span<const std::vector<double>> sag, std::span<const NearPair> pairs,
                                  const FacesInCommon& common, const RunContext& context)
{
    std::vector<std::vector<bool>> shared;
    for (const AssemblyMember& member : members)
        shared.emplace_back(member.volume->model.faces.size(), false);
    for (const SharedFace& face : common.whole) {
        shared[face.a][face.face_a.index()] = true;
        shared[face.b][face.face_b.index()] = true;
    }
    std::vector<NearMiss> found;
    for (const NearPair& pair : pairs) {
        check_cancelled(context);
        PairSearch search(members, sag, pair, shared);
        search.find_faces(common, found);
        search.find_edges(found, context);
    }
    return found;
}

} // namespace lacuna::sweep
