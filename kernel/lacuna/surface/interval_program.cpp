// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/interval_program.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace lacuna::surface {

namespace {

/// Maximum number of free variables for which pairs of vectors are tried. A board of 32 × 32 mapped faces has
/// 64. With a larger value, numbers of lower cost are found, which takes longer. Heuristic.
constexpr std::size_t kByTwos = 64;
/// Additional cost of sides whose length is outside the accepted range. It is multiplied by the wanted number
/// of sides and by the relative excess. Heuristic.
constexpr double kOutOfSize = 2;
/// Maximum coefficient of an equation, so that products stay within the integer range. An equation that would
/// get a larger coefficient is left out; interval assignment does not produce such equations.
constexpr std::int64_t kMostCoefficient = 1 << 20;

double wish_cost(double n, double wanted, double weight)
{
    n = std::max(n, 0.5);
    // The excess of a length out of range, relative to the end of the range, times the wanted number.
    const double out = std::max(
        {0.0, quads::kShortestOfSize * n - wanted, wanted * (wanted / n / quads::kLongestOfSize - 1)});
    return weight * ((n - wanted) * (n - wanted) / n + kOutOfSize * out);
}

/// Equations with common variables, renumbered, in reduced row echelon form.
class IntervalSet {
public:
    IntervalSet(const IntervalProgram& program, std::vector<std::size_t> own)
        : program_(program), own_(std::move(own)), terms_of_(own_.size())
    {
        for (std::size_t i = 0; i < own_.size(); ++i) local_[own_[i]] = i;
    }

    /// One step of Gauss-Jordan elimination in integers. A row that contradicts earlier rows is left out.
    void add(const IntervalEquation& equation)
    {
        Row row;
        const auto add_side = [&](const std::vector<std::size_t>& side, int sign) {
            for (const std::size_t v : side) {
                if (program_.variables[v].fixed)
                    row.right -= sign * program_.variables[v].given;
                else
                    row.of[local_.at(v)] += sign;
            }
        };
        add_side(equation.one, 1);
        add_side(equation.other, -1);
        for (const Row& by : rows_) eliminate(row, by);
        std::erase_if(row.of, [](const auto& part) { return part.second == 0; });
        if (row.of.empty() || row.right % common_factor(row) != 0) return;
        // Choose the variable with the smallest coefficient as pivot (of equal ones, the first). With a
        // coefficient of one, the pivot is an integer for any integer values of the other variables.
        const auto pivot = std::ranges::min_element(row.of, {},
                                                    [](const auto& part) { return std::abs(part.second); });
        row.pivot = pivot->first;
        scale(row, pivot->second < 0 ? -common_factor(row) : common_factor(row));
        for (Row& other : rows_) eliminate(other, row);
        std::erase_if(rows_, [](const Row& other) { return other.of.empty(); });
        rows_.push_back(std::move(row));
    }

    /// Add a term of the objective for the sum of some variables. With weight zero, the term is a floor: the
    /// sum must be at least `wanted`.
    void add_term(const std::vector<std::size_t>& variables, double wanted, double weight)
    {
        Term term{{}, 0, wanted, weight};
        for (const std::size_t v : variables) {
            if (program_.variables[v].fixed)
                term.given += program_.variables[v].given;
            else
                ++term.variables[local_.at(v)];
        }
        for (const auto& [v, times] : term.variables) terms_of_[v].push_back({terms_.size(), times});
        terms_.push_back(std::move(term));
    }

    /// Run the local search from the rounded wishes, and store the resulting values of the set's variables.
    /// @return  false if there is no integer start or coefficients leave the range, or if the result violates
    ///          a floor or the lower bound of a variable
    bool solve(std::vector<int>& counts)
    {
        rows_of_.resize(own_.size());
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            for (const auto& [v, times] : rows_[r].of) rows_of_[v].push_back(r);
        }
        if (!find_vectors() || !start()) return false;
        for (const Term& term : terms_) sums_.push_back(sum_of(term));
        cost_ = whole_cost();
        while (step()) {}
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (count_[i] < variable(i).least) return false;
        }
        for (std::size_t t = 0; t < terms_.size(); ++t) {
            if (terms_[t].weight == 0 && static_cast<double>(sums_[t]) < terms_[t].wanted) return false;
        }
        for (std::size_t i = 0; i < own_.size(); ++i) counts[own_[i]] = static_cast<int>(count_[i]);
        return true;
    }

