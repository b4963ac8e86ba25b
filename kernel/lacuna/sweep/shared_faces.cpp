// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/near_misses.h>
#include <lacuna/sweep/detail/rim_arcs.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/facet_sag.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Two faces whose rims agree are the same face if at least this share of each lies on the other. Coverage
/// may be incomplete: coarse chords of a rim cut off parts of a flat face, and facets of different fineness
/// leave gaps next to the rim of a curved face. If two faces touch along a rim and curve away from each
/// other, less than this share of either face is closer to the other face than the error of the facets.
constexpr double kMostly = 0.5;

/// A face prepared for comparison.
struct Side {
    const OpenVolume* volume = nullptr;
    FaceId face;
    Eigen::AlignedBox3d box;
    double sag = 0; ///< estimated maximum distance of the facets from the true surface [model length]

    [[nodiscard]] const Model& model() const { return volume->model; }
    [[nodiscard]] const Face& face_data() const { return model()[face]; }
};

/// The points of each of a face's loops, as a chain.
std::vector<std::vector<Vec3>> chains_of(const Side& side)
{
    std::vector<std::vector<Vec3>> chains;
    for (const Loop& loop : border_loops(side.model(), side.face)) {
        std::vector<Vec3>& chain = chains.emplace_back();
        for (const EdgeUse& use : loop.uses)
            for (const Index p : use_points(side.model(), use)) chain.push_back(side.model().at(p));
    }
    return chains;
}

/// Maximum distance of one rim from another rim, and the place where it occurs.
struct RimOff {
    double distance = 0;
    Vec3 place = Vec3::Zero();
    double sag = 0; ///< sag of the other rim
};

RimOff rim_off(const Side& one, const Side& other)
{
    RimOff off;
    const std::vector<std::vector<Vec3>> there = chains_of(other);
    for (const std::vector<Vec3>& chain : there) off.sag = std::max(off.sag, geometry::sag(chain));
    for (const std::vector<Vec3>& chain : chains_of(one)) {
        for (const Vec3& p : chain) {
            double nearest = kInfinity;
            for (const std::vector<Vec3>& line : there)
                nearest = std::min(nearest, closest_on(line, p).distance);
            if (nearest > off.distance) {
                off.distance = nearest;
                off.place = p;
            }
        }
    }
    return off;
}

/// Whether the loops of one face lie on those of another.
bool rim_lies_on(const Side& one, const Side& other, double tolerance)
{
    const RimOff off = rim_off(one, other);
    return off.distance <= tolerance + (1 + kArcError) * off.sag;
}

bool is_void(const Side& side) { return side.face_data().origin == Origin::made_void; }

/// Whether the faces in two boxes can share more than a line. This is so if the boxes overlap after each is
/// widened by a limit.
bool share_area(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double limit)
{
    const Vec3 common = (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).array() + limit;
    return common.minCoeff() >= 0 && (common.array() > 2 * limit).count() > 1;
}

/// The relation of two faces of two members.
struct InCommon {
    bool any = false, whole = false;
    double limit = 0; ///< maximum distance between facets of one surface in the two members
    /// The error for this pair: a face is shared only in part or, if no face is shared, the volumes overlap.
    std::optional<Message> refusal;
    bool same_side = false; ///< both volumes are on the same side of the common face
    double apart = 0;       ///< if the faces are the same: distance between the arcs of both rims
    double sag = 0;         ///< maximum distance of the rims' chords from these arcs
};

