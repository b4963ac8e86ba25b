// SPDX-License-Identifier: MIT
#include "families.h"

#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/layer_placer.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lacuna;
using namespace lacuna::test;
using sweep::LayerNodes;
using sweep::place_layers;
using sweep::Placement;

namespace {

struct Named {
    std::string name;
    Motion motion;
};

/// Motions that are affine at every height.
std::vector<Named> affine_motions()
{
    return {{"lifted", lifted(3)},
            {"twisted by 90", twisted(3, 90)},
            {"twisted by 180", twisted(3, 180)},
            {"bent by 90", bent(3, 90)},
            {"tapered 10 to 1", tapered(3, 0.1)},
            {"sheared in its plane and slanted", [](const Vec3& p, double t) {
                 return Vec3(p[0] + 0.5 * t * p[1] + t, (1 + t) * p[1], p[2] * std::sqrt(1 + t) + 2 * t);
             }}};
}

double largest_gap(std::span<const Vec3> a, std::span<const Vec3> b)
{
    double gap = 0;
    for (std::size_t i = 0; i < a.size(); ++i) gap = std::max(gap, (a[i] - b[i]).norm());
    return gap;
}

/// What always holds: sizes, rim and ends bit for bit.
void check_kept(const mesh::QuadMesh& mesh, std::span<const Vec3> target, const sweep::RimColumns& columns,
                const LayerNodes& result)
{
    const std::size_t count = mesh.nodes.size();
    REQUIRE(result.nodes.size() == (static_cast<std::size_t>(columns.layers) + 1) * count);
    std::size_t astray = 0;
    for (int l = 0; l <= columns.layers; ++l) {
        for (std::size_t k = 0; k < columns.rim.size(); ++k) {
            const Vec3& placed =
                result.nodes[static_cast<std::size_t>(l) * count + static_cast<std::size_t>(columns.rim[k])];
            if (placed != columns.row(l)[k]) ++astray;
        }
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (result.nodes[i] != mesh.nodes[i]) ++astray;
        if (result.nodes[static_cast<std::size_t>(columns.layers) * count + i] != target[i]) ++astray;
    }
    CHECK(astray == 0);
}

LayerNodes place(const mesh::QuadMesh& mesh, int layers, const Motion& motion,
                 const sweep::PlacementOptions& options = {})
{
    const auto columns = columns_along(mesh, layers, motion);
    const auto target = moved(mesh, motion, 1);
    const LayerNodes result = place_layers(mesh, target, columns, options);
    check_kept(mesh, target, columns, result);
    return result;
}

/// A motion no affine map follows: the outline of a square swells to a circle, and waves.
Vec3 swollen(const Vec3& p, double t)
{
    const double reach = std::max(std::abs(p[0]), std::abs(p[1]));
    const double length = std::hypot(p[0], p[1]);
    const double scale = length > 0 ? 1 + t * (reach / length * 1.3 - 1) : 1;
    return {scale * p[0], scale * p[1], p[2] + 2 * t + 0.1 * t * (1 - t) * std::sin(3 * p[0])};
}

} // namespace

TEST_CASE("an affine motion is reproduced inside, for every outline and layer count, without factoring")
{
    for (const Family& family : planar_families()) {
        for (const Named& motion : affine_motions()) {
            for (const int layers : {1, 2, 9}) {
                CAPTURE(family.name);
                CAPTURE(motion.name);
                CAPTURE(layers);
                const LayerNodes result = place(family.mesh, layers, motion.motion);
                CHECK(result.placement == Placement::affine);
                for (int l = 0; l <= layers; ++l) {
                    const auto expected = moved(family.mesh, motion.motion, static_cast<double>(l) / layers);
                    const std::span<const Vec3> placed(
                        result.nodes.data() + static_cast<std::size_t>(l) * expected.size(), expected.size());
                    CHECK(largest_gap(placed, expected) < 1e-12);
                }
            }
        }
    }
}

