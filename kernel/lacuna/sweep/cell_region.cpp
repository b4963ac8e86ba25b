// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/cell_region.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/quality/quality.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace lacuna::sweep {

namespace {

std::array<Vec3, 8> corners_of(const std::vector<Vec3>& places, const Hex& hex)
{
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = places[index(hex[i])];
    return corners;
}

CellKind kind_of(const Hex& hex) { return mesh::is_wedge(hex) ? CellKind::wedge : CellKind::hex; }

std::array<Vec3, 6> wedge_corners(const std::array<Vec3, 8>& corners)
{
    return {corners[0], corners[1], corners[2], corners[4], corners[5], corners[6]};
}

double scaled_jacobian(const Hex& hex, const std::array<Vec3, 8>& corners)
{
    return mesh::is_wedge(hex) ? quality::wedge_scaled_jacobian(wedge_corners(corners))
                               : quality::scaled_jacobian(corners);
}

bool certified_positive(const Hex& hex, const std::array<Vec3, 8>& corners)
{
    return mesh::is_wedge(hex) ? quality::wedge_certified_positive(wedge_corners(corners))
                               : quality::certified_positive(corners);
}

const std::array<std::array<std::size_t, 3>, 8>& neighbours_in(const Hex& hex)
{
    return mesh::is_wedge(hex) ? mesh::kWedgeNeighbours : mesh::kHexNeighbours;
}

/// Call `visit(corner, a, b)` for each pair of fixed edges of a cell that meet in a corner. An edge is fixed
/// if both its nodes are fixed.
template <class Visit>
void for_locked_angles(const Hex& hex, const std::vector<char>& locked, const Visit& visit)
{
    const auto& neighbours = neighbours_in(hex);
    const auto stays = [&](std::size_t corner) { return locked[index(hex[corner])] != 0; };
    for (std::size_t c = 0; c < 8; ++c) {
        for (std::size_t i = 0; i < 3 && stays(c); ++i) {
            const std::size_t a = neighbours[c][i], b = neighbours[c][(i + 1) % 3];
            if (stays(a) && stays(b)) visit(c, a, b);
        }
    }
}

/// Upper bound of a cell's quality due to its fixed edges. It is the smaller of two values: the smallest sine
/// of an angle between two fixed edges, and the smallest scaled Jacobian of a corner whose three edges are
/// fixed. In triangles of wedges, sines are relative to the sine of 60°.
double bound_of(const std::array<Vec3, 8>& corners, const Hex& hex, const std::vector<char>& locked)
{
    double bound = 1;
    const auto& neighbours = neighbours_in(hex);
    const double best = mesh::is_wedge(hex) ? 2 * std::numbers::inv_sqrt3 : 1;
    const auto stays = [&](std::size_t corner) { return locked[index(hex[corner])] != 0; };
    for (std::size_t c = 0; c < 8; ++c) {
        if (!stays(c) || !std::ranges::all_of(neighbours[c], stays)) continue;
        const Vec3 u = corners[neighbours[c][0]] - corners[c], v = corners[neighbours[c][1]] - corners[c],
                   w = corners[neighbours[c][2]] - corners[c];
        const double lengths = u.norm() * v.norm() * w.norm();
        bound = std::min(bound, lengths > 0 ? best * std::abs(u.dot(v.cross(w))) / lengths : 0.0);
    }
    for_locked_angles(hex, locked, [&](std::size_t c, std::size_t a, std::size_t b) {
        const Vec3 u = corners[a] - corners[c], v = corners[b] - corners[c];
        const double lengths = u.norm() * v.norm();
        bound = std::min(bound, lengths > 0 ? best * u.cross(v).norm() / lengths : 0.0);
    });
    return bound;
}

/// Whether each cell is poor and can be improved.
std::vector<char> poor_cells(const CellsView& mesh, const std::vector<char>& locked, double good_enough,
                             const RunContext& context)
{
    std::vector<char> poor(mesh.cell_count(), 0);
    parallel_each(context, poor.size(), kPerTask, [&](std::size_t c) {
        const Hex hex = mesh.hex(c);
        const std::array<Vec3, 8> corners = corners_of(mesh.nodes, hex);
        const double scaled = scaled_jacobian(hex, corners);
        if (scaled >= good_enough) {
            poor[c] = certified_positive(hex, corners) ? 0 : 1;
        } else {
            poor[c] = scaled <= 0 || scaled + kAlikeSizes < bound_of(corners, hex, locked) ? 1 : 0;
        }
    });
    return poor;
}

/// Add neighbours: all cells that share a node with a selected one.
void grow(const CellsView& mesh, std::vector<char>& taken)
{
    std::vector<char> touched(mesh.nodes.size(), 0);
    for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c] == 0) continue;
        for (const Index n : mesh.hex(c)) touched[index(n)] = 1;
    }
    for (std::size_t c = 0; c < taken.size(); ++c) {
        const Hex hex = mesh.hex(c);
        taken[c] = std::ranges::any_of(hex, [&](Index n) { return touched[index(n)] != 0; });
    }
}

