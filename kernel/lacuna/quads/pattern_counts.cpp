// SPDX-License-Identifier: MIT
#include <lacuna/quads/pattern_counts.h>

#include <lacuna/quads/detail/count_trial.h>
#include <lacuna/quads/detail/mirror_counts.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/pattern_loop.h>
#include <lacuna/quads/detail/pattern_ring.h>
#include <lacuna/quads/detail/pave_size.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace lacuna::quads {
namespace {

/// Shares of the sides wanted that a segment may get.
struct Range {
    double least, most;
};
/// What a ring's loops may get, and other segments of four sides or more. With the first, rows of a ring are
/// of the size asked by the measure of `measure_plane()`, edges 0.6 to 1.6 times as long; the second is what
/// is promised for sizes. Shorter segments may change by one side.
constexpr Range kRing{1 / 1.6, 1 / 0.6}, kSegment{1 / 1.25, 1.25};
/// Shares by which rounding may take a ring's segments out of that range, so that loops of several segments
/// still have alike ones: it takes edges along one loop. A choice, not a measurement.
constexpr double kRounding = 1.03;
constexpr Range kRingSegment{kRing.least / kRounding, kRing.most* kRounding};
/// Rows with holes between them bend, so that less is left. A choice, not a measurement.
constexpr Range kRingWithHoles{1 / 1.55, 1.55};

/// Where there are fewer quads than this, a grid is made with several numbers and the best are taken. For the
/// time.
constexpr double kFewForTrial = 200;

/// The sides of a segment that run one way.
struct Run {
    std::size_t segment = 0;
    int quarter = 0; ///< 0…3
    double wanted = 0;
    int count = 0;
};

/// Alike for a given ratio, above and below.
double cost_of(const Run& run, int count)
{
    const double off = count - run.wanted;
    return count > 0 ? off * off / count : std::numeric_limits<double>::infinity();
}

/// What a side of a run adds to the excess of sides one way over those back.
std::array<int, 2> step_of(int quarter)
{
    std::array<int, 2> step{};
    step[static_cast<std::size_t>(quarter % 2)] = quarter < 2 ? 1 : -1;
    return step;
}

int badness(const std::array<int, 2>& excess) { return excess[0] * excess[0] + excess[1] * excess[1]; }

/// The runs of one loop, and how far it is from closing.
struct CountedLoop {
    std::vector<Run> runs;
    std::array<int, 2> excess{};
    std::array<int, 2> added{}; ///< sides along headings 0 and 1 that its rows of quads add
    double wanted = 0;          ///< sides in all
    int soft = 0;               ///< turns that its rows of quads make
};

class CountSolver {
public:
    /// @param range  that segments may get in a straight grid.
    /// @param few    whether the quads are few, so that holes may find no place between so few lines.
    CountSolver(const PlanarRegion& region, std::span<const int> segment,
                std::span<const BoundarySegment> segments, const Range& range = kSegment, bool few = false)
        : region_(region),
          segment_(segment),
          segments_(segments),
          range_(range),
          few_(few),
          own_(segments.size(), 0)
    {
        for (const auto& loop : region.loops) {
            for (const Index p : loop) ++own_[segment_of(p)];
        }
    }

    /// Numbers of sides of every segment, and what they cost beside those of other parts of a region.
    struct Counts {
        std::vector<int> sides;
        double cost = 0;
    };

    /// @param cut  whether the region may be cut along mirror axes.
    std::optional<Counts> run(bool cut)
    {
        std::size_t about = 0;
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            if (about == 0 || region_.loops[l].size() > region_.loops[about].size()) about = l;
        }
        std::optional<std::vector<int>> ring;
        if (about > 0) ring = ring_counts(about);
        if (ring && (!cut || are_alike(*ring, mirrored_segments()))) return Counts{*ring};
        is_part_ = !cut;
        if (cut) {
            if (auto counts = part_counts()) return Counts{std::move(*counts)};
        }
        if (ring) return Counts{*ring};
        return straight_counts();
    }

    /// Counts for a part of a region, between mirror axes: in the range that is promised or, of few quads,
    /// where no grid fills it so, in a ring's.
    static std::optional<Counts> of_part(const PlanarRegion& part, std::span<const int> segment,
                                         std::span<const BoundarySegment> segments, bool few)
    {
        auto counts = CountSolver(part, segment, segments, kSegment, few).run(false);
        return counts || !few ? counts : CountSolver(part, segment, segments, kRingSegment, few).run(false);
    }

private:
    /// Counts for straight lines, where ends of 135° may be soft or hard: those of the lower cost. As many
    /// quads as asked count too, for the rows before soft ends add some. Soft ends have quads so much better
    /// shaped that they may cost more. Of few quads of a whole region those that a grid fills best.
    [[nodiscard]] std::optional<Counts> straight_counts() const
    {
        // What those are worth; chosen on 40 of the held family (benchmarks/pave/).
        constexpr double kSoft = 2;
        std::optional<Counts> best;
        std::vector<Counts> all;
        const bool either = has_half_ends(region_);
        for (const HalfEnds half : {HalfEnds::soft, HalfEnds::hard}) {
            if (half == HalfEnds::hard && !either) break;
            StraightCounts found = straight_counts(half);
            const double worth = half == HalfEnds::soft ? 1 / kSoft : 1;
            if (found.best && (!best || worth * found.best->cost < best->cost)) {
                best = found.best;
                best->cost *= worth;
            }
            for (Counts& counts : found.all) {
                counts.cost *= worth;
                all.push_back(std::move(counts));
            }
        }
        if (!is_part_ && quads_asked() < kFewForTrial) {
            if (auto filled = best_filled(std::move(all))) return filled;
        }
        return best;
    }

