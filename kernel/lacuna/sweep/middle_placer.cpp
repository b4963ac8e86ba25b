// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/middle_placer.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/parallel.h>

#include <algorithm>

namespace lacuna::sweep {

namespace {

bool any(const std::vector<Vec3>& vectors)
{
    return std::ranges::any_of(vectors, [](const Vec3& v) { return !v.isZero(0); });
}

} // namespace

SkinPlaces::SkinPlaces(const mesh::HexMesh& mesh) : layers_(index(mesh.layers))
{
    const mesh::MiddlePlaces places(mesh);
    period_ = places.side(1, 0);
    on_level_ = places.upright(0, 0);
    rank_.assign(period_, -1);
    const auto add = [&](std::size_t place) { rank_[place] = static_cast<Index>(ring_++); };
    for (std::size_t r = 0; r < mesh.rim.size(); ++r) {
        add(places.side(0, mesh.middles.rim_side[r]));
        add(places.upright(0, mesh.rim[r][0]));
        if (mesh.middles.full) add(places.face(0, mesh.middles.rim_side[r]));
    }
}

/// The corner nodes of some levels. They are generated if the mesh does not hold them.
class MiddlePlacer::Corners {
public:
    /// Corner nodes of levels [first, last).
    Corners(const mesh::SkinNodes& all, int first, int last, const RunContext& context)
        : row_(index(all.mesh.nodes_per_layer)), first_(first)
    {
        if (all.layers == nullptr) {
            nodes_ = all.mesh.nodes.data() + index(first) * row_;
            return;
        }
        made_.resize(index(last - first) * row_);
        all.layers->place(first, last, made_, context);
        nodes_ = made_.data();
    }
    Corners(const Corners&) = delete;
    Corners& operator=(const Corners&) = delete;

