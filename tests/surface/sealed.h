// SPDX-License-Identifier: MIT
#pragma once

#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>

namespace lacuna::test {

/// A prism with all its faces, given or void.
inline topology::OpenVolume sealed(const PrismOptions& options, const closure::CloseOptions& close = {})
{
    topology::OpenVolume volume = prism(options).open();
    const bool ends = !volume.faces(topology::Role::source).empty() &&
                      !volume.faces(topology::Role::target).empty();
    volume = closure::close(volume, ends ? matching::match(volume) : matching::Match{}, close).volume;
    return volume;
}

/// A box whose source is a board of n × m faces, and whose walls are one face a side; `gone` squares make
/// holes, which have walls too.
inline topology::OpenVolume board_box(int n, int m, double height,
                                      const std::function<bool(int, int)>& gone = nullptr)
{
    healing::FacetSoup soup;
    std::vector<topology::Role> role;
    const auto point = [&](double x, double y, double z) {
        soup.points.emplace_back(x, y, z);
        return static_cast<Index>(soup.points.size()) - 1;
    };
    const auto add = [&](const Quad& q, int label) {
        soup.triangles.push_back({q[0], q[1], q[2]});
        soup.triangles.push_back({q[0], q[2], q[3]});
        soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
    };
    const auto left_out = [&](int i, int j) {
        return i < 0 || j < 0 || i >= n || j >= m || (gone && gone(i, j));
    };
    int label = 0;
    const auto face = [&](topology::Role r) {
        role.push_back(r);
        soup.label_name.push_back("f" + std::to_string(label));
        return label++;
    };
    const int top = face(topology::Role::target);
    std::array<int, 4> outside{};
    for (int& side : outside) side = face(topology::Role::wall);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            if (left_out(i, j)) continue;
            const auto corner = [&](int di, int dj, double z) { return point(i + di, j + dj, z); };
            add({corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0)},
                face(topology::Role::source));
            add({corner(0, 0, height), corner(1, 0, height), corner(1, 1, height), corner(0, 1, height)},
                top);
            const std::array<std::array<int, 2>, 4> step{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
            const std::array<std::array<int, 2>, 4> at{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
            for (std::size_t k = 0; k < 4; ++k) {
                const int a = i + step[k][0], b = j + step[k][1];
                if (!left_out(a, b)) continue;
                const bool rim = a < 0 || b < 0 || a >= n || b >= m;
                const auto& p = at[k];
                const auto& q = at[(k + 1) % 4];
                add({corner(p[0], p[1], 0), corner(q[0], q[1], 0), corner(q[0], q[1], height),
                     corner(p[0], p[1], height)},
                    rim ? outside[k] : face(topology::Role::wall));
            }
        }
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    const topology::Model model = healing::split_facets(soup, split);
    topology::Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const auto r = role[static_cast<std::size_t>(std::stoi(model.faces[f].name.substr(1)))];
        (r == topology::Role::source   ? roles.source
         : r == topology::Role::target ? roles.target
                                       : roles.walls)
            .emplace_back(f);
    }
    return topology::open_volume(model, roles);
}

} // namespace lacuna::test