TEST_CASE("a bowed source keeps its bulge through turns and tapers")
{
    for (const double bulge : {0.3, -0.3}) {
        const auto dome = mapped(disc(6, 4), [=](const Vec3& p) {
            return Vec3(p[0], p[1], bulge * (1 - p[0] * p[0] - p[1] * p[1]));
        });
        for (const Named& motion : {Named{"lifted", lifted(3)}, Named{"twisted", twisted(3, 90)},
                                    Named{"bent", bent(3, 90)}, Named{"tapered", tapered(3, 0.1)}}) {
            CAPTURE(bulge);
            CAPTURE(motion.name);
            const LayerNodes result = place(dome, 10, motion.motion);
            CHECK(result.placement == Placement::affine);
            for (int l = 0; l <= 10; ++l) {
                const auto expected = moved(dome, motion.motion, l / 10.0);
                const std::span<const Vec3> placed(
                    result.nodes.data() + static_cast<std::size_t>(l) * expected.size(), expected.size());
                CHECK(largest_gap(placed, expected) < 1e-12);
            }
        }
    }
}

TEST_CASE("bends and twists give cells that are positive at every corner")
{
    for (const Family& family : planar_families()) {
        CAPTURE(family.name);
        CHECK(worst_hex(family.mesh, place(family.mesh, 16, bent(3, 90)).nodes, 16) > 0.2);
        for (const double degrees : {30.0, 90.0, 180.0}) {
            CAPTURE(degrees);
            CHECK(worst_hex(family.mesh, place(family.mesh, 16, twisted(4, degrees)).nodes, 16) > 0.2);
        }
        CHECK(worst_hex(family.mesh, place(family.mesh, 16, tapered(4, 0.1)).nodes, 16) > 0.2);
    }
}

TEST_CASE("ends that bow differently are blended, and the cells between stay positive")
{
    const auto flat = disc(6, 4);
    for (const double low : {-0.6, 0.0, 0.6}) {
        for (const double high : {-0.6, 0.0, 0.6}) {
            CAPTURE(low);
            CAPTURE(high);
            const auto bow = [](double bulge, double height) {
                return [=](const Vec3& p) {
                    return Vec3(p[0], p[1], height + bulge * (1 - p[0] * p[0] - p[1] * p[1]));
                };
            };
            const auto source = mapped(flat, bow(low, 0));
            const auto target = mapped(flat, bow(high, 2)).nodes;
            const auto columns = columns_along(source, 8, lifted(2));
            const auto result = place_layers(source, target, columns);
            check_kept(source, target, columns, result);
            CHECK(result.placement == Placement::affine);
            CHECK(worst_hex(source, result.nodes, 8) > 0.2);
        }
    }
}

TEST_CASE("a skin between two circles is swept radially, exactly")
{
    const auto skin = tube(24, 6);
    const auto widened = [](const Vec3& p, double t) { return Vec3((1 + t) * p[0], (1 + t) * p[1], p[2]); };
    for (const bool straight : {false, true}) {
        CAPTURE(straight);
        sweep::PlacementOptions options;
        options.straight_lines = straight;
        const auto result = place(skin, 4, widened, options);
        CHECK(result.placement == (straight ? Placement::straight : Placement::affine));
        for (int l = 0; l <= 4; ++l) {
            const auto expected = moved(skin, widened, l / 4.0);
            const std::span<const Vec3> placed(
                result.nodes.data() + static_cast<std::size_t>(l) * expected.size(), expected.size());
            CHECK(largest_gap(placed, expected) < 1e-12);
        }
        CHECK(worst_hex(skin, result.nodes, 4) > 0.9);
    }
    // A frustum's rims enclose different areas: their pseudo-normals know nothing of the skin's length.
    const auto frustum = mapped(
        skin, [](const Vec3& p) { return Vec3((1 + p[2]) * p[0], (1 + p[2]) * p[1], p[2]); });
    const auto result = place(frustum, 4, widened);
    CHECK(result.placement == Placement::affine);
    CHECK(largest_gap(std::span(result.nodes).subspan(2 * frustum.nodes.size(), frustum.nodes.size()),
                      moved(frustum, widened, 0.5)) < 1e-12);
}

TEST_CASE("straight lines are straight, at the heights asked for")
{
    for (const Family& family : planar_families()) {
        sweep::PlacementOptions options;
        options.straight_lines = true;
        options.heights = {0, 0.1, 0.7, 1};
        const auto target = moved(family.mesh, bent(3, 60), 1);
        sweep::RimColumns columns = columns_along(family.mesh, 3, [&](const Vec3& p, double t) {
            const double height = options.heights[static_cast<std::size_t>(std::lround(3 * t))];
            return Vec3((1 - height) * p + height * bent(3, 60)(p, 1));
        });
        const auto result = place_layers(family.mesh, target, columns, options);
        CHECK(result.placement == Placement::straight);
        const std::size_t count = family.mesh.nodes.size();
        for (std::size_t l = 0; l < 4; ++l) {
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3 expected = (1 - options.heights[l]) * family.mesh.nodes[i] +
                                      options.heights[l] * target[i];
                CHECK((result.nodes[l * count + i] - expected).norm() < 1e-14);
            }
        }
    }
}

