// SPDX-License-Identifier: MIT
#include <lacuna/surface/clean_quads.h>

#include <lacuna/surface/marks.h>
#include <lacuna/surface/measure_plane.h>
#include <lacuna/surface/patch_patterns.h>
#include <lacuna/surface/quad_net.h>
#include <lacuna/surface/smooth_plane.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_set>

namespace lacuna::surface {

namespace {

constexpr double kRight = std::numbers::pi / 2;
/// Right angles that a boundary point may have more or less than quads.
constexpr double kFits = 0.65;
/// Points that are looked at for irregular ones to grow a patch to.
constexpr std::size_t kLookedAt = 900;
/// Layers of quads around a patch that are smoothed with it.
constexpr int kRings = 2;
/// What a patch may lose in scaled Jacobian, summed over its quads, for each irregular point it sheds.
constexpr double kLossForgiven = 0.15;

/// How much is tried before a patch is given up.
struct Care {
    std::size_t growths;  ///< irregular points a patch is grown to
    std::size_t largest;  ///< patch, in quads
    std::size_t fillings; ///< of each patch
    int sweeps;           ///< over a filling, before it is judged the first time
    double hopeless;      ///< given up then where the loss is so many times what is allowed
};
/// Small patches, where most is won for little; then larger ones, and while the budget lasts more thorough.
constexpr std::array<Care, 3> kCares{{{3, 60, 2, 1, 1.8}, {12, 100'000, 2, 1, 1.8}, {12, 100'000, 4, 2, 3}}};
/// Quads that may be smoothed for trial however small the mesh.
constexpr long kLeastBudget = 50'000;

/// Loss of a quad for its area being off by a factor e from the one asked.
constexpr double kSizeLoss = 0.1;

/// Quads with one outline.
struct Patch {
    std::vector<Index> quads;
    std::vector<Index> touched;       ///< points, in order of coming
    std::vector<Index> loop;          ///< points round it, the patch on the left
    std::vector<std::size_t> corners; ///< places in the loop
    int irregular = 0;                ///< points inside, and on the mesh's boundary, that a filling changes
};

enum class Outline { fine, unfinished, hopeless };

/// How far from good quads are, in sum.
class Loss {
public:
    explicit Loss(const CleanOptions& options) : options_(options) {}

    double least = 1; ///< scaled Jacobian
    double sum = 0;

    void add(std::span<const Vec2> points, const Quad& quad)
    {
        const double jacobian = scaled_jacobian(points, quad);
        least = std::min(least, jacobian);
        sum += 1 - jacobian;
        if (!options_.size) return;
        const auto at = [&](std::size_t k) -> const Vec2& {
            return points[static_cast<std::size_t>(quad[k])];
        };
        const Vec2 u = at(2) - at(0), v = at(3) - at(1);
        const double size = options_.size((at(0) + at(1) + at(2) + at(3)) / 4);
        const double ratio = (u.x() * v.y() - u.y() * v.x()) / (2 * size * size);
        const double off = ratio > 0 ? std::log(ratio) : kFarOff;
        sum += kSizeLoss * off * off;
    }

private:
    static constexpr double kFarOff = 10;
    const CleanOptions& options_;
};

class Cleaner {
public:
    Cleaner(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options)
        : points_(mesh.points), options_(options), net_(mesh.points.size(), mesh.quads), fixed_(fixed)
    {
        wanted_.assign(points_.size(), 4);
        due_.assign(points_.size(), 1);
        for (Index p = 0; p < static_cast<Index>(points_.size()); ++p) {
            if (net_.is_used(p) && net_.on_boundary(p))
                wanted_[static_cast<std::size_t>(p)] = right_angles(p);
        }
        version_.assign(mesh.quads.size(), 0);
        budget_ = kLeastBudget + static_cast<long>(options.effort * static_cast<double>(mesh.quads.size()));
    }

