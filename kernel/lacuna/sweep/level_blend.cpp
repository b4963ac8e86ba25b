// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/criteria.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/sweep/detail/middle_skin.h>

#include <algorithm>

namespace lacuna::sweep {

SideFrame::SideFrame(const Vec3& from, const Vec3& to, const Vec3& hint) : length((to - from).norm())
{
    along = (to - from).stableNormalized();
    normal = along.cross(hint).stableNormalized();
    across = normal.cross(along);
}

Vec3 SideFrame::local(const Vec3& bend) const
{
    if (!(length > 0)) return Vec3::Zero();
    return Vec3(bend.dot(along), bend.dot(across), bend.dot(normal)) / length;
}

Vec3 SideFrame::world(const Vec3& local) const
{
    return length * (local[0] * along + local[1] * across + local[2] * normal);
}

LevelBlend::LevelBlend(const mesh::HexMesh& mesh)
{
    const std::vector<Index> opposite = mesh::opposite_sides(mesh.quads, mesh.nodes_per_layer);
    std::vector<std::uint8_t> seen(mesh.middles.sides.size(), 0);
    // A side has the direction that its quad gives it. The neighbouring quad has this side in the opposite
    // direction, so the walk reverses it there. Directions thus stay parallel from quad to quad.
    const auto walk = [&](std::size_t start) {
        const std::size_t begin = steps_.size();
        bool closed = false;
        for (std::size_t at = start;;) {
            const std::size_t q = at / 4, k = at % 4;
            const Quad& quad = mesh.quads[q];
            seen[index(mesh.middles.side_of[q][k])] = 1;
            steps_.push_back({quad[k], quad[(k + 1) % 4], mesh.middles.side_of[q][k]});
            const std::size_t across = (k + 2) % 4;
            const Index next = opposite[4 * q + across];
            if (next < 0) {
                seen[index(mesh.middles.side_of[q][across])] = 1;
                steps_.push_back({quad[(across + 1) % 4], quad[across], mesh.middles.side_of[q][across]});
                break;
            }
            if (static_cast<std::size_t>(next) == start) {
                closed = true;
                break;
            }
            at = index(next);
        }
        chords_.push_back({begin, steps_.size(), closed});
    };
    for (const bool rim : {true, false})
        for (std::size_t side = 0; side < opposite.size(); ++side)
            if ((opposite[side] < 0) == rim && seen[index(mesh.middles.side_of[side / 4][side % 4])] == 0)
                walk(side);
}

/// For each chord with known sides, call `take` with each of its sides, the side's frame and the blended bend
/// in that frame.
template <class Take>
void LevelBlend::each_chord(const Vec3* nodes, const std::vector<std::uint8_t>& known,
                            const std::vector<Vec3>& bend, const Take& take) const
{
    std::vector<Vec3> middle, local;
    std::vector<double> way;
    std::vector<std::size_t> knots;
    for (const Chord& chord : chords_) {
        const std::size_t count = chord.end - chord.begin;
        const auto step = [&](std::size_t i) -> const Step& { return steps_[chord.begin + i % count]; };
        middle.resize(count);
        knots.clear();
        for (std::size_t i = 0; i < count; ++i) {
            middle[i] = (nodes[step(i).from] + nodes[step(i).to]) / 2;
            if (known[index(step(i).side)] != 0) knots.push_back(i);
        }
        const auto frame = [&](std::size_t i) {
            const std::size_t last = count - 1;
            const std::size_t before = i > 0 ? i - 1 : chord.closed ? last : 0;
            const std::size_t after = i < last ? i + 1 : chord.closed ? 0 : last;
            return SideFrame(nodes[step(i).from], nodes[step(i).to], middle[after] - middle[before]);
        };
        if (knots.empty()) {
            for (std::size_t i = 0; i < count; ++i) take(step(i).side, frame(i), Vec3(Vec3::Zero()));
            continue;
        }
        local.resize(knots.size());
        for (std::size_t k = 0; k < knots.size(); ++k)
            local[k] = frame(knots[k]).local(bend[index(step(knots[k]).side)]);
        // Interpolate from each known side to the next; in a closed chord also from the last to the first.
        const std::size_t spans = knots.size() - (chord.closed ? 0 : 1);
        for (std::size_t k = 0; k < knots.size(); ++k) take(step(knots[k]).side, frame(knots[k]), local[k]);
        for (std::size_t k = 0; k < spans; ++k) {
            const std::size_t first = knots[k], next = (k + 1) % knots.size();
            const std::size_t last = k + 1 < knots.size() ? knots[k + 1] : knots[0] + count;
            way.assign(1, 0);
            for (std::size_t i = first; i < last; ++i)
                way.push_back(way.back() + (middle[(i + 1) % count] - middle[i % count]).norm());
            for (std::size_t i = first + 1; i < last; ++i) {
                const double share = way.back() > 0 ? way[i - first] / way.back() : 0;
                take(step(i).side, frame(i % count), Vec3((1 - share) * local[k] + share * local[next]));
            }
        }
        if (chord.closed) continue;
        for (std::size_t i = 0; i < knots.front(); ++i) take(step(i).side, frame(i), local.front());
        for (std::size_t i = knots.back() + 1; i < count; ++i) take(step(i).side, frame(i), local.back());
    }
}

void LevelBlend::blend(const Vec3* nodes, const std::vector<std::uint8_t>& known, std::vector<Vec3>& bend,
                       const std::vector<Vec3>& extra) const
{
    each_chord(nodes, known, bend, [&](Index side, const SideFrame& frame, const Vec3& local) {
        if (known[index(side)] != 0) return;
        const Vec3 all = extra.empty() ? local : Vec3(local + extra[index(side)]);
        bend[index(side)] = frame.world(all);
    });
}

std::vector<Vec3> LevelBlend::beyond(const Vec3* nodes, const std::vector<std::uint8_t>& known,
                                     const std::vector<Vec3>& bend) const
{
    std::vector<Vec3> rest(bend.size(), Vec3::Zero());
    each_chord(nodes, known, bend, [&](Index side, const SideFrame& frame, const Vec3& local) {
        if (known[index(side)] != 0) return;
        const Vec3 beyond = frame.local(bend[index(side)]) - local;
        if (beyond.norm() > kSamePlace) rest[index(side)] = beyond;
    });
    return rest;
}

ColumnWindow column_window(int layers, int layer)
{
    const int count = std::min(ColumnWindow::kMost, layers + 1);
    return {std::clamp(layer - 1, 0, layers + 1 - count), count};
}

Vec3 column_bend(std::span<const Vec3> column, std::size_t low)
{
    // Share of the side's length; from a quarter on, cells invert. Without the limit, the least scaled
    // Jacobian of a turn of 270° in three layers is 0.29 instead of 0.60.
    constexpr double kMost = 0.2;
    const std::size_t count = column.size();
    std::array<double, ColumnWindow::kMost> t{};
    for (std::size_t i = 1; i < count; ++i) t[i] = t[i - 1] + (column[i] - column[i - 1]).norm();
    if (count < 3) return Vec3::Zero();
    const Vec3 middle = (column[low] + column[low + 1]) / 2;
    const double length = t[low + 1] - t[low];
    if (!(length > 0)) return Vec3::Zero();
    const double s = (t[low] + t[low + 1]) / 2;
    Vec3 bend = Vec3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        double weight = 1;
        for (std::size_t j = 0; j < count; ++j) {
            if (i == j) continue;
            if (!(t[i] != t[j])) return Vec3::Zero();
            weight *= (s - t[j]) / (t[i] - t[j]);
        }
        bend += weight * (column[i] - middle); // the weights sum to 1
    }
    const double size = bend.norm();
    return size > kMost * length ? Vec3(bend * (kMost * length / size)) : bend;
}

Vec3 rim_bend(const mesh::SkinNodes& corners, Index node, int layer)
{
    const auto [first, count] = column_window(corners.mesh.layers, layer);
    std::array<Vec3, ColumnWindow::kMost> column;
    for (int i = 0; i < count; ++i)
        column[index(i)] = corners[(first + i) * corners.mesh.nodes_per_layer + node];
    return column_bend(std::span(column).first(index(count)), index(layer - first));
}

} // namespace lacuna::sweep
