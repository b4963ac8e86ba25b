// SPDX-License-Identifier: MIT
//
// positive_everywhere(): bisect a cell's coefficients until all coefficients of each part are positive, three
// coefficients at a time. Everything is inlined into its callers, to be compiled for their instruction set.
// Vectors are never passed by value, as the calling convention depends on the instruction set.
#include <lacuna/core/shared/constants.h>
#include <lacuna/quality/detail/cell_batch.h>
#include <lacuna/quality/detail/lanes.h>

#include <cmath>

namespace lacuna::quality {
namespace {

/// Three coefficients along u; the last is repeated, so that all four lanes can be tested.
using Row = double __attribute__((vector_size(32)));

/// The coefficients of a part of a cell: (a, b, c) is element a of row b + 3c.
struct Part {
    Row row[9];
};

/// Number of bisections left along u, v and w.
using CutsLeft = std::array<int, 3>;

LACUNA_INLINE void lower(Row& least, const Row& other) { least = other < least ? other : least; }

LACUNA_INLINE double least_of(const Row& row)
{
    Row least = row;
    lower(least, __builtin_shufflevector(least, least, 2, 3, 0, 1));
    return least[1] < least[0] ? least[1] : least[0];
}

LACUNA_INLINE Part part_of(const CoefficientsView& c)
{
    Part part;
    for (std::size_t r = 0; r < 9; ++r)
        part.row[r] = Row{c.at(3 * r), c.at(3 * r + 1), c.at(3 * r + 2), c.at(3 * r + 2)};
    return part;
}

LACUNA_INLINE bool all_positive(const Part& part)
{
    Row least = part.row[0];
    for (int r = 1; r < 9; ++r) lower(least, part.row[r]);
    return least_of(least) > 0;
}

/// The direction to bisect, among the directions with bisections left: the direction whose middle
/// coefficients contain the smallest value, because a bisection along it raises this value. -1 if no
/// bisection is left.
LACUNA_INLINE int best_cut(const Part& part, const CutsLeft& cuts_left)
{
    const Row* row = part.row;
    Row along_v = row[1], along_w = row[3];
    for (const int r : {4, 7}) lower(along_v, row[r]);
    for (const int r : {4, 5}) lower(along_w, row[r]);
    Row all = along_v;
    for (const int r : {0, 2, 3, 5, 6, 8}) lower(all, row[r]);
    const auto middle = [&](std::size_t d, double least) { return cuts_left[d] > 0 ? least : kInfinity; };
    const double u = middle(0, all[1]), v = middle(1, least_of(along_v)), w = middle(2, least_of(along_w));
    const double uv = v < u ? v : u;
    const int best = w < uv ? 2 : v < u ? 1 : 0;
    return (w < uv ? w : uv) < kInfinity ? best : -1;
}

/// Bisect across rows (de Casteljau). @param kStep  distance in rows between coefficients along the direction
/// of bisection. @return  the smallest Jacobian at the four corners that the halves share.
template <std::size_t kStep>
LACUNA_INLINE double split_rows(const Part& whole, Part& low, Part& high)
{
    constexpr std::size_t kOther = kStep == 1 ? 3 : 1;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t at = i * kOther;
        const Row& a = whole.row[at];
        const Row& b = whole.row[at + kStep];
        const Row& c = whole.row[at + 2 * kStep];
        const Row ab = 0.5 * (a + b), bc = 0.5 * (b + c), abc = 0.5 * (ab + bc);
        low.row[at] = a;
        low.row[at + kStep] = ab;
        low.row[at + 2 * kStep] = high.row[at] = abc;
        high.row[at + kStep] = bc;
        high.row[at + 2 * kStep] = c;
    }
    Row corners = high.row[0];
    lower(corners, high.row[2 * kOther]);
    return corners[2] < corners[0] ? corners[2] : corners[0];
}

/// Bisect along rows. @return  as for `split_rows()`.
LACUNA_INLINE double split_along(const Part& whole, Part& low, Part& high)
{
    for (int r = 0; r < 9; ++r) {
        const Row& row = whole.row[r];
        const Row once = 0.5 * (row + __builtin_shufflevector(row, row, 1, 2, 2, 2));
        const Row twice = 0.5 * (once + __builtin_shufflevector(once, once, 1, 1, 1, 1));
        const Row first = __builtin_shufflevector(once, once, 0, 0, 0, 0);
        const Row middle = __builtin_shufflevector(twice, twice, 0, 0, 0, 0);
        const Row begin = __builtin_shufflevector(row, first, 0, 5, 2, 3);
        const Row end = __builtin_shufflevector(once, row, 0, 1, 6, 7);
        low.row[r] = __builtin_shufflevector(begin, middle, 0, 1, 6, 7);
        high.row[r] = __builtin_shufflevector(middle, end, 0, 5, 6, 7);
    }
    Row corners = high.row[0];
    for (const int r : {2, 6, 8}) lower(corners, high.row[r]);
    return corners[0];
}

bool positive_half(const Part& part, const CutsLeft& cuts_left);

/// Depth-first bisection, each time along the most effective direction. A bisection never lowers the smallest
/// coefficient (convex hull property). So this proves every part that a subdivision into eight parts, to the
/// same depth, would prove. One half is bisected by recursion, the other in the loop.
/// @pre  `given` is positive at its corners, and finite
LACUNA_INLINE bool positive_parts(const Part& given, CutsLeft cuts_left)
{
    Part halves[2][2]; // of this cut and the one before
    const Part* whole = &given;
    for (std::size_t now = 0;; now = 1 - now) {
        const int direction = best_cut(*whole, cuts_left);
        if (direction < 0) return false;
        --cuts_left[static_cast<std::size_t>(direction)];
        Part &low = halves[now][0], &high = halves[now][1];
        const double least_cut = direction == 0   ? split_along(*whole, low, high)
                                 : direction == 1 ? split_rows<1>(*whole, low, high)
                                                  : split_rows<3>(*whole, low, high);
        if (!(least_cut > 0)) return false;
        const bool low_done = all_positive(low), high_done = all_positive(high);
        if (low_done && high_done) return true;
        if (!low_done && !high_done && !positive_half(low, cuts_left)) return false;
        whole = high_done ? &low : &high;
    }
}

bool positive_half(const Part& part, const CutsLeft& cuts_left)
{
    return with_avx2([&]() LACUNA_INLINE_BODY { return positive_parts(part, cuts_left); });
}

/// Whether all coefficients are finite: x - x is NaN otherwise.
LACUNA_INLINE bool all_finite(const Part& part)
{
    Row off = part.row[0] - part.row[0];
    for (int r = 1; r < 9; ++r) off += part.row[r] - part.row[r];
    return off[0] + off[1] + off[2] == 0;
}

LACUNA_INLINE double least_corner(const Part& part)
{
    Row least = part.row[0];
    for (const int r : {2, 6, 8}) lower(least, part.row[r]);
    return least[2] < least[0] ? least[2] : least[0];
}

LACUNA_INLINE bool positive_whole(const CoefficientsView& bezier, int max_depth)
{
    const Part whole = part_of(bezier);
    if (!all_finite(whole)) return false;
    if (all_positive(whole)) return true;
    return least_corner(whole) > 0 && positive_half(whole, {max_depth, max_depth, max_depth});
}

using Values = CellValues<kLanes>;

/// The same coefficient of four cells.
LACUNA_INLINE const Row& four_of(const double (&lanes)[kLanes], int first)
{
    return *reinterpret_cast<const Row*>(lanes + first);
}

/// Four cells bisected along the same direction.
struct FourCut {
    Row least;  ///< smallest coefficient of the two halves
    Row middle; ///< J at the middle of the edges that are bisected, times 4
};

/// @param kAlong  stride of coefficients along the bisection; `kRow` and `kNextRow` across it.
template <int kAlong, int kRow, int kNextRow>
LACUNA_INLINE void cut_four(const Values& values, int first, FourCut& cut)
{
    cut.least = four_of(values.bezier[0], first);
    cut.middle = Row{} + kInfinity;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int at = i * kRow + j * kNextRow;
            const Row& a = four_of(values.bezier[at], first);
            const Row& b = four_of(values.bezier[at + kAlong], first);
            const Row& c = four_of(values.bezier[at + 2 * kAlong], first);
            const Row ab = a + b, bc = b + c;
            for (const Row* one : {&a, &ab, &bc, &c}) lower(cut.least, *one);
            if (i != 1 && j != 1) lower(cut.middle, ab + bc);
        }
    }
}