private:
    /// Σ coefficient · variable = right.
    struct Row {
        std::map<std::size_t, std::int64_t> of;
        std::int64_t right = 0;
        std::size_t pivot = 0; ///< variable that occurs in no other row; its coefficient is positive
    };

    struct Term {
        std::map<std::size_t, int> variables;
        std::int64_t given = 0; ///< sum of the terms of fixed variables
        double wanted = 1, weight = 1;
    };

    [[nodiscard]] const IntervalVariable& variable(std::size_t i) const
    {
        return program_.variables[own_[i]];
    }

    static std::int64_t common_factor(const Row& row)
    {
        std::int64_t common = 0;
        for (const auto& [v, times] : row.of) common = std::gcd(common, times);
        return common;
    }

    static void scale(Row& row, std::int64_t by)
    {
        for (auto& [v, times] : row.of) times /= by;
        row.right /= by;
    }

    /// Eliminate the pivot of row `by` from row `row`. If coefficients of `row` leave the range, it becomes
    /// empty.
    static void eliminate(Row& row, const Row& by)
    {
        const auto found = row.of.find(by.pivot);
        if (found == row.of.end()) return;
        const std::int64_t a = found->second, b = by.of.at(by.pivot), g = std::gcd(a, b);
        for (auto& [v, times] : row.of) times *= b / g;
        row.right = row.right * (b / g) - by.right * (a / g);
        for (const auto& [v, times] : by.of) row.of[v] -= times * (a / g);
        std::erase_if(row.of, [](const auto& part) { return part.second == 0; });
        const std::int64_t common = std::gcd(common_factor(row), row.right);
        if (common > 1) scale(row, common);
        const bool in_range = std::abs(row.right) < kMostCoefficient * kMostCoefficient &&
                              std::ranges::all_of(row.of, [](const auto& part) {
                                  return std::abs(part.second) < kMostCoefficient;
                              });
        if (!in_range) row = {};
    }

    [[nodiscard]] bool is_pivot(std::size_t v) const
    {
        return !rows_of_[v].empty() && rows_[rows_of_[v].front()].pivot == v;
    }

    [[nodiscard]] std::int64_t rounded_wish(std::size_t v) const
    {
        double wanted = 0, weight = 0;
        for (const auto& [t, times] : terms_of_[v]) {
            if (terms_[t].variables.size() > 1 || terms_[t].weight == 0) continue;
            wanted += terms_[t].weight * terms_[t].wanted;
            weight += terms_[t].weight;
        }
        return std::max<std::int64_t>(variable(v).least, weight > 0 ? std::llround(wanted / weight) : 1);
    }

    /// The right-hand side of a row minus the terms of its free variables. It is equal to the value of the
    /// pivot times the pivot's coefficient.
    [[nodiscard]] std::int64_t rest_of(const Row& row) const
    {
        std::int64_t sum = row.right;
        for (const auto& [v, times] : row.of) sum -= v == row.pivot ? 0 : times * count_[v];
        return sum;
    }

    [[nodiscard]] bool is_whole(const Row& row) const { return rest_of(row) % row.of.at(row.pivot) == 0; }

    /// Increase a free variable of a row until the pivots of this row and of all earlier rows are integers.
    /// @return  whether this was possible
    bool make_whole(std::size_t r)
    {
        return is_whole(rows_[r]) || std::ranges::any_of(rows_[r].of, [&](const auto& part) {
                   const std::size_t v = part.first;
                   const std::int64_t before = count_[v];
                   const auto stays = [&](std::size_t q) { return q > r || is_whole(rows_[q]); };
                   for (std::int64_t by = 1; v != rows_[r].pivot && by < rows_[r].of.at(rows_[r].pivot);
                        ++by) {
                       count_[v] = before + by;
                       if (std::ranges::all_of(rows_of_[v], stays)) return true;
                   }
                   count_[v] = before;
                   return false;
               });
    }

    /// Set the start of the local search. Free variables get their rounded wishes, increased where this is
    /// needed to make the pivots integers; then the pivots are computed.
    bool start()
    {
        for (std::size_t v = 0; v < own_.size(); ++v) count_.push_back(is_pivot(v) ? 0 : rounded_wish(v));
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            if (!make_whole(r)) return false;
        }
        for (const Row& row : rows_) count_[row.pivot] = rest_of(row) / row.of.at(row.pivot);
        return true;
    }

    [[nodiscard]] double whole_cost() const
    {
        double cost = 0;
        for (std::size_t v = 0; v < own_.size(); ++v) cost += below(v, count_[v]);
        for (std::size_t t = 0; t < terms_.size(); ++t) cost += term_cost(terms_[t], sums_[t]);
        return cost;
    }

    /// Find the vectors along which the local search moves.
    bool find_vectors()
    {
        for (std::size_t v = 0; v < own_.size(); ++v) {
            if (is_pivot(v)) continue;
            std::int64_t stride = 1;
            const std::vector<std::size_t>& rows = rows_of_[v];
            for (const std::size_t r : rows) {
                const std::int64_t p = rows_[r].of.at(rows_[r].pivot);
                stride = std::lcm(stride, p / std::gcd(p, rows_[r].of.at(v)));
            }
            if (stride >= kMostCoefficient) return false;
            std::vector<std::pair<std::size_t, std::int64_t>> vector{{v, stride}};
            for (const std::size_t r : rows) {
                const Row& row = rows_[r];
                vector.push_back({row.pivot, -row.of.at(v) * stride / row.of.at(row.pivot)});
            }
            vectors_.push_back(std::move(vector));
        }
        if (vectors_.size() <= kByTwos) add_pairs();
        return true;
    }

    /// For each two vectors with a common variable, add their sum and their difference to the vectors.
    void add_pairs()
    {
        const std::size_t alone = vectors_.size();
        for (std::size_t a = 0; a < alone; ++a) {
            for (std::size_t b = a + 1; b < alone; ++b) {
                for (const int sign : {1, -1}) {
                    std::map<std::size_t, std::int64_t> sum(vectors_[a].begin(), vectors_[a].end());
                    for (const auto& [v, by] : vectors_[b]) sum[v] += sign * by;
                    std::erase_if(sum, [](const auto& part) { return part.second == 0; });
                    if (sum.size() < vectors_[a].size() + vectors_[b].size())
                        vectors_.emplace_back(sum.begin(), sum.end());
                }
            }
        }
    }

    [[nodiscard]] std::int64_t sum_of(const Term& term) const
    {
        std::int64_t sum = term.given;
        for (const auto& [v, times] : term.variables) sum += times * count_[v];
        return sum;
    }

    static double term_cost(const Term& term, std::int64_t sum)
    {
        const auto n = static_cast<double>(sum);
        if (term.weight == 0) return kDecides * std::max(0.0, term.wanted - n);
        return wish_cost(n, term.wanted, term.weight);
    }

    [[nodiscard]] double below(std::size_t v, std::int64_t count) const
    {
        return kDecides * static_cast<double>(std::max<std::int64_t>(0, variable(v).least - count));
    }

    /// Change of the objective if the variables move along a vector `times` times.
    double change(const std::vector<std::pair<std::size_t, std::int64_t>>& vector, std::int64_t times)
    {
        touched_.clear();
        double cost = 0;
        for (const auto& [v, by] : vector) {
            cost += below(v, count_[v] + times * by) - below(v, count_[v]);
            for (const auto& [t, often] : terms_of_[v]) touched_.push_back({t, often * times * by});
        }
        std::ranges::sort(touched_);
        for (std::size_t i = 0; i < touched_.size();) {
            std::int64_t by = 0;
            const std::size_t t = touched_[i].first;
            for (; i < touched_.size() && touched_[i].first == t; ++i) by += touched_[i].second;
            cost += term_cost(terms_[t], sums_[t] + by) - term_cost(terms_[t], sums_[t]);
        }
        return cost;
    }

    /// Take the step with the largest gain. @return  false if no step has a gain
    bool step()
    {
        double best = -kRoundoff * (1 + std::abs(cost_));
        const std::vector<std::pair<std::size_t, std::int64_t>>* along = nullptr;
        std::int64_t times = 0;
        for (const auto& vector : vectors_) {
            for (const int sign : {1, -1}) {
                double last = 0;
                for (std::int64_t size = 1;; size *= 2) { // ends, because costs grow with every number
                    const double cost = change(vector, sign * size);
                    if (cost < best) {
                        best = cost;
                        along = &vector;
                        times = sign * size;
                    }
                    if (cost >= last) break;
                    last = cost;
                }
            }
        }
        if (along == nullptr) return false;
        for (const auto& [v, by] : *along) {
            count_[v] += times * by;
            for (const auto& [t, often] : terms_of_[v]) sums_[t] += often * times * by;
        }
        cost_ += best;
        return true;
    }

    const IntervalProgram& program_;
    std::vector<std::size_t> own_; ///< numbers of the variables in the program
    std::map<std::size_t, std::size_t> local_;
    std::vector<Row> rows_;
    std::vector<Term> terms_;
    std::vector<std::vector<std::pair<std::size_t, int>>> terms_of_;
    std::vector<std::vector<std::size_t>> rows_of_; ///< for each variable, the indices of its rows
    std::vector<std::vector<std::pair<std::size_t, std::int64_t>>> vectors_;
    std::vector<std::int64_t> count_, sums_;
    std::vector<std::pair<std::size_t, std::int64_t>> touched_;
    double cost_ = 0;
};

} // namespace