    [[nodiscard]] const Vec3* level(int l) const { return nodes_ + index(l - first_) * row_; }

private:
    std::size_t row_;
    int first_;
    std::vector<Vec3> made_;
    const Vec3* nodes_ = nullptr;
};

MiddlePlacer::MiddlePlacer(const mesh::SkinNodes& corners, std::span<const Vec3> skin,
                           const RunContext& context)
    : corners_(corners),
      skin_(skin),
      rim_side_(corners.mesh.middles.sides.size(), 0),
      rim_node_(index(corners.mesh.nodes_per_layer), 0)
{
    for (const Index side : mesh_.middles.rim_side) rim_side_[index(side)] = 1;
    for (const Segment& side : mesh_.rim) rim_node_[index(side[0])] = 1;
    if (mesh_.layers > 1) blend_ends(context);
    bend_columns(context);
}

std::vector<Vec3> MiddlePlacer::bends_of_end(int level, const Vec3* nodes) const
{
    std::vector<Vec3> bends(mesh_.middles.sides.size());
    for (std::size_t s = 0; s < bends.size(); ++s) {
        const Segment& side = mesh_.middles.sides[s];
        const Vec3 &a = nodes[index(side[0])], &b = nodes[index(side[1])];
        bends[s] = on_skin(places_.side(index(level), static_cast<Index>(s))) - (a + b) / 2;
        if (bends[s].squaredNorm() < kSamePlace * kSamePlace * (b - a).squaredNorm()) bends[s].setZero();
    }
    return bends;
}

/// Blend the bends of the ends over the levels. The relative height of a level is computed from the mean of
/// its nodes.
void MiddlePlacer::blend_ends(const RunContext& context)
{
    for (const int level : {0, mesh_.layers}) {
        const Corners corners(corners_, level, level + 1, context);
        const Vec3* nodes = corners.level(level);
        (level == 0 ? first_ : last_) = blend_.beyond(nodes, rim_side_, bends_of_end(level, nodes));
    }
    if (!any(first_) && !any(last_)) {
        first_.clear();
        last_.clear();
        return;
    }
    const int step = mesh::layers_at_once(mesh_);
    share_.assign(1, 0);
    Vec3 before = Vec3::Zero();
    for (int first = 0; first <= mesh_.layers; first += step) {
        check_cancelled(context);
        const int last = std::min(first + step, mesh_.layers + 1);
        const Corners corners(corners_, first, last, context);
        for (int l = first; l < last; ++l) {
            Vec3 mean = Vec3::Zero();
            for (Index n = 0; n < mesh_.nodes_per_layer; ++n) mean += corners.level(l)[n];
            mean /= mesh_.nodes_per_layer;
            if (l > 0) share_.push_back(share_.back() + (mean - before).norm());
            before = mean;
        }
    }
    for (double& s : share_) s = share_.back() > 0 ? s / share_.back() : 0;
    share_.back() = 1;
}

/// Compute the bends of the walls' columns minus those of their cubics.
void MiddlePlacer::bend_columns(const RunContext& context)
{
    std::vector<Index> rim;
    for (const Segment& side : mesh_.rim) rim.push_back(side[0]);
    // Largest bend of a column of the rim relative to its side: the whole bend, and the bend minus that of
    // the cubic.
    double most = 0, left = 0;
    beyond_.resize(index(mesh_.layers) * rim.size());
    for (int l = 0; l < mesh_.layers; ++l) {
        for (std::size_t k = 0; k < rim.size(); ++k) {
            const Index node = l * mesh_.nodes_per_layer + rim[k];
            const Vec3 a = corners_[node], b = corners_[node + mesh_.nodes_per_layer];
            const Vec3 bend = on_skin(places_.upright(index(l), rim[k])) - (a + b) / 2;
            const double length = (b - a).norm();
            Vec3& rest = beyond_[index(l) * rim.size() + k];
            rest = bend - rim_bend(corners_, rim[k], l);
            most = std::max(most, bend.norm() / length);
            left = std::max(left, rest.norm() / length);
        }
    }
    most_bend_ = most;
    if (most < kSamePlace || left < kVisible) {
        beyond_ = {};
        return;
    }
    const Corners corners(corners_, 0, 1, context);
    const std::span<const Vec3> source(corners.level(0), index(mesh_.nodes_per_layer));
    const NodeGraph graph = node_graph(mesh_.quads, source.size());
    spread_.emplace(graph, side_weights(graph, mesh_.quads, source), rim, context);
}

void MiddlePlacer::place(int first, int last, std::span<Vec3> out, const RunContext& context) const
{
    const ColumnWindow low = column_window(mesh_.layers, first),
                       high = column_window(mesh_.layers, std::max(first, last - 1));
    const Corners corners(corners_, low.first, std::max(high.first + high.count, last + 1), context);
    const std::size_t period = places_.side(1, 0), on_level = places_.upright(0, 0);
    const auto layers = index(last - first);
    // Call `visit` for each of `count` levels or layers, with the output position of its nodes. The position
    // is `skip` entries after that of the level or, for a layer, of the level below it.
    const auto each = [&](std::size_t count, std::size_t skip, const auto& visit) {
        parallel_each(context, count, 1,
                      [&](std::size_t i) { visit(first + static_cast<int>(i), &out[i * period + skip]); });
    };
    each(layers + 1, 0, [&](int l, Vec3* at) { place_level(l, corners, at); });
    each(layers, on_level, [&](int l, Vec3* at) { place_columns(l, corners, at); });
    if (spread_ && layers > 0) {
        const std::size_t rim = mesh_.rim.size();
        spread_->add(std::span(beyond_).subspan(index(first) * rim, layers * rim), layers, &out[on_level],
                     period, context);
    }
    if (!mesh_.middles.full) return;
    each(layers + 1, 0, [&](int l, Vec3* at) { place_level_centres(l, corners, at); });
    each(layers, 0, [&](int l, Vec3* at) { place_layer_centres(l, corners, at); });
}

/// Place the middles of sides on a level. The middles of rim sides are those of the skin; the others are
/// blended from the rim's.
void MiddlePlacer::place_level(int level, const Corners& corners, Vec3* out) const
{
    const Vec3* nodes = corners.level(level);
    const std::size_t sides = mesh_.middles.sides.size();
    const bool end = level == 0 || level == mesh_.layers;
    std::vector<Vec3> bends(end ? 0 : sides, Vec3::Zero());
    for (std::size_t s = 0; s < sides; ++s) {
        const Segment& side = mesh_.middles.sides[s];
        const Vec3 &a = nodes[index(side[0])], &b = nodes[index(side[1])];
        out[s] = (a + b) / 2;
        if (!end && rim_side_[s] == 0) continue;
        const Vec3& at = on_skin(places_.side(index(level), static_cast<Index>(s)));
        if (!end) bends[s] = at - out[s];
        if (!end && bends[s].squaredNorm() < kSamePlace * kSamePlace * (b - a).squaredNorm())
            bends[s].setZero();
        out[s] = at;
    }
    if (end || (first_.empty() && !any(bends))) return;
    std::vector<Vec3> extra(first_.size());
    for (std::size_t s = 0; s < extra.size(); ++s)
        extra[s] = (1 - share_[index(level)]) * first_[s] + share_[index(level)] * last_[s];
    blend_.blend(nodes, rim_side_, bends, extra);
    for (std::size_t s = 0; s < sides; ++s)
        if (rim_side_[s] == 0) out[s] += bends[s];
}

/// Place the middles of the sides that run from level to level in a layer.
void MiddlePlacer::place_columns(int layer, const Corners& corners, Vec3* out) const
{
    const auto [first, count] = column_window(mesh_.layers, layer);
    const auto low = index(layer - first);
    std::array<Vec3, ColumnWindow::kMost> column;
    for (Index n = 0; n < mesh_.nodes_per_layer; ++n) {
        if (rim_node_[index(n)] != 0) {
            out[n] = on_skin(places_.upright(index(layer), n));
            continue;
        }
        out[n] = (corners.level(layer)[n] + corners.level(layer + 1)[n]) / 2;
        if (most_bend_ < kSamePlace) continue;
        for (int i = 0; i < count; ++i) column[index(i)] = corners.level(first + i)[n];
        // Inside, nodes that were moved to improve cells make zigzag columns, which no side follows.
        const Vec3 bend = column_bend(std::span(column).first(index(count)), low);
        const double limit = most_bend_ * (column[low + 1] - column[low]).norm();
        out[n] += bend * std::min(1.0, limit / std::max(bend.norm(), limit));
    }
}

/// Place the centres of the quads on a level.
void MiddlePlacer::place_level_centres(int level, const Corners& corners, Vec3* out) const
{
    const Vec3* nodes = corners.level(level);
    Vec3* const centres = out + places_.quad(0, 0);
    const bool end = level == 0 || level == mesh_.layers;
    for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
        if (end) {
            centres[q] = on_skin(places_.quad(index(level), q));
            continue;
        }
        std::array<Vec3, 4> sides, quad;
        for (std::size_t k = 0; k < 4; ++k) {
            sides[k] = out[mesh_.middles.side_of[q][k]];
            quad[k] = nodes[mesh_.quads[q][k]];
        }
        centres[q] = middle_of_quad(sides, quad);
    }
}

