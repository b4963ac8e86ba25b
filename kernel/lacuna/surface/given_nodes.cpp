// SPDX-License-Identifier: MIT
#include <lacuna/surface/given_nodes.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/core/error.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/detail/paired_breaks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Two rims with other numbers of nodes are compared node by node up to this many pairs: 32 MB and 0.1 s.
constexpr std::size_t kMostPairs = 4'000'000;

/// Edges that keep their nodes, by themselves or with the mesh of a face.
std::set<EdgeId> kept_edges(const Model& model)
{
    std::set<EdgeId> edges;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        if (model.edges[e].keeps_nodes) edges.emplace(e);
    }
    for (const Face& face : model.faces) {
        if (!face.keeps_nodes) continue;
        for (const Loop& loop : face.loops) {
            for (const EdgeUse& use : loop.uses) edges.insert(use.edge);
        }
    }
    return edges;
}

std::string place_of(const Model& model, const Quad& quad)
{
    Vec3 sum = Vec3::Zero();
    for (const Index n : quad) sum += model.at(n);
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g)", sum.x() / 4, sum.y() / 4, sum.z() / 4);
    return text.data();
}

[[noreturn]] void refuse_rows(const std::string& wall, int rows, const std::string& other, int other_rows)
{
    throw NotSweepable("surface.wall_rows",
                       wall + " came with " + std::to_string(rows) +
                           " rows of quads between source and target, and " + other + " with " +
                           std::to_string(other_rows) +
                           "; a sweep has as many layers everywhere: mesh them alike, or load with "
                           "keep_mesh = false");
}

/// The quads of a linking surface's walls, walked from rim to rim.
class ColumnWalker {
public:
    ColumnWalker(const OpenVolume& volume, const LinkingSurface& link) : model_(volume.model), link_(link)
    {
        for (const FaceId wall : link.walls) {
            if (!model_[wall].keeps_nodes || !has_quads_all_over(model_[wall])) continue;
            for (const Quad& quad : model_[wall].given_quads) {
                for (std::size_t k = 0; k < 4; ++k)
                    beside_[edge_key(quad[k], quad[(k + 1) % 4])].push_back(quads_.size());
                quads_.push_back({quad, wall, false});
            }
        }
    }

    GivenColumns run(std::vector<std::string>& notes)
    {
        GivenColumns columns;
        if (quads_.empty()) return columns;
        const std::vector<ChainNode> source = chain_nodes(model_, link_.source);
        const std::vector<ChainNode> target = chain_nodes(model_, link_.target);
        for (const ChainNode& node : target) target_at_.emplace(node.point, node.at);
        for (std::size_t i = 0; i < target.size(); ++i)
            target_sides_.insert(edge_key(target[i].point, target[(i + 1) % target.size()].point));

        std::vector<Strip> strips;
        for (std::size_t i = 0; i < source.size(); ++i) {
            strips.push_back(walk(source[i].point, source[(i + 1) % source.size()].point));
            strips.back().first = i;
            if (!strips.back().whole) strips.pop_back();
        }
        check_rows(strips);
        std::map<std::size_t, Column> column_at; // by number of the source node
        for (const Strip& strip : strips) {
            join(column_at, strip.first, strip.left, {});
            join(column_at, (strip.first + 1) % source.size(), strip.right, {});
            column_at[strip.first].faces = strip.faces;
            for (const std::size_t q : strip.quads) quads_[q].kept = true;
        }
        // What ends before the target, from below or from above, is no column; it is not kept, and said.
        mark_short_strips(source);
        mark_short_strips(target);
        check_all_walked();
        note_short_strips(notes);
        columns.rows = rows_;
        columns.quads = rows_ > 0;
        for (auto& [i, column] : column_at) {
            columns.source_at.push_back(source[i].at);
            columns.target_at.push_back(target_at_.at(column.points.back()));
            columns.points.push_back(std::move(column.points));
            columns.faces.push_back(std::move(column.faces));
        }
        return columns;
    }

private:
    struct WallQuad {
        Quad corners;
        FaceId wall;
        bool walked = false, kept = false;
    };
    struct Strip {
        std::vector<Index> left, right;
        std::vector<std::size_t> quads;
        std::vector<FaceId> faces;
        bool whole = false;
        std::size_t first = 0; ///< number of the source node on its left
    };
    struct Column {
        std::vector<Index> points;
        std::vector<FaceId> faces;
    };