    /// Does every point have its quads in one fan, and lie no point on the boundary but the first ones?
    [[nodiscard]] bool is_sound() const
    {
        std::vector<int> fans(points_.size(), 0);
        for (Index q = 0; q < static_cast<Index>(net_.quad_slots()); ++q) {
            for (const Index p : net_.quad(q)) ++fans[static_cast<std::size_t>(p)];
        }
        for (Index p = 0; p < static_cast<Index>(points_.size()); ++p) {
            if (!net_.is_used(p)) continue;
            if (net_.valence(p) != fans[static_cast<std::size_t>(p)]) return false;
            if (static_cast<std::size_t>(p) >= fixed_ && net_.on_boundary(p)) return false;
        }
        return true;
    }

    [[nodiscard]] std::size_t irregular() const
    {
        std::size_t count = 0;
        for (Index p = 0; p < static_cast<Index>(points_.size()); ++p) {
            if (net_.is_used(p) && !net_.on_boundary(p) && net_.valence(p) != 4) ++count;
        }
        return count;
    }

    std::size_t remove_doublets();
    /// Look at everything again, with so much care.
    void begin(const Care& care)
    {
        care_ = care;
        due_.assign(points_.size(), 1);
        tried_.clear();
    }
    /// @return patches filled anew
    std::size_t pass(CleanReport& report, const RunContext& context);
    void finish(PlanarQuads& mesh) const;

private:
    [[nodiscard]] int right_angles(Index p) const;
    [[nodiscard]] const Vec2& at(Index p) const { return points_[static_cast<std::size_t>(p)]; }
    [[nodiscard]] bool is_irregular(Index p) const
    {
        return net_.is_used(p) && net_.valence(p) != wanted_[static_cast<std::size_t>(p)];
    }
    bool mend(Index seed, CleanReport& report);
    void look_for_others(Index seed);
    void add_star(Patch& patch, Index p);
    bool close(Patch& patch);
    Outline find_outline(Patch& patch);
    bool fill(const Patch& patch, CleanReport& report);
    bool try_filling(const Patch& patch, const Filling& filling, const std::vector<Index>& around);
    std::vector<Index> rings(const Patch& patch);

