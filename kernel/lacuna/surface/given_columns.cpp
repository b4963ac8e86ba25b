// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/chain_nodes.h>
#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/topology/shared/give_mesh.h>
#include <lacuna/topology/shared/names_of.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

namespace lacuna::surface {

using namespace topology;

namespace {

[[noreturn]] void refuse_rows(const NamedEntity& wall, int rows, const NamedEntity& other, int other_rows)
{
    throw NotSweepable(
        Message("surface.wall_rows",
                "{} was given with {} rows of quads between source and target, and {} with {}", wall,
                found(rows), other, found(other_rows))
            .remedy("all walls of a sweep need the same number: remesh one, or load with keep_mesh = false"));
}

/// Walks over the quads of a linking surface's walls from rim to rim.
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

    GivenColumns run()
    {
        GivenColumns columns;
        if (quads_.empty()) return columns;
        const std::vector<ChainNode> source = chain_nodes(model_, link_.source);
        const std::vector<ChainNode> target = chain_nodes(model_, link_.target);
        for (const ChainNode& node : target) target_at_.emplace(node.point, node.at);
        find_sides();
        std::vector<Strip> strips = strips_from(source);
        const std::span<const Strip> stubs = std::ranges::stable_partition(strips, &Strip::whole),
                                     whole(strips.data(), strips.size() - stubs.size());
        check_rows(whole);
        const Ring columns_at = joined(whole, source.size());
        if (crossed_) refuse_no_rows(quads_[*crossed_]);
        const Ring low = joined(stubs, source.size());
        check_stubs(stubs, columns_at, source.size());
        // Walks from the source have visited all other columns, so the remaining ones end before the source's
        // rim.
        std::vector<Strip> hanging = strips_from(target);
        if (crossed_) refuse_no_rows(quads_[*crossed_]);
        check_stubs(hanging, {}, target.size());
        const Ring high = joined(hanging, target.size());
        for (const WallQuad& quad : quads_) {
            if (!quad.walked) refuse_no_rows(quad);
        }

        columns.rows = rows_;
        columns.quads = rows_ > 0;
        for (const auto& [i, column] : columns_at) {
            columns.whole.push_back(
                {source[i].at, target_at_.at(column.points.back()), column.points, column.faces});
        }
        for (const auto& [i, column] : low)
            columns.stubs.push_back({false, source[i].at, column.wall, column.points, column.faces});
        for (const auto& [i, column] : high)
            columns.stubs.push_back({true, target[i].at, column.wall, column.points, column.faces});
        return columns;
    }

private:
    struct WallQuad {
        Quad corners;
        FaceId wall;
        bool walked = false;
    };
    struct Strip {
        std::vector<Index> left, right;
        std::vector<std::size_t> quads;
        std::vector<FaceId> faces;
        bool whole = false;
        std::size_t first = 0; ///< number of the rim's node on its left
    };
    struct Column {
        std::vector<Index> points;
        std::vector<FaceId> faces;
        FaceId wall;
    };
    using Ring = std::map<std::size_t, Column>; ///< columns by the index of their rim node

    void find_sides()
    {
        const auto add_to = [&](std::set<std::uint64_t>& sides, const std::vector<EdgeUse>& uses) {
            const std::vector<Index> points = use_points(model_, uses);
            for (std::size_t i = 0; i + 1 < points.size(); ++i)
                sides.insert(edge_key(points[i], points[i + 1]));
        };
        add_to(target_sides_, link_.target.uses());
        add_to(no_end_, link_.source.uses());
        for (const LinkingLine& line : link_.lines) add_to(no_end_, line.line.uses);
    }

    /// The strips of quads that start at the sides of a rim and have not been walked yet.
    std::vector<Strip> strips_from(const std::vector<ChainNode>& rim)
    {
        std::vector<Strip> strips;
        for (std::size_t i = 0; i < rim.size(); ++i) {
            Strip strip = walk(rim[i].point, rim[(i + 1) % rim.size()].point);
            if (strip.quads.empty()) continue;
            strip.first = i;
            strips.push_back(std::move(strip));
        }
        return strips;
    }

