// SPDX-License-Identifier: MIT
#include "support/plan_prism.h"

#include <lacuna/healing/split_facets.h>

#include <cmath>
#include <map>
#include <string>

namespace lacuna::test {

namespace {

class PrismMaker {
public:
    PrismMaker(const std::vector<PlanPatch>& patches, SpaceMap map, int facets)
        : patches_(patches), map_(std::move(map)), n_(facets)
    {
    }

    topology::OpenVolume make()
    {
        const int target = label("target", topology::Role::target);
        for (const PlanPatch& patch : patches_) add_patch(patch, target);
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            for (std::size_t s = 0; s < 4; ++s) {
                if (uses_.at(key(side_point(patches_[p], s, 0.5))) == 1) add_wall(patches_[p], p, s);
            }
        }
        healing::SplitOptions split;
        split.whole_labels = true;
        const topology::Model model = healing::split_facets(soup_, split);
        topology::Roles roles;
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            const topology::Role role = role_.at(model.faces[f].name);
            (role == topology::Role::source   ? roles.source
             : role == topology::Role::target ? roles.target
                                              : roles.walls)
                .emplace_back(f);
        }
        return topology::open_volume(model, roles);
    }

private:
    using Key = std::array<long, 2>;
    static Key key(const Vec2& p) { return {std::lround(p.x() * 1e6), std::lround(p.y() * 1e6)}; }

    static Vec2 side_point(const PlanPatch& patch, std::size_t side, double t)
    {
        switch (side) {
        case 0:
            return patch.at(t, 0);
        case 1:
            return patch.at(1, t);
        case 2:
            return patch.at(1 - t, 1);
        default:
            return patch.at(0, 1 - t);
        }
    }

    int label(const std::string& name, topology::Role role)
    {
        const auto [found, fresh] = label_.try_emplace(name, static_cast<int>(soup_.label_name.size()));
        if (fresh) {
            soup_.label_name.push_back(name);
            role_[name] = role;
        }
        return found->second;
    }

    Index node(const Vec3& p)
    {
        soup_.points.push_back(p);
        return static_cast<Index>(soup_.points.size()) - 1;
    }

    void add(const Quad& q, int of)
    {
        soup_.triangles.push_back({q[0], q[1], q[2]});
        soup_.triangles.push_back({q[0], q[2], q[3]});
        soup_.triangle_label.insert(soup_.triangle_label.end(), 2, of);
    }

    void add_patch(const PlanPatch& patch, int target)
    {
        const int source = label("source " + std::to_string(patch.face), topology::Role::source);
        for (std::size_t s = 0; s < 4; ++s) ++uses_[key(side_point(patch, s, 0.5))];
        for (const double height : {0.0, 1.0}) {
            std::vector<Index> nodes;
            for (int j = 0; j <= n_; ++j) {
                for (int i = 0; i <= n_; ++i)
                    nodes.push_back(node(map_(patch.at(double(i) / n_, double(j) / n_), height)));
            }
            const auto at = [&](int i, int j) { return nodes[static_cast<std::size_t>(j * (n_ + 1) + i)]; };
            for (int j = 0; j < n_; ++j) {
                for (int i = 0; i < n_; ++i) {
                    if (height > 0)
                        add({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, target);
                    else
                        add({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)}, source);
                }
            }
        }
    }

    void add_wall(const PlanPatch& patch, std::size_t number, std::size_t side)
    {
        const std::string name = patch.wall[side] > 0
                                     ? "wall " + std::to_string(patch.wall[side])
                                     : "wall " + std::to_string(number) + "." + std::to_string(side);
        const int wall = label(name, topology::Role::wall);
        for (int i = 0; i < n_; ++i) {
            const Vec2 a = side_point(patch, side, double(i) / n_),
                       b = side_point(patch, side, double(i + 1) / n_);
            add({node(map_(a, 0)), node(map_(b, 0)), node(map_(b, 1)), node(map_(a, 1))}, wall);
        }
    }

    const std::vector<PlanPatch>& patches_;
    SpaceMap map_;
    int n_;
    healing::FacetSoup soup_;
    std::map<std::string, int> label_;
    std::map<std::string, topology::Role> role_;
    std::map<Key, int> uses_; ///< of the patches' sides, by their middles
};

} // namespace

PlanMap rectangle(double x0, double y0, double x1, double y1)
{
    return [=](double s, double t) { return Vec2(x0 + s * (x1 - x0), y0 + t * (y1 - y0)); };
}

topology::OpenVolume prism_over(const std::vector<PlanPatch>& patches, const SpaceMap& map, int facets)
{
    return PrismMaker(patches, map, facets).make();
}

} // namespace lacuna::test
