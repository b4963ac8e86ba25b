// SPDX-License-Identifier: MIT
#include <lacuna/sweep/untangle.h>

#include <lacuna/quality/quality.h>

#include <Eigen/Dense>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <utility>
#include <vector>

namespace lacuna::sweep {

namespace {

/// Nodes next to each corner of a hexahedron, in the order that makes the corner's determinant positive.
constexpr std::array<std::array<int, 3>, 8> kNext{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
/// Which of the cell's directions (u, v, w) each of those edges runs along.
constexpr std::array<std::array<int, 3>, 8> kAlong{
    {{0, 1, 2}, {1, 0, 2}, {0, 1, 2}, {1, 0, 2}, {1, 0, 2}, {0, 1, 2}, {1, 0, 2}, {0, 1, 2}}};
/// Edges of each direction.
constexpr std::array<std::array<std::pair<int, int>, 4>, 3> kEdges{{
    {{{0, 1}, {3, 2}, {4, 5}, {7, 6}}},
    {{{0, 3}, {1, 2}, {4, 7}, {5, 6}}},
    {{{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
}};
/// Weight of the volume term against the shape term, as Garanzha et al.
constexpr double kVolumeShare = 1.0 / 128;
/// Smallest regularisation.
constexpr double kLeastEpsilon = 1e-3;
constexpr std::size_t kMemory = 10;
constexpr int kSteps = 60;

struct Cell {
    Hex nodes;
    Vec3 reference; ///< edge lengths of its box
};

/// The part of a mesh that is worked on.
struct Region {
    std::vector<Cell> cells;
    std::vector<std::size_t> number; ///< of each cell in the mesh
    std::vector<Index> free_nodes;
    std::vector<Index> variable; ///< of each mesh node; -1: locked
};

std::array<Vec3, 8> corners_of(const std::vector<Vec3>& nodes, const Hex& hex)
{
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = nodes[static_cast<std::size_t>(hex[i])];
    return corners;
}

double scaled_jacobian(const std::vector<Vec3>& nodes, const Hex& hex)
{
    const auto corners = corners_of(nodes, hex);
    return quality::scaled_jacobian(corners);
}

std::vector<char> skin_nodes(const mesh::HexMesh& mesh)
{
    std::vector<char> skin(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_quad(mesh, i).nodes) skin[static_cast<std::size_t>(n)] = 1;
    }
    return skin;
}

Region region_of(const mesh::HexMesh& mesh, const UntangleOptions& options, double& least)
{
    std::vector<char> touched(mesh.nodes.size(), 0);
    least = 1;
    for (std::size_t c = 0; c < mesh.hex_count(); ++c) {
        const Hex hex = mesh.hex(c);
        const double sj = scaled_jacobian(mesh.nodes, hex);
        least = std::min(least, sj);
        if (sj >= options.good_enough) continue;
        for (const Index n : hex) touched[static_cast<std::size_t>(n)] = 1;
    }
    std::vector<char> taken(mesh.hex_count(), 0);
    for (int ring = 0; ring <= options.rings; ++ring) {
        for (std::size_t c = 0; c < taken.size(); ++c) {
            const Hex hex = mesh.hex(c);
            if (std::any_of(hex.begin(), hex.end(),
                            [&](Index n) { return touched[static_cast<std::size_t>(n)] != 0; }))
                taken[c] = 1;
        }
        for (std::size_t c = 0; ring < options.rings && c < taken.size(); ++c) {
            if (taken[c] == 0) continue;
            for (const Index n : mesh.hex(c)) touched[static_cast<std::size_t>(n)] = 1;
        }
    }
    // Nodes of the outermost ring's far side stay, so that the region meets the rest as it was.
    const std::vector<char> skin = skin_nodes(mesh);
    std::vector<char> outside(mesh.nodes.size(), 0);
    for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c] != 0) continue;
        for (const Index n : mesh.hex(c)) outside[static_cast<std::size_t>(n)] = 1;
    }
    Region region;
    region.variable.assign(mesh.nodes.size(), -1);
    for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c] == 0) continue;
        Cell cell{mesh.hex(c), Vec3::Zero()};
        const auto corners = corners_of(mesh.nodes, cell.nodes);
        for (int d = 0; d < 3; ++d) {
            for (const auto& [a, b] : kEdges[static_cast<std::size_t>(d)]) {
                cell.reference[d] +=
                    (corners[static_cast<std::size_t>(b)] - corners[static_cast<std::size_t>(a)]).norm() / 4;
            }
        }
        for (const Index n : cell.nodes) {
            const auto i = static_cast<std::size_t>(n);
            if (skin[i] != 0 || outside[i] != 0 || region.variable[i] >= 0) continue;
            region.variable[i] = static_cast<Index>(region.free_nodes.size());
            region.free_nodes.push_back(n);
        }
        region.cells.push_back(cell);
        region.number.push_back(c);
    }
    return region;
}