    /// Walk from a side of a rim across opposite sides of quads to the last quad. Empty if an earlier walk
    /// has visited the first quad.
    Strip walk(Index a, Index b)
    {
        Strip strip{{a}, {b}, {}, {}, false, 0};
        std::size_t last = quads_.size();
        for (;;) {
            const auto found = beside_.find(edge_key(a, b));
            if (found == beside_.end()) break;
            const auto next = std::ranges::find_if(found->second, [&](std::size_t q) { return q != last; });
            if (next == found->second.end()) break;
            last = *next;
            WallQuad& quad = quads_[last];
            if (quad.walked) {
                if (!strip.quads.empty() && !crossed_) crossed_ = last;
                break;
            }
            quad.walked = true;
            const auto at = static_cast<std::size_t>(std::ranges::find(quad.corners, a) -
                                                     quad.corners.begin());
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

    /// The columns between adjacent strips. Two adjacent strips must have the same nodes on their common
    /// column, up to the end of the shorter one.
    Ring joined(std::span<const Strip> strips, std::size_t rim) const
    {
        Ring ring;
        for (const Strip& strip : strips) {
            for (const auto& [i, points] :
                 {std::pair{strip.first, &strip.left}, {(strip.first + 1) % rim, &strip.right}}) {
                join(ring, i, *points);
                ring[i].wall = strip.faces.front();
            }
            ring[strip.first].faces = strip.faces;
        }
        return ring;
    }

    void join(Ring& ring, std::size_t i, const std::vector<Index>& points) const
    {
        std::vector<Index>& there = ring[i].points;
        const std::size_t both = std::min(there.size(), points.size());
        if (!std::equal(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(both), there.begin())) {
            std::set<FaceId> walls;
            for (const WallQuad& quad : quads_) walls.insert(quad.wall);
            throw NotSweepable(
                Message("surface.wall_not_rows",
                        "the given quads of {} do not form rows: at the node at {} two columns diverge",
                        entities_of(model_, walls), place_with_digits(model_.at(points.front()), 6))
                    .remedy("mesh the wall in rows, or load with keep_mesh = false"));
        }
        if (points.size() > there.size()) there = points;
    }

    /// Check that all strips have the same number of rows. There are two messages: if the numbers differ
    /// within one wall, its quads are not in rows; if they differ between walls, the walls were meshed
    /// separately.
    void check_rows(std::span<const Strip> strips)
    {
        std::map<FaceId, std::size_t> rows_of;
        for (const Strip& strip : strips) {
            const std::size_t rows = strip.faces.size();
            const FaceId wall = strip.faces.front();
            const std::size_t first = rows_of.try_emplace(wall, rows).first->second;
            if (first == rows) continue;
            throw NotSweepable(Message("surface.wall_not_rows",
                                       "the given quads of {} do not form rows: one column has {} of them "
                                       "from the source's rim to the target's, but {} are in the column that "
                                       "starts with the quad at {}",
                                       entity_of(model_, wall), found(first), found(rows),
                                       place_of(quads_[strip.quads.front()]))
                                   .remedy("mesh the wall in rows, or load with keep_mesh = false"));
        }
        for (const auto& [wall, rows] : rows_of) {
            const auto& [first_wall, first_rows] = *rows_of.begin();
            if (rows == first_rows) continue;
            refuse_rows(entity_of(model_, first_wall), static_cast<int>(first_rows), entity_of(model_, wall),
                        static_cast<int>(rows));
        }
        rows_ = strips.empty() ? 0 : static_cast<int>(strips.front().faces.size());
    }

    /// Check that each stub ends inside the walls, below the opposite rim, and shares its nodes with the
    /// columns next to it.
    void check_stubs(std::span<const Strip> stubs, const Ring& columns, std::size_t rim) const
    {
        for (const Strip& stub : stubs) {
            const std::uint64_t end = edge_key(stub.left.back(), stub.right.back());
            if (no_end_.contains(end) || target_sides_.contains(end))
                refuse_no_rows(quads_[stub.quads.back()]);
            for (const auto& [i, points] :
                 {std::pair{stub.first, &stub.left}, {(stub.first + 1) % rim, &stub.right}}) {
                const auto whole = columns.find(i);
                if (whole == columns.end()) continue;
                Ring beside{*whole};
                join(beside, i, *points);
            }
        }
    }

    [[noreturn]] void refuse_no_rows(const WallQuad& quad) const
    {
        throw NotSweepable(Message("surface.wall_not_rows",
                                   "the given quads of {} do not form rows from source to target: the first "
                                   "quad outside all rows is at {}",
                                   entity_of(model_, quad.wall), place_of(quad))
                               .remedy("mesh the wall in rows, or load with keep_mesh = false"));
    }

    [[nodiscard]] std::string place_of(const WallQuad& quad) const
    {
        Vec3 sum = Vec3::Zero();
        for (const Index n : quad.corners) sum += model_.at(n);
        return place_with_digits(sum / 4, 6);
    }

    const Model& model_;
    const LinkingSurface& link_;
    std::vector<WallQuad> quads_;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> beside_; ///< quads on each side
    std::unordered_map<Index, double> target_at_;
    std::set<std::uint64_t> target_sides_;
    /// Sides at which no stub may end: those of the source's rim and of side lines.
    std::set<std::uint64_t> no_end_;
    std::optional<std::size_t> crossed_; ///< a quad that two strips cross
    int rows_ = 0;
};

FaceId first_wall(const GivenColumns& columns)
{
    for (const GivenColumn& column : columns.whole) {
        if (!column.faces.empty()) return column.faces.front();
    }
    return {};
}

/// Number of sides of a side line if all its edges keep their nodes; otherwise 0.
int line_rows(const Model& model, const LinkingLine& line, const std::set<EdgeId>& kept)
{
    int rows = 0;
    for (const EdgeUse& use : line.line.uses) {
        if (!kept.contains(use.edge)) return 0;
        rows += static_cast<int>(model[use.edge].points.size()) - 1;
    }
    return rows;
}

/// The number of sides that all side lines with kept nodes have. 0 if the numbers differ or there is none.
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
    return std::ranges::any_of(columns.whole, [&](const GivenColumn& column) {
        return std::abs(column.source_at - source_at) <= slack;
    });
}

/// Add a side line as a column without quads.
void add_column(const Model& model, const LinkingLine& line, GivenColumns& columns, int rows)
{
    const auto after = std::ranges::upper_bound(columns.whole, line.source_at, {}, &GivenColumn::source_at);
    columns.rows = rows;
    columns.whole.insert(after, {line.source_at, line.target_at, use_points(model, line.line.uses), {}});
}

/// The stub that starts at a running length of its rim's chain; null if there is none.
const GivenStub* stub_at(const GivenColumns& columns, bool from_target, double at, double length)
{
    for (const GivenStub& stub : columns.stubs) {
        if (stub.from_target == from_target &&
            std::abs(std::remainder(stub.at - at, length)) <= kSamePlace * length)
            return &stub;
    }
    return nullptr;
}

int tallest_stub(std::span<const GivenColumns> columns)
{
    std::size_t rows = 0;
    for (const GivenColumns& own : columns) {
        for (const GivenStub& stub : own.stubs) rows = std::max(rows, stub.points.size() - 1);
    }
    return static_cast<int>(rows);
}

/// The two stubs in one column, one from each rim, and the gap between them.
struct StubColumn {
    const GivenStub *low, *high; ///< from the source's and from the target's rim; either may be null
    Vec3 open_from, open_to;     ///< ends of the gap
    /// Number of rows that both stubs have. This occurs where two walls lie side by side, of which one starts
    /// at the source and the other at the target.
    std::size_t shared = 0;
    bool is_open = true; ///< whether there is a gap between the stubs