    /// Of several counts those that a grid fills best by measure, the cheapest first, until one is good.
    /// Nothing where none is filled, or there is no choice.
    [[nodiscard]] std::optional<Counts> best_filled(std::vector<Counts> all) const
    {
        // A score of quads as they should be, and grids made at most: for the time. Choices.
        constexpr double kGood = 3.1;
        constexpr std::size_t kMost = 4;
        std::stable_sort(all.begin(), all.end(),
                         [](const Counts& a, const Counts& b) { return a.cost < b.cost; });
        const auto alike = [](const Counts& a, const Counts& b) { return a.sides == b.sides; };
        all.erase(std::unique(all.begin(), all.end(), alike), all.end());
        if (all.size() < 2) return std::nullopt;
        std::optional<Counts> best;
        double most = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < std::min(kMost, all.size()) && most < kGood; ++i) {
            const auto score = score_of_counts(region_, segment_, all[i].sides, quads_asked());
            if (!score || *score <= most) continue;
            most = *score;
            best = all[i];
        }
        return best;
    }

    struct StraightCounts {
        std::optional<Counts> best;
        std::vector<Counts> all; ///< of a whole region: those looked at
    };

    /// The same for one kind of ends: the best over the rows before soft turns, and over numbers of sides
    /// that are rounded from a few shares of those wanted, for rows add quads and columns take sides.
    [[nodiscard]] StraightCounts straight_counts(HalfEnds half) const
    {
        // What quads are worth, as above; and rows, whose number is to be that of `fitting_rows()`.
        constexpr double kQuads = 0.25, kRows = 1;
        constexpr double kUnlike = 10; // of segments that mirror each other: hardly ever; a choice
        // As many quads as asked, a quarter more or less, is what is promised. Choices.
        constexpr double kMostOff = 0.25, kOff = 2, kNearAsked = 0.1, kMany = 2000;
        constexpr std::array<double, 7> kShares{1, 0.9, 0.8, 1.1, 0.65, 1.25, 1.5}; // choices
        constexpr std::size_t kNear = 4; // of those, for the range that is promised
        const double angle = main_angle(region_), asked = quads_asked();
        std::vector<PatternLoop> headed;
        int fitting = 1;
        for (std::size_t l = 0; l < region_.loops.size(); ++l) {
            auto loop = head_loop(region_.points, region_.loops[l], {false, Vec2::Zero(), angle},
                                  kStraightWeight, 1, half);
            if (!loop || loop->turns != (l == 0 ? 4 : -4)) return {};
            fitting = std::max(fitting, fitting_rows(*loop));
            headed.push_back(std::move(*loop));
        }
        const std::vector<std::array<std::size_t, 2>> pairs = mirrored_segments();
        if (few_ && are_close()) return {};
        StraightCounts best;
        // What is no part has no axes that take up the difference of more rows.
        const std::vector<int> all_rows = is_part_ ? rows_to_try(fitting) : std::vector<int>{1};
        const bool wide = range_.most > kSegment.most;
        const std::span<const double> shares = std::span(kShares).first(wide ? kShares.size() : kNear);
        for (const int rows : all_rows) {
            for (const double share : shares) {
                std::vector<CountedLoop> loops;
                double cost = 0;
                std::vector<LoopGrid> grids;
                double quads = 0;
                int soft = 0;
                for (std::size_t l = 0; l < region_.loops.size(); ++l) {
                    PatternLoop loop = headed[l];
                    set_soft_rows(loop, rows);
                    auto counts = counted(std::move(loop), share);
                    if (!counts || !close(*counts, range_)) break;
                    for (Run& run : counts->runs) run.wanted /= share;
                    cost += sum_of_costs(*counts);
                    soft += counts->soft;
                    if (auto grid = loop_grid(l, *counts, angle, half, rows)) {
                        quads += grid->quads();
                        grids.push_back(std::move(*grid));
                    }
                    loops.push_back(std::move(*counts));
                }
                if (loops.size() < region_.loops.size()) continue;
                // A symmetric region is not filled otherwise than its images.
                if (!is_part_ && !are_alike(*counts_of(loops), pairs)) continue;
                if (grids.size() < loops.size()) quads = asked; // not known
                cost += kQuads * (quads - asked) * (quads - asked) / asked;
                if (is_part_) {
                    const double off = std::log(static_cast<double>(rows) / fitting);
                    cost += kRows * soft * std::max(1.0, fitting / 2.0) * off * off +
                            kUnlike * unlike(*counts_of(loops), pairs);
                }
                const bool fits = std::abs(quads - asked) <= kNearAsked * asked;
                if (std::abs(quads - asked) > kMostOff * asked) cost += kOff;
                // Few lines leave holes no place, and for many looking takes long.
                const bool looks = is_part_ ? few_ : asked < kMany;
                const bool has_place = !looks || have_place(grids);
                if (!has_place) cost += kOff;
                if (!few_ || has_place) {
                    if (loops.size() > 1 && !grids.empty()) centre_holes(loops, grids.front());
                    const Counts counts{*counts_of(loops), cost};
                    if (!best.best || cost < best.best->cost) best.best = counts;
                    if (!is_part_) best.all.push_back(counts);
                }
                if (soft == 0 && share == shares.back()) return best;
                if (!is_part_ && fits && has_place) return best;
            }
        }
        return best;
    }

    /// The symmetries that map segments onto segments. One that is a whole loop ends where the loop
    /// starts.
    static std::vector<Symmetry> segment_symmetries(const PlanarRegion& region, std::span<const int> segment)
    {
        std::vector<char> is_end(region.points.size(), 0);
        for (const auto& loop : region.loops) {
            bool ends = false;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const auto here = static_cast<std::size_t>(loop[i]),
                           before = static_cast<std::size_t>(loop[(i + loop.size() - 1) % loop.size()]);
                if (segment[here] == segment[before]) continue;
                is_end[here] = 1;
                ends = true;
            }
            if (!ends) is_end[static_cast<std::size_t>(loop[0])] = 1;
        }
        std::vector<Symmetry> symmetries = outline_symmetries(region);
        std::erase_if(symmetries, [&](const Symmetry& symmetry) {
            for (std::size_t p = 0; p < is_end.size(); ++p) {
                if (is_end[p] != is_end[static_cast<std::size_t>(symmetry.to[p])]) return true;
            }
            return false;
        });
        return symmetries;
    }

    /// The segments that mirror each other or, twice the same, themselves.
    [[nodiscard]] std::vector<std::array<std::size_t, 2>> mirrored_segments() const
    {
        std::vector<std::array<std::size_t, 2>> pairs;
        for (const Symmetry& symmetry : segment_symmetries(region_, segment_)) {
            if (!symmetry.map.mirrors) continue;
            for (const auto& loop : region_.loops) {
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    const Index to = symmetry.to[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
                    const std::array<std::size_t, 2> pair{segment_of(loop[i]), segment_of(to)};
                    if (pair[0] <= pair[1] && (pairs.empty() || pairs.back() != pair)) pairs.push_back(pair);
                }
            }
        }
        return pairs;
    }

    static bool are_alike(const std::vector<int>& counts,
                          const std::vector<std::array<std::size_t, 2>>& pairs)
    {
        return std::all_of(pairs.begin(), pairs.end(),
                           [&](const auto& pair) { return counts[pair[0]] == counts[pair[1]]; });
    }

    /// How many pairs have unlike numbers of sides, or an odd one.
    static int unlike(const std::vector<int>& counts, const std::vector<std::array<std::size_t, 2>>& pairs)
    {
        return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [&](const auto& pair) {
            return counts[pair[0]] != counts[pair[1]] || (pair[0] == pair[1] && counts[pair[0]] % 2 != 0);
        }));
    }

    static constexpr double kTiny = 1e-6; ///< far above rounding, far below a side

    /// The region with nodes where mirror axes cross sides that are not given.
    struct Halved {
        PlanarRegion region;
        std::vector<int> segment;   ///< of the side from each node to the next
        std::vector<Index> next;    ///< node of each node's loop
        std::vector<double> weight; ///< that side in sides of the region: 1 or ½
        [[nodiscard]] int segment_at(Index p) const { return segment[static_cast<std::size_t>(p)]; }
    };

    /// Counts for the part of a symmetric region between mirror axes, for all of its images.
    /// Those with which a grid fills it or, where there are none, the numbers wanted, rounded.
    [[nodiscard]] std::optional<std::vector<int>> part_counts() const
    {
        const Halved halved = halve_crossed();
        const std::vector<Symmetry> symmetries = segment_symmetries(halved.region, halved.segment);
        std::function<double(const Vec2&)> asked = region_.size;
        if (!asked) asked = [mean = mean_size()](const Vec2&) { return mean; };
        // Few quads do not change their size as slowly as many.
        std::vector<std::function<double(const Vec2&)>> sizes{paving::size_with_boundary(region_)};
        if (quads_asked() < kFewForGrading) sizes.insert(sizes.begin(), asked);
        std::optional<std::vector<int>> first, best;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& size : sizes) {
            const std::size_t choices = &size == &sizes.back() ? 1 : kMostChoices;
            for (std::size_t choice = 0; choice < choices; ++choice) {
                const auto part = mirror_part(halved.region, symmetries, size, choice);
                if (!part) break;
                auto counts = part_counts(halved, *part, sizes.size() > 1);
                if (counts.cost < least) best = counts.sides;
                least = std::min(least, counts.cost);
                if (&size == &sizes.back()) first = std::move(counts.sides);
            }
            if (best) break;
        }
        return best ? best : first;
    }

    struct PartCounts {
        std::vector<int> sides;
        double cost = std::numeric_limits<double>::infinity(); ///< infinite where no grid fills the part
    };

    /// The same of one part.
    [[nodiscard]] PartCounts part_counts(const Halved& halved, const MirrorPart& part, bool few) const
    {
        std::vector<int> own;
        std::vector<BoundarySegment> parts;
        std::vector<Index> starts; // the side that each begins with, by the whole region's node; -1: an axis
        own.resize(part.region.points.size());
        for (const auto& loop : part.region.loops) {
            int last = -1;
            for (const Index p : loop) {
                const auto at = static_cast<std::size_t>(p);
                const int axis = part.axis[at];
                const int key = axis >= 0 ? -2 - axis : halved.segment_at(part.whole[at]);
                if (p == loop.front() || key != last) {
                    parts.push_back({0, 1, false});
                    starts.push_back(axis >= 0 ? -1 : part.whole[at]);
                }
                last = key;
                own[at] = static_cast<int>(parts.size()) - 1;
                if (axis >= 0) {
                    parts.back().wanted = part.wanted[static_cast<std::size_t>(axis)];
                    continue;
                }
                const auto s = static_cast<std::size_t>(key);
                const double share = halved.weight[static_cast<std::size_t>(part.whole[at])] / own_[s];
                parts.back().wanted += share * segments_[s].wanted;
                for (const Symmetry& image : part.images)
                    parts.back().fixed = parts.back().fixed ||
                                         segments_[image_of(halved, part, image, p)].fixed;
            }
        }
        for (std::size_t t = 0; t < parts.size(); ++t) {
            if (starts[t] < 0) continue;
            const BoundarySegment& whole = segments_[static_cast<std::size_t>(halved.segment_at(starts[t]))];
            parts[t].least = std::max(
                1, static_cast<int>(std::ceil(whole.least * parts[t].wanted / whole.wanted - kTiny)));
        }
        std::optional<Counts> counts = of_part(part.region, own, parts, few);
        const auto pairs = CountSolver(part.region, own, parts).mirrored_segments();
        // What is symmetric about more axes is so with numbers that fit them, if no grid.
        if (counts && !few && part.has_centre && unlike(counts->sides, pairs) > 0) counts.reset();
        const std::vector<int> sides = counts ? counts->sides : rounded(parts, pairs);
        std::vector<int> sum(segments_.size(), 0);
        std::vector<char> done(parts.size(), 0);
        for (const auto& loop : part.region.loops) {
            for (const Index p : loop) {
                const auto t = static_cast<std::size_t>(own[static_cast<std::size_t>(p)]);
                if (done[t] || starts[t] < 0) continue;
                done[t] = 1;
                for (const Symmetry& image : part.images) sum[image_of(halved, part, image, p)] += sides[t];
            }
        }
        return counts ? PartCounts{sum, counts->cost} : PartCounts{sum};
    }

    /// The sides wanted of each segment, rounded: to an even number where it mirrors itself.
    static std::vector<int> rounded(const std::vector<BoundarySegment>& parts,
                                    const std::vector<std::array<std::size_t, 2>>& pairs)
    {
        std::vector<int> counts;
        for (const BoundarySegment& part : parts)
            counts.push_back(std::max(part.least, static_cast<int>(std::lround(part.wanted))));
        for (const auto& [a, b] : pairs) {
            if (a == b && !parts[a].fixed)
                counts[a] = std::max(2 * ((parts[a].least + 1) / 2),
                                     2 * static_cast<int>(std::lround(parts[a].wanted / 2)));
            if (!parts[b].fixed) counts[b] = counts[a];
        }
        return counts;
    }

    [[nodiscard]] Halved halve_crossed() const
    {
        std::vector<char> crossed(region_.points.size(), 0);
        for (const Symmetry& symmetry : segment_symmetries(region_, segment_)) {
            for (const auto& loop : region_.loops) {
                for (std::size_t i = 0; i < loop.size() && symmetry.map.mirrors; ++i) {
                    const auto a = static_cast<std::size_t>(loop[i]);
                    const Index b = loop[(i + 1) % loop.size()];
                    if (symmetry.to[a] == b && symmetry.to[static_cast<std::size_t>(b)] == loop[i] &&
                        !segments_[segment_of(loop[i])].fixed)
                        crossed[a] = 1;
                }
            }
        }
        Halved halved;
        halved.region.size = region_.size;
        const auto push = [&](const Vec2& p, int segment, double weight) {
            halved.region.loops.back().push_back(static_cast<Index>(halved.region.points.size()));
            halved.region.points.push_back(p);
            halved.segment.push_back(segment);
            halved.weight.push_back(weight);
            halved.next.push_back(static_cast<Index>(halved.region.points.size()));
        };
        for (const auto& loop : region_.loops) {
            halved.region.loops.emplace_back();
            const auto first = static_cast<Index>(halved.region.points.size());
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const auto a = static_cast<std::size_t>(loop[i]),
                           b = static_cast<std::size_t>(loop[(i + 1) % loop.size()]);
                const int own = segment_[a];
                push(region_.points[a], own, crossed[a] ? 0.5 : 1);
                if (crossed[a]) push((region_.points[a] + region_.points[b]) / 2, own, 0.5);
            }
            halved.next.back() = first;
        }
        return halved;
    }

    /// The segment that the side from a node of a part to the next is mapped to.
    static std::size_t image_of(const Halved& halved, const MirrorPart& part, const Symmetry& image, Index p)
    {
        Index a = part.whole[static_cast<std::size_t>(p)];
        if (image.map.mirrors) a = halved.next[static_cast<std::size_t>(a)];
        return static_cast<std::size_t>(halved.segment_at(image.to[static_cast<std::size_t>(a)]));
    }

    /// Quads that the size asks for: that of the region where it has one, else of the sides wanted.
    [[nodiscard]] double quads_asked() const
    {
        double area = 0, density = 0;
        for (const auto& loop : region_.loops) area += area_of(loop);
        if (!region_.size) return area / (mean_size() * mean_size());
        for (const Vec2& p : region_.points)
            density += 1 / (region_.size(p) * region_.size(p)) / static_cast<double>(region_.points.size());
        return area * density;
    }

    [[nodiscard]] double area_of(const std::vector<Index>& loop) const
    {
        double twice = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = region_.points[static_cast<std::size_t>(loop[i])],
                       &b = region_.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
            twice += a.x() * b.y() - a.y() * b.x();
        }
        return twice / 2;
    }

    [[nodiscard]] std::size_t segment_of(Index p) const
    {
        return static_cast<std::size_t>(segment_[static_cast<std::size_t>(p)]);
    }

    /// A loop's runs, and its excess once its rows are placed.
    /// @param share  of the sides wanted.
    /// @return nothing where it fits no grid.
    [[nodiscard]] std::optional<CountedLoop> counted(PatternLoop loop, double share = 1) const
    {
        CountedLoop counted;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t s = segment_of(loop.nodes[i]);
            const int quarter = ((loop.heading[i] % 4) + 4) % 4;
            auto run = std::find_if(counted.runs.begin(), counted.runs.end(),
                                    [&](const Run& r) { return r.segment == s && r.quarter == quarter; });
            if (run == counted.runs.end()) run = counted.runs.insert(run, {s, quarter, 0, 0});
            run->wanted += share * segments_[s].wanted / own_[s];
            ++run->count;
        }
        counted.soft = static_cast<int>(std::count(loop.movable.begin(), loop.movable.end(), 1));
        std::vector<Vec2> points = region_.points;
        std::vector<Quad> quads;
        if (!lay_pattern_rows(loop, points, quads, [](const Vec2&) { return 1.0; })) return std::nullopt;
        for (const int h : loop.heading) {
            const int quarter = ((h % 4) + 4) % 4;
            const auto step = step_of(quarter);
            for (std::size_t k = 0; k < 2; ++k) counted.excess[k] += step[k];
            if (quarter < 2) ++counted.added[static_cast<std::size_t>(quarter)];
        }
        for (const Run& run : counted.runs) {
            if (run.quarter < 2) counted.added[static_cast<std::size_t>(run.quarter)] -= run.count;
        }
        for (Run& run : counted.runs) {
            counted.wanted += run.wanted;
            if (!segments_[run.segment].fixed)
                add(counted, run, std::max(1, static_cast<int>(std::lround(run.wanted))) - run.count);
        }
        // Rounding may have left a segment of several runs with fewer than it needs.
        for (Run& run : counted.runs) {
            const BoundarySegment& own = segments_[run.segment];
            if (!own.fixed && sides_of(counted, run.segment) < own.least) add(counted, run, 1);
        }
        return counted;
    }

    static int sides_of(const CountedLoop& loop, std::size_t segment)
    {
        int sum = 0;
        for (const Run& run : loop.runs) sum += run.segment == segment ? run.count : 0;
        return sum;
    }

    static void add(CountedLoop& loop, Run& run, int by)
    {
        run.count += by;
        const auto step = step_of(run.quarter);
        for (std::size_t k = 0; k < 2; ++k) loop.excess[k] += by * step[k];
    }

    /// Change runs, the cheapest first, until a loop has no excess. @return false where none may change
    [[nodiscard]] bool close(CountedLoop& loop, const Range& range) const
    {
        while (badness(loop.excess) > 0) {
            double least = std::numeric_limits<double>::infinity();
            Run *best = nullptr, *other = nullptr;
            int best_by = 0;
            for (Run& run : loop.runs) {
                for (const int by : {1, -1}) {
                    if (!may_be(loop, run, run.count + by, range)) continue;
                    const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                    if (!segments_[run.segment].fixed) {
                        if (!improves(loop, run, by, nullptr) || cost >= least) continue;
                        least = cost;
                        best = &run;
                        other = nullptr;
                        best_by = by;
                        continue;
                    }
                    // A given number of sides that turn: the turn moves.
                    for (Run& next : loop.runs) {
                        if (next.segment != run.segment || &next == &run || next.count - by < 1) continue;
                        const double both = cost + cost_of(next, next.count - by) - cost_of(next, next.count);
                        if (!improves(loop, run, by, &next) || both >= least) continue;
                        least = both;
                        best = &run;
                        other = &next;
                        best_by = by;
                    }
                }
            }
            if (best == nullptr) return false;
            add(loop, *best, best_by);
            if (other != nullptr) add(loop, *other, -best_by);
        }
        return true;
    }

    /// A loop with the numbers of sides it has now, in a straight grid.
    struct LoopGrid {
        std::vector<Vec2> points;
        GridLoop grid;
        std::size_t laid = 0; ///< quads of the rows between the loop and the grid

        /// Quads that the loop adds to a region's: those within it, less than none of a hole.
        [[nodiscard]] double quads() const
        {
            double twice = 0;
            for (std::size_t i = 0, n = grid.positions.size(); i < n; ++i) {
                const GridPosition &a = grid.positions[i], &b = grid.positions[(i + 1) % n];
                twice += static_cast<double>(a[0]) * b[1] - static_cast<double>(a[1]) * b[0];
            }
            return twice / 2 + static_cast<double>(laid);
        }
    };
    [[nodiscard]] std::optional<LoopGrid> loop_grid(std::size_t l, const CountedLoop& counted, double angle,
                                                    HalfEnds half, int rows) const
    {
        const std::vector<Index>& loop = region_.loops[l];
        const auto at = [&](std::size_t i) -> const Vec2& {
            return region_.points[static_cast<std::size_t>(loop[i % loop.size()])];
        };
        LoopGrid made;
        double length = 0;
        for (std::size_t from = 0, to = 0; from < loop.size(); from = to) {
            const std::size_t own = segment_of(loop[from]);
            while (to < loop.size() && segment_of(loop[to]) == own) ++to;
            const int sides = sides_of(counted, own);
            for (int k = 0; k < sides; ++k) {
                const double place = static_cast<double>(k) / sides * static_cast<double>(to - from);
                const auto whole = static_cast<std::size_t>(place);
                const double part = place - static_cast<double>(whole);
                made.points.push_back((1 - part) * at(from + whole) + part * at(from + whole + 1));
            }
            for (std::size_t i = from; i < to; ++i) length += (at(i + 1) - at(i)).norm();
        }
        std::vector<Index> nodes(made.points.size());
        std::iota(nodes.begin(), nodes.end(), 0);
        auto headed = head_loop(made.points, nodes, {false, Vec2::Zero(), angle}, kStraightWeight, 1, half);
        if (headed) set_soft_rows(*headed, rows);
        const double mean = length / static_cast<double>(nodes.size());
        std::vector<Quad> quads;
        if (!headed || !lay_pattern_rows(*headed, made.points, quads, [&](const Vec2&) { return mean; }) ||
            !close_pattern_loop(*headed, 0))
            return std::nullopt;
        made.grid = positions_of(*headed);
        made.laid = quads.size();
        return made;
    }

    /// Whether some quads between two loops would be much flatter than asked.
    [[nodiscard]] bool are_close() const
    {
        constexpr double kNarrow = 0.5; // of the size asked: a choice, not a measurement
        const double narrow = kNarrow * mean_size();
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            for (std::size_t m = 0; m < l; ++m) {
                if (ring_widths(region_.points, region_.loops[m], region_.loops[l]).least < narrow)
                    return true;
            }
        }
        return false;
    }

    /// Whether holes lie apart in the outer loop's grid, each where its coordinates put it.
    [[nodiscard]] bool have_place(const std::vector<LoopGrid>& grids) const
    {
        if (grids.size() < region_.loops.size()) return false;
        std::vector<GridLoop> loops;
        for (const LoopGrid& own : grids) {
            loops.push_back(own.grid);
            if (loops.size() == 1) continue;
            Vec2 by = Vec2::Zero();
            for (std::size_t i = 0; i < own.grid.nodes.size(); ++i) {
                const Vec2& p = own.points[static_cast<std::size_t>(own.grid.nodes[i])];
                const GridPosition& at = own.grid.positions[i];
                by += (mean_value_position(grids[0].points, grids[0].grid, p) - Vec2(at[0], at[1])) /
                      static_cast<double>(own.grid.nodes.size());
            }
            if (!by.allFinite()) return false;
            for (GridPosition& at : loops.back().positions) {
                at[0] += static_cast<int>(std::lround(by.x()));
                at[1] += static_cast<int>(std::lround(by.y()));
            }
        }
        return SubmapGrid(loops).enclose(loops);
    }

    /// Give holes an even number of columns where their middle lies on a line of the outer loop's grid, and
    /// an odd one where it lies between two; so for rows. A hole in the middle of a plate then stays there.
    void centre_holes(std::vector<CountedLoop>& loops, const LoopGrid& outer) const
    {
        for (std::size_t l = 1; l < loops.size(); ++l) {
            const Vec2 middle = mean_value_position(outer.points, outer.grid,
                                                    centre_of(region_.points, region_.loops[l]));
            for (int k = 0; k < 2; ++k) {
                const double off = std::abs(middle[k] - std::round(middle[k]));
                int across = loops[l].added[static_cast<std::size_t>(k)];
                for (const Run& run : loops[l].runs) across += run.quarter == k ? run.count : 0;
                if ((off > 0.25) != (across % 2 != 0)) change_both(loops[l], k);
            }
        }
    }

    /// One more or one less along a heading and back, whichever costs less; nothing where neither may be.
    void change_both(CountedLoop& loop, int quarter) const
    {
        double least = std::numeric_limits<double>::infinity();
        std::array<Run*, 2> best{};
        int best_by = 0;
        for (const int by : {1, -1}) {
            std::array<Run*, 2> cheapest{};
            double sum = 0;
            for (int back = 0; back < 2; ++back) {
                double own = std::numeric_limits<double>::infinity();
                for (Run& run : loop.runs) {
                    if (run.quarter != quarter + 2 * back || segments_[run.segment].fixed ||
                        !may_be(loop, run, run.count + by, kSegment))
                        continue;
                    const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                    if (cost >= own) continue;
                    own = cost;
                    cheapest[static_cast<std::size_t>(back)] = &run;
                }
                sum += own;
            }
            if (sum >= least) continue;
            least = sum;
            best = cheapest;
            best_by = by;
        }
        if (best_by == 0) return;
        for (Run* run : best) add(loop, *run, best_by);
    }

    [[nodiscard]] bool may_be(const CountedLoop& loop, const Run& run, int count, const Range& range) const
    {
        const BoundarySegment& own = segments_[run.segment];
        if (count < 1 || own.fixed) return count >= 1;
        const int sides = sides_of(loop, run.segment) + count - run.count;
        if (count < run.count && sides < own.least) return false;
        const double off = sides / own.wanted;
        return (off <= range.most && off >= range.least) || std::abs(sides - own.wanted) <= 1;
    }

    static bool improves(const CountedLoop& loop, const Run& run, int by, const Run* other)
    {
        std::array<int, 2> now = loop.excess;
        for (std::size_t k = 0; k < 2; ++k) {
            now[k] += by * step_of(run.quarter)[k];
            if (other != nullptr) now[k] -= by * step_of(other->quarter)[k];
        }
        return badness(now) < badness(loop.excess);
    }

    /// The sides of a loop that are not of the size asked, each of which costs as much as one too few.
    [[nodiscard]] static double out_of_size(const CountedLoop& loop)
    {
        int sum = 0;
        for (const Run& run : loop.runs) {
            const double off = run.count / run.wanted;
            if (off < kRing.least || off > kRing.most) sum += run.count;
        }
        return sum;
    }

    [[nodiscard]] static double sum_of_costs(const CountedLoop& loop)
    {
        double sum = 0;
        for (const Run& run : loop.runs) sum += cost_of(run, run.count);
        return sum;
    }

    /// Counts for a grid round a hole: the number of sides along it for which the loops' costs, each over
    /// what the loop wants, are least in sum.
    [[nodiscard]] std::optional<std::vector<int>> ring_counts(std::size_t about) const
    {
        std::array<CountedLoop, 2> ends;
        std::array<int, 2> along{};
        std::vector<CountedLoop> others;
        const Vec2 centre = centre_of(region_.points, region_.loops[about]);
        for (std::size_t l = 0; l < region_.loops.size(); ++l) {
            const Vec2 own = centre_of(region_.points, region_.loops[l]);
            const bool is_end = l == 0 || l == about;
            LoopFrame frame{is_end, own, 0};
            if (!is_end) frame.angle = std::atan2(own.y() - centre.y(), own.x() - centre.x());
            auto headed = head_loop(
                region_.points, region_.loops[l], frame,
                is_end ? kRoundWeight / static_cast<double>(region_.loops[l].size()) : kStraightWeight, 1);
            if (!headed || headed->turns != (is_end ? 0 : -4) ||
                (is_end && !is_ring_loop(region_.points, *headed)))
                return std::nullopt;
            auto loop = counted(std::move(*headed));
            if (!loop) return std::nullopt;
            if (!is_end) {
                if (!close(*loop, kSegment)) return std::nullopt;
                others.push_back(std::move(*loop));
                continue;
            }
            const std::size_t e = l == 0 ? 0 : 1;
            along[e] = std::abs(loop->excess[0]);
            ends[e] = std::move(*loop);
        }
        const int fold = alike(others, about);
        // Numbers that leave loops as symmetric as they are, where others are as good.
        const int symmetric = std::lcm(fold, std::lcm(repeats(0), repeats(about)));
        std::optional<std::vector<CountedLoop>> best;
        const RingWidths widths = ring_widths(region_.points, region_.loops[0], region_.loops[about]);
        const double size = mean_size();
        const bool alone = others.empty();
        const int steps = alone ? widths.steps(size) : 0;
        // An even number, where there is one, leaves what lies beyond a loop to quads alone.
        for (const int multiple : {std::lcm(alone ? symmetric : fold, 2), std::lcm(fold, 2), fold}) {
            if (!best)
                best = ring_ends(ends, along, multiple, std::array{2 * steps},
                                 alone ? kRingSegment : kRingWithHoles);
        }
        if (!best && alone && symmetric > 2) {
            // A loop of many corners has that many sides, and the other as many for a symmetric mesh.
            constexpr Range kMany{kRing.least, 4}; // a choice, not a measurement
            const auto corners = static_cast<int>(std::count_if(
                ends[0].runs.begin(), ends[0].runs.end(), [](const Run& run) { return run.quarter == 0; }));
            if (corners % symmetric == 0 && corners > 2 * symmetric - 1)
                best = ring_ends(ends, {corners, corners}, corners, std::array{0}, kMany);
        }
        if (!best && alone) {
            // Rows that change their number of sides, alike at two nodes.
            std::vector<int> more;
            for (int rows = 1; rows <= widths.changing(size); ++rows)
                more.push_back(along[0] > along[1] ? 4 * rows : -4 * rows);
            best = ring_ends(ends, along, 2, more, kSegment);
            if (!best) best = ring_ends(ends, along, 2, more, kRingSegment);
        }
        if (!best) return std::nullopt;
        best->insert(best->end(), others.begin(), others.end());
        return counts_of(*best);
    }

    /// The loops of a ring at the least cost in sum, each over what the loop wants.
    /// @param multiple  that the outer loop's number of sides along must be.
    /// @param more      sides more than the inner loop has: the numbers to be tried.
    [[nodiscard]] std::optional<std::vector<CountedLoop>> ring_ends(const std::array<CountedLoop, 2>& ends,
                                                                    const std::array<int, 2>& along,
                                                                    int multiple, std::span<const int> more,
                                                                    const Range& range) const
    {
        std::optional<std::vector<CountedLoop>> best;
        double least = std::numeric_limits<double>::infinity();
        const int low = std::max(3, std::min(along[0], along[1])), high = std::max(along[0], along[1]);
        // As many quads as asked are worth this much where rows are alike all round; elsewhere rows that
        // change make up for it. Chosen on gears of 400 and 3,000 quads.
        constexpr double kQuads = 3;
        const double mean = (wanted_along(ends[0]) + wanted_along(ends[1])) / 2;
        for (const int by : more) {
            for (int sides = (low + multiple - 1) / multiple * multiple; sides < high + multiple;
                 sides += multiple) {
                if (sides - by < 3) continue;
                const double off = by == 0 ? sides / mean - 1 : 0;
                double cost = kQuads * off * off;
                bool closed = true;
                std::vector<CountedLoop> tried(ends.begin(), ends.end());
                for (std::size_t e = 0; e < 2 && closed; ++e) {
                    tried[e].excess[0] -= e == 0 ? sides : by - sides;
                    closed = close(tried[e], range);
                    cost += (sum_of_costs(tried[e]) + out_of_size(tried[e])) / tried[e].wanted;
                }
                if (!closed || cost >= least) continue;
                least = cost;
                best = std::move(tried);
            }
        }
        return best;
    }

    /// Sides wanted round a ring.
    static double wanted_along(const CountedLoop& loop)
    {
        double sum = 0;
        for (const Run& run : loop.runs)
            sum += run.quarter % 2 != 0 ? 0 : run.quarter == 0 ? run.wanted : -run.wanted;
        return std::abs(sum);
    }

    /// The mean of the sizes asked along the boundary.
    [[nodiscard]] double mean_size() const
    {
        double length = 0, wanted = 0;
        for (const auto& loop : region_.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 &a = region_.points[static_cast<std::size_t>(loop[i])],
                           &b = region_.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
                length += (b - a).norm();
                wanted += segments_[segment_of(loop[i])].wanted / own_[segment_of(loop[i])];
            }
        }
        return length / wanted;
    }

    /// How often the same segments follow each other on a loop.
    [[nodiscard]] int repeats(std::size_t l) const
    {
        constexpr double kAlike = 0.01; // share by which they may differ; a choice, not a measurement
        std::vector<double> wanted;
        const std::vector<Index>& loop = region_.loops[l];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t own = segment_of(loop[i]);
            if (i == 0 || own != segment_of(loop[i - 1])) wanted.push_back(segments_[own].wanted);
        }
        const std::size_t n = wanted.size();
        for (std::size_t period = 1; period < n; ++period) {
            if (n % period != 0) continue;
            bool same = true;
            for (std::size_t i = 0; i < n && same; ++i)
                same = std::abs(wanted[i] - wanted[i % period]) <= kAlike * wanted[i];
            if (same) return static_cast<int>(n / period);
        }
        return 1;
    }

    /// How many holes there are beside the one the grid goes round, where they are of one size and at one
    /// distance from it; else 1. A number of sides that they divide leaves them alike.
    [[nodiscard]] int alike(const std::vector<CountedLoop>& others, std::size_t about) const
    {
        constexpr double kAlike = 0.01; // share by which they may differ; a choice, not a measurement
        const Vec2 centre = centre_of(region_.points, region_.loops[about]);
        double first = 0;
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            if (l == about) continue;
            const double distance = (centre_of(region_.points, region_.loops[l]) - centre).norm();
            if (first == 0) first = distance;
            if (std::abs(distance - first) > kAlike * first) return 1;
        }
        const bool same = std::all_of(others.begin(), others.end(), [&](const CountedLoop& loop) {
            return std::abs(loop.wanted - others.front().wanted) <= kAlike * others.front().wanted;
        });
        return same && !others.empty() ? static_cast<int>(others.size()) : 1;
    }

    [[nodiscard]] std::optional<std::vector<int>> counts_of(const std::vector<CountedLoop>& loops) const
    {
        std::vector<int> counts(segments_.size(), 0);
        for (const CountedLoop& loop : loops) {
            for (const Run& run : loop.runs) counts[run.segment] += run.count;
        }
        return counts;
    }

    const PlanarRegion& region_;
    std::span<const int> segment_;
    std::span<const BoundarySegment> segments_;
    Range range_;
    bool few_;
    std::vector<int> own_; ///< sides that each segment has in the region
    bool is_part_ = false; ///< whether the region is a part of another, with axes
};

} // namespace