TEST_CASE("a rim no affine map follows is met exactly, and the inside follows it")
{
    for (const Family& family : planar_families()) {
        if (family.name == "holed plate") continue; // its holes do not go with this motion
        CAPTURE(family.name);
        const auto result = place(family.mesh, 8, swollen);
        CHECK(worst_hex(family.mesh, result.nodes, 8) > 0.05);
        CHECK(!result.report.empty());
    }
    CHECK(place(square(6), 8, swollen).placement == Placement::fitted);
}

TEST_CASE("mesh lines crowded at the rim are not folded by a waving rim")
{
    // Equal weights in the Laplacian pulled thin cells apart and inside out.
    const auto crowded = [](double x) { return std::tanh(3 * x) / std::tanh(3.0); };
    const Motion wave = [](const Vec3& p, double t) {
        return Vec3(p[0] + 0.15 * t * std::sin(3 * p[1]), p[1] + 0.15 * t * std::cos(3 * p[0]), p[2] + 2 * t);
    };
    for (const Family& family : {Family{"square", square(12)}, Family{"L", l_shape(12)}}) {
        CAPTURE(family.name);
        const auto graded = mapped(family.mesh,
                                   [&](const Vec3& p) { return Vec3(crowded(p[0]), crowded(p[1]), 0); });
        const auto result = place(graded, 8, wave);
        CHECK(result.placement == Placement::fitted);
        CHECK(worst_hex(graded, result.nodes, 8) > 0.3);
    }
}

TEST_CASE(
    "a spread field stays within its rim's values, is exact for linear ones, and zero where nothing reaches")
{
    const auto graded = mapped(
        square(9), [](const Vec3& p) { return Vec3(p[0] * p[0] * p[0], p[1] * std::abs(p[1]), 0); });
    auto mesh = graded;
    const auto rim = rim_nodes(mesh);
    const auto apart = static_cast<Index>(mesh.nodes.size()); // a quad of its own, no node of it fixed
    for (const Vec3& p : square(1).nodes) mesh.nodes.push_back(p + Vec3(9, 0, 0));
    mesh.quads.push_back({apart, apart + 1, apart + 3, apart + 2});
    const auto graph = sweep::node_graph(mesh.quads, mesh.nodes.size());
    const sweep::HarmonicSpread spread(graph, sweep::side_weights(graph, mesh.quads, mesh.nodes), rim);

    std::vector<Vec3> values;
    for (const Index node : rim) {
        const Vec3& p = mesh.nodes[static_cast<std::size_t>(node)];
        values.emplace_back(1, 2 * p[0] - p[1], std::sin(5 * p[0]) * std::cos(4 * p[1]));
    }
    std::vector<Vec3> out(mesh.nodes.size(), Vec3::Zero());
    spread.add(values, 1, out.data(), out.size());
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        if (std::find(rim.begin(), rim.end(), static_cast<Index>(i)) != rim.end()) continue;
        if (static_cast<Index>(i) >= apart) {
            CHECK(out[i] == Vec3(0, 0, 0));
            continue;
        }
        CHECK(std::abs(out[i][0] - 1) < 1e-12);
        CHECK(std::abs(out[i][1] - (2 * mesh.nodes[i][0] - mesh.nodes[i][1])) < 1e-12);
        CHECK(std::abs(out[i][2]) < 1);
    }
}

