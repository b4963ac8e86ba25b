// SPDX-License-Identifier: MIT
#include <lacuna/core/edge_key.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/facet_tree.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/assembly_imprint.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/side_points.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <unordered_map>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Share of a face by which another may be off it and still be the same: rounding of the facets' rims.
constexpr double kWhole = 0.999;
/// Faces that share less touch along their rims.
constexpr double kNothing = 1e-3;
/// Facets are asked at the centres of this many parts of each side: a face of two facets, half covered, is
/// seen to be.
constexpr int kParts = 6;
/// Points of one rim may be off the chords of another by this times their sag: it is an estimate.
constexpr double kRimSag = 1.5;
/// Of a curved face, where facets of either fineness leave the rim to each other.
constexpr double kWholeCurved = 0.98;
/// A place is above a facet where the way from its foot is along the facet's normal by this cosine.
constexpr double kAbove = 0.7;
/// Faces that touch along a rim and bend away are within their facets' own error for less than this share.
constexpr double kAlongRim = 0.5;
/// Places nearer to a volume's skin than this part of its diagonal are on it: facets of curved faces differ.
constexpr double kInside = 5e-3;
/// A face is asked at about this many places in all; more facets are asked at fewer places each.
constexpr std::size_t kPlaces = 4000;

/// A face ready to be compared.
struct Side {
    const OpenVolume* volume = nullptr;
    FaceId face;
    Eigen::AlignedBox3d box;
    double sag = 0; ///< how far the facets may be off what they stand for [model length]
    std::shared_ptr<geometry::FacetTree> tree;

    [[nodiscard]] const Model& model() const { return volume->model; }
    [[nodiscard]] const Face& face_data() const { return model()[face]; }
    const geometry::FacetTree& facets()
    {
        if (!tree) tree = std::make_shared<geometry::FacetTree>(model().points, face_data().triangles);
        return *tree;
    }
};

Vec3 area_of(const Model& model, const Triangle& t)
{
    return (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0])) / 2;
}

/// Facets that bend by an angle where they meet stand for an arc that is off them by about an eighth of it,
/// times their height over the side they share.
double sag_of(const Model& model, const Face& face)
{
    double sag = 0;
    std::unordered_map<std::uint64_t, std::size_t> beside;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = face.triangles[t][k], b = face.triangles[t][(k + 1) % 3];
            const auto [other, fresh] = beside.emplace(edge_key(a, b), t);
            if (fresh) continue;
            const Vec3 m = area_of(model, face.triangles[t]),
                       n = area_of(model, face.triangles[other->second]);
            const double side = (model.at(b) - model.at(a)).norm();
            if (!(m.norm() > 0) || !(n.norm() > 0) || !(side > 0)) continue;
            const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
            sag = std::max(sag, angle / 8 * 2 * std::max(m.norm(), n.norm()) / side);
        }
    }
    return sag;
}

/// How much of a face lies on another, and how much of that faces the same way.
struct Cover {
    double share = 0, same_way = 0;
};

Cover cover_of(Side& one, Side& other, double limit, const RunContext& context)
{
    const Model& model = one.model();
    const std::vector<Triangle>& triangles = one.face_data().triangles;
    int parts = kParts;
    while (parts > 1 && triangles.size() * static_cast<std::size_t>(parts * parts) > kPlaces) --parts;
    const std::size_t step = std::max<std::size_t>(1, triangles.size() / kPlaces);
    const double tolerance = std::max(model.tolerance, other.model().tolerance);
    double all = 0, on = 0, same = 0;
    for (std::size_t t = 0; t < triangles.size(); t += step) {
        check_cancelled(context);
        const Triangle& facet = triangles[t];
        const Vec3 area = area_of(model, facet);
        const double each = area.norm() / (parts * parts);
        for (int i = 0; i < parts; ++i) {
            for (int j = 0; j < 2 * (parts - i) - 1; ++j) {
                // Centres of the parts of a facet divided evenly, those upright and those turned over.
                const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
                const double u = (i + third) / parts, v = (j / 2 + third) / parts;
                const Vec3 p = (1 - u - v) * model.at(facet[0]) + u * model.at(facet[1]) +
                               v * model.at(facet[2]);
                all += each;
                const auto hit = other.facets().closest(p, limit * limit);
                if (hit.triangle < 0) continue;
                // Beside the rim of a face is not on it, however near.
                const Vec3 there = area_of(other.model(), other.face_data().triangles[index(hit.triangle)]);
                const Vec3 off = p - hit.point;
                if (off.norm() > tolerance && std::abs(off.dot(there)) < kAbove * off.norm() * there.norm())
                    continue;
                on += each;
                if (area.dot(there) > 0) same += each;
            }
        }
    }
    return {all > 0 ? on / all : 0, on > 0 ? same / on : 0};
}

