// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/edge_counts.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/shared/rim_breaks.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/wall_columns.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/detail/plan_heights.h>
#include <lacuna/sweep/detail/shared_faces.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/detail/volume_share.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Four areas of the source divided by the length of its rims: a square's side, a circle's diameter, twice
/// the width of a narrow strip or ring.
double source_width(const OpenVolume& volume)
{
    const Model& model = volume.model;
    double area = 0, round = 0;
    for (const FaceId face : volume.faces(Role::source)) area += face_area(model, face);
    for (const Rim& rim : rims(model, volume.faces(Role::source)))
        for (const EdgeUse& use : rim.uses) round += edge_length(model, use.edge);
    return round > 0 ? 4 * area / round : 0;
}

/// For each member without a requested size: its default size. Members that touch get the largest of their
/// default sizes, so that a small one does not make the edges that it shares with a large one fine, but at
/// least `kDefaultGap` quads across the source. Curvature and narrow places reduce the size afterwards.
std::vector<double> default_sizes(const SameEdges& edges)
{
    const std::span<const AssemblyMember> members = edges.members();
    std::vector<double> own(members.size(), 0);
    for (std::size_t m = 0; m < members.size(); ++m)
        if (!members[m].options.size) own[m] = surface::default_size(*members[m].volume).length;
    const auto is_free = [&](std::size_t m) { return own[m] > 0 && members[m].fixed == nullptr; };
    geometry::UnionFind touching(members.size());
    for (const SharedFace& face : edges.shared()) {
        const std::string &a = members[face.a].whole, &b = members[face.b].whole;
        const bool pieces = !a.empty() && a == b; // pieces of one volume keep their sizes
        if (!pieces && is_free(face.a) && is_free(face.b)) touching.unite_least(face.a, face.b);
    }
    std::map<std::size_t, double> largest;
    for (std::size_t m = 0; m < members.size(); ++m) {
        double& size = largest[touching.find(m)];
        size = std::max(size, own[m]);
    }
    std::vector<double> sizes;
    for (std::size_t m = 0; m < members.size(); ++m) {
        const double coarsest = source_width(*members[m].volume) / kDefaultGap;
        sizes.push_back(std::max(own[m], std::min(largest.at(touching.find(m)), coarsest)));
    }
    return sizes;
}

} // namespace

EdgeCounts::EdgeCounts(const SameEdges& edges, const RunContext& context)
    : edges_(edges),
      context_(context),
      classes_(edges.size()),
      layers_(edges.members().size(), 1),
      levels_(edges.members(), edges.shared()),
      spacing_(default_sizes(edges))
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        classes_.unite(edges.set_of(e), e);
        planned_.push_back(edges.is_planned(e));
    }
    for (const AssemblyMember& member : edges.members()) per_turn_.push_back(member.options.curvature);
    for (std::size_t m = 0; m < edges.members().size(); ++m) {
        check_cancelled(context);
        if (edges.members()[m].fixed == nullptr) join_by_sweep(m);
    }
    ahead_ = lines_ahead(edges_, [this](std::size_t e) { return wanted(edges_[e]); });
    std::map<std::size_t, double> finest; // size that lines ahead need on each set of same edges
    for (const LineAhead& line : ahead_) {
        double& size = finest.try_emplace(edges_.set_of(line.edge), line.size).first->second;
        size = std::min(size, line.size);
    }
    for (const auto& [m, sides] : sides_)
        for (const EdgeUse& side : sides)
            if (const auto need = finest.find(edges_.set_of(edges_.number(m, side.edge)));
                need != finest.end())
                layers_[m] = std::max(
                    layers_[m], static_cast<int>(edges_[edges_.number(m, side.edge)].length / need->second));
    heights_ = levels_.heights([this](std::size_t m, double height) {
        const std::vector<Vec3>& points = edges_.model(m).points;
        const Vec3 middle = std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) /
                            static_cast<double>(points.size());
        return std::max<double>(layers_[m], height / size(m, middle));
    });
    join_opposite();
    for (std::size_t e = 0; e < edges.size(); ++e) {
        class_.push_back(classes_.find(e));
        if (stacked_.contains(edges.set_of(e))) planned_[e] = false;
    }
    find_directions();
    find_frame();
    find_across();
    rows_ = shared_rows(edges);
    count();
    settle();
}