/// For each free node, the cells and corners that use it.
mesh::Incidence uses_of(const CellRegion& region)
{
    return mesh::incidence(region.free, [&](const auto& visit) {
        for (std::size_t c = 0; c < region.cells.size(); ++c) {
            for (std::size_t k = 0; k < 8; ++k) {
                // In a wedge, corners 3 and 7 are the same nodes as 2 and 6, and are not counted again.
                if (k % 4 == 3 && mesh::is_wedge(region.cells[c])) continue;
                if (index(region.cells[c][k]) < region.free)
                    visit(index(region.cells[c][k]), static_cast<Index>(8 * c + k));
            }
        }
    });
}

/// The first corner of a cell at which two fixed sides are collinear.
std::optional<StuckCorner> stuck_corner(const Hex& hex, const std::array<Vec3, 8>& corners,
                                        const std::vector<char>& locked)
{
    std::optional<StuckCorner> stuck;
    for_locked_angles(hex, locked, [&](std::size_t c, std::size_t a, std::size_t b) {
        const Vec3 u = corners[a] - corners[c], v = corners[b] - corners[c];
        if (!stuck && u.cross(v).norm() <= kFileAccuracy * u.norm() * v.norm())
            stuck = StuckCorner{hex[c], {hex[a], hex[b]}};
    });
    return stuck;
}

} // namespace

std::optional<StuckCorner> stuck_corner(const mesh::HexMesh& mesh, const Sliding& sliding)
{
    const std::vector<char> locked = locked_nodes(mesh, sliding);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        const Hex hex = mesh.hex(c);
        const std::array<Vec3, 8> corners = corners_of(mesh.nodes, hex);
        const auto stuck = stuck_corner(hex, corners, locked);
        if (stuck && !certified_positive(hex, corners)) return stuck;
    }
    return std::nullopt;
}

std::vector<char> locked_nodes(const mesh::HexMesh& mesh, const Sliding& sliding)
{
    std::vector<char> locked = sliding.held;
    locked.resize(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_quad(mesh, i).nodes) {
            if (sliding.surface.empty() || sliding.surface[index(n)] < 0) locked[index(n)] = 1;
        }
    }
    return locked;
}

CellRegion poor_region(const CellsView& mesh, const std::vector<char>& locked, const ImproveOptions& options,
                       const Sliding& sliding, const RunContext& context)
{
    CellRegion region;
    std::vector<char> taken = poor_cells(mesh, locked, options.good_enough, context);
    if (std::ranges::none_of(taken, [](char c) { return c != 0; })) return region;
    for (int ring = 0; ring < options.rings; ++ring) grow(mesh, taken);

    // Nodes of cells outside the region are fixed, so that the region still fits these cells.
    std::vector<char> held = locked;
    std::vector<char> inside(mesh.nodes.size(), 0);
    for (std::size_t c = 0; c < taken.size(); ++c) {
        for (const Index n : mesh.hex(c)) (taken[c] != 0 ? inside : held)[index(n)] = 1;
    }
    std::vector<Index> number(mesh.nodes.size(), -1);
    const auto number_those = [&](char wanted) {
        for (std::size_t n = 0; n < number.size(); ++n) {
            if (inside[n] == 0 || held[n] != wanted) continue;
            number[n] = static_cast<Index>(region.node.size());
            region.node.push_back(static_cast<Index>(n));
        }
    };
    number_those(0);
    region.free = region.node.size();
    number_those(1);
    region.surface.assign(region.free, -1);
    for (std::size_t i = 0; i < region.free && !sliding.surface.empty(); ++i)
        region.surface[i] = sliding.surface[index(region.node[i])];
    for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c] == 0) continue;
        const Hex hex = mesh.hex(c);
        Hex local{};
        for (std::size_t k = 0; k < 8; ++k) local[k] = number[index(hex[k])];
        region.cells.push_back(local);
        const std::array<Vec3, 8> corners = corners_of(mesh.nodes, hex);
        region.box.push_back(mean_edges(corners, kind_of(hex)));
        region.aim.push_back(std::min(options.good_enough, bound_of(corners, hex, held) - kAlikeSizes));
    }
    region.uses = uses_of(region);
    return region;
}