/// Place the centres of the faces that stand on the sides of a level, and of the cells above the level.
/// @param out  the middle nodes of the level below the layer, which those of the layer follow.
void MiddlePlacer::place_layer_centres(int layer, const Corners& corners, Vec3* out) const
{
    const Vec3 *below = corners.level(layer), *above = corners.level(layer + 1);
    const Vec3* const next = out + places_.side(1, 0); // the level above
    const Vec3* const uprights = out + places_.upright(0, 0);
    Vec3* const faces = out + places_.face(0, 0);
    for (std::size_t s = 0; s < mesh_.middles.sides.size(); ++s) {
        if (rim_side_[s] != 0) {
            faces[s] = on_skin(places_.face(index(layer), static_cast<Index>(s)));
            continue;
        }
        const auto [a, b] = mesh_.middles.sides[s];
        faces[s] = middle_of_quad({out[s], uprights[b], next[s], uprights[a]},
                                  {below[a], below[b], above[b], above[a]});
    }
    const std::size_t level_centres = places_.quad(0, 0);
    for (std::size_t q = 0; q < mesh_.quads.size(); ++q) {
        const Quad &quad = mesh_.quads[q], &side = mesh_.middles.side_of[q];
        std::array<Vec3, 12> sides;
        std::array<Vec3, 8> nodes;
        for (std::size_t k = 0; k < 4; ++k) {
            sides[k] = out[side[k]], sides[4 + k] = next[side[k]], sides[8 + k] = uprights[quad[k]];
            nodes[k] = below[quad[k]], nodes[4 + k] = above[quad[k]];
        }
        out[places_.cell(0, q)] = middle_of_cell({faces[side[0]], faces[side[1]], faces[side[2]],
                                                  faces[side[3]], out[level_centres + q],
                                                  next[level_centres + q]},
                                                 sides, nodes);
    }
}

} // namespace lacuna::sweep