/// The energy of a region and its gradient at the free nodes.
class Energy {
public:
    Energy(const std::vector<Vec3>& nodes, const Region& region) : nodes_(nodes), region_(region) {}

    double epsilon = 1;

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
    {
        gradient.setZero(x.size());
        double sum = 0;
        for (const Cell& cell : region_.cells) {
            std::array<Vec3, 8> corner;
            for (std::size_t i = 0; i < 8; ++i) corner[i] = place(x, cell.nodes[i]);
            std::array<Vec3, 8> slope;
            slope.fill(Vec3::Zero());
            for (std::size_t c = 0; c < 8; ++c) sum += corner_energy(cell, corner, c, slope);
            for (std::size_t i = 0; i < 8; ++i) {
                const Index v = region_.variable[static_cast<std::size_t>(cell.nodes[i])];
                if (v >= 0) gradient.segment<3>(3 * v) += slope[i];
            }
        }
        return sum;
    }

    /// Least determinant over all corners, in units of the references.
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x) const
    {
        double least = std::numeric_limits<double>::infinity();
        for (const Cell& cell : region_.cells) {
            for (std::size_t c = 0; c < 8; ++c) {
                Eigen::Matrix3d jacobian;
                for (int k = 0; k < 3; ++k) {
                    const auto e = static_cast<std::size_t>(k);
                    jacobian.col(k) = (place(x, cell.nodes[static_cast<std::size_t>(kNext[c][e])]) -
                                       place(x, cell.nodes[c])) /
                                      cell.reference[kAlong[c][e]];
                }
                least = std::min(least, jacobian.determinant());
            }
        }
        return least;
    }

private:
    [[nodiscard]] Vec3 place(const Eigen::VectorXd& x, Index node) const
    {
        const Index v = region_.variable[static_cast<std::size_t>(node)];
        return v >= 0 ? Vec3(x.segment<3>(3 * v)) : nodes_[static_cast<std::size_t>(node)];
    }

    double corner_energy(const Cell& cell, const std::array<Vec3, 8>& corner, std::size_t c,
                         std::array<Vec3, 8>& slope) const
    {
        Eigen::Matrix3d j;
        Vec3 inverse;
        for (int k = 0; k < 3; ++k) {
            const auto e = static_cast<std::size_t>(k);
            inverse[k] = 1 / cell.reference[kAlong[c][e]];
            j.col(k) = (corner[static_cast<std::size_t>(kNext[c][e])] - corner[c]) * inverse[k];
        }
        Eigen::Matrix3d cofactor;
        cofactor << j.col(1).cross(j.col(2)), j.col(2).cross(j.col(0)), j.col(0).cross(j.col(1));
        const double d = j.col(0).dot(cofactor.col(0));
        const double root = std::sqrt(epsilon * epsilon + d * d);
        const double chi = (d + root) / 2;
        const double chi_slope = (1 + d / root) / 2;
        const double trace = j.squaredNorm();
        const double power = std::pow(chi, -2.0 / 3);
        const double shape = trace * power;
        const double volume = (1 + d * d) / chi;
        const Eigen::Matrix3d by_j = (1 - kVolumeShare) *
                                         (2 * power * j - 2.0 / 3 * shape / chi * chi_slope * cofactor) +
                                     kVolumeShare * (2 * d / chi - volume / chi * chi_slope) * cofactor;
        for (int k = 0; k < 3; ++k) {
            const Vec3 by_edge = by_j.col(k) * inverse[k];
            slope[static_cast<std::size_t>(kNext[c][static_cast<std::size_t>(k)])] += by_edge;
            slope[c] -= by_edge;
        }
        return (1 - kVolumeShare) * shape + kVolumeShare * volume;
    }

    const std::vector<Vec3>& nodes_;
    const Region& region_;
};