    /// Over opposite sides from a side of a rim, as far as quads go.
    Strip walk(Index a, Index b)
    {
        Strip strip{{a}, {b}, {}, {}, false, 0};
        std::size_t last = quads_.size();
        while (strip.faces.size() <= quads_.size()) {
            const auto found = beside_.find(edge_key(a, b));
            if (found == beside_.end()) break;
            const auto next = std::find_if(found->second.begin(), found->second.end(),
                                           [&](std::size_t q) { return q != last; });
            if (next == found->second.end()) break;
            last = *next;
            WallQuad& quad = quads_[last];
            quad.walked = true;
            const std::size_t at = position(quad.corners, a);
            const bool onwards = quad.corners[(at + 1) % 4] == b;
            a = quad.corners[(at + (onwards ? 3 : 1)) % 4];
            b = quad.corners[(at + 2) % 4];
            strip.left.push_back(a);
            strip.right.push_back(b);
            strip.quads.push_back(last);
            strip.faces.push_back(quad.wall);
            if (target_sides_.contains(edge_key(a, b))) {
                strip.whole = true;
                break;
            }
        }
        return strip;
    }

    static std::size_t position(const Quad& quad, Index point)
    {
        return static_cast<std::size_t>(std::find(quad.begin(), quad.end(), point) - quad.begin());
    }

    void join(std::map<std::size_t, Column>& columns, std::size_t i, const std::vector<Index>& points,
              const std::vector<FaceId>& faces)
    {
        const auto [found, fresh] = columns.try_emplace(i, Column{points, faces});
        if (fresh || found->second.points == points) return;
        throw NotSweepable("surface.wall_not_rows",
                           "the quads that " + walls() +
                               " came with are no rows: beside the source's node at " +
                               place(points.front()) + " their columns part");
    }

    /// As many rows in all strips. Within one wall another number means that its quads are no rows; from wall
    /// to wall, that they were meshed unlike.
    void check_rows(const std::vector<Strip>& strips)
    {
        std::map<FaceId, std::size_t> rows_of;
        for (const Strip& strip : strips) {
            const std::size_t rows = strip.faces.size();
            const FaceId wall = strip.faces.front();
            const std::size_t first = rows_of.try_emplace(wall, rows).first->second;
            if (first == rows) continue;
            throw NotSweepable("surface.wall_not_rows",
                               "the quads that " + name_of(model_, wall) +
                                   " came with are no rows: " + std::to_string(first) +
                                   " of them lead from the source's rim to the target's in one column, and " +
                                   std::to_string(rows) + " in the one that starts with the quad at " +
                                   place_of(model_, quads_[strip.quads.front()].corners) +
                                   "; mesh the wall in rows, or load with keep_mesh = false");
        }
        for (const auto& [wall, rows] : rows_of) {
            const auto& [first_wall, first_rows] = *rows_of.begin();
            if (rows == first_rows) continue;
            refuse_rows(name_of(model_, first_wall), static_cast<int>(first_rows), name_of(model_, wall),
                        static_cast<int>(rows));
        }
        rows_ = strips.empty() ? 0 : static_cast<int>(strips.front().faces.size());
    }

    void mark_short_strips(const std::vector<ChainNode>& rim)
    {
        for (std::size_t i = 0; i < rim.size(); ++i) walk(rim[i].point, rim[(i + 1) % rim.size()].point);
    }

    void note_short_strips(std::vector<std::string>& notes) const
    {
        std::map<FaceId, std::size_t> left_out;
        for (const WallQuad& quad : quads_) {
            if (!quad.kept) ++left_out[quad.wall];
        }
        for (const auto& [wall, count] : left_out) {
            notes.push_back(name_of(model_, wall) + ": " + std::to_string(count) +
                            " of its quads do not go all the way from source to target, and are not kept");
        }
    }