/// Whether the loops of a face run along those of another.
bool rim_lies_on(const Side& one, const Side& other, double tolerance)
{
    const auto points_of = [](const Side& side) {
        std::vector<std::vector<Index>> loops;
        for (const Loop& loop : border_loops(side.model(), side.face)) {
            std::vector<Index>& points = loops.emplace_back();
            for (const EdgeUse& use : loop.uses) {
                const std::vector<Index> along = use_points(side.model(), use);
                points.insert(points.end(), along.begin(), along.end());
            }
        }
        return loops;
    };
    const std::vector<std::vector<Index>> there = points_of(other);
    double sag = 0;
    for (const std::vector<Index>& chain : there) {
        std::vector<Vec3> line;
        for (const Index point : chain) line.push_back(other.model().at(point));
        sag = std::max(sag, geometry::sag(line));
    }
    const double slack = tolerance + kRimSag * sag;
    for (const std::vector<Index>& loop : points_of(one)) {
        for (const Index point : loop) {
            const Vec3& p = one.model().at(point);
            const bool near = std::ranges::any_of(there, [&](const std::vector<Index>& chain) {
                for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                    const Vec3 &a = other.model().at(chain[i]), &b = other.model().at(chain[i + 1]);
                    const double f = fraction_along(p, a, b);
                    if ((p - ((1 - f) * a + f * b)).norm() <= slack) return true;
                }
                return false;
            });
            if (!near) return false;
        }
    }
    return true;
}

std::string named(const AssemblyMember& member, FaceId face)
{
    return name_of(member.volume->model, face) + " of " + member.region;
}

bool is_void(const Side& side) { return side.face_data().origin == Origin::made_void; }

/// Whether faces within two boxes can share more than a line: the boxes do where each is widened by a limit.
bool share_area(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b, double limit)
{
    const Vec3 common = (a.max().cwiseMin(b.max()) - a.min().cwiseMax(b.min())).array() + limit;
    return common.minCoeff() >= 0 && (common.array() > 2 * limit).count() > 1;
}

/// What two faces of two members have in common.
struct InCommon {
    bool any = false, whole = false;
    double limit = 0;  ///< how far the facets may be off each other
    std::string words; ///< of a part
};

/// Refuses two volumes on the same side of a face.
InCommon in_common(const AssemblyMember& a, Side& one, const AssemblyMember& b, Side& other,
                   const RunContext& context)
{
    const double tolerance = std::max(a.volume->model.tolerance, b.volume->model.tolerance);
    const double limit = tolerance + one.sag + other.sag;
    if (!share_area(one.box, other.box, limit)) return {};
    // A face that was made where none was given is the one that is given there.
    bool same = (is_void(one) || is_void(other)) && rim_lies_on(one, other, tolerance) &&
                rim_lies_on(other, one, tolerance);
    const Cover there = cover_of(one, other, limit, context), back = cover_of(other, one, limit, context);
    std::string words;
    if (!same) {
        if (there.share <= kNothing && back.share <= kNothing) return {};
        const double whole = limit > tolerance ? kWholeCurved : kWhole;
        same = there.share >= whole && back.share >= whole;
        // Faces that bend away from each other along a common rim are near each other there, and no more.
        if (!same && limit > tolerance && std::max(there.share, back.share) < kAlongRim) return {};
        const auto percent = [](double share) {
            std::array<char, 32> text{};
            std::snprintf(text.data(), text.size(), "%.3g %%", 100 * share);
            return std::string(text.data());
        };
        words = percent(there.share) + " of " + named(a, one.face) + " lies on " + named(b, other.face) +
                ", and " + percent(back.share) + " of that on it";
    }
    if (std::max(there.same_way, back.same_way) > 0.5)
        throw InvalidInput("assembly.overlap", named(a, one.face) + " and " + named(b, other.face) +
                                                   " are one face, and both volumes lie on the same side of "
                                                   "it: volumes of an assembly may touch, not overlap");
    return {true, same, limit, std::move(words)};
}