std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments)
{
    auto counts = CountSolver(region, segment, segments).run(true);
    if (!counts) return std::nullopt;
    return std::move(counts->sides);
}

std::optional<double> count_axes(MirrorPart& part, const std::function<double(const Vec2&)>& size, bool few)
{
    // Given sides between corners are segments of their own, for no corner may move.
    std::vector<int> segment(part.region.points.size());
    std::vector<BoundarySegment> segments;
    std::vector<std::size_t> of_axis(part.wanted.size());
    for (const auto& loop : part.region.loops) {
        for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
            const auto at = [&](std::size_t k) -> const Vec2& {
                return part.region.points[static_cast<std::size_t>(loop[k % n])];
            };
            const int axis = part.axis[static_cast<std::size_t>(loop[i])];
            const int last = part.axis[static_cast<std::size_t>(loop[(i + n - 1) % n])];
            const bool corner = paving::quads_in(
                                    paving::turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i))) != 2;
            if (i == 0 || axis != last || (axis < 0 && corner)) segments.push_back({0, 1, axis < 0});
            segment[static_cast<std::size_t>(loop[i])] = static_cast<int>(segments.size()) - 1;
            segments.back().wanted += 1;
            if (axis >= 0) of_axis[static_cast<std::size_t>(axis)] = segments.size() - 1;
        }
    }
    std::vector<int> sides;
    int given = 0;
    for (const BoundarySegment& s : segments) given += s.fixed ? static_cast<int>(s.wanted) : 0;
    for (std::size_t a = 0; a < of_axis.size(); ++a) {
        sides.push_back(static_cast<int>(segments[of_axis[a]].wanted));
        segments[of_axis[a]].wanted = part.wanted[a];
    }
    const auto counts = CountSolver::of_part(part.region, segment, segments, few);
    if (counts) {
        for (std::size_t a = 0; a < of_axis.size(); ++a) sides[a] = counts->sides[of_axis[a]];
    }
    // Quads alone take an even number of sides.
    if (std::accumulate(sides.begin(), sides.end(), given) % 2 != 0)
        ++*std::max_element(sides.begin(), sides.end());
    divide_axes(part, sides, size);
    if (!counts) return std::nullopt;
    return counts->cost;
}

} // namespace lacuna::quads