    void check_all_walked() const
    {
        for (const WallQuad& quad : quads_) {
            if (quad.walked) continue;
            throw NotSweepable("surface.wall_not_rows",
                               "the quads that " + name_of(model_, quad.wall) +
                                   " came with are no rows from source to target: the first that is in none "
                                   "is the one at " +
                                   place_of(model_, quad.corners) +
                                   "; mesh the wall in rows, or load with keep_mesh = false");
        }
    }

    [[nodiscard]] std::string walls() const
    {
        std::set<FaceId> faces;
        for (const WallQuad& quad : quads_) faces.insert(quad.wall);
        std::string text;
        for (const FaceId face : faces) text += (text.empty() ? "" : ", ") + name_of(model_, face);
        return text;
    }

    [[nodiscard]] std::string place(Index point) const
    {
        return place_of(model_, {point, point, point, point});
    }

    const Model& model_;
    const LinkingSurface& link_;
    std::vector<WallQuad> quads_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> beside_; ///< quads at each side
    std::unordered_map<Index, double> target_at_;
    std::set<std::uint64_t> target_sides_;
    int rows_ = 0;
};

FaceId first_wall(const GivenColumns& columns)
{
    for (const std::vector<FaceId>& faces : columns.faces) {
        if (!faces.empty()) return faces.front();
    }
    return {};
}

/// Sides of a side line that is all edges of kept faces; 0 for others.
int line_rows(const Model& model, const LinkingLine& line, const std::set<EdgeId>& kept)
{
    int rows = 0;
    for (const EdgeUse& use : line.line.uses) {
        if (!kept.contains(use.edge)) return 0;
        rows += static_cast<int>(model[use.edge].points.size()) - 1;
    }
    return rows;
}

/// The number of sides that all kept side lines have; 0 where they differ or there are none.
int common_line_rows(const Model& model, std::span<const LinkingSurface> links, const std::set<EdgeId>& kept)
{
    int rows = 0;
    for (const LinkingSurface& link : links) {
        for (const LinkingLine& line : link.lines) {
            const int own = line_rows(model, line, kept);
            if (own == 0) continue;
            if (rows != 0 && rows != own) return 0;
            rows = own;
        }
    }
    return rows;
}

bool has_column(const GivenColumns& columns, const LinkingSurface& link, double source_at)
{
    const double slack = kSamePlace * link.source.length();
    return std::any_of(columns.source_at.begin(), columns.source_at.end(),
                       [&](double at) { return std::abs(at - source_at) <= slack; });
}

/// Make a side line a column of its own.
void add_column(const Model& model, const LinkingLine& line, GivenColumns& columns, int rows)
{
    std::vector<Index> points;
    for (const EdgeUse& use : line.line.uses) {
        const std::vector<Index> more = use_points(model, use);
        points.insert(points.end(), more.begin() + (points.empty() ? 0 : 1), more.end());
    }
    const auto after = std::upper_bound(columns.source_at.begin(), columns.source_at.end(), line.source_at);
    const auto at = after - columns.source_at.begin();
    columns.rows = rows;
    columns.source_at.insert(after, line.source_at);
    columns.target_at.insert(columns.target_at.begin() + at, line.target_at);
    columns.points.insert(columns.points.begin() + at, std::move(points));
    columns.faces.insert(columns.faces.begin() + at, std::vector<FaceId>{});
}

/// A break of the segments: a place on both rims that belongs together.
struct Break {
    double source = 0, target = 0; ///< running lengths; the target's may run past its length
    bool given = false;            ///< what lies between it and the next break is one side of a quad
};