LACUNA_INLINE void find_signs(const Values& values, int first, Sign* sign)
{
    FourCut along[3];
    cut_four<1, 3, 9>(values, first, along[0]);
    cut_four<3, 1, 9>(values, first, along[1]);
    cut_four<9, 1, 3>(values, first, along[2]);
    for (int i = 0; i < 4; ++i) {
        // If a value is not finite, the sum is not finite.
        const bool finite = std::isfinite(values.volume[first + i]);
        const bool positive = along[0].least[i] > 0 || along[1].least[i] > 0 || along[2].least[i] > 0;
        const bool crossed = !(along[0].middle[i] > 0 && along[1].middle[i] > 0 && along[2].middle[i] > 0);
        if (finite && (positive || crossed)) sign[i] = positive ? Sign::positive : Sign::not_positive;
    }
}

LACUNA_INLINE void find_signs(const Values& values, std::array<Sign, kLanes>& sign)
{
    for (int first = 0; first < kLanes; first += 4)
        if (!(least_of(four_of(values.smallest, first)) > 0)) find_signs(values, first, &sign[index(first)]);
}

} // namespace

bool positive_everywhere(const CoefficientsView& bezier, int max_depth)
{
    return with_avx2([&]() LACUNA_INLINE_BODY { return positive_whole(bezier, max_depth); });
}

std::array<Sign, kLanes> signs_after_cut(const CellValues<kLanes>& values)
{
    std::array<Sign, kLanes> sign{}; // all undecided
    with_avx2([&]() LACUNA_INLINE_BODY { find_signs(values, sign); });
    return sign;
}

} // namespace lacuna::quality
