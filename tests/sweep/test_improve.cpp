// SPDX-License-Identifier: MIT
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/improve.h>

#include "support/blocks.h"
#include "support/check_valid.h"

#include <doctest/doctest.h>

#include <random>

using namespace lacuna;

namespace {

/// A block whose inside nodes are thrown about by `share` of a cell, its skin left alone.
mesh::HexMesh shaken(double share, unsigned seed)
{
    mesh::HexMesh mesh = test::block({6, 6, 6});
    std::vector<char> skin(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_quad(mesh, i).nodes) skin[static_cast<std::size_t>(n)] = 1;
    }
    const Hex first = mesh.hex(0);
    const double size = (mesh.nodes[static_cast<std::size_t>(first[6])] - mesh.nodes[static_cast<std::size_t>(first[0])]).norm() / std::sqrt(3.0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> throws(-share * size, share * size);
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        if (skin[i] == 0) mesh.nodes[i] += Vec3(throws(random), throws(random), throws(random));
    }
    return mesh;
}

} // namespace

TEST_CASE("a block with its inside shaken until cells fold is valid again after untangling, its skin untouched")
{
    for (const double share : {0.6, 1.0, 1.5}) {
        for (unsigned seed = 1; seed <= 3; ++seed) {
            CAPTURE(share);
            CAPTURE(seed);
            mesh::HexMesh mesh = shaken(share, seed);
            const mesh::HexMesh before = mesh;
            REQUIRE(quality::measure(mesh).inverted > 0);
            const sweep::Improved report = sweep::improve(mesh);
            CHECK(report.after > 0.2);
            test::check_valid(mesh);
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_quad(mesh, i).nodes) {
                    CHECK(mesh.nodes[static_cast<std::size_t>(n)] == before.nodes[static_cast<std::size_t>(n)]);
                }
            }
        }
    }
}

TEST_CASE("untangling leaves a good mesh as it is, and never lowers the least scaled Jacobian")
{
    mesh::HexMesh good = test::block({6, 6, 6});
    const std::vector<Vec3> nodes = good.nodes;
    sweep::improve(good);
    CHECK(good.nodes == nodes);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        mesh::HexMesh mesh = shaken(0.35, seed);
        const double before = quality::measure(mesh).min_scaled_jacobian;
        sweep::improve(mesh);
        CHECK(quality::measure(mesh).min_scaled_jacobian >= before);
    }
}