/// The segments of one linking surface, with given nodes for breaks.
class BreakKeeper {
public:
    BreakKeeper(const OpenVolume& volume, const std::set<EdgeId>& kept, const GivenColumns& columns,
                LinkingSurface& link, bool wedges)
        : model_(volume.model), kept_(kept), columns_(columns), link_(link)
    {
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            const Face& face = model_.faces[f];
            const bool end = volume.role[f] != Role::wall;
            if (!face.keeps_nodes || !has_cells_to_keep(face, wedges && end)) continue;
            for (const Loop& loop : face.loops) {
                for (const EdgeUse& use : loop.uses) of_quads_.insert(use.edge);
            }
        }
        const auto is_kept = [&](EdgeId edge) { return kept_.contains(edge); };
        source_ = chain_nodes(model_, link.source, is_kept);
        target_ = chain_nodes(model_, link.target, is_kept);
    }

    void run(std::vector<std::string>& notes)
    {
        if (source_.empty() && target_.empty()) return;
        const double s_end = link_.source.length(), t_end = link_.target.length();
        std::vector<Break> breaks = old_breaks();
        if (link_.lines.empty()) align_start(breaks);
        breaks.push_back({s_end, breaks.front().target + t_end, false});
        breaks = with_columns(breaks);
        breaks = with_pairs_between_lines(breaks);
        std::vector<Break> result;
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) add_between(breaks[i], breaks[i + 1], result);
        link_.segments.clear();
        result.push_back(breaks.back());
        for (std::size_t i = 0; i + 1 < result.size(); ++i) {
            RimSegment segment{
                result[i].source, result[i + 1].source, result[i].target, result[i + 1].target, 0,
                result[i].given};
            segment.use = link_.source.position((segment.source_from + segment.source_to) / 2).use;
            link_.segments.push_back(segment);
        }
        if (lost_ > 0) {
            notes.push_back(std::to_string(lost_) + " given nodes of the target's rim from " +
                            name_of(model_, lost_edge_) +
                            " on are not kept: the source's rim has another number of them");
        }
    }