double cost_of_intervals(const IntervalProgram& program, std::span<const int> counts)
{
    double cost = 0;
    for (const IntervalWish& wish : program.wishes) {
        int sum = 0;
        for (const std::size_t v : wish.variables) sum += counts[v];
        cost += wish_cost(sum, wish.wanted, wish.weight);
    }
    return cost;
}

std::vector<int> solve_intervals(const IntervalProgram& program)
{
    const std::size_t n = program.variables.size();
    geometry::UnionFind sets(n);
    // Fixed variables do not connect equations.
    const auto first_of = [&](const std::vector<std::size_t>& variables, std::size_t first = kNoIndex) {
        for (const std::size_t v : variables) {
            if (program.variables[v].fixed) continue;
            if (first == kNoIndex)
                first = v;
            else
                sets.unite_least(first, v);
        }
        return first;
    };
    const auto first_in = [&](const IntervalEquation& equation) {
        return first_of(equation.other, first_of(equation.one));
    };
    for (const IntervalEquation& equation : program.equations) first_in(equation);
    for (const IntervalWish& wish : program.wishes) first_of(wish.variables);
    for (const IntervalFloor& floor : program.floors) first_of(floor.variables);

    std::vector<int> counts(n, 0);
    std::map<std::size_t, std::vector<std::size_t>> variables;
    for (std::size_t v = 0; v < n; ++v) {
        if (program.variables[v].fixed)
            counts[v] = program.variables[v].given;
        else
            variables[sets.find(v)].push_back(v);
    }
    std::map<std::size_t, IntervalSet> parts;
    for (auto& [set, own] : variables) parts.try_emplace(set, program, std::move(own));
    for (const IntervalEquation& equation : program.equations) {
        const std::size_t first = first_in(equation);
        if (first != kNoIndex) parts.at(sets.find(first)).add(equation);
    }
    const auto add_term = [&](const std::vector<std::size_t>& own, double wanted, double weight) {
        const std::size_t first = first_of(own);
        if (first != kNoIndex) parts.at(sets.find(first)).add_term(own, wanted, weight);
    };
    for (const IntervalWish& wish : program.wishes) add_term(wish.variables, wish.wanted, wish.weight);
    for (const IntervalFloor& floor : program.floors) add_term(floor.variables, floor.least, 0);
    for (auto& [set, part] : parts) part.solve(counts);
    return counts;
}

} // namespace lacuna::surface
