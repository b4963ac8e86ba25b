// SPDX-License-Identifier: MIT
#include "support/assemblies.h"

#include "support/check_valid.h"
#include "support/prove_cells.h"

#include <lacuna/closure/close.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lacuna::test {

using namespace topology;

OpenVolume closed(OpenVolume volume)
{
    const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
    volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}).volume;
    return volume;
}

OpenVolume brick(const Brick& b)
{
    healing::FacetSoup soup;
    std::vector<Role> role;
    for (int side = 0; side < 6; ++side) {
        if (b.drop && b.drop(side)) continue;
        const int n = side / 2, u = (n + 1) % 3, v = (n + 2) % 3;
        const auto label = static_cast<int>(role.size());
        role.push_back(n != b.axis ? Role::wall : side % 2 == 0 ? Role::source : Role::target);
        soup.label_name.push_back("side_" + std::to_string(side));
        const auto point = [&](int i, int j) {
            Vec3 p = side % 2 == 0 ? b.low : b.high;
            p[u] = b.low[u] + (b.high[u] - b.low[u]) * i / b.cuts;
            p[v] = b.low[v] + (b.high[v] - b.low[v]) * j / b.cuts;
            soup.points.push_back(b.map ? b.map(p) : p);
            return static_cast<Index>(soup.points.size()) - 1;
        };
        for (int i = 0; i < b.cuts; ++i) {
            for (int j = 0; j < b.cuts; ++j) {
                Quad q{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
                if (side % 2 == 0) std::swap(q[1], q[3]);
                soup.triangles.push_back({q[0], q[1], q[2]});
                soup.triangles.push_back({q[0], q[2], q[3]});
                soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
            }
        }
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    split.tolerance = b.tolerance;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const int side = std::stoi(model.faces[f].name.substr(5));
        (side / 2 != b.axis ? roles.walls : side % 2 == 0 ? roles.source : roles.target).emplace_back(f);
    }
    return closed(open_volume(model, roles));
}

void Members::add(OpenVolume volume, double size, int layers)
{
    volumes.push_back(std::move(volume));
    sweep::SweepOptions& own = options.emplace_back();
    own.size = [size](const Vec3&) { return size; };
    own.layers.count = layers;
}

std::vector<sweep::AssemblyMember> Members::list() const
{
    std::vector<sweep::AssemblyMember> list;
    for (std::size_t m = 0; m < volumes.size(); ++m)
        list.push_back({&volumes[m], options[m], "part_" + std::to_string(m + 1)});
    return list;
}

void check_assembly(const sweep::SweptAssembly& whole, double volume, double share)
{
    std::vector<Vec3> nodes(whole.nodes);
    std::vector<Hex> hexes;
    double sum = 0;
    for (std::size_t p = 0; p < whole.parts.size(); ++p) {
        const mesh::HexMesh& mesh = whole.parts[p].mesh;
        check_valid(mesh);
        sum += whole.parts[p].fidelity.volume;
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            nodes[static_cast<std::size_t>(whole.numbering[p].of(static_cast<Index>(n)))] = mesh.nodes[n];
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            Hex hex = mesh.hex(c);
            for (Index& n : hex) n = whole.numbering[p].of(n);
            hexes.push_back(hex);
        }
    }
    const quality::Proof proof = prove_cells(nodes, hexes);
    // Volumes that meet along an edge or in a point alone make a skin that is no manifold there.
    if (proof.finding && proof.finding->fault != quality::Fault::pinched &&
        proof.finding->fault != quality::Fault::open_skin)
        FAIL_CHECK(proof.finding->message.text());
    CHECK(std::abs(sum - volume) <= share * volume);
}

std::size_t inner_quads(const sweep::SweptAssembly& whole)
{
    std::size_t count = 0;
    std::map<Quad, int> uses;
    for (std::size_t p = 0; p < whole.parts.size(); ++p) {
        for (std::size_t i = 0; i < whole.parts[p].mesh.skin_count(); ++i) {
            Quad quad = mesh::skin_quad(whole.parts[p].mesh, i).nodes;
            for (Index& n : quad) n = whole.numbering[p].of(n);
            std::sort(quad.begin(), quad.end());
            if (++uses[quad] == 2) ++count;
        }
    }
    return count;
}

void Refusals::add(unsigned seed, const Error& error)
{
    ++by_code[error.code()];
    MESSAGE(std::string(std::to_string(seed) + ": " + error.what()));
}

std::string Refusals::in_words() const
{
    std::string words;
    for (const auto& [code, count] : by_code) words += " " + code + " " + std::to_string(count);
    return words;
}

} // namespace lacuna::test