void EdgeCounts::join(std::size_t a, std::size_t b, bool reversed)
{
    classes_.unite(a, b);
    joined_.push_back({a, b, reversed});
}

void EdgeCounts::find_directions()
{
    std::map<std::size_t, std::vector<std::pair<std::size_t, bool>>> beside; // of sets of same edges
    for (const JoinedEdges& pair : joined_) {
        const std::size_t a = edges_.set_of(pair.a), b = edges_.set_of(pair.b);
        const bool reversed = pair.reversed != (edges_.runs_along(pair.a) != edges_.runs_along(pair.b));
        beside[a].emplace_back(b, reversed);
        beside[b].emplace_back(a, reversed);
    }
    std::map<std::size_t, bool> against; // of sets of same edges
    for (const auto& [first, ignored] : beside) {
        if (!against.emplace(first, false).second) continue;
        for (std::vector<std::size_t> left{first}; !left.empty();) {
            const std::size_t at = left.back();
            left.pop_back();
            for (const auto& [next, reversed] : beside.at(at))
                if (against.emplace(next, against.at(at) != reversed).second) left.push_back(next);
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const auto found = against.find(edges_.set_of(e));
        reversed_.push_back((found != against.end() && found->second) == edges_.runs_along(e));
    }
}

void EdgeCounts::join_by_sweep(std::size_t m)
{
    std::map<EdgeId, std::set<EdgeId>> target_of, source_of;
    std::map<EdgeId, bool> reversed; // on the source: the side corresponds to one of the other direction
    const std::vector<surface::LinkingSurface> links = surface::linking_surfaces(*edges_.members()[m].volume);
    find_demands(m, links);
    plan_sides(m, links);
    levels_.read(m, links, context_);
    for (const surface::LinkingSurface& link : links) {
        if (surface::has_bent_line(edges_.model(m), link)) {
            for (std::size_t l = 0; l < link.lines.size(); ++l)
                bent_lines_.try_emplace({m, link.lines[l].line.uses.front().edge}, bent_.size(), l);
            bent_.push_back(link);
        }
        for (const surface::RimSegment& segment : link.segments) {
            const EdgeId from = link.source.uses()[segment.use].edge;
            // A segment may cover several edges of the target.
            const double whole = link.target.length();
            const double inset = kVisible * (segment.target_to - segment.target_from);
            const auto use_at = [&](double at) {
                while (at >= whole) at -= whole;
                return link.target.position(at).use;
            };
            const std::size_t last = use_at(segment.target_to - inset);
            for (std::size_t use = use_at(segment.target_from + inset);;
                 use = (use + 1) % link.target.uses().size()) {
                const EdgeId to = link.target.uses()[use].edge;
                target_of[from].insert(to);
                source_of[to].insert(from);
                reversed[from] = link.source.uses()[segment.use].reversed != link.target.uses()[use].reversed;
                if (use == last) break;
            }
        }
        for (const surface::LinkingLine& line : link.lines) {
            if (line.line.uses.size() != 1) { // the sweep decides how many sides each edge gets
                for (const EdgeUse& use : line.line.uses)
                    stacked_.insert(edges_.set_of(edges_.number(m, use.edge)));
                const auto is_beside = [&](const EdgeUse& use) {
                    return edges_.is_beside(edges_.number(m, use.edge));
                };
                if (std::ranges::any_of(line.line.uses, is_beside)) stacks_[m].push_back(line.line.uses);
                continue;
            }
            sides_[m].push_back(line.line.uses.front());
            classes_.unite(edges_.number(m, sides_[m].front().edge), edges_.number(m, sides_[m].back().edge));
        }
    }
    for (const auto& [from, to] : target_of) {
        if (to.size() == 1 && source_of.at(*to.begin()).size() == 1)
            join(edges_.number(m, from), edges_.number(m, *to.begin()), reversed.at(from));
    }
    for (const auto& [own, other] : {std::tie(target_of, source_of), std::tie(source_of, target_of)}) {
        for (const auto& [whole, parts] : own) {
            if (parts.size() < 2 ||
                std::ranges::any_of(parts, [&](EdgeId part) { return other.at(part).size() > 1; }))
                continue;
            Chain& chain = chains_.emplace_back(Chain{edges_.number(m, whole), {}});
            for (const EdgeId part : parts) chain.parts.push_back(edges_.number(m, part));
        }
    }
}

std::vector<double> EdgeCounts::on_line(std::size_t m, EdgeId first, std::vector<double> heights) const
{
    const auto found = bent_lines_.find({m, first});
    if (found == bent_lines_.end()) return heights;
    const auto [link, line] = found->second;
    return surface::shares_on_line(*edges_.members()[m].volume, bent_[link], line, std::move(heights),
                                   context_);
}

void EdgeCounts::find_demands(std::size_t m, std::span<const surface::LinkingSurface> links)
{
    const AssemblyMember& member = edges_.members()[m];
    if (member.options.intervals.empty()) return;
    auto demands = attempt(
        [&] { return surface::find_intervals(*member.volume, links, member.options.intervals); });
    if (demands)
        demands_[m] = std::move(*demands);
    else
        log_line(context_, demands.why->about(member.region).text());
}

void EdgeCounts::plan_sides(std::size_t m, std::span<const surface::LinkingSurface> links)
{
    const OpenVolume& volume = *edges_.members()[m].volume;
    const SweepOptions& options = edges_.members()[m].options;
    const surface::SizeField size_at = [this, m](const Vec3& p) { return size(m, p); };
    const VolumePlan plan = plan_volume(volume, links, options, size_at, context_);
    per_turn_[m] = plan.per_turn;
    if (plan.layers) layers_[m] = plan.layers(1);
    if (!sizes_by_default(options)) return;
    spacing_[m] *= plan.part;
    surface::RimFacets facets(volume, links);
    for (const auto& [edge, at] : facets.breaks(per_turn_[m], size_at).edges) {
        std::vector<double> ends{0};
        ends.insert(ends.end(), at.begin(), at.end());
        ends.push_back(1);
        followed_[edges_.set_of(edges_.number(m, edge))] = {edges_.number(m, edge), std::move(ends)};
    }
}

void EdgeCounts::join_opposite()
{
    for (std::size_t m = 0; m < edges_.members().size(); ++m) {
        for (const FaceId wall : edges_.members()[m].volume->faces(Role::wall)) join_opposite(m, wall, true);
    }
    for (const SharedFace& face : edges_.shared()) {
        const bool rows = edges_.is_wall(face.a, face.face_a) || edges_.is_wall(face.b, face.face_b);
        join_opposite(face.a, face.face_a, rows);
        join_opposite(face.b, face.face_b, rows);
    }
}

void EdgeCounts::join_opposite(std::size_t m, FaceId face, bool rows)
{
    if (edges_.members()[m].fixed != nullptr) return; // a fixed member keeps its quads
    const std::vector<Loop> loops = border_loops(edges_.model(m), face);
    if (rows && loops.size() == 2 && loops[0].uses.size() == 1 && loops[1].uses.size() == 1)
        classes_.unite(edges_.number(m, loops[0].uses[0].edge), edges_.number(m, loops[1].uses[0].edge));
    if (loops.size() != 1 || loops[0].uses.size() != 4) return;
    for (std::size_t k = 0; k < 2; ++k) {
        const EdgeUse &use = loops[0].uses[k], &opposite = loops[0].uses[k + 2];
        join(edges_.number(m, use.edge), edges_.number(m, opposite.edge), use.reversed == opposite.reversed);
    }
}

void EdgeCounts::find_across()
{
    std::set<std::pair<std::size_t, std::size_t>> across; // member, class
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (planned_[e] && !frame_[e]) across.emplace(edges_[e].member, class_of(e));
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (frame_[e] && across.contains({edges_[e].member, class_of(e)})) planned_[e] = true;
}

std::pair<int, double> EdgeCounts::beside_rows(std::size_t e) const
{
    int taken = 0;
    double left = edges_[e].length;
    const std::array<EdgeRows, 2>* ends = rows(edges_.set_of(e));
    for (std::size_t k = 0; ends != nullptr && k < 2; ++k) {
        taken += static_cast<int>((*ends)[k].places.size());
        if (!(*ends)[k].places.empty()) left -= (*ends)[k].places.back();
    }
    return {taken, left};
}

void EdgeCounts::check_rows() const
{
    for (const auto& [e, ends] : rows_) {
        const int taken = beside_rows(e).first, count = count_.at(class_of(e));
        if (taken < count) continue;
        const EdgeRows& end = ends[ends[0].places.empty() ? 1 : 0];
        const AssemblyMember &own = edges_.members()[end.member], &other = edges_.members()[edges_[e].member];
        throw NotSweepable(Message("assembly.layers_rows",
                                   "{} of {} has {} sides, but {} rows of boundary layers end on it (among "
                                   "them those of {} of {}), so at least {} sides are needed",
                                   entity_in(other, edges_[e].edge), other.region, found(count), taken,
                                   entity_in(own, end.face), own.region, needed(taken + 1))
                               .remedy("use fewer rows, or more 'layers' or 'intervals'"));
    }
}

void EdgeCounts::ask_sides()
{
    for (const auto& [m, demands] : demands_) {
        for (const surface::SidesAsked& asked : demands.sides) {
            std::vector<EdgeAsked> edges;
            for (const surface::SidesAsked::Part& part : asked.parts) {
                if (edges.empty() || edges.back().edge != part.edge)
                    edges.push_back({part.edge, 0, 0, part.reversed});
                edges.back().covered += part.to - part.from;
                edges.back().length += (part.to - part.from) * edges_[edges_.number(m, part.edge)].length;
            }
            const bool whole = std::ranges::all_of(
                edges, [](const EdgeAsked& edge) { return edge.covered > 1 - kVisible; });
            if (whole && static_cast<std::size_t>(asked.count) >= edges.size()) ask_sides(m, asked, edges);
        }
    }
}

void EdgeCounts::ask_sides(std::size_t m, const surface::SidesAsked& asked,
                           const std::vector<EdgeAsked>& edges)
{
    double all = 0, until = 0;
    for (const EdgeAsked& edge : edges) all += edge.length;
    int before = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        until += edges[k].length;
        const auto left = static_cast<int>(edges.size() - k - 1);
        const int node = left == 0 ? asked.count
                                   : std::clamp(static_cast<int>(std::lround(asked.count * until / all)),
                                                before + 1, asked.count - left);
        const std::size_t e = edges_.number(m, edges[k].edge);
        ask_class(e, {node - before, edges_.members()[m].region, asked.name});
        if (edges.size() == 1 && asked.bias != 1)
            bias_[edges_.set_of(e)] = {e, edges[k].reversed ? 1 / asked.bias : asked.bias};
        before = node;
    }
}