RegionQuality measure(const CellRegion& region, const std::vector<Vec3>& places, const RunContext& context)
{
    const std::size_t chunks = (region.cells.size() + kPerTask - 1) / kPerTask;
    std::vector<RegionQuality> part(chunks);
    parallel_for(context, region.cells.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
        RegionQuality& found = part[begin / kPerTask];
        found.mean = 0;
        for (std::size_t c = begin; c < end; ++c) {
            const std::array<Vec3, 8> corners = corners_of(places, region.cells[c]);
            const Hex& hex = region.cells[c];
            double scaled = scaled_jacobian(hex, corners);
            found.mean += scaled;
            // A cell may be invalid even if the Jacobians at its corners are positive.
            if (scaled > 0 && !certified_positive(hex, corners)) scaled = 0;
            found.least = std::min(found.least, scaled);
            found.folded += std::max(0.0, -scaled);
            found.lacking += std::max(0.0, region.aim[c] - scaled);
        }
    });
    RegionQuality whole{1, 0, 0, 0};
    for (const RegionQuality& found : part) {
        whole.least = std::min(whole.least, found.least);
        whole.folded += found.folded;
        whole.lacking += found.lacking;
        whole.mean += found.mean / static_cast<double>(std::max<std::size_t>(region.cells.size(), 1));
    }
    return whole;
}

RegionEnergy::RegionEnergy(const CellRegion& region, std::vector<Vec3> places, const RunContext& context)
    : region_(region), context_(context), places_(std::move(places)), slopes_(8 * region.cells.size())
{
}

void RegionEnergy::put(const Eigen::VectorXd& x)
{
    Eigen::Map<Eigen::VectorXd>(places_.front().data(), x.size()) = x;
}

double RegionEnergy::operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient)
{
    put(x);
    std::vector<double> part((region_.cells.size() + kPerTask - 1) / kPerTask, 0.0);
    parallel_for(context_, region_.cells.size(), kPerTask, [&](std::size_t begin, std::size_t end) {
        std::array<Vec3, 8> slope;
        for (std::size_t c = begin; c < end; ++c) {
            const Hex& cell = region_.cells[c];
            part[begin / kPerTask] += cell_energy(energy, corners_of(places_, cell), region_.box[c], slope,
                                                  kind_of(cell));
            std::copy(slope.begin(), slope.end(), slopes_.begin() + static_cast<std::ptrdiff_t>(8 * c));
        }
    });
    // Summing the gradients at a node is much cheaper than evaluating a cell, so threads pay off only from 32
    // times as many nodes on.
    parallel_each(context_, region_.free, 32 * kPerTask, [&](std::size_t i) {
        Vec3 sum = Vec3::Zero();
        for (const Index use : region_.uses.of(i)) sum += slopes_[index(use)];
        if (along_[i].isZero(0))
            sum -= normal_[i] * normal_[i].dot(sum);
        else
            sum = along_[i] * along_[i].dot(sum);
        gradient.segment<3>(3 * static_cast<Eigen::Index>(i)) = sum;
    });
    double sum = 0;
    for (const double value : part) sum += value;
    return sum;
}

double RegionEnergy::least_determinant(const Eigen::VectorXd& x)
{
    put(x);
    return parallel_min(
        context_, region_.cells.size(), kPerTask, kInfinity, [&](std::size_t begin, std::size_t end) {
            double least = kInfinity;
            for (std::size_t c = begin; c < end; ++c) {
                const Hex& cell = region_.cells[c];
                least = std::min(least, sweep::least_determinant(corners_of(places_, cell), region_.box[c],
                                                                 kind_of(cell)));
            }
            return least;
        });
}

void RegionEnergy::set_planes(const Eigen::VectorXd& x, const Sliding& sliding)
{
    put(x);
    normal_.assign(region_.free, Vec3::Zero());
    for (const Hex& cell : region_.cells) {
        for (const Quad& side : mesh::kHexSides) {
            std::array<std::size_t, 4> node{};
            for (std::size_t k = 0; k < 4; ++k) node[k] = index(cell[index(side[k])]);
            const Vec3 area =
                (places_[node[2]] - places_[node[0]]).cross(places_[node[3]] - places_[node[1]]);
            // A side inside the region is visited twice, in opposite directions, and the two contributions
            // cancel. What remains is the normal of the skin.
            for (const std::size_t n : node) {
                if (n < region_.free && region_.surface[n] >= 0) normal_[n] += area;
            }
        }
    }
    for (Vec3& normal : normal_) normal.normalize(); // a zero vector stays zero
    along_.assign(region_.free, Vec3::Zero());
    for (std::size_t i = 0; sliding.along && i < region_.free; ++i)
        if (region_.surface[i] >= 0) along_[i] = sliding.along(region_.surface[i], places_[i]);
}

} // namespace lacuna::sweep