/// Compare the rims of a face that two members share.
/// @return  true if the rims agree, at least within the sag of their chords; false if they are farther apart
///          than `window`.
/// @throw InvalidInput "assembly.rims_apart"  the distance of the rims is between these limits.
bool rims_agree(const AssemblyMember& a, const Side& one, const AssemblyMember& b, const Side& other,
                double tolerance, double window, InCommon& common)
{
    RimOff off = rim_off(one, other);
    const RimOff back = rim_off(other, one);
    // If a rim was projected onto facets, its distance from its curve is that of these facets.
    const double slack = std::max(tolerance + (1 + kArcError) * std::max(off.sag, back.sag), common.limit);
    if (back.distance > off.distance) off = back;
    if (off.distance <= tolerance) return true;
    const double by_arcs = arcs_apart(rim_chords(one.model(), one.face),
                                      rim_chords(other.model(), other.face));
    if (by_arcs <= tolerance) return true;
    if (off.distance <= slack) {
        common.apart = by_arcs;
        common.sag = std::max(off.sag, back.sag);
        return true;
    }
    if (off.distance > window) return false;
    const double apart = corners_apart(one.model(), one.face, other.model(), other.face, off.distance);
    throw InvalidInput(
        Message("assembly.rims_apart",
                "{} of {} and {} of {} are one face, but their rims are {:.2g} apart at {}, more than the "
                "tolerance, {:.2g}",
                entity_in(a, one.face), a.region, entity_in(b, other.face), b.region, found(off.distance),
                place_in_short(off.place), tolerance)
            .remedy("give both models tolerance = {:.2g}",
                    needed(joining_tolerance(one.model(), std::max(apart, off.distance)))));
}

/// @param overlap  null: no part of one face is near the other
InCommon in_common(const AssemblyMember& a, const Side& one, const AssemblyMember& b, const Side& other,
                   const FaceOverlap* overlap, double tolerance, double window, MayOverlap may_overlap)
{
    const double limit = tolerance + one.sag + other.sag;
    if (!share_area(one.box, other.box, limit)) return {};
    // A void face is the same face as a neighbour's given face with the same rim.
    bool same = (is_void(one) || is_void(other)) && rim_lies_on(one, other, tolerance) &&
                rim_lies_on(other, one, tolerance);
    if (!same && overlap == nullptr) return {};
    InCommon common;
    common.limit = limit;
    common.same_side = overlap != nullptr && overlap->a.same_way > 0.5 * overlap->a.on;
    const bool refused = common.same_side && may_overlap == MayOverlap::no;
    const NamedEntity entity_a = entity_in(a, one.face), entity_b = entity_in(b, other.face);
    double percent_a = 0, percent_b = 0;
    if (!same) {
        const double whole = face_area(one.model(), one.face),
                     whole_other = face_area(other.model(), other.face);
        const double there = overlap->a.on / whole, back = overlap->b.on / whole_other;
        if (there <= kVisible && back <= kVisible) return {};
        // The two faces may lie on opposite sides of one curve, which they approximate by different chords.
        if (std::max(there, back) < kMostly) {
            const double under = area_under_arcs(rim_chords(one.model(), one.face),
                                                 rim_chords(other.model(), other.face), tolerance);
            if (overlap->a.on <= under + kVisible * std::min(whole, whole_other)) return {};
        }
        same = there >= kMostly && back >= kMostly && !refused &&
               rims_agree(a, one, b, other, tolerance, window, common);
        // Faces that touch along a common rim and curve away from each other are close only along that rim.
        if (!same && limit > tolerance && std::max(there, back) < kMostly) return {};
        percent_a = 100 * std::min(there, 1.0);
        percent_b = 100 * std::min(back, 1.0);
        common.refusal = Message("assembly.part_of_face",
                                 "{:.3g} % of {} of {} and {:.3g} % of {} of {} coincide, but volumes can "
                                 "only share whole faces",
                                 found(percent_a), entity_a, a.region, found(percent_b), entity_b, b.region)
                             .remedy("split one of these faces along the rim of the other");
    }
    if (refused) {
        const bool part = common.refusal &&
                          std::max(overlap->a.on / face_area(one.model(), one.face),
                                   overlap->b.on / face_area(other.model(), other.face)) < kMostly;
        constexpr const char* kCode = "assembly.overlap";
        common.refusal =
            (part ? Message(kCode,
                            "{:.3g} % of {} of {} lies on {} of {}, and {:.3g} % of that face on the first, "
                            "with both volumes on the same side",
                            found(percent_a), entity_a, a.region, entity_b, b.region, found(percent_b))
                  : Message(kCode, "{} of {} and {} of {} are one face, with both volumes on the same side",
                            entity_a, a.region, entity_b, b.region))
                .remedy("separate the volumes: they may touch, but not overlap");
        return common;
    }
    common.any = true;
    common.whole = same;
    return common;
}

