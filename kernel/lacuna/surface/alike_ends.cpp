// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/alike_ends.h>

#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/surface/imprint.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Vertices this far apart round the rim are not swept to each other where no side line says so [share of the
/// rim]. A choice, not a measurement.
constexpr double kFarRound = 0.125;

/// A part of a face's loop: an inner edge, or a run of rim edges between inner ones.
struct Item {
    EdgeUse use; ///< of a rim: its first
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
        if (sources != volume_.faces(Role::target).size()) return std::nullopt;
        for (const LinkingSurface& link : links_) {
            if (!pair(link)) return std::nullopt;
        }
        if (!walk_faces(Role::source) || !walk_faces(Role::target)) return std::nullopt;
        for (const RimPair& pair : result_.pairs) {
            if (!match_at(pair)) return std::nullopt;
        }
        for (std::size_t i = 0; i < front_.size(); ++i) {
            const auto [low, high] = front_[i];
            if (!match_across(low, high)) return std::nullopt;
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

    /// Side lines passed before a place of the source's rim.
    static std::size_t lines_before(const LinkingSurface& link, double at)
    {
        std::size_t count = 0;
        for (const LinkingLine& line : link.lines) {
            if (line.source_at <= (at + 1e-9) * link.source.length()) ++count;
        }
        return count;
    }

    /// Pair the ends of inner edges on a loop's rims, in order.
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
            if (at > 1 - 1e-9) at -= 1;
            high.push_back({vertex, at});
        }
        std::stable_sort(high.begin(), high.end(), [](const End& a, const End& b) { return a.at < b.at; });
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
        for (const FaceId face : volume_.faces(role)) {
            for (const Loop& loop : model_[face].loops) {
                Walk walk;
                for (const EdgeUse& use : loop.uses) {
                    if (inner_.contains(use.edge))
                        walk.push_back({use, false, use_from(model_, use)});
                    else if (walk.empty() || !walk.back().rim || ends_.contains(use_from(model_, use)))
                        walk.push_back({use, true, use_from(model_, use)});
                }
                // A run over the loop's start is one.
                if (walk.size() > 1 && walk.front().rim && walk.back().rim &&
                    !ends_.contains(walk.front().from)) {
                    walk.front() = walk.back();
                    walk.pop_back();
                }
                for (std::size_t i = 0; i < walk.size(); ++i) {
                    if (!walk[i].rim) at_use_[walk[i].use] = {walks_.size(), i};
                    if (!place_.try_emplace({walk[i].from, face}, std::pair(walks_.size(), i)).second &&
                        ends_.contains(walk[i].from))
                        return false; // a face that meets itself
                }
                walks_.push_back(std::move(walk));
                face_.push_back(face);
            }
        }
        return true;
    }

    /// The rim that leaves a pair's vertices: the source's runs on, the target's back.
    bool match_at(const RimPair& pair)
    {
        for (const auto& [key, low] : place_) {
            if (key.first != pair.source || !walks_[low.first][low.second].rim) continue;
            for (const auto& [other, high] : place_) {
                if (other.first != pair.target) continue;
                // The source's walk leaves the vertex by the rim; the target's comes to it so.
                const Walk& walk = walks_[high.first];
                const std::size_t before = (high.second + walk.size() - 1) % walk.size();
                if (walk[before].rim && !match(low, {high.first, before})) return false;
            }
        }
        return true;
    }

    bool match_across(const EdgeUse& low, const EdgeUse& high)
    {
        return match(at_use_.at(low), at_use_.at(high));
    }

    /// Match two loops item by item, the target's backwards.
    bool match(std::pair<std::size_t, std::size_t> low, std::pair<std::size_t, std::size_t> high)
    {
        const Walk &a = walks_[low.first], &b = walks_[high.first];
        if (a.size() != b.size()) return false;
        const auto [known, fresh] = result_.faces.try_emplace(face_[low.first], face_[high.first]);
        if (known->second != face_[high.first]) return false;
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

    static EdgeUse opposite(EdgeUse use) { return {use.edge, !use.reversed}; }

    const OpenVolume& volume_;
    const Model& model_;
    std::span<const LinkingSurface> links_;
    std::set<EdgeId> inner_;
    std::set<VertexId> ends_;
    AlikeEnds result_;
    std::vector<Walk> walks_;
    std::vector<FaceId> face_; ///< of each walk
    std::map<EdgeUse, std::pair<std::size_t, std::size_t>> at_use_;
    std::map<std::pair<VertexId, FaceId>, std::pair<std::size_t, std::size_t>> place_;
    std::vector<std::pair<EdgeUse, EdgeUse>> front_;
};

} // namespace

std::optional<AlikeEnds> alike_ends(const OpenVolume& volume, std::span<const LinkingSurface> links)
{
    return Matcher(volume, links).run();
}

} // namespace lacuna::surface
