// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/square_lines.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/sparse_factor.h>
#include <lacuna/geometry/shared/union_find.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/surface/detail/section_line.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/walls.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Factor on the weight of evenness of the first and the last side of an edge. Heuristic, measured on flat
/// rings: with a factor of 1, a third of the rows along shared edges are too low; with a factor of 4, the
/// mean scaled Jacobian drops by 0.01.
constexpr double kEnds = 2;
/// Nodes move only if the largest cosine decreases by at least this, which is 3°. With a lower value, nodes
/// of an L of two faces move, whose quads are good.
constexpr double kWorthIt = 0.05;
using Line = SectionLine;

/// A cosine, and its derivatives with respect to the positions of both ends of a line.
struct Cosine {
    double value = 0, from = 0, to = 0;
};

struct Node {
    std::size_t line = 0, node = 0;
};

/// Rung: a line of a grid, between corresponding nodes of two opposite sides.
struct Rung {
    Node from, to;
    /// For each end: the deviation of the line's direction there from its chord, on the source.
    std::array<Vec3, 2> bend{Vec3::Zero(), Vec3::Zero()};
    bool on_rims = false; ///< both ends lie on rims of the source
};

class LineSquarer {
public:
    LineSquarer(Seeds& seeds, const OpenVolume& volume, std::span<const LinkingSurface> links,
                const RunContext& context)
        : seeds_(seeds), volume_(volume), model_(volume.model), links_(links), context_(context)
    {
        for (const LinkingSurface& link : links) {
            for (const EdgeUse& use : link.source.uses()) rim_.insert(use.edge);
        }
        for (const auto& [face, corners] : seeds.corners) add_edges(face);
        for (const auto& [face, corners] : seeds.corners) add_rungs(face, corners);
    }

    void run()
    {
        geometry::UnionFind sets(lines_.size());
        for (const Rung& rung : rungs_) sets.unite_least(rung.from.line, rung.to.line);
        std::map<std::size_t, std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> parts;
        for (std::size_t l = 0; l < lines_.size(); ++l) parts[sets.find(l)].first.push_back(l);
        for (std::size_t r = 0; r < rungs_.size(); ++r)
            parts[sets.find(rungs_[r].from.line)].second.push_back(r);
        bool above = false; // whether sections above the source are used
        for (const auto& [set, part] : parts) {
            const auto& [lines, rungs] = part;
            check_cancelled(context_);
            if (worst_cosine(rungs, 1) < kWorthIt) continue;
            const bool swept = std::ranges::any_of(rungs, [&](std::size_t r) { return rungs_[r].on_rims; });
            if (swept && !std::exchange(above, true) && !add_sections()) return;
            settle(lines, rungs);
        }
    }

private:
    void add_edges(FaceId face)
    {
        for (const EdgeUse& use : model_[face].loops[0].uses) {
            const auto [found, fresh] = first_.try_emplace(use.edge, lines_.size());
            if (!fresh) continue;
            for (SeedPiece& piece : seeds_.pieces.at(use.edge)) {
                Line line;
                line.piece = &piece;
                line.on_rim = rim_.contains(use.edge);
                const std::vector<double> at = fractions_of(piece, kSamplesPerSide);
                line.points[kSource] = edge_points(model_, use.edge, at);
                for (int i = 0; i <= piece.count; ++i) line.at.push_back(i);
                lines_.push_back(std::move(line));
            }
        }
    }