/// Report a shared face whose rims agree within the sag of their chords, but do not lie on one curve. Its
/// meshes have no gap.
NearMiss welded(const AssemblyMember& a, const AssemblyMember& b, const SharedFace& faces,
                const InCommon& common, double area, double tolerance)
{
    NearMiss miss;
    miss.a = faces.a;
    miss.b = faces.b;
    miss.face_a = faces.face_a;
    miss.face_b = faces.face_b;
    miss.tag_a = a.volume->model[faces.face_a].tag;
    miss.tag_b = b.volume->model[faces.face_b].tag;
    miss.least = miss.width = common.apart;
    miss.area = area;
    miss.tolerance = tolerance;
    miss.message = Message("assembly.near_miss",
                           "{} of {} and {} of {} are treated as one face: their rims are {:.2g} apart, "
                           "above the tolerance of {:.2g}, but their chords deviate from the curve by up to "
                           "{:.2g}, which may hide a gap or an overlap",
                           entity_in(a, faces.face_a), a.region, entity_in(b, faces.face_b), b.region,
                           found(common.apart), tolerance, common.sag)
                       .remedy("use finer facets");
    return miss;
}

/// A tree of a volume's facets. The tree is empty if the volume has free edges.
geometry::FacetTree closed_skin(const OpenVolume& volume)
{
    if (!free_edges(volume).empty()) return {};
    return {volume.model.points, facets_of(volume.model, all_faces(volume.model))};
}

/// Refuse a volume if part of its skin is inside another volume, deeper than `depth` and than the errors of
/// both volumes' facets explain. An open volume has no inside and is not checked.
/// @param skin_of_b  see `closed_skin()`; computed when first needed
void check_apart(const AssemblyMember& a, std::span<const Side> sides_of_a,
                 const Eigen::AlignedBox3d& box_of_a, const AssemblyMember& b,
                 std::span<const Side> sides_of_b, const Eigen::AlignedBox3d& box_of_b,
                 std::optional<geometry::FacetTree>& skin_of_b, double depth)
{
    const Eigen::AlignedBox3d inner(box_of_b.min().array() + depth, box_of_b.max().array() - depth);
    if (inner.isEmpty() || !inner.intersects(box_of_a)) return;
    if (!skin_of_b) skin_of_b = closed_skin(*b.volume);
    const geometry::FacetTree& tree = *skin_of_b;
    const auto is_far = [&](const Vec3& p, double sag) {
        double by = depth + sag;
        for (const Side& side : sides_of_b) {
            const double reach = depth + sag + side.sag;
            if (side.box.squaredExteriorDistance(p) <= reach * reach) by = std::max(by, reach);
        }
        return tree.bounds().contains(p) && tree.closest(p, by * by).triangle < 0;
    };
    const auto refuse_inside = [&](const Vec3& p) {
        if (std::abs(tree.winding_number(p)) < 0.5) return;
        throw InvalidInput(
            Message("assembly.overlap",
                    "{} reaches into {} at {}: volumes of an assembly may touch, but not overlap", a.region,
                    b.region, place_in_short(p))
                .remedy("move or cut one of them in the CAD system"));
    };
    const Model& model = a.volume->model;
    const auto corners = [](const Model& of, const Triangle& t) {
        return std::array{of.at(t[0]), of.at(t[1]), of.at(t[2])};
    };
    std::vector<Triangle> own;
    std::vector<double> sag; // for each facet of `own`, the sag of its face
    for (const Side& side : sides_of_a) {
        std::ranges::copy_if(side.face_data().triangles, std::back_inserter(own), [&](const Triangle& t) {
            Eigen::AlignedBox3d box;
            for (const Vec3& corner : corners(model, t)) box.extend(corner);
            return tree.may_meet(box);
        });
        sag.resize(own.size(), side.sag);
    }
    // A facet may run through the other volume from side to side. The middle of the lines in which it crosses
    // the other skin, weighted by their lengths, is then inside.
    std::vector<Vec3> middle(own.size(), Vec3::Zero());
    std::vector<double> length(own.size(), 0);
    const std::vector<Triangle> theirs = facets_of(b.volume->model, all_faces(b.volume->model));
    geometry::FacetTree(model.points, own).overlaps(tree, [&](Index t, Index other) {
        const auto line = geometry::crossing_line(
            corners(model, own[index(t)]), corners(b.volume->model, theirs[index(other)]), model.tolerance);
        if (!line) return true;
        const double long_by = ((*line)[1] - (*line)[0]).norm();
        middle[index(t)] += long_by * ((*line)[0] + (*line)[1]) / 2;
        length[index(t)] += long_by;
        return true;
    });
    // Other facets that are connected and far from the other skin are all inside or all outside.
    geometry::UnionFind sets(model.points.size());
    std::vector<std::pair<Index, Vec3>> far; // a corner and the middle of each such facet
    for (std::size_t t = 0; t < own.size(); ++t) {
        const auto [p, q, r] = corners(model, own[t]);
        const Vec3 place = length[t] > 0 ? Vec3(middle[t] / length[t]) : (p + q + r) / 3;
        if (!is_far(place, sag[t])) continue;
        if (length[t] > 0) {
            refuse_inside(place);
            continue;
        }
        far.emplace_back(own[t][0], place);
        for (const Index corner : own[t]) sets.unite_least(index(own[t][0]), index(corner));
    }
    std::set<std::size_t> seen;
    for (const auto& [corner, place] : far)
        if (seen.insert(sets.find(index(corner))).second) refuse_inside(place);
}

