// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/facet_overlap.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/shared/face_facts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A polygon in a plane, with a height over the plane at each corner. Clipping a triangle by seven lines
/// gives at most ten corners.
class Clipped {
public:
    Clipped(std::span<const Vec3, 3> triangle) : count_(3)
    {
        std::copy(triangle.begin(), triangle.end(), corner_.begin());
    }

    /// Keep the part where way · position >= from.
    void keep(const Vec3& way, double from)
    {
        std::array<Vec3, kMost> kept;
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Vec3 &p = corner_[i], &q = corner_[(i + 1) % count_];
            const double a = way.dot(p) - from, b = way.dot(q) - from;
            if (a >= 0) kept[count++] = p;
            if ((a >= 0) != (b >= 0)) kept[count++] = p + a / (a - b) * (q - p);
        }
        std::copy_n(kept.begin(), count, corner_.begin());
        count_ = count;
    }
    void keep_heights(double most)
    {
        keep(Vec3::UnitZ(), -most);
        keep(-Vec3::UnitZ(), -most);
    }

    [[nodiscard]] double area() const
    {
        double twice = 0;
        for (std::size_t i = 2; i < count_; ++i) {
            const Vec3 u = corner_[i - 1] - corner_[0], v = corner_[i] - corner_[0];
            twice += u.x() * v.y() - u.y() * v.x();
        }
        return std::abs(twice) / 2;
    }
    [[nodiscard]] std::span<const Vec3> corners() const { return {corner_.data(), count_}; }

private:
    static constexpr std::size_t kMost = 12;
    std::array<Vec3, kMost> corner_;
    std::size_t count_;
};

/// Facets of a volume whose boxes overlap a given box, with the face of each facet.
struct NearFacets {
    std::vector<Triangle> facets;
    std::vector<FaceId> face;

    NearFacets(const OpenVolume& volume, const Eigen::AlignedBox3d& box)
    {
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
            for (const Triangle& t : volume.model.faces[f].triangles) {
                Eigen::AlignedBox3d own(volume.model.at(t[0]));
                own.extend(volume.model.at(t[1])).extend(volume.model.at(t[2]));
                if (!box.intersects(own)) continue;
                facets.push_back(t);
                face.emplace_back(f);
            }
        }
    }
    [[nodiscard]] static std::array<Vec3, 3> corners(const Model& model, const Triangle& t)
    {
        return {model.at(t[0]), model.at(t[1]), model.at(t[2])};
    }
};

Eigen::AlignedBox3d box_of(const OpenVolume& volume, double margin)
{
    Eigen::AlignedBox3d box;
    for (const FaceId face : all_faces(volume.model)) box.extend(topology::box_of(volume.model, face));
    box.min().array() -= margin;
    box.max().array() += margin;
    return box;
}

/// Distance limits of one pair of facets, in increasing order.
struct Bounds {
    double limit = 0, window = 0, around = 0;
};

/// Add the part of one facet that a facet of the other face covers.
void add_overlap(const std::array<Vec3, 3>& one, const std::array<Vec3, 3>& other, const Bounds& bounds,
                 FaceOverlap& overlap)
{
    const Vec3 twice = (one[1] - one[0]).cross(one[2] - one[0]);
    const Vec3 twice_other = (other[1] - other[0]).cross(other[2] - other[0]);
    const double size = twice.norm() * twice_other.norm();
    if (!(size > 0)) return;
    const double cosine = twice.dot(twice_other) / size;
    // The facets are adjacent, and neither covers the other. Coarse facets of a curved face differ from fine
    // ones by about 30°.
    if (std::abs(cosine) < kContinues) return;
    const Vec3 up = twice.normalized(), along = (one[1] - one[0]).normalized(), aside = up.cross(along);
    std::array<Vec3, 3> below, above;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = one[k] - one[0], q = other[k] - one[0];
        below[k] = {along.dot(p), aside.dot(p), 0};
        above[k] = {along.dot(q), aside.dot(q), up.dot(q)};
    }
    Clipped piece(above);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = below[(k + 1) % 3] - below[k];
        const Vec3 inward(-side.y(), side.x(), 0);
        piece.keep(inward, inward.dot(below[k]));
        if (piece.corners().empty()) return;
    }
    const auto add = [&](double most, double OverlapAreas::*of) {
        piece.keep_heights(most);
        const double area = piece.area();
        overlap.a.*of += area;
        overlap.b.*of += area / std::abs(cosine);
        return area;
    };
    if (cosine < 0) { // only faces with opposite orientations can be shared by two volumes
        if (!(add(bounds.around, &OverlapAreas::around) > 0)) return;
        if (!(add(bounds.window, &OverlapAreas::within) > 0)) return;
        for (const Vec3& p : piece.corners()) {
            overlap.least = std::min(overlap.least, std::abs(p.z()));
            overlap.gap = std::max(overlap.gap, p.z());
            overlap.depth = std::max(overlap.depth, -p.z());
            overlap.box.extend(Vec3(one[0] + p.x() * along + p.y() * aside));
        }
    }
    if (add(bounds.limit, &OverlapAreas::on) > 0 && cosine > 0) {
        overlap.a.same_way += piece.area();
        overlap.b.same_way += piece.area() / cosine;
    }
}

} // namespace

FaceOverlaps face_overlaps(const OpenVolume& a, std::span<const double> sag_a, const OpenVolume& b,
                           std::span<const double> sag_b, double tolerance, double window,
                           const RunContext& context)
{
    FaceOverlaps overlaps;
    const auto most = [](std::span<const double> sag) {
        return sag.empty() ? 0.0 : *std::ranges::max_element(sag);
    };
    const double margin = std::max(kAround * window, tolerance + most(sag_a) + most(sag_b));
    const NearFacets own(a, box_of(b, margin)), others(b, box_of(a, margin));
    if (own.facets.empty() || others.facets.empty()) return overlaps;
    const geometry::FacetTree tree(a.model.points, own.facets), other_tree(b.model.points, others.facets);
    std::size_t looked = 0;
    tree.overlaps(
        other_tree,
        [&](Index i, Index j) {
            if (++looked % kBetweenPolls == 0) check_cancelled(context);
            const FaceId f = own.face[index(i)], g = others.face[index(j)];
            const double limit = tolerance + sag_a[f.index()] + sag_b[g.index()];
            const Bounds bounds{limit, std::max(limit, window), kAround * std::max(limit, window)};
            add_overlap(NearFacets::corners(a.model, own.facets[index(i)]),
                        NearFacets::corners(b.model, others.facets[index(j)]), bounds, overlaps[{f, g}]);
            return true;
        },
        margin);
    std::erase_if(overlaps, [](const auto& entry) {
        const OverlapAreas& areas = entry.second.a;
        return !(areas.around > 0 || areas.on > 0);
    });
    return overlaps;
}

} // namespace lacuna::sweep