void EdgeCounts::ask_class(std::size_t e, const SidesOfClass& sides)
{
    const auto [found, fresh] = intervals_.try_emplace(class_of(e), sides);
    if (fresh || found->second.count == sides.count) return;
    const SidesOfClass& before = found->second;
    throw NotSweepable(Message("surface.sides_asked",
                               "intervals: matching edges cannot have both {} sides ({}: {}) and {} ({}: {})",
                               lacuna::found(sides.count), sides.region, sides.name, needed(before.count),
                               before.region, before.name)
                           .remedy("ask for the same number in both"));
}

int EdgeCounts::layers_asked(std::size_t m) const
{
    const LayerSpec& spec = edges_.members()[m].options.layers;
    const auto demands = demands_.find(m);
    if (demands != demands_.end() && demands->second.layers) return demands->second.layers->count;
    return spec.heights.empty() ? spec.count : static_cast<int>(spec.heights.size());
}

double EdgeCounts::followed_sides(const Followed& followed, const MemberEdge& edge) const
{
    double sides = 0;
    for (std::size_t i = 1; i < followed.ends.size(); ++i)
        sides += std::max(1.0, std::round((followed.ends[i] - followed.ends[i - 1]) * edge.length /
                                          size(edge.member, edge.middle)));
    return sides;
}