/// The faces of all members, prepared for comparison.
struct MemberSides {
    std::vector<std::vector<Side>> sides;
    std::vector<Eigen::AlignedBox3d> box;
    std::vector<std::optional<geometry::FacetTree>> skin; ///< see `closed_skin()`; computed when first needed

    /// @param sag  the sag of the first faces of each member; the sag of the other faces is appended.
    MemberSides(std::span<const AssemblyMember> members, std::vector<std::vector<double>>& sag)
        : sides(members.size()), box(members.size()), skin(members.size())
    {
        sag.resize(members.size());
        for (std::size_t m = 0; m < members.size(); ++m) {
            const OpenVolume& volume = *members[m].volume;
            for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
                if (f == sag[m].size()) sag[m].push_back(facet_sag(volume.model, volume.model.faces[f]));
                sides[m].push_back({&volume, FaceId(f), box_of(volume.model, FaceId(f)), sag[m][f]});
                box[m].extend(sides[m].back().box);
            }
        }
    }

    [[nodiscard]] bool are_near(std::size_t a, std::size_t b, double distance) const
    {
        const double margin = std::max(distance,
                                       1e-3 * (box[a].diagonal().norm() + box[b].diagonal().norm()));
        return Eigen::AlignedBox3d(box[a].min().array() - margin, box[a].max().array() + margin)
            .intersects(box[b]);
    }
    void check_apart(std::span<const AssemblyMember> members, const NearPair& pair)
    {
        const std::size_t a = pair.a, b = pair.b;
        sweep::check_apart(members[a], sides[a], box[a], members[b], sides[b], box[b], skin[b], pair.window);
        sweep::check_apart(members[b], sides[b], box[b], members[a], sides[a], box[a], skin[a], pair.window);
    }
};

} // namespace

FacesInCommon faces_in_common(std::span<const AssemblyMember> members, const RunContext& context,
                              std::vector<std::vector<double>> sag, MayOverlap may_overlap)
{
    MemberSides all(members, sag);
    const std::vector<std::vector<Side>>& sides = all.sides;
    FacesInCommon found;
    std::optional<Message> same_side;
    std::vector<NearPair> pairs;
    std::vector<NearMiss> hidden;
    for (std::size_t a = 0; a < members.size(); ++a) {
        for (std::size_t b = a + 1; b < members.size(); ++b) {
            NearPair pair{a, b, pair_tolerance(members[a], members[b]), 0, {}};
            pair.window = near_window(members[a], members[b]);
            if (!all.are_near(a, b, kAround * pair.window)) continue;
            if (may_overlap == MayOverlap::no) all.check_apart(members, pair);
            pair.overlaps = face_overlaps(*members[a].volume, sag[a], *members[b].volume, sag[b],
                                          pair.tolerance, pair.window, context);
            for (const Side& one : sides[a]) {
                for (const Side& other : sides[b]) {
                    const auto overlap = pair.overlaps.find({one.face, other.face});
                    InCommon common = in_common(members[a], one, members[b], other,
                                                overlap == pair.overlaps.end() ? nullptr : &overlap->second,
                                                pair.tolerance, pair.window, may_overlap);
                    if (!common.any) {
                        if (!same_side) same_side = std::move(common.refusal);
                        continue;
                    }
                    const SharedFace faces{a, b, one.face, other.face};
                    if (common.same_side) found.same_side.emplace(a, b);
                    if (common.apart > 0)
                        hidden.push_back(welded(members[a], members[b], faces, common, overlap->second.a.on,
                                                pair.tolerance));
                    if (common.whole)
                        found.whole.push_back(faces);
                    else
                        found.partly.push_back({faces, common.limit, std::move(*common.refusal)});
                }
            }
            pairs.push_back(std::move(pair));
        }
    }
    if (may_overlap == MayOverlap::no) found.near = near_misses(members, sag, pairs, found, context);
    found.near.insert(found.near.end(), hidden.begin(), hidden.end());
    if (same_side) throw InvalidInput(*same_side);
    found.sag = std::move(sag);
    return found;
}

