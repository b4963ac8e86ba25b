// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/row_heights.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/plane_stars.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <cmath>

namespace lacuna::quads::paving {
namespace {

/// The first node inward from a boundary node, and its target position.
struct Post {
    Index foot, top;
    Vec2 inward; ///< unit vector halfway between the directions perpendicular to the two sides
    double height;
};

class RowHeights {
public:
    RowHeights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height)
        : mesh_(mesh), fixed_(region.points.size()), stars_(mesh.points.size(), mesh.quads)
    {
        for (const auto& loop : region.loops) {
            for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
                const Index before = loop[(i + n - 1) % n], here = loop[i], after = loop[(i + 1) % n];
                if (stars_[index(here)].size() != 2) continue;
                const Index top = shared(stars_[index(here)][0], stars_[index(here)][1]);
                if (top < 0 || index(top) < fixed_) continue;
                const Vec2 along = (at(after) - at(here)).normalized() + (at(here) - at(before)).normalized();
                if (along.norm() < 1) continue; // a bend of more than 120°
                const Vec2 unit = along.normalized();
                posts_.push_back({here, top, {-unit.y(), unit.x()}, height(at(here))});
            }
        }
    }

    void run()
    {
        // Maximum number of rounds. Several are needed, because a node may have room only after its
        // neighbours have moved.
        constexpr int kRounds = 4;
        for (int round = 0; round < kRounds; ++round) {
            for (const Post& post : posts_) raise(post);
        }
    }

private:
    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }

    /// The other end of the edge that two neighbouring quads at a node share.
    [[nodiscard]] static Index shared(const Spoke& a, const Spoke& b)
    {
        for (const Index p : {a.next, a.before}) {
            if (p == b.next || p == b.across || p == b.before) return p;
        }
        return -1;
    }

    [[nodiscard]] double worst_at(Index p) const { return worst_quad(mesh_.points, stars_[index(p)], at(p)); }

    void raise(const Post& post)
    {
        // Deviations of the height and along the boundary, up to these shares of the height, are not
        // corrected. With larger values, fewer nodes are moved.
        constexpr double kHeight = 0.2, kLean = 0.2;
        const Vec2 start = at(post.top), arm = start - at(post.foot);
        const Vec2 along(post.inward.y(), -post.inward.x());
        // If the row's height is already within `kRowOffHeight` of the requested height, the correction must
        // not make neighbours worse.
        const bool is_good = std::abs(arm.dot(post.inward) - post.height) <= kRowOffHeight * post.height;
        const double up = std::clamp(arm.dot(post.inward), (1 - kHeight) * post.height,
                                     (1 + kHeight) * post.height);
        const double side = std::clamp(arm.dot(along), -kLean * post.height, kLean * post.height);
        const Vec2 goal = at(post.foot) + up * post.inward + side * along;
        const double before = worst_at(post.top), least = is_good ? before : std::min(before, kGoodQuad);
        for (const double part : {1.0, 0.5, 0.25}) {
            mesh_.points[index(post.top)] = start + part * (goal - start);
            if (worst_at(post.top) >= least) return;
        }
        mesh_.points[index(post.top)] = start;
    }

    PlanarQuads& mesh_;
    std::size_t fixed_;
    Stars stars_;
    std::vector<Post> posts_;
};

} // namespace

void correct_row_heights(PlanarQuads& mesh, const PlanarRegion& region, const SizeField& height)
{
    RowHeights(mesh, region, height).run();
}

} // namespace lacuna::quads::paving