double EdgeCounts::wanted(const MemberEdge& edge) const
{
    const std::vector<Vec3> line = surface::edge_line(edges_.model(edge.member), edge.edge);
    double sides = 0, turn = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 &a = line[i], &b = line[i + 1];
        sides += (b - a).norm() / size(edge.member, (a + b) / 2);
        if (i > 0) turn += geometry::angle_between(a - line[i - 1], b - a);
    }
    const std::size_t set = edges_.set_of(edges_.number(edge.member, edge.edge));
    if (const Followed* follows = followed(set)) return followed_sides(*follows, edge);
    const auto lines = sides_.find(edge.member);
    const bool is_side = lines != sides_.end() &&
                         std::ranges::find(lines->second, edge.edge, &EdgeUse::edge) != lines->second.end();
    if (is_side) sides = std::max(sides, static_cast<double>(layers_[edge.member]));
    return std::max(sides, turn * per_turn_[edge.member] / (2 * std::numbers::pi));
}

void EdgeCounts::count()
{
    std::map<std::size_t, std::size_t> asked; // for each class: the member that requests layers
    for (const auto& [m, sides] : sides_) {
        if (layers_asked(m) == 0 || sides.empty()) continue;
        const auto [found, fresh] = asked.try_emplace(class_of(edges_.number(m, sides.front().edge)), m);
        const AssemblyMember &a = edges_.members()[found->second], &b = edges_.members()[m];
        if (fresh || layers_asked(found->second) == layers_asked(m)) continue;
        throw NotSweepable(Message("assembly.layers",
                                   "{} and {} lie side by side and are swept in the same direction, so they "
                                   "need equal numbers of layers, but {} and {} are requested",
                                   a.region, b.region, lacuna::found(layers_asked(found->second)),
                                   lacuna::found(layers_asked(m)))
                               .remedy("ask for the same number in both"));
    }
    ask_sides();
    for (const auto& [of, m] : asked)
        if (const auto other = intervals_.find(of); other != intervals_.end())
            ask_class(of, {layers_asked(m), edges_.members()[m].region, "its layers"});
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        SameEdges::Kept& of = kept_of_class_[class_of(e)];
        of = std::max(of, edges_.kept(e));
    }
    find_dense();
    std::map<std::size_t, double> most;
    for (const auto& [of, dense] : dense_)
        most[of] = std::accumulate(dense.begin(), dense.end(), 0.0) / kFineChords;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const std::size_t of = class_of(e);
        double& sides = most[of];
        if (asked.contains(of) || edges_.kept(e) != kept_of_class_.at(of)) continue;
        const auto [taken, left] = beside_rows(e);
        sides = std::max(sides, edges_.kept(e) != SameEdges::Kept::no ? edges_.given_sides(e)
                                : taken == 0                          ? wanted(edges_[e])
                                             : taken + std::max(1.0, std::round(wanted(edges_[e]) * left /
                                                                                edges_[e].length)));
    }
    for (const auto& [of, sides] : most) {
        if (!(sides < std::numeric_limits<Index>::max() / 16.0))
            throw InvalidInput(
                Message("sweep.too_many",
                        "an edge of the assembly would have more sides than node numbers allow")
                    .remedy("use a larger 'size'"));
        count_[of] = std::max(1, static_cast<int>(std::lround(sides)));
    }
    const auto ask = [&](std::size_t of, int sides) {
        count_[of] = sides;
        asked_.insert(of);
    };
    for (const auto& [of, m] : asked) ask(of, layers_asked(m));
    for (const auto& [m, sides] : sides_)
        if (!sides.empty() && !heights_[m].empty())
            ask(class_of(edges_.number(m, sides.front().edge)), static_cast<int>(heights_[m].size()));
    for (const auto& [of, sides] : intervals_)
        if (kept_of_class_.at(of) != SameEdges::Kept::quads) // the sweep reports a conflict of numbers
            ask(of, sides.count);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (edges_[e].closed) count_[class_of(e)] = std::max(count_[class_of(e)], 4);
    }
    check_rows();
}

