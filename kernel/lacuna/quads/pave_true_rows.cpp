// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_true_rows.h>

#include <lacuna/quads/detail/partial_mesh.h>

namespace lacuna::quads::paving {
namespace {

/// A node over a boundary node, and where it should be.
struct Post {
    Index foot, top;
    Vec2 inward; ///< unit length, half way between the two sides
    double height;
};

std::vector<std::vector<std::size_t>> quads_of(const PlanarQuads& mesh)
{
    std::vector<std::vector<std::size_t>> around(mesh.points.size());
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (const Index p : mesh.quads[q]) around[static_cast<std::size_t>(p)].push_back(q);
    }
    return around;
}

class RowTruer {
public:
    RowTruer(PlanarQuads& mesh, const PlanarRegion& region, const std::function<double(const Vec2&)>& height)
        : mesh_(mesh), fixed_(region.points.size()), around_(quads_of(mesh))
    {
        for (const auto& loop : region.loops) {
            for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
                const Index before = loop[(i + n - 1) % n], here = loop[i], after = loop[(i + 1) % n];
                if (around_[index(here)].size() != 2) continue;
                const Index top = shared(here);
                if (top < 0 || is_fixed(top)) continue;
                const Vec2 along = (at(after) - at(here)).normalized() + (at(here) - at(before)).normalized();
                if (along.norm() < 1) continue; // a bend of more than two thirds of a straight angle
                const Vec2 unit = along.normalized();
                posts_.push_back({here, top, {-unit.y(), unit.x()}, height(at(here))});
            }
        }
    }

    void run()
    {
        constexpr int kRounds = 4; // neighbours make room for each other
        for (int round = 0; round < kRounds; ++round) {
            for (const Post& post : posts_) raise(post);
        }
    }

private:
    [[nodiscard]] bool is_fixed(Index p) const { return index(p) < fixed_; }
    [[nodiscard]] const Vec2& at(Index p) const { return mesh_.points[index(p)]; }

    /// The other end of the side between the two quads at a node.
    [[nodiscard]] Index shared(Index node) const
    {
        const Quad& a = mesh_.quads[around_[index(node)][0]];
        const Quad& b = mesh_.quads[around_[index(node)][1]];
        const auto k = static_cast<std::size_t>(std::find(a.begin(), a.end(), node) - a.begin());
        for (const Index p : {a[(k + 1) % 4], a[(k + 3) % 4]}) {
            if (std::find(b.begin(), b.end(), p) != b.end()) return p;
        }
        return -1;
    }

    [[nodiscard]] double worst_at(Index p) const
    {
        double worst = 1;
        for (const std::size_t q : around_[index(p)]) {
            const Quad& quad = mesh_.quads[q];
            worst = std::min(worst, least_sine(at(quad[0]), at(quad[1]), at(quad[2]), at(quad[3])));
        }
        return worst;
    }

    void raise(const Post& post)
    {
        constexpr double kGood = 0.8;                ///< what a row may cost its neighbours
        constexpr double kHeight = 0.2, kLean = 0.2; ///< left as it is within this share of the height
        const Vec2 start = at(post.top), arm = start - at(post.foot);
        const Vec2 along(post.inward.y(), -post.inward.x());
        const double up = std::clamp(arm.dot(post.inward), (1 - kHeight) * post.height,
                                     (1 + kHeight) * post.height);
        const double side = std::clamp(arm.dot(along), -kLean * post.height, kLean * post.height);
        const Vec2 goal = at(post.foot) + up * post.inward + side * along;
        const double before = worst_at(post.top);
        for (const double part : {1.0, 0.5, 0.25}) {
            mesh_.points[index(post.top)] = start + part * (goal - start);
            if (worst_at(post.top) >= std::min(before, kGood)) return;
        }
        mesh_.points[index(post.top)] = start;
    }

    PlanarQuads& mesh_;
    std::size_t fixed_;
    std::vector<std::vector<std::size_t>> around_;
    std::vector<Post> posts_;
};

} // namespace

void true_rows(PlanarQuads& mesh, const PlanarRegion& region,
               const std::function<double(const Vec2&)>& height)
{
    RowTruer(mesh, region, height).run();
}

} // namespace lacuna::quads::paving