/// Facets of a volume of which the middles are asked whether they are within another.
constexpr std::size_t kAsked = 64;

/// Refuse a volume some of whose skin is within another's; what is within one that is open no one can say.
void check_apart(const AssemblyMember& a, const Eigen::AlignedBox3d& box_of_a, const AssemblyMember& b,
                 const Eigen::AlignedBox3d& box_of_b)
{
    const double inside_by = kInside * b.volume->model.diagonal;
    const Eigen::AlignedBox3d inner(box_of_b.min().array() + inside_by, box_of_b.max().array() - inside_by);
    if (inner.isEmpty() || !inner.intersects(box_of_a) || !free_edges(*b.volume).empty()) return;
    const auto facets_of = [](const OpenVolume& volume) {
        std::vector<Triangle> facets;
        for (const Face& face : volume.model.faces)
            facets.insert(facets.end(), face.triangles.begin(), face.triangles.end());
        return facets;
    };
    const Model& model = a.volume->model;
    const std::vector<Triangle> own = facets_of(*a.volume), others = facets_of(*b.volume);
    const geometry::FacetTree tree(b.volume->model.points, others);
    const std::size_t step = std::max<std::size_t>(1, own.size() / kAsked);
    for (std::size_t t = 0; t < own.size(); t += step) {
        const Vec3 p = (model.at(own[t][0]) + model.at(own[t][1]) + model.at(own[t][2])) / 3;
        if (!tree.bounds().contains(p) || tree.closest(p, inside_by * inside_by).triangle >= 0) continue;
        if (std::abs(tree.winding_number(p)) < 0.5) continue;
        throw InvalidInput("assembly.overlap", a.region + " reaches into " + b.region + " at " +
                                                   place_in_short(p) +
                                                   ": volumes of an assembly may touch, not overlap");
    }
}

} // namespace

FacesInCommon faces_in_common(std::span<const AssemblyMember> members, const RunContext& context)
{
    std::vector<std::vector<Side>> sides(members.size());
    std::vector<Eigen::AlignedBox3d> box(members.size());
    for (std::size_t m = 0; m < members.size(); ++m) {
        const OpenVolume& volume = *members[m].volume;
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
            Side side{&volume, FaceId(f), {}, sag_of(volume.model, volume.model.faces[f]), nullptr};
            for (const Triangle& t : volume.model.faces[f].triangles) {
                for (const Index p : t) side.box.extend(volume.model.at(p));
            }
            box[m].extend(side.box);
            sides[m].push_back(std::move(side));
        }
    }
    FacesInCommon found;
    for (std::size_t a = 0; a < members.size(); ++a) {
        for (std::size_t b = a + 1; b < members.size(); ++b) {
            const double margin = 1e-3 * (box[a].diagonal().norm() + box[b].diagonal().norm());
            if (!Eigen::AlignedBox3d(box[a].min().array() - margin, box[a].max().array() + margin)
                     .intersects(box[b]))
                continue;
            check_apart(members[a], box[a], members[b], box[b]);
            check_apart(members[b], box[b], members[a], box[a]);
            for (Side& one : sides[a]) {
                for (Side& other : sides[b]) {
                    InCommon common = in_common(members[a], one, members[b], other, context);
                    if (!common.any) continue;
                    const SharedFace faces{a, b, one.face, other.face};
                    if (common.whole)
                        found.whole.push_back(faces);
                    else
                        found.partly.push_back({faces, common.limit, std::move(common.words)});
                }
            }
        }
    }
    return found;
}

std::vector<SharedFace> shared_faces(std::span<const AssemblyMember> members, const RunContext& context)
{
    FacesInCommon found = faces_in_common(members, context);
    if (!found.partly.empty())
        throw InvalidInput("assembly.part_of_face",
                           found.partly.front().words +
                               ": a face must be shared as a whole; split it along the other's rim");
    return std::move(found.whole);
}

} // namespace lacuna::sweep