void EdgeCounts::settle()
{
    const auto before = count_;
    if (settle(true) || chains_.empty()) return;
    count_ = before;
    bumps_.clear();
    settle(false);
}

bool EdgeCounts::settle(bool chains)
{
    for (int round = 0; round < kMostRounds; ++round) {
        bool changed = chains && match_chains();
        for (std::size_t m = 0; m < edges_.members().size(); ++m)
            for (const FaceId face : all_faces(edges_.model(m)))
                if (!edges_.is_wall(m, face)) changed = make_even(m, face, round) || changed;
        if (!changed) return true;
    }
    return false;
}

bool EdgeCounts::match_chains()
{
    const auto is_free = [&](std::size_t e) {
        return planned_[e] && !asked_.contains(class_of(e)) &&
               kept_of_class_.at(class_of(e)) == SameEdges::Kept::no;
    };
    bool changed = false;
    for (const Chain& chain : chains_) {
        if (!planned_[chain.whole] ||
            !std::ranges::all_of(chain.parts, [&](std::size_t e) -> bool { return planned_[e]; }))
            continue;
        int missing = -sides_of(chain.whole);
        for (const std::size_t part : chain.parts) missing += sides_of(part);
        const auto side = [&](std::size_t e) { return is_free(e) ? edges_[e].length / sides_of(e) : 0.0; };
        const std::size_t e = missing > 0 ? chain.whole : *std::ranges::max_element(chain.parts, {}, side);
        if (missing == 0 || !is_free(e)) continue;
        count_.at(class_of(e)) += std::abs(missing);
        changed = true;
    }
    return changed;
}

