// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/periodic_nodes.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lacuna::io {

using Eigen::Matrix3d;
using mesh::MeshView;

namespace {

bool is_translation(const mesh::PeriodicNodes& pair) { return pair.onto.linear() == Matrix3d::Identity(); }

/// The displacement of a node as a sum: the displacement of the first node of its chain, rotated by `turn`,
/// plus multiples of displacements of reference nodes.
struct Depends {
    std::size_t first = 0;
    Matrix3d turn = Matrix3d::Identity();
    std::map<std::size_t, Matrix3d> references{};
};

/// Let a node on the axis move along the axis only: equations eliminate the two other directions.
void hold_on_axis(std::size_t node, const Vec3& axis, std::vector<std::vector<PeriodicTerm>>& equations)
{
    Eigen::Index along = 0;
    axis.cwiseAbs().maxCoeff(&along);
    for (int i = 0; i < 3; ++i) {
        if (i == along) continue;
        std::vector<PeriodicTerm>& terms = equations.emplace_back();
        terms.push_back({node, i, 1});
        if (axis[i] != 0) terms.push_back({node, static_cast<int>(along), -axis[i] / axis[along]});
    }
}

} // namespace

void add_periodic(std::span<const mesh::PeriodicNodes> pairs, bool sets, MeshView& view)
{
    view.periodic.reserve(pairs.size()); // the vector must not grow later, because sets refer to its tags
    for (std::size_t p = 0; p < pairs.size(); ++p) {
        view.periodic.push_back({pairs[p], {}});
        MeshView::Periodic& own = view.periodic.back();
        for (const std::size_t side : {0, 1}) {
            const std::string name = "periodic_" + std::to_string(p + 1) + (side == 0 ? "_a" : "_b");
            std::vector<int> points;
            for (const auto& pair : pairs[p].pairs) {
                points.push_back(pair[side]);
                own.tags[side].push_back(view.point_tags[index(pair[side])]);
            }
            if (!sets) {
                view.lists.emplace_back("nodes:" + name, std::move(points));
                continue;
            }
            MeshView::Set set{mesh::SetKind::nodes, 0, name};
            set.count = own.tags[side].size();
            set.members = mesh::Numbers(own.tags[side]);
            view.sets.push_back(std::move(set));
        }
    }
}

PeriodicEquations periodic_equations(const MeshView& view)
{
    PeriodicEquations found;
    std::map<std::size_t, std::vector<std::pair<std::size_t, std::pair<std::size_t, bool>>>> next;
    std::map<std::size_t, std::size_t> on_axis; // for each node on the axis, its pair
    for (std::size_t p = 0; p < view.periodic.size(); ++p) {
        const mesh::PeriodicNodes& own = view.periodic[p].nodes;
        found.number.push_back(is_translation(own) ? found.references.size() : kNoIndex);
        if (is_translation(own)) found.references.push_back(own.onto.translation());
        for (const auto& [a, b] : own.pairs) {
            if (a == b) on_axis.emplace(index(a), p);
            if (a == b) continue;
            next[index(a)].push_back({index(b), {p, true}});
            next[index(b)].push_back({index(a), {p, false}});
        }
    }
    std::map<std::size_t, Depends> known;
    for (const auto& [first, ignored] : next) {
        if (!known.emplace(first, Depends{first}).second) continue;
        for (std::vector<std::size_t> left{first}; !left.empty();) {
            const std::size_t from = left.back();
            left.pop_back();
            for (const auto& [to, by] : next.at(from)) {
                const auto& [p, forth] = by;
                if (known.contains(to)) continue;
                const Matrix3d linear = view.periodic[p].nodes.onto.linear(),
                               turn = forth ? linear : Matrix3d(linear.transpose());
                Depends own = known.at(from);
                own.turn = turn * own.turn;
                for (auto& [reference, factor] : own.references) factor = turn * factor;
                if (is_translation(view.periodic[p].nodes))
                    own.references.try_emplace(found.number[p], Matrix3d::Zero()).first->second +=
                        (forth ? 1 : -1) * Matrix3d::Identity();
                known.emplace(to, std::move(own));
                left.push_back(to);
            }
        }
    }
    for (const auto& [node, p] : on_axis)
        hold_on_axis(node, Eigen::AngleAxisd(view.periodic[p].nodes.onto.linear()).axis(), found.equations);
    for (const auto& [node, own] : known) {
        if (own.first == node) continue;
        for (int i = 0; i < 3; ++i) {
            std::vector<PeriodicTerm>& terms = found.equations.emplace_back();
            terms.push_back({node, i, 1});
            const auto add = [&](std::size_t other, const Matrix3d& factor) {
                for (int j = 0; j < 3; ++j)
                    if (std::abs(factor(i, j)) > kRoundoff) terms.push_back({other, j, -factor(i, j)});
            };
            add(own.first, own.turn);
            for (const auto& [reference, factor] : own.references) add(view.points + reference, factor);
        }
    }
    found.first = view.point_tags.bounds(view.points).second + 1;
    for (std::vector<PeriodicTerm>& terms : found.equations)
        for (PeriodicTerm& term : terms)
            term.tag = term.node < view.points
                           ? view.point_tags[term.node]
                           : found.first + static_cast<std::int64_t>(term.node - view.points);
    return found;
}

CyclicSector cyclic_sector(const MeshView& view)
{
    if (view.periodic.size() != 1) return {};
    const mesh::PeriodicNodes& pair = view.periodic.front().nodes;
    const Eigen::AngleAxisd turn(pair.onto.linear());
    const double sectors = kFullTurn / turn.angle();
    const bool whole = std::isfinite(sectors) && std::abs(sectors - std::round(sectors)) < kFileAccuracy;
    const bool axis = std::ranges::any_of(pair.pairs, [](const auto& nodes) { return nodes[0] == nodes[1]; });
    if (is_translation(pair) || !whole || axis) return {};
    CyclicSector sector{static_cast<int>(std::lround(sectors)), {}, turn.axis()};
    // The point p of the axis closest to the origin solves (1 - R) p = t, where R and t are the rotation and
    // the translation of the motion. The component of p along the axis is set to zero.
    const Matrix3d across = Matrix3d::Identity() - pair.onto.linear() + turn.axis() * turn.axis().transpose();
    const Vec3 shift = pair.onto.translation();
    const double along = shift.dot(turn.axis());
    if (std::abs(along) > kFileAccuracy * shift.norm()) return {}; // a screw motion
    sector.point = across.inverse() * (shift - along * turn.axis());
    return sector;
}

} // namespace lacuna::io
