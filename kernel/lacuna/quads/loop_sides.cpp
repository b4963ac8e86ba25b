// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/loop_sides.h>

#include <lacuna/geometry/shared/predicates.h>

namespace lacuna::quads::paving {

namespace {

using geometry::orient2d;

constexpr std::size_t kRun = 16; ///< number of sides in a box

} // namespace

LoopSides::LoopSides(const PartialMesh& partial, const Cycle& loop) : partial_(partial), loop_(loop)
{
    const std::size_t n = loop.size();
    for (std::size_t first = 0; first < n; first += kRun) {
        Eigen::AlignedBox2d& run = runs_.emplace_back();
        for (std::size_t k = first; k <= std::min(first + kRun, n); ++k) run.extend(partial.at(loop[k % n]));
        whole_.extend(run);
    }
}

double LoopSides::gap(const LoopSides& other) const
{
    double least = kInfinity;
    for (const auto& one : runs_)
        for (const auto& two : other.runs_) least = std::min(least, one.squaredExteriorDistance(two));
    return std::sqrt(least);
}

bool LoopSides::is_clear(Index a, Index b) const
{
    Eigen::AlignedBox2d line(partial_.at(a));
    line.extend(partial_.at(b));
    if (!whole_.intersects(line)) return true;
    const std::size_t n = loop_.size();
    for (std::size_t r = 0; r < runs_.size(); ++r) {
        if (!runs_[r].intersects(line)) continue;
        for (std::size_t k = r * kRun; k < std::min((r + 1) * kRun, n); ++k)
            if (!passes(a, b, loop_[k], loop_[k + 1 == n ? 0 : k + 1])) return false;
    }
    return true;
}

/// Whether the segment from a to b, without its ends, does not meet the side from c to d.
bool LoopSides::passes(Index a, Index b, Index c, Index d) const
{
    const Vec2 &pa = partial_.at(a), &pb = partial_.at(b), &pc = partial_.at(c), &pd = partial_.at(d);
    const Vec2 low = pa.cwiseMin(pb), high = pa.cwiseMax(pb);
    if ((pc.cwiseMax(pd).array() < low.array()).any() || (pc.cwiseMin(pd).array() > high.array()).any())
        return true;
    const bool c_shared = c == a || c == b, d_shared = d == a || d == b;
    if (c_shared && d_shared) return false;
    const double oc = orient2d(pa, pb, pc), od = orient2d(pa, pb, pd);
    if (c_shared || d_shared) {
        const Vec2& other = c_shared ? pd : pc;
        const double along = (other - pa).dot(pb - pa);
        return (c_shared ? od : oc) != 0 || along <= 0 || along >= (pb - pa).squaredNorm();
    }
    if ((oc > 0 && od > 0) || (oc < 0 && od < 0)) return true;
    const double oa = orient2d(pc, pd, pa), ob = orient2d(pc, pd, pb);
    return (oa > 0 && ob > 0) || (oa < 0 && ob < 0);
}

} // namespace lacuna::quads::paving