bool EdgeCounts::make_even(std::size_t m, FaceId face, int round)
{
    std::map<std::size_t, int> uses; // number of uses of each class by the face
    int sides = 0;
    for (const Loop& loop : border_loops(edges_.model(m), face)) {
        for (const EdgeUse& use : loop.uses) {
            const std::size_t e = edges_.number(m, use.edge);
            if (!planned_[e] && edges_.kept(e) == SameEdges::Kept::no) return false;
            const std::size_t of = class_of(e);
            ++uses[of];
            sides += count_.at(of);
        }
    }
    if (sides % 2 == 0) return false;
    std::size_t best = edges_.size();
    for (const auto& [of, times] : uses) {
        if (times % 2 == 0 || asked_.contains(of) || kept_of_class_.at(of) == SameEdges::Kept::quads)
            continue;
        // Later rounds choose the next class, so that two ends do not undo each other's changes. Classes
        // with given nodes on rims of faces whose mesh only defines the shape are changed last.
        const auto before = [&](std::size_t a, std::size_t b) {
            return std::tuple(kept_of_class_.at(a) != SameEdges::Kept::rim, -bumps_[a], count_.at(a)) >
                   std::tuple(kept_of_class_.at(b) != SameEdges::Kept::rim, -bumps_[b], count_.at(b));
        };
        if (best == edges_.size() || before(of, best)) best = of;
    }
    if (best == edges_.size()) return false;
    ++bumps_[best];
    count_[best] += round < kMostRounds / 2 ? 1 : count_[best] % 2;
    return true;
}

