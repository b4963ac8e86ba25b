// SPDX-License-Identifier: MIT
#include <lacuna/surface/seeds.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/quads/pattern_counts.h>
#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/interval_program.h>
#include <lacuna/surface/detail/mapped_face.h>
#include <lacuna/surface/detail/plane_loops.h>
#include <lacuna/surface/detail/round_sides.h>
#include <lacuna/surface/detail/seed_pieces.h>
#include <lacuna/surface/detail/square_lines.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Sides for a full turn where none are asked for. With fewer a quad of a round face has a corner of 120° or
/// more.
constexpr int kFewestPerTurn = 6;
/// Part of a side by which the curvature may ask for more before it gets one: what the sampling of a curve
/// is off by. A choice, not a measurement.
constexpr double kPartOfSide = 0.05;
/// Points per piece at which the size is asked: a choice, not a measurement.
constexpr int kSizeSamples = 32;
/// Sizes that differ by a smaller share along an edge are one, and its nodes stand evenly: less than can be
/// seen.
constexpr double kSameSize = 1e-3;

/// What a line across a mapped face weighs beside an edge of its rim: a choice, not a measurement.
constexpr double kLineWeight = 1;
/// Faces whose grid would have a mean scaled Jacobian or a share of even sides below these are given to the
/// planar mesher. Grids bear more than the source alone shows: of the bent pipe's flat rings they have a mean
/// of 0.80 and what is paved instead 0.95, but swept the grids' hexahedra have 0.94 and those of the others
/// 0.88, the worst 0.67 and 0.58. So this is for grids that no sweep makes good; a choice.
constexpr double kFairMean = 0.7, kFairEven = 0.6;

/// Two threes side by side fill a face from this turn of its round side on: 120°. A choice.
constexpr double kHalves = 2 * std::numbers::pi / 3;
/// What a core of as many sides one way as the other weighs beside an edge. With a quarter of it sectors
/// about one point got unlike numbers, 15 and 13 on every other radius.
constexpr double kEvenCore = 1;
/// Quads of a sector from which its numbers of sides go by rows along the round side. Quarters of a disc got
/// 80 and 86 quads for 30 and 12 asked by rows, 45 and 39 without; at 120 the rows are better in all.
constexpr double kQuadsForRows = 20;

class Seeder {
public:
    Seeder(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
           QuadStyle style, const ShapeSizing& sizing, const std::map<EdgeId, double>& lengths, bool wedges,
           const EdgeDemands& demands)
        : volume_(volume),
          model_(volume.model),
          size_(size),
          style_(style),
          wedges_(wedges),
          per_turn_(sizing.curvature > 0 ? sizing.curvature : kFewestPerTurn),
          gap_(sizing.gap),
          counts_across_(sizing.counts_across),
          shared_(demands.kept)
    {
        for (const LinkingSurface& link : links) add_rim(link);
        for (const FaceId face : volume.faces(Role::source)) {
            if (keeps(face))
                seeds_.kept.insert(face);
            else
                note_mixed(face);
            for (const Loop& loop : model_[face].loops) {
                for (const EdgeUse& use : loop.uses) {
                    users_[use.edge].insert(face);
                    if (!seeds_.pieces.contains(use.edge)) {
                        seeds_.pieces[use.edge] = {{0, 1, edge_length(model_, use.edge), 1}};
                    }
                }
            }
        }
        for (auto& [edge, pieces] : seeds_.pieces) {
            const auto swept_to = lengths.find(edge);
            const double longer = swept_to == lengths.end() ? 1
                                                            : swept_to->second / edge_length(model_, edge);
            for (SeedPiece& piece : pieces) {
                if (piece.fixed) continue;
                ask_size(edge, piece);
                piece.count = std::max(piece.count, static_cast<int>(std::lround(longer * piece.count)));
                piece.sides = std::max(1.0, longer) * piece.sides;
            }
        }
        for (const FaceId face : seeds_.kept) {
            for (const Loop& loop : model_[face].loops) {
                for (const EdgeUse& use : loop.uses) keep_nodes(face, use.edge);
            }
        }
        for (const auto& [edge, faces] : users_) {
            if (model_[edge].keeps_nodes && !rim_.contains(edge)) keep_nodes(*faces.begin(), edge);
        }
        seeds_.rows = demands.rows;
        for (const auto& [at, end] : demands.rows.ends) end_rows(at.first, at.second, end);
        for (const SidesAsked& asked : demands.sides) set_sides(asked);
        for (const FaceId face : volume.faces(Role::source)) find_alike(face);
    }

    Seeds run()
    {
        for (const FaceId face : volume_.faces(Role::source)) choose(face);
        solve_together();
        balance();
        for (const FaceId face : most_loops_first()) fit_grid(face);
        for (int round = 0; round < 2; ++round) {
            make_even();
            balance();
        }
        divide_given_sides();
        check_even();
        return std::move(seeds_);
    }

private:
    void add_rim(const LinkingSurface& link)
    {
        const EdgeTurning target(model_, link.target.uses());
        for (const RimSegment& segment : link.segments) {
            const EdgeUse use = link.source.uses()[segment.use];
            const double start = link.source.start(segment.use);
            const double length = link.source.start(segment.use + 1) - start;
            double from = std::clamp((segment.source_from - start) / length, 0.0, 1.0);
            double to = std::clamp((segment.source_to - start) / length, 0.0, 1.0);
            if (use.reversed) {
                std::swap(from, to);
                from = 1 - from;
                to = 1 - to;
            }
            SeedPiece piece{from, to, segment.source_to - segment.source_from, 1};
            piece.opposite = opposite_turning(target, segment);
            if (use.reversed) std::reverse(piece.opposite.begin(), piece.opposite.end());
            piece.fixed = segment.given;
            seeds_.pieces[use.edge].push_back(std::move(piece));
            rim_.insert(use.edge);
        }
        for (auto& [edge, pieces] : seeds_.pieces) {
            std::sort(pieces.begin(), pieces.end(),
                      [](const SeedPiece& a, const SeedPiece& b) { return a.from < b.from; });
        }
    }