    std::vector<Vec2> points_;
    const CleanOptions& options_;
    QuadNet net_;
    std::size_t fixed_;
    std::vector<int> wanted_; ///< quads at each point
    std::vector<char> due_;   ///< points to be looked at, if irregular
    Care care_ = kCares[0];
    long budget_ = 0;
    std::vector<std::uint32_t> version_;      ///< of each quad, as its number is given again
    std::unordered_set<std::uint64_t> tried_; ///< patches that were filled for trial
    // Of the patch at hand.
    Marks in_patch_, seen_;
    Numbers count_, number_, parent_, next_;
    std::vector<Index> seen_points_; ///< near the seed
    std::vector<Index> others_;      ///< irregular points near the seed, the nearest first
};

int Cleaner::right_angles(Index p) const
{
    Vec2 first(0, 0), last(0, 0);
    bool any = false;
    net_.for_sides(p, [&](Index side) {
        if (!any) first = at(net_.to(side)) - at(p);
        any = true;
        last = at(net_.from(QuadNet::before(side))) - at(p);
    });
    double angle = std::atan2(first.x() * last.y() - first.y() * last.x(), first.dot(last));
    if (angle <= 0) angle += 2 * std::numbers::pi;
    // Half way between two numbers either will do: the one that is there.
    const double fit = angle / kRight;
    const int valence = net_.valence(p);
    return std::abs(fit - valence) < kFits ? valence : std::max(1, static_cast<int>(std::lround(fit)));
}

std::size_t Cleaner::remove_doublets()
{
    std::size_t removed = 0;
    std::vector<Index> left;
    for (std::size_t p = fixed_; p < points_.size(); ++p) left.push_back(static_cast<Index>(p));
    while (!left.empty()) {
        const Index p = left.back();
        left.pop_back();
        if (!net_.is_used(p) || net_.on_boundary(p) || net_.valence(p) != 2) continue;
        std::vector<Index> sides;
        net_.for_sides(p, [&](Index side) { sides.push_back(side); });
        const Index a = net_.to(sides[0]), b = net_.to(QuadNet::after(sides[0]));
        const Index c = net_.to(sides[1]), d = net_.to(QuadNet::after(sides[1]));
        if (b == d) continue;
        const std::array<Index, 2> old{sides[0] / 4, sides[1] / 4};
        const std::array<Quad, 1> merged{{{a, b, c, d}}};
        net_.replace(old, merged);
        ++removed;
        for (const Index q : {a, c}) {
            if (static_cast<std::size_t>(q) >= fixed_) left.push_back(q);
        }
    }
    return removed;
}

/// Irregular points near the seed in `others_`, with the way back in `parent_`.
void Cleaner::look_for_others(Index seed)
{
    others_.clear();
    parent_.clear(points_.size());
    parent_[seed] = -1;
    std::vector<Index>& queue = seen_points_;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size() && queue.size() < kLookedAt && others_.size() < care_.growths;
         ++i) {
        const Index here = queue[i];
        net_.for_sides(here, [&](Index side) {
            for (const Index p : {net_.to(side), net_.from(QuadNet::before(side))}) {
                if (parent_.has(p)) continue;
                parent_[p] = here;
                queue.push_back(p);
                if (is_irregular(p)) others_.push_back(p);
            }
        });
    }
}

void Cleaner::add_star(Patch& patch, Index p)
{
    net_.for_sides(p, [&](Index side) {
        if (!in_patch_.add(side / 4)) return;
        patch.quads.push_back(side / 4);
        for (const Index q : net_.quad(side / 4)) {
            if (!count_.has(q)) patch.touched.push_back(q);
            ++count_[q];
        }
    });
}

/// Add quads until no point of the outline is concave. @return false where it grows too large
bool Cleaner::close(Patch& patch)
{
    for (bool more = true; more;) {
        more = false;
        for (std::size_t i = 0; i < patch.touched.size(); ++i) {
            const Index p = patch.touched[i];
            const int inside = count_[p], valence = net_.valence(p);
            if (inside == valence || inside < 2) continue;
            if (inside == 2) continue;
            add_star(patch, p);
            more = true;
            if (patch.quads.size() >
                std::min(care_.largest, static_cast<std::size_t>(options_.largest_patch)))
                return false;
        }
    }
    return true;
}

Outline Cleaner::find_outline(Patch& patch)
{
    next_.clear(points_.size());
    Index start = -1;
    std::size_t sides = 0;
    for (const Index q : patch.quads) {
        for (Index side = 4 * q; side < 4 * q + 4; ++side) {
            const Index other = net_.opposite(side);
            if (other >= 0 && in_patch_.has(other / 4)) continue;
            const Index from = net_.from(side);
            if (next_.has(from)) { // pinched
                add_star(patch, from);
                return net_.on_boundary(from) ? Outline::hopeless : Outline::unfinished;
            }
            next_[from] = net_.to(side);
            start = from;
            ++sides;
        }
    }
    patch.loop.clear();
    patch.corners.clear();
    patch.irregular = 0;
    if (start < 0) return Outline::hopeless;
    Index p = start;
    do {
        const int valence = net_.valence(p), inside = count_[p];
        const int wanted = wanted_[static_cast<std::size_t>(p)];
        // On the mesh's boundary a filling may put right how many quads there are.
        const bool whole = inside == valence;
        const int corner = whole ? wanted : inside;
        if (corner > 2) return Outline::hopeless;
        if (corner == 1) patch.corners.push_back(patch.loop.size());
        if (whole && valence != wanted) ++patch.irregular;
        patch.loop.push_back(p);
        p = next_[p];
    } while (p != start && patch.loop.size() <= sides);
    if (patch.loop.size() != sides) return Outline::hopeless; // a hole in it
    for (const Index q : patch.touched) {
        if (!next_.has(q) && net_.valence(q) != 4) ++patch.irregular;
    }
    return Outline::fine;
}

/// Quads around a patch.
std::vector<Index> Cleaner::rings(const Patch& patch)
{
    std::vector<Index> around, front = patch.loop;
    seen_.clear(net_.quad_slots());
    for (int ring = 0; ring < kRings; ++ring) {
        const std::size_t first = around.size();
        for (const Index p : front) {
            net_.for_sides(p, [&](Index side) {
                if (!in_patch_.has(side / 4) && seen_.add(side / 4)) around.push_back(side / 4);
            });
        }
        front.clear();
        for (std::size_t i = first; i < around.size(); ++i) {
            for (const Index p : net_.quad(around[i])) front.push_back(p);
        }
    }
    return around;
}

/// Smooth the filling with what is around it, and keep it where it is good.
bool Cleaner::try_filling(const Patch& patch, const Filling& filling, const std::vector<Index>& around)
{
    Loss before(options_);
    for (const auto* quads : {&patch.quads, &around}) {
        for (const Index q : *quads) before.add(points_, net_.quad(q));
    }
    // Points that stay come first: those on the boundary and those with quads further out.
    seen_.clear(net_.quad_slots());
    for (const Index q : around) seen_.add(q);
    number_.clear(points_.size());
    std::vector<Index> staying, moving;
    const auto sort_in = [&](Index p) {
        if (number_.has(p)) return;
        number_[p] = -1;
        bool stays = net_.on_boundary(p);
        net_.for_sides(p, [&](Index side) {
            if (!in_patch_.has(side / 4) && !seen_.has(side / 4)) stays = true;
        });
        (stays ? staying : moving).push_back(p);
    };
    for (const Index p : patch.loop) sort_in(p);
    for (const Index q : around) {
        for (const Index p : net_.quad(q)) sort_in(p);
    }
    std::vector<Vec2> local;
    for (const auto* list : {&staying, &moving}) {
        for (const Index p : *list) {
            number_[p] = static_cast<Index>(local.size());
            local.push_back(at(p));
        }
    }
    const auto inner = static_cast<Index>(local.size());
    const auto rim = static_cast<Index>(patch.loop.size());
    local.insert(local.end(), filling.inner.begin(), filling.inner.end());
    std::vector<Quad> quads;
    for (Quad quad : filling.quads) {
        for (Index& p : quad)
            p = p < rim ? number_[patch.loop[static_cast<std::size_t>(p)]] : inner + p - rim;
        quads.push_back(quad);
    }
    for (const Index q : around) {
        Quad quad = net_.quad(q);
        for (Index& p : quad) p = number_[p];
        quads.push_back(quad);
    }
    budget_ -= static_cast<long>(quads.size());
    SmoothPlaneOptions smoothing;
    smoothing.size = options_.size;
    smoothing.untangle = false;
    smoothing.still = static_cast<std::size_t>(inner);
    const double allowed = before.sum + kLossForgiven * (patch.irregular - filling.irregular);
    for (const bool at_last : {false, true}) {
        smoothing.sweeps = at_last ? 6 : care_.sweeps;
        smoothing.repairs = at_last ? 4 : 0;
        smooth_plane(local, quads, staying.size(), smoothing);
        smoothing.still = 0;
        Loss after(options_);
        for (const Quad& quad : quads) after.add(local, quad);
        // What is far from good at first is not good later.
        if (!at_last && after.sum > care_.hopeless * allowed) return false;
        if (!at_last) continue;
        if (!(after.least > 0) || after.least < std::min(before.least, options_.least)) return false;
        if (after.sum > allowed) return false;
    }

    for (const Index p : moving)
        points_[static_cast<std::size_t>(p)] = local[static_cast<std::size_t>(number_[p])];
    std::vector<Index> made;
    for (std::size_t i = 0; i < filling.inner.size(); ++i) {
        made.push_back(net_.add_point());
        points_.push_back(local[static_cast<std::size_t>(inner) + i]);
        wanted_.push_back(4);
        due_.push_back(1);
    }
    std::vector<Quad> added = filling.quads;
    for (Quad& quad : added) {
        for (Index& p : quad)
            p = p < rim ? patch.loop[static_cast<std::size_t>(p)] : made[static_cast<std::size_t>(p - rim)];
    }
    for (const Index q : net_.replace(patch.quads, added)) {
        version_.resize(net_.quad_slots(), 0);
        ++version_[static_cast<std::size_t>(q)];
    }
    return true;
}

bool Cleaner::fill(const Patch& patch, CleanReport& report)
{
    if (fewest_irregular(patch.loop.size(), patch.corners) >= patch.irregular) return false;
    std::uint64_t key = 0;
    for (const Index q : patch.quads)
        key += mixed((static_cast<std::uint64_t>(q) << 32) + version_[static_cast<std::size_t>(q)] + 1);
    if (!tried_.insert(key).second) return false;
    std::vector<Vec2> loop;
    for (const Index p : patch.loop) loop.push_back(at(p));
    std::vector<Index> around;
    for (const Filling& filling : fillings(loop, patch.corners, care_.fillings)) {
        if (filling.irregular >= patch.irregular) continue;
        if (around.empty()) around = rings(patch);
        ++report.tried;
        if (try_filling(patch, filling, around)) {
            ++report.patches;
            return true;
        }
    }
    return false;
}

/// Grow a patch from an irregular point to the next, and the next, until a filling is better.
bool Cleaner::mend(Index seed, CleanReport& report)
{
    look_for_others(seed);
    Patch patch;
    in_patch_.clear(net_.quad_slots());
    count_.clear(points_.size());
    add_star(patch, seed);
    for (std::size_t growth = 0; growth <= others_.size(); ++growth) {
        if (growth > 0) {
            const Index other = others_[growth - 1];
            if (count_.has(other) && count_[other] == net_.valence(other)) continue;
            for (Index p = other; p >= 0; p = parent_[p]) add_star(patch, p);
        }
        Outline outline = Outline::unfinished;
        while (outline == Outline::unfinished) {
            if (!close(patch)) return false;
            outline = find_outline(patch);
        }
        if (outline == Outline::fine && fill(patch, report)) return true;
        if (budget_ < 0) return false;
    }
    return false;
}

std::size_t Cleaner::pass(CleanReport& report, const RunContext& context)
{
    std::size_t mended = 0;
    for (Index p = 0; p < static_cast<Index>(points_.size()) && budget_ >= 0; ++p) {
        if (due_[static_cast<std::size_t>(p)] == 0 || !is_irregular(p)) continue;
        check_cancelled(context);
        due_[static_cast<std::size_t>(p)] = 0;
        if (!mend(p, report)) continue;
        ++mended;
        // What was looked at has changed for those who looked at it in vain.
        for (const Index q : seen_points_) due_[static_cast<std::size_t>(q)] = 1;
    }
    return mended;
}

void Cleaner::finish(PlanarQuads& mesh) const
{
    std::vector<Index> number(points_.size(), -1);
    mesh.points.clear();
    for (std::size_t p = 0; p < points_.size(); ++p) {
        if (p >= fixed_ && !net_.is_used(static_cast<Index>(p))) continue;
        number[p] = static_cast<Index>(mesh.points.size());
        mesh.points.push_back(points_[p]);
    }
    mesh.quads.clear();
    for (Index q = 0; q < static_cast<Index>(net_.quad_slots()); ++q) {
        if (!net_.is_live(q)) continue;
        Quad quad = net_.quad(q);
        for (Index& p : quad) p = number[static_cast<std::size_t>(p)];
        mesh.quads.push_back(quad);
    }
}

} // namespace

CleanReport clean_quads(PlanarQuads& mesh, std::size_t fixed, const CleanOptions& options,
                        const RunContext& context)
{
    CleanReport report;
    Cleaner cleaner(mesh, fixed, options);
    if (!cleaner.is_sound()) return report;
    report.irregular_before = cleaner.irregular();
    report.doublets = cleaner.remove_doublets();
    for (const Care& care : kCares) {
        cleaner.begin(care);
        for (int pass = 0; pass < options.passes; ++pass) {
            if (cleaner.pass(report, context) == 0) break;
        }
    }
    report.irregular_after = cleaner.irregular();
    cleaner.finish(mesh);
    return report;
}

} // namespace lacuna::surface