TEST_CASE("the same nodes to the bit for any number of threads, and layer by layer")
{
    for (const Named& motion : {Named{"affine", bent(3, 90)}, Named{"fitted", swollen}}) {
        CAPTURE(motion.name);
        const auto mesh = square(40);
        const auto columns = columns_along(mesh, 11, motion.motion);
        const auto target = moved(mesh, motion.motion, 1);
        RunContext context;
        context.threads = 1;
        const auto first = place_layers(mesh, target, columns, {}, context);
        for (const int threads : {2, 5}) {
            context.threads = threads;
            CHECK(place_layers(mesh, target, columns, {}, context).nodes == first.nodes);
        }
        const sweep::LayerPlacer placer(mesh, target, columns);
        std::vector<Vec3> layer(mesh.nodes.size());
        for (int l = 0; l <= 11; ++l) {
            placer.place(l, l + 1, layer);
            CHECK(std::equal(layer.begin(), layer.end(),
                             first.nodes.begin() +
                                 static_cast<std::ptrdiff_t>(static_cast<std::size_t>(l) * layer.size())));
        }
    }
}

TEST_CASE("moving everything rigidly moves the result, source and target swapped turns it upside down")
{
    const auto mesh = disc(6, 4);
    const auto place_me = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 shift(5, -3, 2);
    const Motion waved = [](const Vec3& p, double t) {
        return Vec3(p[0] * (1 + 0.3 * t * p[0]), p[1], p[2] + 2 * t + 0.2 * t * p[0] * p[1]);
    };
    const auto result = place(mesh, 6, waved);
    REQUIRE(result.placement == Placement::fitted);

    const auto turned = mapped(mesh, [&](const Vec3& p) { return Vec3(place_me * p + shift); });
    const auto other = place(turned, 6, [&](const Vec3& p, double t) {
        return Vec3(place_me * waved(place_me.transpose() * (p - shift), t) + shift);
    });
    for (std::size_t i = 0; i < result.nodes.size(); ++i) {
        CHECK((place_me * result.nodes[i] + shift - other.nodes[i]).norm() < 1e-12);
    }

    auto back = mesh;
    back.nodes = moved(mesh, waved, 1);
    sweep::RimColumns columns = columns_along(mesh, 6, waved);
    sweep::RimColumns down = columns;
    for (int l = 0; l <= 6; ++l) {
        const auto row = columns.row(6 - l);
        std::copy(row.begin(), row.end(),
                  down.points.begin() +
                      static_cast<std::ptrdiff_t>(static_cast<std::size_t>(l) * row.size()));
    }
    const auto swapped = place_layers(back, mesh.nodes, down);
    const std::size_t count = mesh.nodes.size();
    for (std::size_t l = 0; l <= 6; ++l) {
        for (std::size_t i = 0; i < count; ++i) {
            CHECK((swapped.nodes[(6 - l) * count + i] - result.nodes[l * count + i]).norm() < 1e-12);
        }
    }
}

TEST_CASE("a closed source without a rim is swept along straight lines")
{
    // The skin of a cube: six sides, no boundary.
    mesh::QuadMesh cube;
    for (int i = 0; i < 8; ++i) cube.nodes.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    cube.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    sweep::RimColumns columns;
    columns.layers = 3;
    std::vector<Vec3> target;
    for (const Vec3& p : cube.nodes) target.push_back(3 * p - Vec3(1, 1, 1));
    const auto result = place_layers(cube, target, columns);
    CHECK(result.placement == Placement::straight);
    CHECK(worst_hex(cube, result.nodes, 3) > 0.5);
}

TEST_CASE("columns that do not fit are refused, the node named")
{
    const auto mesh = disc(4, 2);
    const auto target = moved(mesh, lifted(1), 1);
    const auto good = columns_along(mesh, 3, lifted(1));
    const auto refused = [&](const sweep::RimColumns& columns, std::span<const Vec3> end) {
        try {
            place_layers(mesh, end, columns);
        } catch (const InvalidInput& error) {
            return error.code().starts_with("sweep.");
        }
        return false;
    };
    CHECK(!refused(good, target));
    CHECK(refused(good, std::span(target).first(3)));
    auto bad = good;
    bad.points.pop_back();
    CHECK(refused(bad, target));
    bad = good;
    bad.layers = 0;
    CHECK(refused(bad, target));
    bad = good;
    bad.rim[1] = bad.rim[0];
    CHECK(refused(bad, target));
    bad = good;
    bad.rim[1] = 1000000;
    CHECK(refused(bad, target));
    bad = good;
    bad.points[7][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused(bad, target));
    bad = good;
    bad.points.back() += Vec3(0.1, 0, 0);
    CHECK(refused(bad, target));
    bad = columns_along(mesh, 3, lifted(1));
    bad.rim.pop_back();
    bad.points.resize(4 * bad.rim.size());
    CHECK(refused(bad, target));
}