private:
    [[nodiscard]] std::vector<Break> old_breaks() const
    {
        std::vector<Break> breaks;
        for (const RimSegment& segment : link_.segments)
            breaks.push_back({segment.source_from, segment.target_from, false});
        return breaks;
    }

    [[nodiscard]] bool all_kept(const Chain& chain) const
    {
        return std::all_of(chain.uses().begin(), chain.uses().end(),
                           [&](const EdgeUse& use) { return kept_.contains(use.edge); });
    }

    /// A ring without side lines starts at a node of the target.
    void align_start(std::vector<Break>& breaks) const
    {
        const double length = link_.target.length();
        const double start = breaks.front().target;
        double move = 0;
        if (columns_.rows > 0) {
            // Node for node where quads lead up from the start.
            move = columns_.target_at.front() - start;
            if (columns_.source_at.front() > kSamePlace * link_.source.length()) return;
        } else if (all_kept(link_.target)) {
            double least = length;
            for (const ChainNode& node : target_) {
                const double off = std::remainder(node.at - start, length);
                if (std::abs(off) < least) {
                    least = std::abs(off);
                    move = off;
                }
            }
        }
        for (Break& b : breaks) b.target += move;
        const double turns = std::floor(breaks.front().target / length + kSamePlace);
        for (Break& b : breaks) b.target -= turns * length;
    }

    /// A running length of the target chain, whole turns added, that lies past `from`.
    [[nodiscard]] double past(double at, double from) const
    {
        const double length = link_.target.length();
        while (at < from - kSamePlace * length) at += length;
        return at;
    }

    /// Breaks at every column, and no other where quads lead from rim to rim.
    [[nodiscard]] std::vector<Break> with_columns(const std::vector<Break>& breaks) const
    {
        if (columns_.rows == 0) return breaks;
        const double slack = kSamePlace * link_.source.length();
        std::vector<Break> merged;
        std::size_t next = 0;
        double target = breaks.front().target;
        for (std::size_t c = 0; c <= columns_.source_at.size(); ++c) {
            const double limit = c < columns_.source_at.size() ? columns_.source_at[c]
                                                               : link_.source.length();
            const bool inside = c > 0 && !columns_.faces[c - 1].empty();
            for (; next < breaks.size() && breaks[next].source < limit - slack; ++next) {
                if (!inside && (merged.empty() || breaks[next].source > merged.back().source + slack))
                    merged.push_back(breaks[next]);
            }
            while (next < breaks.size() && breaks[next].source <= limit + slack) ++next;
            if (c == columns_.source_at.size()) break;
            target = past(columns_.target_at[c], merged.empty() ? target : merged.back().target);
            merged.push_back({columns_.source_at[c], target, !columns_.faces[c].empty()});
        }
        merged.push_back(breaks.back());
        return merged;
    }

    /// Where as many nodes are given on both ends between two side lines (or all round), they are paired in
    /// order.
    [[nodiscard]] std::vector<Break> with_pairs_between_lines(const std::vector<Break>& breaks) const
    {
        std::vector<double> hard;
        for (const LinkingLine& line : link_.lines) hard.push_back(line.source_at);
        if (hard.empty()) hard.push_back(breaks.front().source);
        hard.push_back(link_.source.length());
        const double slack = kSamePlace * link_.source.length();
        std::vector<Break> result;
        std::size_t i = 0;
        for (std::size_t h = 0; h + 1 < hard.size(); ++h) {
            std::vector<Break> between;
            for (; i < breaks.size() && breaks[i].source < hard[h + 1] - slack; ++i)
                between.push_back(breaks[i]);
            if (between.empty() || i >= breaks.size()) return breaks;
            const bool has_columns = std::any_of(between.begin(), between.end(),
                                                 [](const Break& b) { return b.given; });
            std::vector<Break> paired;
            if (!has_columns) paired = pairs(between.front(), breaks[i]);
            const std::vector<Break>& use = paired.empty() ? between : paired;
            result.insert(result.end(), use.begin(), use.end());
        }
        result.push_back(breaks.back());
        return result;
    }

    /// Nodes of both ends from `from` to below `to`, in order; empty where their numbers differ or not all
    /// edges are kept.
    [[nodiscard]] std::vector<Break> pairs(const Break& from, const Break& to) const
    {
        if (!covered(link_.source, from.source, to.source) || !covered(link_.target, from.target, to.target))
            return {};
        const std::vector<double> s = inside(source_, link_.source, from.source, to.source);
        const std::vector<double> t = inside(target_, link_.target, from.target, to.target);
        if (s.size() != t.size()) return {};
        std::vector<Break> result{{from.source, from.target, true}};
        for (std::size_t i = 0; i < s.size(); ++i) result.push_back({s[i], t[i], true});
        return result;
    }

    /// Whether a chain is on kept edges alone from a running length to another.
    [[nodiscard]] bool covered(const Chain& chain, double from, double to) const
    {
        std::set<EdgeId> others;
        for (const EdgeUse& use : chain.uses()) {
            if (!kept_.contains(use.edge)) others.insert(use.edge);
        }
        return others.empty() || !meets(chain, from, to, others);
    }

    /// Whether a chain is partly on one of some edges between two running lengths.
    [[nodiscard]] static bool meets(const Chain& chain, double from, double to, const std::set<EdgeId>& edges)
    {
        const double length = chain.length(), slack = kSamePlace * length;
        for (std::size_t u = 0; u < chain.uses().size(); ++u) {
            if (!edges.contains(chain.uses()[u].edge)) continue;
            for (int turn = 0; turn < 2; ++turn) {
                if (chain.start(u) + turn * length < to - slack &&
                    chain.start(u + 1) + turn * length > from + slack)
                    return true;
            }
        }
        return false;
    }

    /// Running lengths of given nodes strictly between two places.
    static std::vector<double> inside(const std::vector<ChainNode>& nodes, const Chain& chain, double from,
                                      double to)
    {
        const double length = chain.length(), slack = kSamePlace * length;
        std::vector<double> result;
        for (int turn = 0; turn < 2; ++turn) {
            for (const ChainNode& node : nodes) {
                const double at = node.at + turn * length;
                if (at > from + slack && at < to - slack) result.push_back(at);
            }
        }
        return result;
    }

    void add_between(const Break& from, const Break& to, std::vector<Break>& result)
    {
        if (from.given) {
            result.push_back(from);
            return;
        }
        std::vector<Break> both = pairs(from, to);
        if (!both.empty()) {
            result.insert(result.end(), both.begin(), both.end());
            return;
        }
        const bool source_kept = covered(link_.source, from.source, to.source);
        const bool target_kept = covered(link_.target, from.target, to.target);
        result.push_back({from.source, from.target, source_kept || target_kept});
        std::vector<double> s = inside(source_, link_.source, from.source, to.source);
        std::vector<double> t = inside(target_, link_.target, from.target, to.target);
        if (!source_kept) s.clear();
        if (!target_kept) t.clear();
        if (s.empty() && t.empty()) return;
        // Quads that stay can have no node more on their rim; triangles' rims can.
        std::vector<double>* left_out = nullptr;
        if (source_kept && meets(link_.source, from.source, to.source, of_quads_)) left_out = &t;
        if (left_out == nullptr && target_kept && meets(link_.target, from.target, to.target, of_quads_))
            left_out = &s;
        if (left_out == nullptr && s.size() * t.size() > kMostPairs) left_out = &t;
        if (left_out != nullptr && !left_out->empty()) {
            const bool target = left_out == &t;
            if (lost_ == 0)
                lost_edge_ = edge_at(target ? link_.target : link_.source,
                                     target ? from.target : from.source);
            lost_ += left_out->size();
            left_out->clear();
        }
        for (double& x : s) x = (x - from.source) / (to.source - from.source);
        for (double& x : t) x = (x - from.target) / (to.target - from.target);
        std::vector<std::pair<double, double>> shares = paired_breaks(s, t);
        complete(shares);
        for (const auto& [a, b] : shares) {
            result.push_back({from.source + a * (to.source - from.source),
                              from.target + b * (to.target - from.target), true});
        }
    }

    static EdgeId edge_at(const Chain& chain, double at)
    {
        const double wrapped = at >= chain.length() ? at - chain.length() : at;
        return chain.uses()[chain.position(wrapped + kSamePlace * chain.length()).use].edge;
    }

    const Model& model_;
    const std::set<EdgeId>& kept_;
    std::set<EdgeId> of_quads_; ///< edges of faces whose quads stay
    const GivenColumns& columns_;
    LinkingSurface& link_;
    std::vector<ChainNode> source_, target_; ///< given nodes
    std::size_t lost_ = 0;
    EdgeId lost_edge_;
};

} // namespace