    /// How much the target's rim turns in even steps along a segment [radian].
    static std::vector<double> opposite_turning(const EdgeTurning& target, const RimSegment& segment)
    {
        const double whole = target.length(), step = (segment.target_to - segment.target_from) / kSizeSamples;
        std::vector<double> turning;
        for (int i = 0; i < kSizeSamples; ++i) {
            double from = segment.target_from + i * step;
            while (from >= whole) from -= whole;
            const double past = std::max(from + step - whole, 0.0);
            turning.push_back(target.between(from, from + step - past) + target.between(0, past));
        }
        return turning;
    }

    /// A face of quads and triangles is a mesh, and no hexahedra stand on its triangles. Facets that are all
    /// triangles are a shape. That it is meshed anew where that was asked for is said.
    void note_mixed(FaceId face)
    {
        const Face& f = model_[face];
        const std::size_t quads = f.given_quads.size(), triangles = f.triangles.size() - 2 * quads;
        if (!f.keeps_nodes || quads == 0 || triangles == 0) return;
        const std::string found = name_of(model_, face) + " came with " + std::to_string(quads) +
                                  " quads and " + std::to_string(triangles) +
                                  " triangles, on which no hexahedra stand";
        if (style_ == QuadStyle::automatic) {
            throw NotSweepable("surface.given_triangles",
                               found + "; use wedges = true to keep all of them, quads = \"paved\" to mesh "
                                       "the face anew inside its rim, or load with keep_mesh = false");
        }
        seeds_.notes.push_back(found + ": it is meshed anew inside its rim");
    }

    /// Whether a face came with quads that are to be its mesh.
    [[nodiscard]] bool keeps(FaceId face) const
    {
        const Face& f = model_[face];
        const bool whole = has_cells_to_keep(f, wedges_);
        if (style_ == QuadStyle::kept && !whole) {
            throw NotSweepable(
                "surface.not_kept",
                name_of(model_, face) + " has " + std::to_string(f.given_quads.size()) +
                    " quads of its own and " +
                    std::to_string(f.triangles.size() -
                                   std::min(f.triangles.size(), 2 * f.given_quads.size())) +
                    " triangles; quads = \"keep\" needs quads all over: wedges = true keeps triangles too, "
                    "and quads = \"auto\" makes quads");
        }
        return whole &&
               (style_ == QuadStyle::kept || style_ == QuadStyle::automatic || shared_.contains(face));
    }

    /// The pieces of an edge get the nodes it came with.
    void keep_nodes(FaceId face, EdgeId edge)
    {
        const std::vector<double> arc = geometry::arc_lengths(edge_line(model_, edge));
        for (SeedPiece& piece : seeds_.pieces[edge]) {
            const double slack = model_.tolerance / arc.back();
            const std::size_t sides = piece.kept.size();
            piece.kept.clear();
            bool from = false, to = false;
            for (const double length : arc) {
                const double f = length / arc.back();
                from = from || std::abs(f - piece.from) <= slack;
                to = to || std::abs(f - piece.to) <= slack;
                if (f > piece.from + slack && f < piece.to - slack) piece.kept.push_back(f);
            }
            // A piece that is one side already has no node inside.
            if (!from || !to || (piece.fixed && piece.kept.size() != sides)) {
                throw NotSweepable("surface.kept_rim", name_of(model_, edge) + " of " +
                                                           name_of(model_, face) +
                                                           ", whose quads are to be kept, has no node where "
                                                           "the other end has a corner; mesh both ends "
                                                           "alike, or load with keep_mesh = false");
            }
            piece.fixed = true;
            piece.wanted.clear();
            piece.count = static_cast<int>(piece.kept.size()) + 1;
        }
    }

    /// Edges that a face's symmetries map onto each other: one number of sides for each set of which as many
    /// are wanted on every edge and none are given.
    void find_alike(FaceId face)
    {
        constexpr double kSame = 0.01; // share by which those may differ; a choice, not a measurement
        if (seeds_.kept.contains(face)) return;
        for (std::vector<EdgeId>& set : alike_edges(model_, face)) {
            double sum = 0;
            bool same = true;
            for (const EdgeId edge : set) {
                const SeedPiece& piece = seeds_.pieces.at(edge).front();
                same = same && seeds_.pieces.at(edge).size() == 1 && !piece.fixed && piece.low.empty() &&
                       piece.high.empty();
                sum += piece.sides;
            }
            const double mean = sum / static_cast<double>(set.size());
            for (const EdgeId edge : set)
                same = same && std::abs(seeds_.pieces.at(edge).front().sides - mean) <= kSame * mean;
            if (!same) continue;
            // What is not the same by rounding alone must not round to different numbers.
            int most = 1, least = 1;
            for (const EdgeId edge : set) {
                most = std::max(most, seeds_.pieces.at(edge).front().count);
                least = std::max(least, seeds_.pieces.at(edge).front().least);
            }
            for (const EdgeId edge : set) {
                SeedPiece& piece = seeds_.pieces.at(edge).front();
                piece.sides = mean;
                piece.count = most;
                piece.least = least;
            }
            alike_[face].push_back(std::move(set));
        }
    }