    [[nodiscard]] std::size_t rows() const
    {
        return (low != nullptr ? low->points.size() - 1 : 0) +
               (high != nullptr ? high->points.size() - 1 : 0) - shared;
    }
};

/// Find out whether the two stubs of a column share nodes, and how many rows they share.
void meet(StubColumn& column)
{
    if (column.low == nullptr || column.high == nullptr) return;
    const std::vector<Index>&low = column.low->points, &high = column.high->points;
    const auto found = std::ranges::find(high, low.back());
    if (found == high.end()) return;
    const auto rows = static_cast<std::size_t>(high.end() - found) - 1;
    if (rows >= low.size()) return;
    if (!std::equal(found, high.end(), low.rbegin())) return;
    column.shared = rows;
    column.is_open = false;
}

/// The running length on the other rim's chain that corresponds to a running length on one rim's chain.
double opposite(const LinkingSurface& link, double at, bool from_target)
{
    const double end = from_target ? link.target.length() : link.source.length();
    for (const RimSegment& segment : link.segments) {
        double a0 = segment.source_from, a1 = segment.source_to;
        double b0 = segment.target_from, b1 = segment.target_to;
        if (from_target) {
            std::swap(a0, b0);
            std::swap(a1, b1);
        }
        const double slack = kSamePlace * end;
        for (const double place : {at, at + end}) {
            if (place < a0 - slack || place > a1 + slack) continue;
            const double found = b0 + (place - a0) / (a1 - a0) * (b1 - b0);
            const double length = from_target ? link.source.length() : link.target.length();
            return found >= length ? found - length : std::max(found, 0.0);
        }
    }
    return 0;
}

std::vector<StubColumn> stub_columns(const Model& model, const LinkingSurface& link,
                                     const GivenColumns& columns)
{
    std::vector<StubColumn> result;
    for (const GivenStub& stub : columns.stubs) {
        const double above = opposite(link, stub.at, stub.from_target);
        const Chain& other = stub.from_target ? link.source : link.target;
        const GivenStub* facing = stub_at(columns, !stub.from_target, above, other.length());
        if (stub.from_target && facing != nullptr) continue; // it was counted with the stub from the source
        const Vec3 end = facing != nullptr ? model.at(facing->points.back())
                                           : other.points(std::array{above}).front();
        StubColumn column{&stub, facing, model.at(stub.points.back()), end};
        if (stub.from_target) {
            std::swap(column.low, column.high);
            std::swap(column.open_from, column.open_to);
        }
        meet(column);
        result.push_back(column);
    }
    return result;
}

/// Relative heights of a column's nodes.
std::vector<double> heights_of(const Model& model, const StubColumn& column, std::size_t layers)
{
    std::vector<double> heights{0};
    if (column.low != nullptr) heights = geometry::arc_lengths(places_at(model, column.low->points));
    const std::size_t open = layers - column.rows();
    for (std::size_t k = 0; k < open; ++k) {
        const double rest = (column.open_to - column.open_from).norm();
        heights.push_back(heights.back() + rest / static_cast<double>(open));
    }
    for (std::size_t k = column.high != nullptr ? column.high->points.size() - column.shared : 1; k-- > 1;) {
        const std::vector<Index>& points = column.high->points;
        heights.push_back(heights.back() + (model.at(points[k]) - model.at(points[k - 1])).norm());
    }
    for (double& height : heights) height /= heights.back();
    return heights;
}

void check_stub(const Model& model, const StubColumn& column, std::size_t layers)
{
    const std::size_t rows = column.rows(), least = column.is_open ? rows + 1 : rows;
    if (column.is_open ? least <= layers : least == layers) return;
    std::vector<NamedEntity> walls;
    for (const GivenStub* stub : {column.low, column.high}) {
        if (stub != nullptr) walls.push_back(entity_of(model, stub->wall));
    }
    throw NotSweepable(Message("surface.stub_rows",
                               "walls were given with {} rows of quads that end between source and target "
                               "({}), but there are {} layers",
                               rows, walls, found(layers))
                           .remedy("use layers = {}{}, or load with keep_mesh = false", needed(least),
                                   column.is_open ? " or more" : ""));
}

} // namespace

GivenRows given_columns(const OpenVolume& volume, std::span<const LinkingSurface> links, int layers)
{
    GivenRows result;
    std::vector<GivenColumns>& columns = result.columns;
    const GivenColumns* first = nullptr;
    for (const LinkingSurface& link : links) columns.push_back(ColumnWalker(volume, link).run());
    for (const GivenColumns& own : columns) {
        if (own.rows == 0) continue;
        if (first == nullptr) first = &own;
        if (first->rows == own.rows) continue;
        refuse_rows(entity_of(volume.model, first_wall(*first)), first->rows,
                    entity_of(volume.model, first_wall(own)), own.rows);
    }
    for (const GivenColumns& own : columns) {
        for (const GivenStub& stub : own.stubs) {
            if (first == nullptr || stub.faces.size() < static_cast<std::size_t>(first->rows)) continue;
            throw NotSweepable(
                Message("surface.wall_rows",
                        "{} has {} rows of given quads but does not reach the opposite end, and {} has {} "
                        "rows from source to target: no row is left for the gap",
                        entity_of(volume.model, stub.faces.front()), found(stub.faces.size()),
                        entity_of(volume.model, first_wall(*first)), found(first->rows))
                    .remedy("remesh one of them, or load with keep_mesh = false"));
        }
    }
    const std::set<EdgeId> kept = kept_edges(volume.model);
    const int rows = first != nullptr ? first->rows : common_line_rows(volume.model, links, kept);
    if (rows <= tallest_stub(columns)) return result; // the stubs' quads determine the rows, not side lines
    for (std::size_t b = 0; b < links.size(); ++b) {
        for (const LinkingLine& line : links[b].lines) {
            const int own = line_rows(volume.model, line, kept);
            if (own == 0 || has_column(columns[b], links[b], line.source_at)) continue;
            if (own == rows && (layers == 0 || layers == rows)) {
                add_column(volume.model, line, columns[b], rows);
            } else {
                result.notes.push_back(formatted(
                    "{} was given with {} sides from source to target, but there are {} "
                    "layers: only its end nodes are kept",
                    entity_of(volume.model, line.line.uses.front().edge), own, layers > 0 ? layers : rows));
            }
        }
    }
    return result;
}

std::vector<double> given_heights(const Model& model, std::span<const GivenColumns> columns)
{
    std::vector<double> sum;
    for (const GivenColumns& own : columns) {
        for (const GivenColumn& column : own.whole) {
            const std::vector<double> arc = geometry::arc_lengths(places_at(model, column.points));
            sum.resize(arc.size(), 0);
            for (std::size_t i = 0; i < arc.size(); ++i) sum[i] += arc[i] / arc.back();
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= sum.back();
    return sum;
}

std::vector<double> stub_heights(const Model& model, std::span<const LinkingSurface> links,
                                 std::span<const GivenColumns> columns, const SizeField& size, int layers)
{
    std::vector<StubColumn> all;
    for (std::size_t b = 0; b < links.size(); ++b) {
        const std::vector<StubColumn> more = stub_columns(model, links[b], columns[b]);
        all.insert(all.end(), more.begin(), more.end());
    }
    auto count = static_cast<std::size_t>(layers);
    for (const StubColumn& column : all) {
        if (layers > 0) break;
        const double open = column.is_open ? (column.open_to - column.open_from).norm() : 0;
        const double steps = std::round(open / size((column.open_from + column.open_to) / 2));
        if (!(steps < std::numeric_limits<Index>::max() / 16.0)) {
            throw InvalidInput("sweep.too_many",
                               "the size requires more layers than node numbers allow; give 'layers'");
        }
        count = std::max(count, column.rows() +
                                    static_cast<std::size_t>(column.is_open ? std::max(steps, 1.0) : 0.0));
    }
    for (const StubColumn& column : all) check_stub(model, column, count);
    std::vector<double> sum(all.empty() ? 0 : count + 1, 0.0);
    for (const StubColumn& column : all) {
        const std::vector<double> own = heights_of(model, column, count);
        for (std::size_t k = 0; k <= count; ++k) sum[k] += own[k];
    }
    for (double& height : sum) height /= sum.back();
    return sum;
}

} // namespace lacuna::surface
