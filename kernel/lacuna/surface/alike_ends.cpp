// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/alike_ends.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/shared/imprint.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Two vertices without a side line are paired only if their positions on the two rims, as shares of the
/// rims' lengths, differ by less than this. Heuristic.
constexpr double kFarRound = 0.125;

/// An item of a face's loop: an inner edge, or a sequence of rim edges between two inner edges.
struct Item {
    EdgeUse use; ///< for a rim item: the first edge use of the sequence
    bool rim = false;
    VertexId from;
};

using Walk = std::vector<Item>;

class Matcher {
public:
    Matcher(const OpenVolume& volume, std::span<const LinkingSurface> links)
        : volume_(volume), model_(volume.model), links_(links)
    {
        for (const Role role : {Role::source, Role::target}) {
            for (const EdgeId edge : inner_edges(volume, role)) {
                inner_.insert(edge);
                ends_.insert({model_[edge].from, model_[edge].to});
            }
        }
    }

    std::optional<AlikeEnds> run()
    {
        const std::size_t sources = volume_.faces(Role::source).size();
        if (sources != volume_.faces(Role::target).size() ||
            !std::ranges::all_of(links_, [&](const LinkingSurface& link) { return pair(link); }) ||
            !walk_faces(Role::source) || !walk_faces(Role::target) ||
            !std::ranges::all_of(result_.pairs, [&](const RimPair& pair) { return match_at(pair); }) ||
            !std::ranges::all_of(links_, [&](const LinkingSurface& link) { return match_rims(link); }))
            return std::nullopt;
        for (bool grown = true; grown;) {
            for (; next_ < front_.size(); ++next_) {
                const auto [low, high] = front_[next_];
                if (!match(at_use_.at(low), at_use_.at(high))) return std::nullopt;
            }
            const std::optional<bool> more = match_inside();
            if (!more) return std::nullopt;
            grown = *more;
        }
        std::set<FaceId> covered;
        for (const auto& [low, high] : result_.faces) covered.insert(high);
        if (result_.faces.size() != sources || covered.size() != sources) return std::nullopt;
        return std::move(result_);
    }

private:
    struct End {
        VertexId vertex;
        double at; ///< share of the source rim
    };

    /// Number of side lines before a position on the source's rim.
    static std::ptrdiff_t lines_before(const LinkingSurface& link, double at)
    {
        return std::ranges::count_if(link.lines, [&](const LinkingLine& line) {
            return line.source_at <= (at + kSamePlace) * link.source.length();
        });
    }