/// Limited-memory BFGS with backtracking; stops when a step wins next to nothing.
void minimise(const Energy& energy, Eigen::VectorXd& x, const RunContext& context)
{
    struct Pair {
        Eigen::VectorXd step, change;
        double inverse;
    };
    std::deque<Pair> memory;
    Eigen::VectorXd gradient(x.size()), next_gradient(x.size());
    double value = energy(x, gradient);
    for (int step = 0; step < kSteps; ++step) {
        check_cancelled(context);
        Eigen::VectorXd direction = -gradient;
        std::vector<double> alpha(memory.size());
        for (std::size_t i = memory.size(); i-- > 0;) {
            alpha[i] = memory[i].inverse * memory[i].step.dot(direction);
            direction -= alpha[i] * memory[i].change;
        }
        if (!memory.empty())
            direction *= memory.back().step.dot(memory.back().change) / memory.back().change.squaredNorm();
        for (std::size_t i = 0; i < memory.size(); ++i) {
            direction += (alpha[i] - memory[i].inverse * memory[i].change.dot(direction)) * memory[i].step;
        }
        double slope = gradient.dot(direction);
        if (!(slope < 0)) {
            memory.clear();
            direction = -gradient;
            slope = -gradient.squaredNorm();
        }
        if (!(slope < 0)) return;
        double length = memory.empty() ? 0.1 * std::abs(value) / -slope : 1;
        Eigen::VectorXd tried;
        double found = value;
        bool won = false;
        for (int half = 0; half < 30 && !won; ++half, length /= 2) {
            tried = x + length * direction;
            found = energy(tried, next_gradient);
            won = std::isfinite(found) && found <= value + 1e-4 * length * slope;
        }
        if (!won) return;
        Pair pair{tried - x, next_gradient - gradient, 0};
        const double curvature = pair.step.dot(pair.change);
        if (curvature > 1e-12 * pair.step.norm() * pair.change.norm()) {
            pair.inverse = 1 / curvature;
            memory.push_back(std::move(pair));
            if (memory.size() > kMemory) memory.pop_front();
        }
        const double won_by = value - found;
        x = std::move(tried);
        gradient = next_gradient;
        value = found;
        if (won_by < 1e-7 * std::abs(value)) return;
    }
}

double least_of(const std::vector<Vec3>& nodes, const Region& region)
{
    double least = 1;
    for (const Cell& cell : region.cells) {
        const auto corners = corners_of(nodes, cell.nodes);
        double sj = quality::scaled_jacobian(corners);
        // Valid at its corners is not yet valid.
        if (sj > 0 && !quality::certified_positive(corners)) sj = 0;
        least = std::min(least, sj);
    }
    return least;
}

} // namespace

Untangled untangle(mesh::HexMesh& mesh, const UntangleOptions& options, const RunContext& context)
{
    const auto start = std::chrono::steady_clock::now();
    Untangled result;
    const Region region = region_of(mesh, options, result.before);
    result.after = result.before;
    if (region.free_nodes.empty()) return result;
    result.cells = region.cells.size();
    result.moved = region.free_nodes.size();

    Eigen::VectorXd x(3 * static_cast<Eigen::Index>(region.free_nodes.size()));
    for (std::size_t v = 0; v < region.free_nodes.size(); ++v) {
        x.segment<3>(
            3 * static_cast<Eigen::Index>(v)) = mesh.nodes[static_cast<std::size_t>(region.free_nodes[v])];
    }
    const auto put = [&](std::vector<Vec3>& nodes) {
        for (std::size_t v = 0; v < region.free_nodes.size(); ++v) {
            nodes[static_cast<std::size_t>(region.free_nodes[v])] = x.segment<3>(
                3 * static_cast<Eigen::Index>(v));
        }
    };
    Energy energy(mesh.nodes, region);
    std::vector<Vec3> best = mesh.nodes, tried = mesh.nodes;
    double least = least_of(mesh.nodes, region);
    const double first = least;
    int without_gain = 0;
    for (int round = 0; round < options.rounds && without_gain < 4; ++round) {
        const double determinant = energy.least_determinant(x);
        energy.epsilon = determinant > 0
                             ? kLeastEpsilon
                             : std::sqrt(kLeastEpsilon * kLeastEpsilon + 0.04 * determinant * determinant);
        minimise(energy, x, context);
        put(tried);
        const double now = least_of(tried, region);
        without_gain = now > least + 1e-4 ? 0 : without_gain + 1;
        if (now > least) {
            least = now;
            best = tried;
        }
        if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > options.seconds)
            break;
    }
    if (least > first) {
        mesh.nodes = std::move(best);
        result.after = std::max(result.before, least);
    }
    return result;
}

} // namespace lacuna::sweep