    /// How many sides size and curvature ask for, and where they are wanted.
    void ask_size(EdgeId edge, SeedPiece& piece) const
    {
        std::vector<double> at;
        for (int i = 0; i < kSizeSamples; ++i)
            at.push_back(piece.from + (i + 0.5) / kSizeSamples * (piece.to - piece.from));
        const EdgeTurning turning(model_, edge);
        const double step = (piece.to - piece.from) * turning.length() / kSizeSamples;
        // Only what the opposite rim turns more counts: an oblique end turns unevenly and as much.
        const double own = turning.between(piece.from * turning.length(), piece.to * turning.length());
        const double opposite = std::accumulate(piece.opposite.begin(), piece.opposite.end(), 0.0);
        const double more = opposite > own ? (opposite - own) / opposite : 0;
        double by_turn = 0, by_size = 0, sides = 0;
        double least = std::numeric_limits<double>::infinity(), most = 0;
        piece.wanted = {0};
        const std::vector<Vec3> points = edge_points(model_, edge, at);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double from = piece.from * turning.length() + static_cast<double>(i) * step;
            double turn = turning.between(from, from + step);
            if (more > 0) turn += more * piece.opposite[i];
            const double size = piece.length / kSizeSamples / size_(points[i]);
            const double bend = turn * per_turn_ / (2 * std::numbers::pi);
            const double here = std::max(size, bend);
            by_turn += bend;
            by_size += size;
            sides += here;
            piece.wanted.push_back(sides);
            least = std::min(least, here);
            most = std::max(most, here);
        }
        if (most < least * (1 + kSameSize)) piece.wanted.clear();
        if (sides > std::numeric_limits<Index>::max() / 8) {
            char count[32];
            std::snprintf(count, sizeof count, "%.3g", sides);
            throw NotSweepable("surface.too_many_sides",
                               name_of(model_, edge) + " would have " + count +
                                   " sides by the size asked for, more than nodes can be numbered; "
                                   "give a larger size");
        }
        const auto bends = static_cast<int>(std::ceil(by_turn - kPartOfSide));
        piece.count = std::max({1, static_cast<int>(std::lround(sides)), bends});
        piece.bends = piece.count > std::max(1L, std::lround(by_size));
        piece.sides = std::max(sides, by_turn);
        piece.least = std::max(1, bends);
    }

    /// Nodes on an edge at the heights of rows that end at one of its ends.
    void end_rows(EdgeId edge, bool at_end, const RimRows::End& end)
    {
        std::vector<SeedPiece>& pieces = seeds_.pieces.at(edge);
        SeedPiece& piece = at_end ? pieces.back() : pieces.front();
        if (piece.fixed) return; // whether its nodes will do shows when the rows are placed
        const std::vector<double>& heights = seeds_.rows.heights[static_cast<std::size_t>(end.table)];
        std::vector<double>& own = at_end ? piece.high : piece.low;
        own = row_places(model_, edge, at_end, end, heights);
        const double low = piece.low.empty() ? piece.from : piece.low.back();
        const double high = piece.high.empty() ? piece.to : piece.high.front();
        if (own.size() < heights.size() || !(low < high)) {
            throw NotSweepable("surface.layers_room",
                               "the boundary layers of " + name_of(model_, end.wall) + ", " +
                                   in_short(heights.back()) + " high, end on " + name_of(model_, edge) +
                                   " at " + name_of(model_, end.corner) + ", where there is room for " +
                                   in_short(room_on(piece, edge, at_end, end)) +
                                   ((at_end ? piece.low : piece.high).empty()
                                        ? ""
                                        : " beside the rows that end at its other end") +
                                   "; ask for fewer or thinner rows");
        }
        const double share = (high - low) / (piece.to - piece.from);
        const double sides_between = piece.wanted.empty() ? share * piece.count
                                                          : wanted_at(piece, high) - wanted_at(piece, low);
        piece.count = std::max(1, static_cast<int>(std::lround(sides_between))) +
                      static_cast<int>(piece.low.size() + piece.high.size());
    }

    /// Height over the side that rows run along, up to which an edge has room for them.
    [[nodiscard]] double room_on(const SeedPiece& piece, EdgeId edge, bool at_end,
                                 const RimRows::End& end) const
    {
        const std::vector<double>& other = at_end ? piece.low : piece.high;
        const double far = at_end ? (other.empty() ? piece.from : other.back())
                                  : (other.empty() ? piece.to : other.front());
        const double at[] = {far};
        return (edge_points(model_, edge, at).front() - model_.at(model_[end.corner].point)).dot(end.inward);
    }

    static std::string in_short(double x)
    {
        char words[32];
        std::snprintf(words, sizeof words, "%.4g", x);
        return words;
    }

    /// A number of sides that a person asks for: its nodes, for good.
    void set_sides(const SidesAsked& asked)
    {
        const std::string who = asked.name + " asks for " + std::to_string(asked.count) + " sides";
        std::vector<SeedPiece*> pieces;
        std::vector<bool> reversed;
        std::vector<std::string> names;
        for (const SidesAsked::Part& part : asked.parts) {
            std::vector<std::size_t> within;
            std::vector<SeedPiece>& all = seeds_.pieces.at(part.edge);
            for (std::size_t i = 0; i < all.size(); ++i) {
                const double middle = (all[i].from + all[i].to) / 2;
                if (middle > part.from && middle < part.to) within.push_back(i);
            }
            if (part.reversed) std::reverse(within.begin(), within.end());
            for (const std::size_t i : within) {
                pieces.push_back(&all[i]);
                reversed.push_back(part.reversed);
                names.push_back(name_of(model_, part.edge));
            }
        }
        if (static_cast<std::size_t>(asked.count) < pieces.size()) {
            refuse_sides(who + " where corners of both ends leave at least " + std::to_string(pieces.size()));
        }
        std::vector<double> ends{0}; // running lengths
        for (const SeedPiece* piece : pieces) ends.push_back(ends.back() + piece->length);
        const std::vector<int> node = nodes_at(ends, asked);
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            SeedPiece own = *pieces[p];
            own.fixed = own.asked = true;
            own.count = node[p + 1] - node[p];
            own.kept.clear();
            const double from = index_at(ends[p] / ends.back(), asked),
                         to = index_at(ends[p + 1] / ends.back(), asked);
            for (int i = 1; i < own.count; ++i) {
                const double at = from + (to - from) * i / own.count;
                double share = (length_at(at, asked) * ends.back() - ends[p]) / (ends[p + 1] - ends[p]);
                if (reversed[p]) share = 1 - share;
                own.kept.push_back(own.from + share * (own.to - own.from));
            }
            std::sort(own.kept.begin(), own.kept.end());
            settle(*pieces[p], own, who + " on " + names[p], asked);
        }
    }

    /// Put what is asked of a piece in its place.
    void settle(SeedPiece& piece, const SeedPiece& own, const std::string& who, const SidesAsked& asked)
    {
        const auto before = askers_.find(&piece);
        if (piece.fixed) {
            const std::string other = before != askers_.end() ? before->second : "the mesh given there";
            if (piece.count != own.count)
                refuse_sides(who + " (" + std::to_string(own.count) + " of them on this part), and " + other +
                             " has " + std::to_string(piece.count));
            for (std::size_t i = 0; i < own.kept.size() && before != askers_.end(); ++i) {
                if (std::abs(own.kept[i] - piece.kept[i]) * piece.length > model_.tolerance)
                    refuse_sides(who + ", and " + other + ", with other lengths");
            }
            return;
        }
        if (!piece.low.empty() || !piece.high.empty()) {
            const auto rows = static_cast<int>(piece.low.size() + piece.high.size());
            if (own.count <= rows)
                refuse_sides(who + ", where boundary layers end that have " + std::to_string(rows) +
                             " of their own: ask for " + std::to_string(rows + 1) + " or more");
            if (asked.bias != 1)
                refuse_sides(who + " with a bias, where boundary layers end: these set the lengths");
            piece.count = own.count;
            const std::vector<double> at = piece.fractions();
            piece.kept.assign(at.begin() + 1, at.end());
            piece.fixed = piece.asked = true;
        } else {
            piece = own;
        }
        askers_[&piece] = who;
    }

    [[noreturn]] static void refuse_sides(const std::string& what)
    {
        throw NotSweepable("surface.sides_asked", "intervals: " + what);
    }

    /// Number of sides up to a share of the length, by the bias.
    static double index_at(double share, const SidesAsked& asked)
    {
        if (asked.count < 2 || asked.bias == 1) return share * asked.count;
        const double growth = std::log(asked.bias) / (asked.count - 1);
        return std::log1p(share * std::expm1(growth * asked.count)) / growth;
    }
    static double length_at(double index, const SidesAsked& asked)
    {
        if (asked.count < 2 || asked.bias == 1) return index / asked.count;
        const double growth = std::log(asked.bias) / (asked.count - 1);
        return std::expm1(growth * index) / std::expm1(growth * asked.count);
    }

    /// The nodes at the ends of pieces: those nearest by the bias, one side at least each.
    static std::vector<int> nodes_at(const std::vector<double>& ends, const SidesAsked& asked)
    {
        std::vector<int> node{0};
        const auto pieces = static_cast<int>(ends.size()) - 1;
        for (int p = 1; p < pieces; ++p) {
            const double at = index_at(ends[static_cast<std::size_t>(p)] / ends.back(), asked);
            node.push_back(
                std::clamp(static_cast<int>(std::lround(at)), node.back() + 1, asked.count - (pieces - p)));
        }
        node.push_back(asked.count);
        return node;
    }

    void choose(FaceId face)
    {
        if (style_ == QuadStyle::free || seeds_.kept.contains(face)) return;
        const auto corners = four_corners(model_, face);
        // How many columns of a submapped face pass a neck is what other sides leave over.
        if (!corners && gap_ > 0 && !counts_across_ && style_ == QuadStyle::automatic) return;
        const std::vector<SidePair> opposite = corners ? side_pairs(model_, face, *corners)
                                                       : grid_sides(model_, face);
        if (style_ == QuadStyle::mapped && opposite.empty()) {
            throw NotSweepable(
                "surface.not_four_sided",
                name_of(model_, face) +
                    " is to be mapped and has neither four corners (vertices with an inner angle below 135°) "
                    "on one loop nor loops of right angles alone; use quads = \"auto\"");
        }
        if (opposite.empty() ||
            (style_ == QuadStyle::automatic && !(alike(model_, opposite) && counts_alike(opposite))))
            return;
        if (!corners) {
            opposite_[face] = opposite;
            seeds_.submapped.insert(face);
            return;
        }
        MappedFace mapped(model_, face, *corners);
        if (!is_fairly_mapped(face, mapped)) return;
        opposite_[face] = opposite;
        seeds_.corners[face] = *corners;
        mapped_.try_emplace(face, std::move(mapped));
        if (!counts_across_) return;
        for (const SidePair& sides : opposite) {
            for (const std::vector<EdgeId>& side : sides) raise(side, gap_ - total(side));
        }
    }

    /// Whether the size asks for about as many sides of quads on either side of the face. Where it does not,
    /// one side would get as many as the other needs.
    [[nodiscard]] bool counts_alike(const std::vector<SidePair>& pairs) const
    {
        // As `alike()` for lengths, in counts; up to four sides any ratio will do. A choice, not a
        // measurement.
        constexpr int kUnlike = 3, kFew = 4;
        return std::all_of(pairs.begin(), pairs.end(), [&](const SidePair& sides) {
            const int a = total(sides[0]), b = total(sides[1]);
            return std::max(a, b) <= std::max(kUnlike * std::min(a, b), kFew);
        });
    }

    /// One more side where the sides are longest. @return false where all are fixed
    bool raise(const std::vector<EdgeId>& edges, int by)
    {
        for (; by > 0; --by) {
            SeedPiece* longest = nullptr;
            for (const EdgeId edge : edges) {
                for (SeedPiece& piece : seeds_.pieces[edge]) {
                    if (piece.fixed) continue;
                    if (longest == nullptr || piece.length / piece.count > longest->length / longest->count)
                        longest = &piece;
                }
            }
            if (longest == nullptr) return false;
            ++longest->count;
        }
        return true;
    }

    [[nodiscard]] int total(const std::vector<EdgeId>& edges) const
    {
        return std::accumulate(edges.begin(), edges.end(), 0,
                               [&](int sum, EdgeId e) { return sum + seeds_.count(e); });
    }

    /// The source faces, those whose loops have to agree with each other before those that take what is
    /// settled: a ring about a disc before the disc.
    [[nodiscard]] std::vector<FaceId> most_loops_first() const
    {
        std::vector<FaceId> faces = volume_.faces(Role::source);
        std::stable_sort(faces.begin(), faces.end(),
                         [&](FaceId a, FaceId b) { return model_[a].loops.size() > model_[b].loops.size(); });
        return faces;
    }

    /// Give a free face numbers of sides that one grid can have. Edges that other faces have settled, and
    /// those of mapped faces, keep theirs.
    void fit_grid(FaceId face)
    {
        if (style_ != QuadStyle::automatic || gap_ > 0 || !is_free(face)) return;
        const Vec3 normal = face_area_vector(model_, face).stableNormalized();
        if (!faces_one_way(face, normal)) return;
        const geometry::Plane plane = geometry::plane_across(face_centroid(model_, face), normal);
        std::vector<quads::BoundarySegment> segments;
        std::vector<SeedPiece*> pieces;
        std::vector<int> segment;
        quads::PlanarRegion region;
        for (const Loop& loop : border_loops(model_, face)) {
            std::vector<Index>& cycle = region.loops.emplace_back();
            for (const EdgeUse& use : loop.uses) {
                std::vector<SeedPiece>& own = seeds_.pieces.at(use.edge);
                const std::vector<Vec3> points = edge_points(model_, use.edge, seeds_.fractions(use.edge));
                std::vector<int> of_side;
                for (SeedPiece& piece : own) {
                    of_side.insert(of_side.end(), static_cast<std::size_t>(piece.count),
                                   static_cast<int>(segments.size()));
                    segments.push_back({piece.sides, piece.least, piece.fixed || is_settled(use.edge)});
                    pieces.push_back(&piece);
                }
                const std::size_t sides = of_side.size();
                for (std::size_t i = 0; i < sides; ++i) {
                    cycle.push_back(static_cast<Index>(region.points.size()));
                    region.points.push_back(geometry::to_plane(plane, points[use.reversed ? sides - i : i]));
                    segment.push_back(of_side[use.reversed ? sides - 1 - i : i]);
                }
            }
        }
        sort_outer_first(region.points, region.loops);
        const auto counts = quads::pattern_counts(region, segment, segments);
        if (!counts) return;
        for (std::size_t p = 0; p < pieces.size(); ++p) pieces[p]->count = (*counts)[p];
        for (const EdgeId edge : edges_of(face)) settled_.insert(edge);
    }

    /// Whether other faces need the number of sides an edge has.
    [[nodiscard]] bool is_settled(EdgeId edge) const
    {
        const std::set<FaceId>& users = users_.at(edge);
        return settled_.contains(edge) ||
               std::any_of(users.begin(), users.end(), [&](FaceId user) { return opposite_.contains(user); });
    }

    /// Whether all of a face looks one way, so that it can be laid on a plane without folding.
    [[nodiscard]] bool faces_one_way(FaceId face, const Vec3& normal) const
    {
        constexpr double kSteepest = 0.5; // cosine of 60°; a choice, not a measurement
        const std::vector<Triangle>& facets = model_[face].triangles;
        return std::all_of(facets.begin(), facets.end(), [&](const Triangle& t) {
            const Vec3 area = (model_.at(t[1]) - model_.at(t[0])).cross(model_.at(t[2]) - model_.at(t[0]));
            return area.dot(normal) >= kSteepest * area.norm();
        });
    }

    /// Numbers of sides with which all mapped and submapped faces close, and the free faces beside them,
    /// solved as one program.
    void solve_together()
    {
        Program all;
        add_mapped(all);
        const Program mapped = all;
        add_beside_mapped(all);
        const IntervalProgram alike = with_alike(all);
        std::vector<int> counts = solve_intervals(alike);
        std::vector<int> straight = solve_intervals(with_straight(alike, all));
        if (is_worth_it(all, straight, counts)) counts = std::move(straight);
        if (std::ranges::find(counts, 0) != counts.end()) {
            const std::vector<int> unlike = solve_intervals(all.intervals);
            for (std::size_t v = 0; v < counts.size(); ++v) {
                if (counts[v] == 0) counts[v] = unlike[v];
            }
        }
        std::vector<int> fewer; // where free faces have no solution
        for (std::size_t p = 0; p < all.pieces.size(); ++p) {
            int count = counts[all.piece_variable[p]];
            if (count == 0 && p < mapped.pieces.size()) {
                if (fewer.empty()) fewer = solve_intervals(mapped.intervals);
                count = fewer[mapped.piece_variable[p]];
            }
            if (count > 0) all.pieces[p]->count = count;
        }
    }

    /// Numbers of sides to be solved for, and the pieces they are of.
    struct Program {
        IntervalProgram intervals;
        std::vector<SeedPiece*> pieces;
        std::vector<std::size_t> piece_variable;
        std::map<EdgeId, std::size_t> first; ///< variable of the first piece of each edge
    };

    /// The same with as many sides on edges that symmetries of a face map onto each other.
    [[nodiscard]] IntervalProgram with_alike(const Program& program) const
    {
        IntervalProgram intervals = program.intervals;
        for (const auto& [face, sets] : alike_) {
            for (const std::vector<EdgeId>& set : sets) {
                const auto first = program.first.find(set.front());
                for (std::size_t i = 1; i < set.size() && first != program.first.end(); ++i) {
                    const auto other = program.first.find(set[i]);
                    if (other != program.first.end())
                        intervals.equations.push_back({{first->second}, {other->second}});
                }
            }
        }
        return intervals;
    }

    /// Whether numbers of sides with which the lines of grids are straight cost little more than others: an L
    /// of 400 quads gets 24, 12 and 12 sides where 23, 12 and 11 would cost least.
    static bool is_worth_it(const Program& program, const std::vector<int>& straight,
                            const std::vector<int>& counts)
    {
        constexpr double kCost = 2, kQuads = 0.15; // of the cost, and the share of quads: choices
        if (std::ranges::find(straight, 0) != straight.end()) return false;
        double sides = 0, wanted = 0;
        for (std::size_t p = 0; p < program.pieces.size(); ++p) {
            if (program.pieces[p]->fixed) continue;
            sides += straight[program.piece_variable[p]];
            wanted += program.pieces[p]->sides;
        }
        return std::abs(sides * sides / (wanted * wanted) - 1) <= kQuads &&
               cost_of_intervals(program.intervals, straight) <=
                   kCost * cost_of_intervals(program.intervals, counts);
    }

    /// The same with as many sides on edges of a submapped face that want as many.
    [[nodiscard]] IntervalProgram with_straight(const IntervalProgram& intervals,
                                                const Program& program) const
    {
        constexpr double kSame = 0.01; // as of edges alike
        IntervalProgram straight = intervals;
        for (const FaceId face : seeds_.submapped) {
            std::vector<std::pair<double, std::size_t>> wanted; // by variable
            for (const EdgeId edge : edges_of(face)) {
                const std::vector<SeedPiece>& pieces = seeds_.pieces.at(edge);
                const auto first = program.first.find(edge);
                if (first == program.first.end() || pieces.size() > 1 || pieces.front().fixed) continue;
                wanted.emplace_back(pieces.front().sides, first->second);
            }
            std::sort(wanted.begin(), wanted.end());
            for (std::size_t i = 1; i < wanted.size(); ++i) {
                if (wanted[i].first <= (1 + kSame) * wanted[i - 1].first)
                    straight.equations.push_back({{wanted[i - 1].second}, {wanted[i].second}});
            }
        }
        return straight;
    }

    /// The variables of edges.
    std::vector<std::size_t> variables_of(const std::vector<EdgeId>& edges, Program& program)
    {
        std::vector<std::size_t> variables;
        for (const EdgeId edge : edges) {
            std::vector<SeedPiece>& own = seeds_.pieces.at(edge);
            const auto [found, fresh] = program.first.try_emplace(edge, program.intervals.variables.size());
            for (std::size_t i = 0; i < own.size(); ++i) {
                variables.push_back(found->second + i);
                if (fresh) add_piece(own[i], program);
            }
        }
        return variables;
    }

    static void add_piece(SeedPiece& piece, Program& program)
    {
        const auto rows = static_cast<int>(piece.low.size() + piece.high.size());
        const double wanted = rows > 0 ? piece.count : piece.sides;
        const std::size_t variable = program.intervals.variables.size();
        program.intervals.wishes.push_back({{variable}, std::max(wanted, kLeastWish), 1});
        program.intervals.variables.push_back({std::max(piece.least, rows + 1), piece.count, piece.fixed});
        program.pieces.push_back(&piece);
        program.piece_variable.push_back(variable);
    }

    void add_mapped(Program& program)
    {
        for (const auto& [face, pairs] : opposite_) {
            const auto mapped = mapped_.find(face);
            std::array<std::vector<double>, 2> inside;
            if (mapped != mapped_.end()) inside = mapped->second.wanted_inside(size_);
            for (std::size_t k = 0; k < pairs.size(); ++k) {
                IntervalEquation equation{variables_of(pairs[k][0], program),
                                          variables_of(pairs[k][1], program)};
                IntervalProgram& intervals = program.intervals;
                if (mapped != mapped_.end()) {
                    for (const double sides : inside[k])
                        intervals.wishes.push_back({equation.one, std::max(sides, kLeastWish), kLineWeight});
                    if (counts_across_) {
                        intervals.floors.push_back({equation.one, gap_});
                        intervals.floors.push_back({equation.other, gap_});
                    }
                }
                intervals.equations.push_back(std::move(equation));
            }
        }
    }

    /// Free faces that share edges with mapped ones, so that these leave them numbers that close.
    void add_beside_mapped(Program& program)
    {
        if (style_ != QuadStyle::automatic) return;
        for (const FaceId face : volume_.faces(Role::source)) {
            const std::vector<EdgeId> edges = edges_of(face);
            const bool beside = std::any_of(edges.begin(), edges.end(), [&](EdgeId edge) {
                const std::set<FaceId>& users = users_.at(edge);
                return std::any_of(users.begin(), users.end(),
                                   [&](FaceId user) { return opposite_.contains(user); });
            });
            if (is_free(face) && (beside || is_sector_beside(face, edges))) {
                if (add_free(face, edges, program)) settled_.insert(edges.begin(), edges.end());
            }
        }
    }

    /// Whether a face of three sides, one of them round, shares an edge with another free one: the number of
    /// sides there has to do for both. None of its sides are given or asked for, and its quads are enough for
    /// rows along the round side.
    [[nodiscard]] bool is_sector_beside(FaceId face, const std::vector<EdgeId>& edges) const
    {
        const std::vector<std::vector<EdgeId>> sides = sides_by_corners(model_, face);
        if (gap_ > 0 || sides.size() != 3 ||
            std::ranges::any_of(edges, [&](EdgeId edge) { return is_fixed(edge); }))
            return false;
        const auto bulge = bulge_of(model_, face, sides, size_);
        if (!bulge || bulge->turn / 2 * std::pow(bulge->radius / bulge->size, 2) < kQuadsForRows)
            return false;
        return std::any_of(edges.begin(), edges.end(), [&](EdgeId edge) {
            const std::set<FaceId>& users = users_.at(edge);
            return std::any_of(users.begin(), users.end(),
                               [&](FaceId user) { return user != face && is_free(user); });
        });
    }

    /// What a free face needs. Of three sides: each as many as two of three grids have that meet in one node
    /// inside, so an even number in all and none more than the others together. Of two, as a half disc, its
    /// round side and the other: those of two such threes side by side, with a square core. Of two others:
    /// one has an even number more than the other, as round four corners of a grid, two of them inside.
    /// Others: an even number in all.
    /// @return  whether one side is round, and the numbers are those of its rows as well
    bool add_free(FaceId face, const std::vector<EdgeId>& edges, Program& program)
    {
        IntervalProgram& intervals = program.intervals;
        const auto fresh = [&] {
            intervals.variables.push_back({});
            return intervals.variables.size() - 1;
        };
        const std::vector<std::vector<EdgeId>> side = sides_by_corners(model_, face);
        const auto bulge = bulge_of(model_, face, side, size_);
        if (side.size() == 3) {
            std::array<std::vector<std::size_t>, 3> own;
            for (std::size_t s = 0; s < 3; ++s) own[s] = variables_of(side[s], program);
            const std::array<std::size_t, 3> grid{fresh(), fresh(), fresh()};
            for (std::size_t s = 0; s < 3; ++s)
                intervals.equations.push_back({own[s], {grid[s], grid[(s + 1) % 3]}});
            if (bulge) {
                const std::size_t rows = grid[(bulge->side + 2) % 3];
                const double core = wish_rows(*bulge, 1, own[bulge->side], rows, intervals);
                for (const std::size_t v : grid) {
                    if (v != rows) intervals.wishes.push_back({{v}, core, kEvenCore});
                }
                return true;
            }
        } else if (side.size() == 2 && bulge && bulge->turn > kHalves) {
            const std::vector<std::size_t> round = variables_of(side[bulge->side], program),
                                           other = variables_of(side[1 - bulge->side], program);
            const std::size_t core = fresh(), rows = fresh();
            intervals.equations.push_back({round, {core, core, core, core}});
            intervals.equations.push_back({other, {core, core, rows, rows}});
            intervals.wishes.push_back({{core}, wish_rows(*bulge, 2, round, rows, intervals), kEvenCore});
            return true;
        } else if (side.size() == 2) {
            const double a = length_of(model_, side[0]), b = length_of(model_, side[1]);
            std::vector<std::size_t> longer = variables_of(side[a > b ? 0 : 1], program),
                                     shorter = variables_of(side[a > b ? 1 : 0], program);
            const std::size_t more = fresh();
            shorter.insert(shorter.end(), {more, more});
            intervals.equations.push_back({std::move(longer), std::move(shorter)});
        } else {
            std::vector<std::size_t> all = variables_of(edges, program);
            const std::size_t half = fresh();
            intervals.equations.push_back({std::move(all), {half, half}});
        }
        return false;
    }

    /// Whether a grid over a face is nearly as good as what the planar mesher makes, or cannot be had
    /// otherwise.
    [[nodiscard]] bool is_fairly_mapped(FaceId face, const MappedFace& mapped) const
    {
        if (style_ != QuadStyle::automatic || gap_ > 0) return true;
        const MappedFace::Shape shape = mapped.shape(size_);
        return (shape.mean_scaled_jacobian >= kFairMean && shape.even_share >= kFairEven) ||
               !faces_one_way(face, face_area_vector(model_, face).stableNormalized());
    }

    /// Equal counts on opposite sides of every mapped face. Counts only grow; where they would chase each
    /// other, the face is meshed freely.
    void balance()
    {
        const std::size_t most = 4 * seeds_.pieces.size() + 16;
        for (std::size_t round = 0;; ++round) {
            bool changed = false;
            for (auto it = opposite_.begin(); it != opposite_.end();) {
                bool raised = false, stuck = false;
                for (const SidePair& sides : it->second) {
                    const int difference = total(sides[0]) - total(sides[1]);
                    if (difference == 0) continue;
                    stuck = !raise(sides[difference > 0 ? 1 : 0], std::abs(difference)) || stuck;
                    raised = true;
                }
                changed = changed || raised;
                if (stuck && style_ == QuadStyle::mapped) {
                    throw NotSweepable("surface.kept_side",
                                       name_of(model_, it->first) +
                                           " is to be mapped, and sides opposite to each other have " +
                                           unlike_counts(it->second) +
                                           ", given or asked for; use quads = \"auto\", or give both as "
                                           "many");
                }
                if (stuck || (raised && round > most)) {
                    seeds_.corners.erase(it->first);
                    seeds_.submapped.erase(it->first);
                    mapped_.erase(it->first);
                    it = opposite_.erase(it);
                } else {
                    ++it;
                }
            }
            if (!changed) return;
        }
    }

    /// "5 (edge 1) and 7 (edge 3)" of sides whose counts differ.
    [[nodiscard]] std::string unlike_counts(const std::vector<SidePair>& pairs) const
    {
        std::string words;
        for (const SidePair& sides : pairs) {
            if (total(sides[0]) == total(sides[1])) continue;
            for (std::size_t k = 0; k < 2; ++k) {
                words += words.empty() ? "" : " and ";
                words += std::to_string(total(sides[k])) + " (";
                for (std::size_t i = 0; i < sides[k].size(); ++i)
                    words += (i > 0 ? ", " : "") + name_of(model_, sides[k][i]);
                words += ")";
            }
            break;
        }
        return words;
    }

    [[nodiscard]] int sides_of(FaceId face) const
    {
        int sum = 0;
        for (const Loop& loop : model_[face].loops) {
            for (const EdgeUse& use : loop.uses) sum += seeds_.count(use.edge);
        }
        return sum;
    }
    [[nodiscard]] bool odd(FaceId face) const { return sides_of(face) % 2 != 0; }

    /// An edge by which a face gets rid of an odd side, and the edges that get one more for it.
    struct WayOut {
        EdgeId edge;
        FaceId into;
        std::vector<EdgeId> raised;
    };

    [[nodiscard]] std::vector<EdgeId> edges_of(FaceId face) const
    {
        std::vector<EdgeId> edges;
        for (const Loop& loop : model_[face].loops) {
            for (const EdgeUse& use : loop.uses) edges.push_back(use.edge);
        }
        return edges;
    }

    /// The edges of a mapped face's side opposite to one of its edges.
    [[nodiscard]] std::vector<EdgeId> opposite_to(FaceId face, EdgeId edge) const
    {
        for (const SidePair& sides : opposite_.at(face)) {
            for (std::size_t k = 0; k < 2; ++k) {
                if (std::find(sides[k].begin(), sides[k].end(), edge) != sides[k].end()) return sides[1 - k];
            }
        }
        return {};
    }

    [[nodiscard]] bool is_free(FaceId face) const
    {
        return !opposite_.contains(face) && !seeds_.kept.contains(face);
    }

    [[nodiscard]] bool is_fixed(EdgeId edge) const
    {
        const std::vector<SeedPiece>& pieces = seeds_.pieces.at(edge);
        return std::all_of(pieces.begin(), pieces.end(), [](const SeedPiece& piece) { return piece.fixed; });
    }

    /// One more side on an edge that a face's symmetries leave where it is: that of the longest sides, of no
    /// other face. @return false where there is none
    bool raise_alike(FaceId face)
    {
        const auto sets = alike_.find(face);
        if (sets == alike_.end()) return false;
        std::optional<EdgeId> best;
        double longest = 0;
        for (const std::vector<EdgeId>& set : sets->second) {
            const EdgeId edge = set.front();
            if (set.size() > 1 || users_.at(edge).size() > 1 || !rim_.contains(edge)) continue;
            const SeedPiece& piece = seeds_.pieces.at(edge).front();
            if (piece.length <= longest * piece.count) continue;
            longest = piece.length / piece.count;
            best = edge;
        }
        return best && raise({*best}, 1);
    }

    /// Free faces by how many edges lie between them and the rim, farthest first: each hands its odd side on.
    /// A mapped face between two free ones passes a side from one of its sides to the one opposite.
    void make_even()
    {
        std::vector<WayOut> exits;
        std::set<std::pair<EdgeId, FaceId>> known;
        const auto push = [&](EdgeId edge, FaceId from, std::vector<EdgeId> raised) {
            raised.push_back(edge);
            for (const FaceId into : users_[edge]) {
                if (into == from || is_fixed(edge) || !known.insert({edge, into}).second) continue;
                exits.push_back({edge, into, raised});
            }
        };
        std::vector<EdgeId> rim(rim_.begin(), rim_.end());
        std::stable_sort(rim.begin(), rim.end(),
                         [&](EdgeId a, EdgeId b) { return edge_length(model_, a) > edge_length(model_, b); });
        for (const EdgeId edge : rim) push(edge, {}, {});
        std::map<FaceId, std::vector<EdgeId>> way_out;
        std::vector<FaceId> order;
        const auto settle = [&](FaceId face, const std::vector<EdgeId>& raised) {
            if (!way_out.try_emplace(face, raised).second) return;
            order.push_back(face);
            for (const EdgeId edge : edges_of(face)) push(edge, face, {});
        };
        std::size_t next = 0;
        const auto spread = [&] {
            for (; next < exits.size(); ++next) {
                const WayOut way = exits[next];
                if (seeds_.kept.contains(way.into)) continue;
                if (is_free(way.into)) {
                    settle(way.into, way.raised);
                    continue;
                }
                for (const EdgeId edge : opposite_to(way.into, way.edge)) push(edge, way.into, way.raised);
            }
        };
        spread();
        // Faces that no way leads to from the rim hand their odd sides to one of them, where two cancel.
        for (const FaceId face : volume_.faces(Role::source)) {
            if (!is_free(face)) continue;
            settle(face, {});
            spread();
        }
        for (auto face = order.rbegin(); face != order.rend(); ++face) {
            if (!odd(*face) || raise_alike(*face)) continue;
            for (const EdgeId edge : way_out.at(*face)) raise({edge}, 1);
        }
    }

    /// No quads fill a rim with an odd number of sides. Where all are given, the longest of the rim's that no
    /// kept quads of the source stand on is divided, and that is said.
    void divide_given_sides()
    {
        for (const FaceId face : volume_.faces(Role::source)) {
            if (!is_free(face) || !odd(face)) continue;
            SeedPiece* longest = nullptr;
            EdgeId at;
            for (const EdgeId edge : rim_) {
                const std::set<FaceId>& users = users_.at(edge);
                if (!users.contains(face) || users.size() > 1) continue;
                for (SeedPiece& piece : seeds_.pieces[edge]) {
                    if (piece.asked || (longest != nullptr && piece.length <= longest->length)) continue;
                    longest = &piece;
                    at = edge;
                }
            }
            if (longest == nullptr) continue;
            if (wedges_) {
                seeds_.notes.push_back("the rim of " + name_of(model_, face) + " came with " +
                                       std::to_string(sides_of(face)) +
                                       " sides, an odd number: one of its cells is a triangle");
                odd_.insert(face);
                continue;
            }
            seeds_.notes.push_back(
                "the rim of " + name_of(model_, face) + " came with " + std::to_string(sides_of(face)) +
                " sides, an odd number, which no quads fill: a side on " + name_of(model_, at) +
                ", with what stands on it, is divided in two; wedges = true keeps it");
            longest->kept.push_back((longest->from + longest->to) / 2);
            longest->count = 2;
        }
    }

    void check_even() const
    {
        for (const FaceId face : volume_.faces(Role::source)) {
            if (!is_free(face) || !odd(face) || odd_.contains(face)) continue;
            std::string counts;
            for (const EdgeId edge : edges_of(face)) {
                const std::vector<SeedPiece>& pieces = seeds_.pieces.at(edge);
                if (std::none_of(pieces.begin(), pieces.end(), [](const SeedPiece& p) { return p.asked; }))
                    continue;
                counts += (counts.empty() ? "" : ", ") + name_of(model_, edge) + " " +
                          std::to_string(seeds_.count(edge));
            }
            if (!counts.empty()) {
                refuse_sides("the loops of " + name_of(model_, face) +
                             " have an odd number of sides in all, which no quads fill, and no edge is free "
                             "to take one more; asked for: " +
                             counts + ". Change one of them by one");
            }
            throw NotSweepable(
                "surface.odd_loop",
                "the loops of " + name_of(model_, face) +
                    " have an odd number of sides in all, and no edge of it is free to take one more");
        }
    }

    const OpenVolume& volume_;
    const Model& model_;
    const SizeField& size_;
    QuadStyle style_;
    bool wedges_;
    int per_turn_; ///< sides for a full turn
    int gap_;      ///< quads across a narrow place
    bool counts_across_;
    const std::set<FaceId>& shared_; ///< whose quads stay whatever the style
    Seeds seeds_;
    std::map<FaceId, std::vector<std::vector<EdgeId>>> alike_; ///< what faces' symmetries map on each other
    std::map<FaceId, std::vector<SidePair>> opposite_;         ///< of mapped and submapped faces
    std::map<FaceId, MappedFace> mapped_;                      ///< of four sides
    std::set<EdgeId> rim_;
    std::set<EdgeId> settled_;                       ///< edges with numbers of sides that a grid has
    std::set<FaceId> odd_;                           ///< faces that get a triangle
    std::map<const SeedPiece*, std::string> askers_; ///< who asked for the sides of a piece
    std::map<EdgeId, std::set<FaceId>> users_;
};

} // namespace

Seeds seed_source(const OpenVolume& volume, std::span<const LinkingSurface> links, const SizeField& size,
                  QuadStyle style, const ShapeSizing& sizing, const std::map<EdgeId, double>& lengths,
                  bool wedges, const EdgeDemands& demands, const RunContext& context)
{
    Seeds seeds = Seeder(volume, links, size, style, sizing, lengths, wedges, demands).run();
    square_mapped_lines(seeds, volume, links, context);
    return seeds;
}

} // namespace lacuna::surface