    /// Positions at even steps of a piece's sides, as fractions of the edge. The end of the piece is
    /// included.
    static std::vector<double> fractions_of(const SeedPiece& piece, int per_side)
    {
        std::vector<double> nodes = piece.fractions(), at;
        nodes.push_back(piece.to);
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            for (int k = 0; k < per_side; ++k)
                at.push_back(nodes[i] + (nodes[i + 1] - nodes[i]) * k / per_side);
        }
        at.push_back(piece.to);
        return at;
    }

    /// Find the positions of the nodes of the source's rims in the sections above the source. @return  false
    /// if the walls do not determine these positions
    bool add_sections()
    {
        std::vector<LinkingNodes> nodes;
        for (const LinkingSurface& link : links_) nodes.push_back(seeds_.nodes(link));
        std::vector<double> heights;
        for (std::size_t k = 0; k < kSections; ++k) heights.push_back(height_of(k));
        auto walls = attempt<NotSweepable>(
            [&] { return mesh_walls(volume_, links_, nodes, heights, {}, context_, false); });
        if (!walls) return false; // there are more edges to follow than layers
        for (std::size_t b = 0; b < links_.size(); ++b) {
            std::size_t next = 0;
            const std::size_t round = nodes[b].source_at.size();
            for (const RimSegment& segment : links_[b].segments) {
                const EdgeUse use = links_[b].source.uses()[segment.use];
                const std::size_t piece = seeds_.piece_of(links_[b], segment);
                const auto sides = static_cast<std::size_t>(seeds_.pieces.at(use.edge)[piece].count);
                const auto first = first_.find(use.edge);
                for (std::size_t k = 1; first != first_.end() && k < kSections; ++k) {
                    std::vector<Vec3>& points = lines_[first->second + piece].points[k];
                    points.clear();
                    for (std::size_t i = 0; i <= sides; ++i)
                        points.push_back((*walls)[b].points[k * round + (next + i) % round]);
                    if (use.reversed) std::ranges::reverse(points);
                }
                next += sides;
            }
        }
        return true;
    }

    void add_rungs(FaceId face, const std::vector<std::size_t>& corners)
    {
        const Loop& loop = model_[face].loops[0];
        std::array<std::vector<Node>, 4> side;
        for (std::size_t s = 0; s < 4; ++s) {
            for (std::size_t i = corners[s]; i != corners[(s + 1) % 4]; i = (i + 1) % loop.uses.size())
                add_nodes(loop.uses[i], side[s]);
        }
        std::ranges::reverse(side[2]);
        std::ranges::reverse(side[3]);
        add_between(side[0], side[2], side[3], side[1]);
        add_between(side[3], side[1], side[0], side[2]);
    }

    void add_nodes(EdgeUse use, std::vector<Node>& side) const
    {
        const std::size_t first = first_.at(use.edge), pieces = seeds_.pieces.at(use.edge).size();
        for (std::size_t k = 0; k < pieces; ++k) {
            const std::size_t l = use.reversed ? first + pieces - 1 - k : first + k;
            const std::size_t last = lines_[l].at.size() - 1;
            for (std::size_t i = side.empty() ? 0 : 1; i <= last; ++i)
                side.push_back({l, use.reversed ? last - i : i});
        }
    }

    [[nodiscard]] Vec3 now(std::size_t end, const Node& node) const
    {
        return lines_[node.line].place(end, lines_[node.line].at[node.node]);
    }

    /// Add the lines that run from one side to the opposite side. The other two sides, `first` and `last`,
    /// are parallel to these lines.
    void add_between(const std::vector<Node>& from, const std::vector<Node>& to,
                     const std::vector<Node>& first, const std::vector<Node>& last)
    {
        const auto sides = static_cast<double>(first.size() - 1);
        // Deviations from the chord of the first and the last line, at both ends.
        std::array<std::array<Vec3, 2>, 2> bend;
        bool straight = true;
        for (std::size_t k = 0; k < 2; ++k) {
            const std::vector<Node>& own = k == 0 ? first : last;
            const std::size_t n = own.size();
            const Vec3 whole = now(kSource, own[n - 1]) - now(kSource, own[0]);
            bend[k][0] = sides * (now(kSource, own[1]) - now(kSource, own[0])) - whole;
            bend[k][1] = sides * (now(kSource, own[n - 1]) - now(kSource, own[n - 2])) - whole;
            for (const Vec3& b : bend[k]) straight = straight && b.norm() <= kParallel * whole.norm();
        }
        for (std::size_t i = 1; i + 1 < from.size(); ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(from.size() - 1);
            Rung rung{from[i], to[i]};
            for (std::size_t k = 0; k < 2; ++k) rung.bend[k] = (1 - share) * bend[0][k] + share * bend[1][k];
            rung.on_rims = straight && lines_[from[i].line].on_rim && lines_[to[i].line].on_rim;
            rungs_.push_back(rung);
        }
    }

    /// Cosines of the angles between a line and the edges at its two ends.
    [[nodiscard]] std::array<Cosine, 2> cosines(const Rung& rung, std::size_t section) const
    {
        const Line &a = lines_[rung.from.line], &b = lines_[rung.to.line];
        const double u = at(rung.from, section), v = at(rung.to, section);
        const Line::Spot from = a.spot(section, u), to = b.spot(section, v);
        std::array<Cosine, 2> found{};
        for (std::size_t side = 0; side < 2; ++side) {
            Vec3 way = to.at - from.at;
            if (section == kSource) way += rung.bend[side];
            const double length = way.norm();
            if (length <= 0) continue;
            way /= length;
            const Line::Spot along = side == 0 ? a.tangent(section, u) : b.tangent(section, v);
            const Vec3 across = (along.at - way.dot(along.at) * way) / length;
            found[side] = {way.dot(along.at), -from.slope.dot(across), to.slope.dot(across)};
            (side == 0 ? found[side].from : found[side].to) += way.dot(along.slope);
        }
        return found;
    }

    [[nodiscard]] double at(const Node& node, std::size_t section) const
    {
        return lines_[node.line].column(section, node.node);
    }

    /// Weight of a line's angles in one section.
    static double share(const Rung& rung) { return rung.on_rims ? 1.0 / kSections : 1; }

    template <class Visit>
    void for_cosines(const std::vector<std::size_t>& rungs, std::size_t most, const Visit& visit) const
    {
        for (const std::size_t r : rungs) {
            const std::size_t sections = rungs_[r].on_rims ? most : 1;
            for (std::size_t section = 0; section < sections; ++section) {
                for (const Cosine& cosine : cosines(rungs_[r], section)) visit(rungs_[r], section, cosine);
            }
        }
    }

    [[nodiscard]] double worst_cosine(const std::vector<std::size_t>& rungs, std::size_t sections) const
    {
        double worst = 0;
        for_cosines(rungs, sections, [&](const Rung&, std::size_t, const Cosine& cosine) {
            worst = std::max(worst, std::abs(cosine.value));
        });
        return worst;
    }

    /// As above, including the angles between edges and columns. These are 90° before nodes move.
    [[nodiscard]] double worst_cosine(const std::vector<std::size_t>& lines,
                                      const std::vector<std::size_t>& rungs) const
    {
        double worst = worst_cosine(rungs, kSections);
        for (const std::size_t l : lines) {
            for_columns(lines_[l], [&](std::size_t, double slope) {
                worst = std::max(worst, std::abs(slope) / std::hypot(1, slope));
            });
        }
        return worst;
    }

    /// Whether the angles between lines and edges differ from section to section.
    [[nodiscard]] bool are_unlike(const std::vector<std::size_t>& rungs) const
    {
        return std::ranges::any_of(rungs, [&](std::size_t r) {
            const std::array<Cosine, 2> below = cosines(rungs_[r], kSource);
            for (std::size_t section = 1; section < kSections; ++section) {
                const std::array<Cosine, 2> own = cosines(rungs_[r], section);
                for (std::size_t side = 0; side < 2; ++side) {
                    if (std::abs(own[side].value - below[side].value) > kWorthIt) return true;
                }
            }
            return false;
        });
    }

    [[nodiscard]] double energy(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs,
                                double weight) const
    {
        double sum = 0;
        for_terms(lines, rungs, weight,
                  [&](double r, double w, std::span<const Slope>) { sum += w * r * r; });
        return sum;
    }

    using Slope = std::pair<std::size_t, double>; ///< derivative by a variable

    /// Visit the terms of the objective. Each has a residual, a weight and derivatives.
    template <class Visit>
    void for_terms(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs,
                   double weight, const Visit& visit) const
    {
        for (const std::size_t l : lines) {
            const Line& line = lines_[l];
            // Evenness on the source and on the target. If the nodes have the same positions on both, there
            // is only one term, with the full weight.
            const double each = line.above.empty() ? weight : weight / 2;
            const auto visit_sides = [&](const std::vector<double>& u,
                                         const std::vector<std::size_t>& variable) {
                for (std::size_t i = 0; i + 1 < u.size(); ++i) {
                    // The first and the last side of a line are the heights of rows along the adjacent edges.
                    const double ends = i == 0 || i + 2 == u.size() ? kEnds : 1;
                    visit(u[i + 1] - u[i] - 1, each * ends,
                          std::array<Slope, 2>{{{variable[i], -1}, {variable[i + 1], 1}}});
                }
            };
            visit_sides(line.at, line.variable);
            visit_sides(line.above, line.variable_above);
            for_columns(line, [&](std::size_t i, double slope) {
                visit(slope, 1.0,
                      std::array<Slope, 2>{
                          {{line.variable[i], -line.steep[i]}, {line.variable_above[i], line.steep[i]}}});
            });
        }
        std::vector<Slope> own;
        for_cosines(rungs, kSections, [&](const Rung& rung, std::size_t section, const Cosine& cosine) {
            own.clear();
            add_slopes(rung.from, section, cosine.from, own);
            add_slopes(rung.to, section, cosine.to, own);
            visit(cosine.value, share(rung), own);
        });
    }

    /// Visit the nodes that may have different positions on source and target, with the slope of their
    /// columns along the edge: the displacement divided by the length of the column.
    template <class Visit>
    static void for_columns(const Line& line, const Visit& visit)
    {
        for (std::size_t i = 1; i + 1 < line.above.size(); ++i)
            visit(i, (line.above[i] - line.at[i]) * line.steep[i]);
    }

    /// Add the derivatives of the position of a node's column in a section, with respect to the variables of
    /// the node.
    void add_slopes(const Node& node, std::size_t section, double slope, std::vector<Slope>& slopes) const
    {
        const Line& line = lines_[node.line];
        const double height = line.above.empty() ? 0 : height_of(section);
        if (height < 1) slopes.emplace_back(line.variable[node.node], (1 - height) * slope);
        if (height > 0) slopes.emplace_back(line.variable_above[node.node], height * slope);
    }

    /// One Gauss-Newton step. @return its length [sides]
    double step(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs, double weight,
                std::size_t variables)
    {
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(variables));
        for_terms(lines, rungs, weight, [&](double r, double w, std::span<const Slope> own) {
            for (const auto& [v, dv] : own) {
                if (v == kNoIndex) continue;
                right[static_cast<Eigen::Index>(v)] -= w * dv * r;
                for (const auto& [o, d_o] : own) {
                    if (o != kNoIndex && o <= v)
                        entries.emplace_back(static_cast<int>(v), static_cast<int>(o), w * dv * d_o);
                }
            }
        });
        const auto n = static_cast<Eigen::Index>(variables);
        Eigen::SparseMatrix<double> matrix(n, n);
        matrix.setFromTriplets(entries.begin(), entries.end());
        const geometry::SparseFactor factor(matrix);
        if (!factor.good()) return 0;
        const Eigen::VectorXd move = factor.solve(right);
        const double before = energy(lines, rungs, weight);
        double length = 1;
        for (double last = 0; length > 1.0 / 16; length /= 2) {
            shift(lines, move, length - last);
            last = length;
            if (energy(lines, rungs, weight) < before) return length * move.cwiseAbs().maxCoeff();
        }
        shift(lines, move, -2 * length);
        return 0;
    }

    void shift(const std::vector<std::size_t>& lines, const Eigen::VectorXd& move, double length)
    {
        for (const std::size_t l : lines) {
            Line& line = lines_[l];
            const auto shift_end = [&](std::vector<double>& at, const std::vector<std::size_t>& variable) {
                for (std::size_t i = 0; i < at.size(); ++i) {
                    if (variable[i] != kNoIndex)
                        at[i] += length * move[static_cast<Eigen::Index>(variable[i])];
                }
            };
            shift_end(line.at, line.variable);
            shift_end(line.above, line.variable_above);
        }
    }

    [[nodiscard]] bool is_even(const std::vector<std::size_t>& lines) const
    {
        bool even = true;
        for (const std::size_t l : lines) {
            for (const std::vector<double>* u : {&lines_[l].at, &lines_[l].above}) {
                for (std::size_t i = 0; i + 1 < u->size(); ++i) {
                    const double side = (*u)[i + 1] - (*u)[i]; // 1 if even
                    even = even && side >= quads::kShortestOfSize && side <= quads::kLongestOfSize;
                }
            }
        }
        return even;
    }

    void settle(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs)
    {
        std::size_t variables = 0;
        for (const std::size_t l : lines) {
            Line& line = lines_[l];
            line.variable.assign(line.at.size(), kNoIndex);
            if (line.piece->fixed || line.piece->rows() > 0) continue;
            for (std::size_t i = 1; i + 1 < line.at.size(); ++i) line.variable[i] = variables++;
        }
        if (variables == 0) return;
        const double before = worst_cosine(rungs, kSections);
        const bool squarer = square(lines, rungs, variables) &&
                             worst_cosine(rungs, kSections) < before - kWorthIt;
        if (!squarer) {
            for (const std::size_t l : lines) lines_[l].at = lines_[l].even();
        }
        if (settle_apart(lines, rungs, variables) || squarer) take(lines);
    }

    /// If the sections differ, give nodes other positions on the target, provided that this improves the
    /// angles. @return  whether it does
    bool settle_apart(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs,
                      std::size_t variables)
    {
        const bool swept = std::ranges::all_of(rungs, [&](std::size_t r) { return rungs_[r].on_rims; });
        if (!swept || !are_unlike(rungs)) return false;
        const double before = worst_cosine(rungs, kSections);
        std::vector<std::vector<double>> alike;
        for (const std::size_t l : lines) {
            Line& line = lines_[l];
            alike.push_back(line.at);
            line.above = line.at;
            line.variable_above = line.variable;
            for (std::size_t& v : line.variable_above) v += v == kNoIndex ? 0 : variables;
            line.steep = line.steepness();
        }
        const bool even = square(lines, rungs, 2 * variables);
        if (even && worst_cosine(lines, rungs) < before - kWorthIt) return true;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            lines_[lines[i]].at = alike[i];
            lines_[lines[i]].above.clear();
        }
        return false;
    }

    /// Move nodes so that the lines become as square to the edges as possible. @return  whether the sides
    /// stay even enough
    bool square(const std::vector<std::size_t>& lines, const std::vector<std::size_t>& rungs,
                std::size_t variables)
    {
        double weight = 1; // of evenness: with a large one, all sides get the same length
        for (int round = 0; round < kMostSteps; ++round, weight *= 2) {
            for (int k = 0; k < kMostSteps && step(lines, rungs, weight, variables) > kVisible; ++k) {}
            if (is_even(lines)) return true;
        }
        return false;
    }

    void take(const std::vector<std::size_t>& lines)
    {
        for (const std::size_t l : lines) {
            Line& line = lines_[l];
            std::vector<double> nodes = line.piece->fractions();
            nodes.push_back(line.piece->to);
            const auto fractions = [&](const std::vector<double>& at) {
                std::vector<double> placed;
                for (std::size_t i = 1; i + 1 < at.size(); ++i) {
                    if (line.variable[i] == kNoIndex) break;
                    const auto k = std::min(static_cast<std::size_t>(at[i]), nodes.size() - 2);
                    placed.push_back(nodes[k] + (at[i] - static_cast<double>(k)) * (nodes[k + 1] - nodes[k]));
                }
                return placed;
            };
            line.piece->placed = fractions(line.at);
            line.piece->placed_above = fractions(line.above);
        }
    }

    Seeds& seeds_;
    const OpenVolume& volume_;
    const Model& model_;
    std::span<const LinkingSurface> links_;
    const RunContext& context_;
    std::set<EdgeId> rim_;
    std::vector<Line> lines_;
    std::vector<Rung> rungs_;
    std::map<EdgeId, std::size_t> first_; ///< for each edge, the index of the line of its first piece
};

} // namespace

void square_mapped_lines(Seeds& seeds, const OpenVolume& volume, std::span<const LinkingSurface> links,
                         const RunContext& context)
{
    if (!seeds.corners.empty()) LineSquarer(seeds, volume, links, context).run();
}

} // namespace lacuna::surface