void EdgeCounts::find_dense()
{
    std::set<std::size_t> layered;
    for (const auto& [m, sides] : sides_)
        for (const EdgeUse& side : sides) layered.insert(class_of(edges_.number(m, side.edge)));
    std::vector<double> at;
    for (std::size_t i = 0; i < kFineChords; ++i) at.push_back((static_cast<double>(i) + 0.5) / kFineChords);
    for (std::size_t m = 0; m < edges_.members().size(); ++m) {
        const AssemblyMember& member = edges_.members()[m];
        if (member.fixed != nullptr) continue;
        SourceSize sizes;
        sizes.asked = [this, m](const Vec3& p) { return size(m, p); };
        SweepOptions options = member.options;
        // More quads across are left to the member's own edges: all neighbours would be fine there too.
        options.gap = options.gap > 0 || !options.size ? 1 : 0;
        reduce_by_shape(*member.volume, options, sizes);
        if (!sizes.shape.width) continue;
        for (const FaceId face : member.volume->faces(Role::source))
            for (const Loop& loop : border_loops(edges_.model(m), face))
                for (const EdgeUse& use : loop.uses) {
                    const std::size_t e = edges_.number(m, use.edge);
                    if (layered.contains(class_of(e)) || edges_.kept(e) != SameEdges::Kept::no) continue;
                    std::vector<double>& dense = dense_[class_of(e)];
                    dense.resize(kFineChords, 0);
                    std::vector<Vec3> points = surface::edge_points(edges_.model(m), use.edge, at);
                    if (reversed_[e]) std::ranges::reverse(points);
                    for (std::size_t i = 0; i < kFineChords; ++i)
                        dense[i] = std::max(dense[i], edges_[e].length / sizes.shape.at(points[i]));
                }
    }
    for (const LineAhead& line : ahead_) {
        if (layered.contains(class_of(line.edge)) || edges_.kept(line.edge) != SameEdges::Kept::no) continue;
        std::vector<double>& dense = dense_[class_of(line.edge)];
        dense.resize(kFineChords, 0);
        const double length = edges_[line.edge].length;
        for (std::size_t i = 0; i < kFineChords; ++i) {
            const double share = reversed_[line.edge] ? 1 - at[i] : at[i];
            const double off = std::max({line.from - share, share - line.to, 0.0}) * length;
            dense[i] = std::max(dense[i], length / (line.size + kGrading * off));
        }
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) { // the rest of a bent edge still has its sides
        const auto dense = dense_.find(class_of(e));
        if (dense == dense_.end()) continue;
        const double least = wanted(edges_[e]);
        for (double& sides : dense->second) sides = std::max(sides, least);
    }
}

std::vector<double> EdgeCounts::spread(std::size_t e, int count) const
{
    std::vector<double> at;
    const std::vector<double>* dense = entry(dense_, class_of(e));
    if (dense == nullptr || edges_[e].closed) {
        for (int i = 0; i <= count; ++i) at.push_back(static_cast<double>(i) / count);
        return at;
    }
    std::vector<double> sums{0};
    for (const double sides : *dense) sums.push_back(sums.back() + sides);
    std::size_t k = 0;
    for (int i = 0; i < count; ++i) {
        const double sum = sums.back() * i / count;
        while (sums[k + 1] < sum) ++k;
        at.push_back((static_cast<double>(k) + (sum - sums[k]) / (*dense)[k]) / kFineChords);
    }
    at.push_back(1);
    if (reversed_[e]) reverse_heights(at);
    return at;
}

double EdgeCounts::size(std::size_t m, const Vec3& p) const
{
    if (edges_.members()[m].options.size) return edges_.members()[m].options.size(p);
    return spacing_[m];
}

int EdgeCounts::layers_of(std::size_t m, const std::vector<std::vector<EdgeUse>>& lines) const
{
    double layers = std::max(layers_asked(m), layers_[m]);
    if (const auto sides = sides_.find(m); sides != sides_.end())
        layers = count_.at(class_of(edges_.number(m, sides->second.front().edge)));
    std::size_t most = 1;
    for (const std::vector<EdgeUse>& line : lines) {
        double wanted_here = 0;
        for (const EdgeUse& use : line) wanted_here += wanted(edges_[edges_.number(m, use.edge)]);
        if (!sides_.contains(m) && layers_asked(m) == 0) layers = std::max(layers, wanted_here);
        most = std::max(most, line.size());
    }
    return std::max(static_cast<int>(std::lround(layers)), static_cast<int>(most));
}

void EdgeCounts::find_frame()
{
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const std::size_t m = edges_[e].member;
        frame_.push_back(
            std::ranges::any_of(edges_.model(m).uses_of_edge(edges_[e].edge),
                                [&](const FaceUse& user) { return !edges_.is_wall(m, user.face); }));
    }
    for (const auto& [m, sides] : sides_)
        for (const EdgeUse& side : sides) frame_[edges_.number(m, side.edge)] = true;
}

} // namespace lacuna::sweep