    /// Pair the end vertices of the inner edges on both rims, in order.
    bool pair(const LinkingSurface& link)
    {
        std::vector<End> low, high;
        for (std::size_t i = 0; i < link.source.uses().size(); ++i) {
            const VertexId vertex = use_from(model_, link.source.uses()[i]);
            if (ends_.contains(vertex)) low.push_back({vertex, link.source.start(i) / link.source.length()});
        }
        for (std::size_t i = 0; i < link.target.uses().size(); ++i) {
            const VertexId vertex = use_from(model_, link.target.uses()[i]);
            if (!ends_.contains(vertex)) continue;
            double at = target_coordinate(link, link.target.start(i));
            if (at > 1 - kSamePlace) at -= 1;
            high.push_back({vertex, at});
        }
        std::ranges::stable_sort(high, {}, &End::at);
        if (low.size() != high.size()) return false;
        const std::size_t n = low.size();
        const auto off = [&](std::size_t i, std::size_t shift) {
            const double d = std::abs(low[i].at - high[(i + shift) % n].at);
            return std::min(d, 1 - d);
        };
        std::size_t best = 0;
        double least = 0;
        for (std::size_t shift = 0; shift < n; ++shift) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) sum += off(i, shift);
            if (shift > 0 && sum >= least) continue;
            least = sum;
            best = shift;
        }
        for (std::size_t i = 0; i < n; ++i) {
            const End& other = high[(i + best) % n];
            if (off(i, best) > kFarRound || lines_before(link, low[i].at) != lines_before(link, other.at))
                return false;
            result_.pairs.push_back({low[i].vertex, other.vertex});
        }
        return true;
    }

    bool walk_faces(Role role)
    {
        for (const FaceId face : volume_.faces(role))
            for (const std::vector<EdgeUse>& chain : closed_chains(face))
                if (!add_walk(face, chain)) return false;
        return true;
    }

    /// The loops of a face without its seams. A seam, which has its face on both sides, joins two closed
    /// chains to one loop.
    [[nodiscard]] std::vector<std::vector<EdgeUse>> closed_chains(FaceId face) const
    {
        std::map<EdgeId, int> times;
        for (const EdgeUse& use : uses_of(model_[face])) ++times[use.edge];
        std::vector<std::vector<EdgeUse>> chains;
        for (const Loop& loop : model_[face].loops) {
            const std::size_t first = chains.size();
            for (const EdgeUse& use : loop.uses) {
                if (times[use.edge] > 1) continue;
                if (chains.size() == first || use_to(model_, chains.back().back()) != use_from(model_, use))
                    chains.emplace_back();
                chains.back().push_back(use);
            }
            // The last chain may continue in the first one.
            if (chains.size() - first < 2 ||
                use_to(model_, chains.back().back()) != use_from(model_, chains[first].front()))
                continue;
            chains.back().insert(chains.back().end(), chains[first].begin(), chains[first].end());
            chains[first] = std::move(chains.back());
            chains.pop_back();
        }
        return chains;
    }

    /// @return  false if the face touches itself
    bool add_walk(FaceId face, const std::vector<EdgeUse>& chain)
    {
        Walk walk;
        for (const EdgeUse& use : chain) {
            if (inner_.contains(use.edge))
                walk.push_back({use, false, use_from(model_, use)});
            else if (walk.empty() || !walk.back().rim || ends_.contains(use_from(model_, use)))
                walk.push_back({use, true, use_from(model_, use)});
        }
        // If the sequence of rim edges at the end of the chain continues at its start, both are one item.
        if (walk.size() > 1 && walk.front().rim && walk.back().rim && !ends_.contains(walk.front().from)) {
            walk.front() = walk.back();
            walk.pop_back();
        }
        for (std::size_t i = 0; i < walk.size(); ++i) {
            if (!walk[i].rim) at_use_[walk[i].use] = {walks_.size(), i};
            if (walk[i].rim && walk.size() == 1) {
                for (const EdgeUse& use : chain) at_rim_[use.edge] = walks_.size();
            }
            if (!place_.try_emplace({walk[i].from, face}, std::pair(walks_.size(), i)).second &&
                ends_.contains(walk[i].from))
                return false;
        }
        walks_.push_back(std::move(walk));
        face_.push_back(face);
        return true;
    }

    /// Match the loops of the faces on both sides of a pair of vertices. At a vertex, a loop is found by the
    /// edge use of the rim that leaves the vertex: in the rim's direction on the source, against it on the
    /// target.
    bool match_at(const RimPair& pair)
    {
        for (const auto& [key, low] : place_) {
            if (key.first != pair.source || !walks_[low.first][low.second].rim) continue;
            for (const auto& [other, high] : place_) {
                if (other.first != pair.target) continue;
                // The source's loop leaves the vertex along the rim. The target's loop runs in the opposite
                // direction, so its item that arrives at the vertex corresponds.
                const Walk& walk = walks_[high.first];
                const std::size_t before = (high.second + walk.size() - 1) % walk.size();
                if (walk[before].rim && !match(low, {high.first, before})) return false;
            }
        }
        return true;
    }

    /// Match the faces beside rims at which no inner edge ends.
    bool match_rims(const LinkingSurface& link)
    {
        const auto low = at_rim_.find(link.source.uses().front().edge);
        const auto high = at_rim_.find(link.target.uses().front().edge);
        const bool whole = low != at_rim_.end() && high != at_rim_.end() && walks_[low->second].size() == 1 &&
                           walks_[high->second].size() == 1;
        return !whole || match({low->second, 0}, {high->second, 0});
    }

    /// Match one inner loop of two faces that are already matched. An affine map of the source's rims onto
    /// the target's rims is applied to the source's loop; the closest loop of the target's face corresponds.
    /// @return  whether a loop was matched; empty if an inner loop has no counterpart.
    std::optional<bool> match_inside()
    {
        const std::map<FaceId, FaceId> faces = result_.faces;
        for (const auto& [source, target] : faces) {
            for (std::size_t a = 0; a < walks_.size(); ++a) {
                if (face_[a] != source || done_.contains(a)) continue;
                std::optional<std::pair<std::size_t, std::size_t>> best;
                double least = kAlikeLoops;
                for (std::size_t b = 0; b < walks_.size(); ++b) {
                    if (face_[b] != target || done_.contains(b) || walks_[b].size() != walks_[a].size())
                        continue;
                    for (std::size_t j = 0; j < walks_[b].size(); ++j) {
                        const double off = offset(walks_[a], walks_[b], j);
                        if (off >= least) continue;
                        least = off;
                        best = {b, j};
                    }
                }
                if (!best || !match({a, 0}, *best)) return std::nullopt;
                return true;
            }
        }
        return false;
    }

    /// Distance between corresponding vertices of two loops, divided by the loop's radius, under the
    /// assumption that item `j` of the target's loop corresponds to the first item of the source's loop.
    double offset(const Walk& a, const Walk& b, std::size_t j)
    {
        if (!fit_) fit_rims();
        const auto flat = [&](const Vec3& p) { return Vec3(p - p.dot(up_) * up_); };
        std::vector<Vec3> outline;
        for (const Item& item : b) {
            for (const Index p : model_[item.use.edge].points) outline.push_back(flat(model_.at(p)));
        }
        const Vec3 centre = geometry::mean_point(outline);
        double radius = 0, far = 0;
        for (const Vec3& p : outline) radius = std::max(radius, (p - centre).norm());
        for (std::size_t k = 0; k < a.size(); ++k) {
            const Item& high = b[(j + b.size() - k) % b.size()];
            const Vec3 to = flat(model_.at(model_[use_to(model_, high.use)].point));
            const Vec3 from = flat((*fit_)(model_.at(model_[a[k].from].point)));
            far = std::max(far, (to - from).norm());
        }
        return radius > 0 ? far / radius : kAlikeLoops;
    }

    /// The affine map from the source's rims to the target's rims, and the normal of the target.
    void fit_rims()
    {
        std::vector<Vec3> low, high;
        Vec3 low_area = Vec3::Zero(), high_area = Vec3::Zero();
        for (const LinkingSurface& link : links_) {
            std::vector<double> from, to;
            for (const RimSegment& segment : link.segments) {
                for (const double f : {0.0, 0.25, 0.5, 0.75}) {
                    from.push_back(segment.source_from + f * (segment.source_to - segment.source_from));
                    to.push_back(link.target.wrapped(segment.target_from +
                                                     f * (segment.target_to - segment.target_from)));
                }
            }
            const std::vector<Vec3> a = link.source.points(from), b = link.target.points(to);
            low_area += geometry::newell_vector(a);
            high_area += geometry::newell_vector(b);
            low.insert(low.end(), a.begin(), a.end());
            high.insert(high.end(), b.begin(), b.end());
        }
        fit_ = geometry::fit_affine(low, high, low_area, high_area);
        up_ = high_area.stableNormalized();
    }

    /// Match two loops item by item. The target's loop is traversed backwards.
    bool match(std::pair<std::size_t, std::size_t> low, std::pair<std::size_t, std::size_t> high)
    {
        const Walk &a = walks_[low.first], &b = walks_[high.first];
        if (a.size() != b.size()) return false;
        const auto [known, fresh] = result_.faces.try_emplace(face_[low.first], face_[high.first]);
        if (known->second != face_[high.first]) return false;
        done_.insert({low.first, high.first});
        for (std::size_t k = 0; k < a.size(); ++k) {
            const Item& i = a[(low.second + k) % a.size()];
            const Item& j = b[(high.second + b.size() - k) % b.size()];
            if (i.rim != j.rim) return false;
            if (i.rim) continue;
            const auto [edge, added] = result_.edges.try_emplace(i.use, j.use);
            if (edge->second.edge != j.use.edge || edge->second.reversed != j.use.reversed) return false;
            if (added) front_.emplace_back(opposite(i.use), opposite(j.use));
        }
        return true;
    }

    const OpenVolume& volume_;
    const Model& model_;
    std::span<const LinkingSurface> links_;
    std::set<EdgeId> inner_;
    std::set<VertexId> ends_;
    AlikeEnds result_;
    std::vector<Walk> walks_;
    std::vector<FaceId> face_; ///< for each walk, its face
    std::map<EdgeUse, std::pair<std::size_t, std::size_t>> at_use_;
    std::map<std::pair<VertexId, FaceId>, std::pair<std::size_t, std::size_t>> place_;
    std::map<EdgeId, std::size_t> at_rim_; ///< for each edge of a rim without inner edges, its walk
    std::vector<std::pair<EdgeUse, EdgeUse>> front_;
    std::size_t next_ = 0;       ///< index in `front_` of the next pair to visit
    std::set<std::size_t> done_; ///< walks that are matched
    std::optional<geometry::AffineFit> fit_;
    Vec3 up_ = Vec3::Zero();
};

} // namespace

std::optional<AlikeEnds> alike_ends(const OpenVolume& volume, std::span<const LinkingSurface> links)
{
    return Matcher(volume, links).run();
}

} // namespace lacuna::surface