std::vector<GivenColumns> given_columns(const OpenVolume& volume, std::span<const LinkingSurface> links,
                                        int layers, std::vector<std::string>& notes)
{
    std::vector<GivenColumns> columns;
    const GivenColumns* first = nullptr;
    for (const LinkingSurface& link : links) columns.push_back(ColumnWalker(volume, link).run(notes));
    for (const GivenColumns& own : columns) {
        if (own.rows == 0) continue;
        if (first == nullptr) first = &own;
        if (first->rows == own.rows) continue;
        refuse_rows(name_of(volume.model, first_wall(*first)), first->rows,
                    name_of(volume.model, first_wall(own)), own.rows);
    }
    const std::set<EdgeId> kept = kept_edges(volume.model);
    const int rows = first != nullptr ? first->rows : common_line_rows(volume.model, links, kept);
    if (rows == 0) return columns;
    for (std::size_t b = 0; b < links.size(); ++b) {
        for (const LinkingLine& line : links[b].lines) {
            const int own = line_rows(volume.model, line, kept);
            if (own == 0 || has_column(columns[b], links[b], line.source_at)) continue;
            if (own == rows && (layers == 0 || layers == rows)) {
                add_column(volume.model, line, columns[b], rows);
            } else {
                notes.push_back(name_of(volume.model, line.line.uses.front().edge) + " came with " +
                                std::to_string(own) + " sides from source to target, of which " +
                                std::to_string(layers > 0 ? layers : rows) + " layers keep the ends alone");
            }
        }
    }
    return columns;
}

std::vector<double> given_heights(const Model& model, std::span<const GivenColumns> columns)
{
    std::vector<double> sum;
    for (const GivenColumns& own : columns) {
        for (const std::vector<Index>& points : own.points) {
            std::vector<double> arc{0};
            for (std::size_t i = 1; i < points.size(); ++i)
                arc.push_back(arc.back() + (model.at(points[i]) - model.at(points[i - 1])).norm());
            sum.resize(arc.size(), 0);
            for (std::size_t i = 0; i < arc.size(); ++i) sum[i] += arc[i] / arc.back();
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= sum.back();
    return sum;
}

void keep_given_nodes(const OpenVolume& volume, std::span<const GivenColumns> columns,
                      std::vector<LinkingSurface>& links, std::vector<std::string>& notes, bool wedges)
{
    const std::set<EdgeId> kept = kept_edges(volume.model);
    if (kept.empty()) return;
    for (std::size_t b = 0; b < links.size(); ++b)
        BreakKeeper(volume, kept, columns[b], links[b], wedges).run(notes);
}

} // namespace lacuna::surface