void refuse_partly_shared(const FacesInCommon& found)
{
    if (!found.partly.empty()) throw InvalidInput(found.partly.front().refusal);
}

std::vector<FaceContact> faces_in_contact(std::span<const AssemblyMember> members,
                                          const std::function<double(std::size_t a, std::size_t b)>& gap,
                                          const RunContext& context)
{
    std::vector<std::vector<double>> sag;
    MemberSides all(members, sag);
    std::vector<NearPair> pairs;
    // For each face of each member, whether most of it lies on another member.
    std::vector<std::vector<char>> covered;
    for (const AssemblyMember& member : members) covered.emplace_back(member.volume->model.faces.size(), 0);
    const auto area = [&](std::size_t m, FaceId face) { return face_area(members[m].volume->model, face); };
    for (std::size_t a = 0; a < members.size(); ++a)
        for (std::size_t b = a + 1; b < members.size(); ++b) {
            NearPair pair{a, b, pair_tolerance(members[a], members[b]), 0, {}};
            pair.window = std::max(pair.tolerance, gap(a, b));
            if (!all.are_near(a, b, pair.window)) continue;
            if (members[a].glue != members[b].glue) all.check_apart(members, pair);
            pair.overlaps = face_overlaps(*members[a].volume, sag[a], *members[b].volume, sag[b],
                                          pair.tolerance, pair.window, context);
            for (const auto& [faces, overlap] : pair.overlaps) {
                const double opposite = overlap.a.on - overlap.a.same_way;
                if (opposite >= kMostly * area(a, faces.first)) covered[a][faces.first.index()] = 1;
                if (opposite >= kMostly * area(b, faces.second)) covered[b][faces.second.index()] = 1;
            }
            pairs.push_back(std::move(pair));
        }
    std::vector<FaceContact> found;
    for (const NearPair& pair : pairs) {
        const AssemblyMember &a = members[pair.a], &b = members[pair.b];
        if (!a.whole.empty() && a.whole == b.whole) continue;
        for (const auto& [faces, overlap] : pair.overlaps) {
            const double least = std::min(area(pair.a, faces.first), area(pair.b, faces.second));
            const bool touch = overlap.a.on - overlap.a.same_way > kVisible * least;
            const bool hidden = covered[pair.a][faces.first.index()] != 0 ||
                                covered[pair.b][faces.second.index()] != 0;
            if (touch ? a.glue == b.glue : hidden) continue;
            // A strip along a common rim is not a contact, unless the strip covers most of one of the faces.
            const double limit = pair.tolerance + sag[pair.a][faces.first.index()] +
                                 sag[pair.b][faces.second.index()];
            const double strip = std::max(limit, pair.window) * overlap.box.diagonal().norm();
            if (!(overlap.a.within > 0) || (overlap.a.within < kMostly * least && overlap.a.within <= strip))
                continue;
            found.push_back({pair.a, pair.b, faces.first, faces.second, overlap.least,
                             std::max(overlap.gap, overlap.depth), overlap.a.within});
        }
    }
    return found;
}

std::vector<SharedFace> shared_faces(std::span<const AssemblyMember> members, const RunContext& context)
{
    FacesInCommon found = faces_in_common(members, context);
    refuse_partly_shared(found);
    return std::move(found.whole);
}

} // namespace lacuna::sweep
