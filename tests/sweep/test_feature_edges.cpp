// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/whole_families.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

using Outline = std::vector<Vec2>; ///< anticlockwise

Outline polygon(int sides, const Vec2& centre, double radius)
{
    Outline outline;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 0.5) / sides;
        outline.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return outline;
}

Outline rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Facets with a label a face.
class Faces {
public:
    int face(Role role)
    {
        role_.push_back(role);
        soup_.label_name.push_back("f" + std::to_string(role_.size() - 1));
        return static_cast<int>(role_.size()) - 1;
    }

    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, int label)
    {
        const auto first = static_cast<Index>(soup_.points.size());
        soup_.points.insert(soup_.points.end(), {a, b, c, d});
        soup_.triangles.push_back({first, first + 1, first + 2});
        soup_.triangles.push_back({first, first + 2, first + 3});
        soup_.triangle_label.insert(soup_.triangle_label.end(), 2, label);
    }

    /// What lies within the first outline and outside the others, put in space by `place`.
    void plane(const std::vector<Outline>& outlines, const std::function<Vec3(const Vec2&)>& place, int label)
    {
        std::vector<Vec2> points;
        std::vector<std::vector<Index>> loops;
        for (const Outline& outline : outlines) {
            loops.emplace_back();
            for (const Vec2& p : outline) {
                loops.back().push_back(static_cast<Index>(points.size()));
                points.push_back(p);
            }
        }
        geometry::TriangulateOptions options;
        options.interior_points = false;
        const geometry::Triangulation made = geometry::triangulate(points, loops, options);
        const auto first = static_cast<Index>(soup_.points.size());
        for (const Vec2& p : made.points) soup_.points.push_back(place(p));
        for (const Triangle& t : made.triangles) {
            soup_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
            soup_.triangle_label.push_back(label);
        }
    }

    /// Sealed; walls left out are made.
    [[nodiscard]] OpenVolume volume() const
    {
        healing::SplitOptions split;
        split.whole_labels = true;
        split.feature_angle = 30;
        const Model model = healing::split_facets(soup_, split);
        Roles roles;
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            const Role role = role_[static_cast<std::size_t>(std::stoi(model.faces[f].name.substr(1)))];
            (role == Role::source   ? roles.source
             : role == Role::target ? roles.target
                                    : roles.walls)
                .emplace_back(f);
        }
        OpenVolume volume = open_volume(model, roles);
        const bool whole = std::find(role_.begin(), role_.end(), Role::wall) != role_.end();
        volume = closure::close(volume, whole ? matching::Match{} : matching::match(volume)).volume;
        return volume;
    }

private:
    healing::FacetSoup soup_;
    std::vector<Role> role_;
};

/// A pocket (rise below 0), a boss (above 0) or an imprint (0) of an end.
struct Feature {
    Outline outline;
    double rise = 0;         ///< outward
    bool wall_a_side = true; ///< a wall face a side, or one round
};

/// One end of a block: its face and its features'.
void add_end(Faces& faces, const Outline& rim, const std::vector<Feature>& features, double z, bool top)
{
    const Role role = top ? Role::target : Role::source;
    const double out = top ? 1 : -1;
    std::vector<Outline> outlines{rim};
    for (const Feature& feature : features) outlines.push_back(feature.outline);
    faces.plane(
        outlines, [&](const Vec2& p) { return Vec3(p.x(), p.y(), z); }, faces.face(role));
    for (const Feature& feature : features) {
        const double floor = z + out * feature.rise;
        faces.plane(
            {feature.outline}, [&](const Vec2& p) { return Vec3(p.x(), p.y(), floor); }, faces.face(role));
        if (feature.rise == 0) continue;
        int wall = -1;
        for (std::size_t i = 0; i < feature.outline.size(); ++i) {
            const Vec2 &a = feature.outline[i], &b = feature.outline[(i + 1) % feature.outline.size()];
            if (wall < 0 || feature.wall_a_side) wall = faces.face(role);
            faces.quad({a.x(), a.y(), z}, {b.x(), b.y(), z}, {b.x(), b.y(), floor}, {a.x(), a.y(), floor},
                       wall);
        }
    }
}

/// A block of two units with features on both ends.
OpenVolume block(const std::vector<Feature>& bottom, const std::vector<Feature>& top,
                 const Outline& rim = rectangle(0, 0, 2, 2))
{
    Faces faces;
    add_end(faces, rim, bottom, 0, false);
    add_end(faces, rim, top, 2, true);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
        faces.quad({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), 2}, {a.x(), a.y(), 2},
                   faces.face(Role::wall));
    }
    return faces.volume();
}

/// A profile over x, carried two units along y: chains of points from left to right below and above.
OpenVolume profile(const std::vector<Vec2>& bottom, const std::vector<Vec2>& top)
{
    Faces faces;
    const auto strip = [&](const Vec2& a, const Vec2& b, Role role) {
        faces.quad({a.x(), 0, a.y()}, {b.x(), 0, b.y()}, {b.x(), 2, b.y()}, {a.x(), 2, a.y()},
                   faces.face(role));
    };
    for (std::size_t i = 0; i + 1 < bottom.size(); ++i) strip(bottom[i], bottom[i + 1], Role::source);
    for (std::size_t i = 0; i + 1 < top.size(); ++i) strip(top[i], top[i + 1], Role::target);
    strip(bottom.front(), top.front(), Role::wall);
    strip(bottom.back(), top.back(), Role::wall);
    Outline outline = bottom;
    outline.insert(outline.end(), top.rbegin(), top.rend());
    for (const double y : {0.0, 2.0})
        faces.plane(
            {outline}, [y](const Vec2& p) { return Vec3(p.x(), y, p.y()); }, faces.face(Role::wall));
    return faces.volume();
}

/// Two outlines with straight void walls between them.
OpenVolume between(const Outline& low, const Outline& high)
{
    Faces faces;
    faces.plane(
        {low}, [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); }, faces.face(Role::source));
    faces.plane(
        {high}, [](const Vec2& p) { return Vec3(p.x(), p.y(), 2); }, faces.face(Role::target));
    return faces.volume();
}

/// Two outlines of as many points with one wall round, point to point; without walls where they are void.
OpenVolume walled(const Outline& low, const Outline& high)
{
    Faces faces;
    add_end(faces, low, {}, 0, false);
    add_end(faces, high, {}, 2, true);
    const int wall = faces.face(Role::wall);
    constexpr int kRows = 16;
    for (std::size_t i = 0; i < low.size(); ++i) {
        const auto at = [&](std::size_t j, int k) {
            const double h = static_cast<double>(k) / kRows;
            const Vec2 p = (1 - h) * low[j % low.size()] + h * high[j % low.size()];
            return Vec3(p.x(), p.y(), 2 * h);
        };
        for (int k = 0; k < kRows; ++k)
            faces.quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1), wall);
    }
    return faces.volume();
}

/// A circle cut straight off beyond `cuts` (directions with distances), by 64 directions from its middle.
Outline cut_circle(const std::vector<std::pair<double, double>>& cuts)
{
    Outline outline;
    for (int i = 0; i < 64; ++i) {
        const double angle = 2 * std::numbers::pi * i / 64;
        double reach = 1;
        for (const auto& [direction, distance] : cuts) {
            const double along = std::cos(angle - direction);
            if (along > 0) reach = std::min(reach, distance / along);
        }
        outline.emplace_back(reach * std::cos(angle), reach * std::sin(angle));
    }
    return outline;
}

/// A box whose wall at y = 0 is made of cells between places in x and z; cells with one number are one face,
/// a row of `cells` from the source up.
OpenVolume celled_wall(const std::vector<double>& xs, const std::vector<double>& zs,
                       const std::vector<std::string>& cells)
{
    Faces faces;
    const Outline rim = rectangle(0, 0, 2, 2);
    add_end(faces, rim, {}, 0, false);
    add_end(faces, rim, {}, 2, true);
    for (std::size_t i = 1; i < rim.size(); ++i) {
        const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
        faces.quad({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), 2}, {a.x(), a.y(), 2},
                   faces.face(Role::wall));
    }
    std::map<char, int> label;
    for (std::size_t k = 0; k + 1 < zs.size(); ++k) {
        for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
            const auto [found, fresh] = label.try_emplace(cells[k][i], 0);
            if (fresh) found->second = faces.face(Role::wall);
            faces.quad({xs[i], 0, zs[k]}, {xs[i + 1], 0, zs[k]}, {xs[i + 1], 0, zs[k + 1]},
                       {xs[i], 0, zs[k + 1]}, found->second);
        }
    }
    return faces.volume();
}

/// A box whose wall at y = 0 has a patch from one x and z to another imprinted on it.
OpenVolume patched_wall(double x0, double z0, double x1, double z1)
{
    return celled_wall({0, x0, x1, 2}, {0, z0, z1, 2}, {"aaa", "aba", "aaa"});
}

/// A box whose wall at y = 0 has a patch of any outline.
OpenVolume patched_wall(const Outline& patch)
{
    Faces faces;
    const Outline rim = rectangle(0, 0, 2, 2);
    add_end(faces, rim, {}, 0, false);
    add_end(faces, rim, {}, 2, true);
    for (std::size_t i = 1; i < rim.size(); ++i) {
        const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
        faces.quad({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), 2}, {a.x(), a.y(), 2},
                   faces.face(Role::wall));
    }
    const auto at = [](const Vec2& p) { return Vec3(p.x(), 0, p.y()); };
    faces.plane({rectangle(0, 0, 2, 2), patch}, at, faces.face(Role::wall));
    faces.plane({patch}, at, faces.face(Role::wall));
    return faces.volume();
}

/// A cylinder of facets with one wall face round, and patches of cells on it: `cells` has a row a height and
/// a letter a column, cells with one letter are one face.
OpenVolume patched_tube(const std::vector<std::string>& cells, double lean = 0)
{
    Faces faces;
    const auto sides = static_cast<int>(cells.front().size());
    const double step = 2.0 / static_cast<double>(cells.size());
    const auto at = [&](std::size_t i, std::size_t k) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / sides;
        const double z = static_cast<double>(k) * step;
        return Vec3(std::cos(angle) + lean * z, std::sin(angle), z);
    };
    Outline low, high;
    for (std::size_t i = 0; i < cells.front().size(); ++i) {
        low.emplace_back(at(i, 0).head<2>());
        high.emplace_back(at(i, cells.size()).head<2>());
    }
    add_end(faces, low, {}, 0, false);
    add_end(faces, high, {}, 2, true);
    std::map<char, int> label;
    for (std::size_t k = 0; k < cells.size(); ++k) {
        for (std::size_t i = 0; i < cells[k].size(); ++i) {
            const auto [found, fresh] = label.try_emplace(cells[k][i], 0);
            if (fresh) found->second = faces.face(Role::wall);
            faces.quad(at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1), found->second);
        }
    }
    return faces.volume();
}

/// A box whose walls are stacked at heights of their own on each corner.
OpenVolume stacked(const std::vector<std::array<double, 4>>& levels)
{
    Faces faces;
    const Outline rim = rectangle(0, 0, 2, 2);
    add_end(faces, rim, {}, 0, false);
    add_end(faces, rim, {}, 2, true);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const std::size_t j = (i + 1) % rim.size();
        const auto at = [&](std::size_t k, double z) { return Vec3(rim[k].x(), rim[k].y(), z); };
        double a = 0, b = 0;
        for (std::size_t l = 0; l <= levels.size(); ++l) {
            const double c = l < levels.size() ? levels[l][j] : 2, d = l < levels.size() ? levels[l][i] : 2;
            faces.quad(at(i, a), at(j, b), at(j, c), at(i, d), faces.face(Role::wall));
            a = d;
            b = c;
        }
    }
    return faces.volume();
}

// --- the judge ----------------------------------------------------------------------------------------

/// Running length of a place on a polyline; below 0 off it.
double place_on(const std::vector<Vec3>& line, const Vec3& p, double slack)
{
    double before = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec3 d = line[i + 1] - line[i];
        const double f = std::clamp((p - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
        if ((line[i] + f * d - p).norm() <= slack) return before + f * d.norm();
        before += d.norm();
    }
    return -1;
}

/// Edges between two given faces that are no chains of mesh edges, by their names. Knows the skin's quads and
/// the model's edges alone.
std::vector<std::string> edges_cut(const OpenVolume& volume, const mesh::HexMesh& mesh)
{
    const Model& model = volume.model;
    const double slack = 1e-9 * model.diagonal;
    std::set<std::pair<Index, Index>> sides;
    std::set<Index> skin;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const Quad quad = mesh::skin_quad(mesh, i).nodes;
        for (std::size_t k = 0; k < 4; ++k) {
            sides.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
            skin.insert(quad[k]);
        }
    }
    std::vector<std::string> cut;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const auto uses = model.uses_of_edge(EdgeId(e));
        if (uses.size() != 2 || uses[0].face == uses[1].face) continue;
        std::vector<Vec3> line;
        double length = 0;
        for (const Index p : model.edges[e].points) {
            if (!line.empty()) length += (model.at(p) - line.back()).norm();
            line.push_back(model.at(p));
        }
        std::vector<std::pair<double, Index>> on;
        for (const Index node : skin) {
            const double at = place_on(line, mesh.nodes[static_cast<std::size_t>(node)], slack);
            if (at >= 0) on.emplace_back(at, node);
        }
        std::sort(on.begin(), on.end());
        // A smooth closed edge has a vertex somewhere, and its nodes may start anywhere on it.
        const bool closed = model.edges[e].from == model.edges[e].to;
        bool kept = on.size() >= 2 && (closed || on.front().first <= slack);
        if (closed && kept) on.emplace_back(length, on.front().second);
        kept = kept && on.back().first >= length - slack;
        for (std::size_t i = 0; kept && i + 1 < on.size(); ++i)
            kept = sides.contains(std::minmax(on[i].second, on[i + 1].second));
        if (!kept) cut.push_back(name_of(model, EdgeId(e)));
    }
    return cut;
}

/// Skin quads whose nodes are off the face that their patch is named for.
std::size_t quads_off_their_face(const OpenVolume& volume, const mesh::HexMesh& mesh)
{
    const Model& model = volume.model;
    std::map<std::string, geometry::FacetTree> trees;
    for (const Face& face : model.faces) trees[face.name] = geometry::FacetTree(model.points, face.triangles);
    std::size_t off = 0;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        const std::string& name = mesh.patches[static_cast<std::size_t>(quad.patch)].groups.front();
        double largest = 0;
        for (const Index node : quad.nodes) {
            const Vec3& p = mesh.nodes[static_cast<std::size_t>(node)];
            largest = std::max(largest, trees.at(name).closest(p).distance2);
        }
        if (std::sqrt(largest) > 1e-9 * model.diagonal) ++off;
    }
    return off;
}

struct Counts {
    int meshed = 0, refused = 0;
    test::MembersToRun fine{5}; ///< volumes that are meshed at the finest size too
};

/// Mesh at two or three sizes: every edge kept, every quad on its face, the volume right and the cells fair;
/// or refused with words.
/// @param closeness  of the volume: a face with folds of its own is followed by quads across them.
/// @param least      scaled Jacobian.
void check_features(const std::string& name, const OpenVolume& volume, Counts& counts,
                    double closeness = 1e-9, double least = 0.2)
{
    const bool fine = counts.fine.next();
    for (const double size : {0.4, 0.25, 0.13}) {
        if (size < 0.2 && !fine) continue;
        CAPTURE(name);
        CAPTURE(size);
        sweep::SweepOptions options;
        options.layers.count = 8;
        options.size = [size](const Vec3&) { return size; };
        try {
            const sweep::Swept swept = sweep::sweep(volume, options);
            ++counts.meshed;
            test::check_valid(swept.mesh);
            for (const std::string& edge : edges_cut(volume, swept.mesh)) FAIL_CHECK(edge << " is cut");
            CHECK(quads_off_their_face(volume, swept.mesh) == 0);
            CHECK(quality::measure(swept.mesh).volume ==
                  doctest::Approx(closure::enclosed_volume(volume)).epsilon(closeness));
            CHECK(swept.min_scaled_jacobian >= least);
        } catch (const NotSweepable& error) {
            ++counts.refused;
            MESSAGE(name << " at " << size << ": " << std::string(error.what()));
        }
    }
}

} // namespace

TEST_CASE("pockets, bosses and imprints on one end keep every edge, whichever end they are on")
{
    Counts counts;
    test::MembersToRun run(5);
    for (const bool turned : {false, true}) {
        for (const int sides : {4, 6, 8, 24}) {
            for (const double rise : {-0.3, 0.0, 0.3}) {
                if (!run.next()) continue;
                // The round one has one wall, whose facets quads of this size cannot all follow.
                const bool round = sides == 24;
                const Feature feature{polygon(sides, {1.05, 0.95}, 0.55), rise, !round};
                const std::vector<Feature> one{feature}, none;
                const std::string name = std::to_string(sides) + " sides, rise " + std::to_string(rise) +
                                         (turned ? ", on the source" : ", on the target");
                check_features(name, turned ? block(one, none) : block(none, one), counts,
                               round ? 0.01 : 1e-9);
            }
        }
    }
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.refused == 0);
}

TEST_CASE("steps, slots, ribs and chamfers across an end keep every edge")
{
    Counts counts;
    const std::vector<Vec2> flat{{0, 0}, {2, 0}};
    const std::map<std::string, std::vector<Vec2>> tops{
        {"step", {{0, 2}, {1.1, 2}, {1.1, 1.6}, {2, 1.6}}},
        {"slot", {{0, 2}, {0.7, 2}, {0.7, 1.7}, {1.3, 1.7}, {1.3, 2}, {2, 2}}},
        {"rib", {{0, 2}, {0.7, 2}, {0.7, 2.3}, {1.3, 2.3}, {1.3, 2}, {2, 2}}},
        {"chamfer", {{0, 2}, {1.6, 2}, {2, 1.6}}},
        {"roof", {{0, 1.8}, {0.9, 2.2}, {2, 1.8}}},
        {"split", {{0, 2}, {0.8, 2}, {2, 2}}},
    };
    for (const auto& [name, top] : tops) {
        check_features(name, profile(flat, top), counts);
        std::vector<Vec2> below = top; // the same upside down
        for (Vec2& p : below) p.y() = 2 - p.y();
        check_features(name + " on the source", profile(below, {{0, 2}, {2, 2}}), counts);
    }
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.refused == 0);
}

TEST_CASE("ends that are both split, alike and differently, are both kept")
{
    Counts counts;
    const auto square = [](double r, double rise) { return Feature{polygon(4, {1, 1}, r), rise, true}; };
    const Feature hexagon{polygon(6, {1, 1}, 0.5), 0, true};
    check_features("alike", block({square(0.6, 0)}, {square(0.6, 0)}), counts);
    check_features("nearly alike", block({square(0.6, 0)}, {square(0.65, 0)}), counts);
    check_features("one inside the other", block({square(1.0, 0)}, {hexagon}), counts);
    check_features("pocket below a pocket", block({square(0.6, -0.2)}, {square(0.6, -0.2)}), counts);
    check_features("boss below a pocket", block({square(0.6, 0.2)}, {square(0.6, -0.2)}), counts);
    check_features(
        "crossing imprints",
        block({{rectangle(0.5, 0.3, 0.9, 1.7), 0, true}}, {{rectangle(0.3, 0.6, 1.7, 1.4), 0, true}}),
        counts);
    check_features("split lines apart", profile({{0, 0}, {0.6, 0}, {2, 0}}, {{0, 2}, {1.4, 2}, {2, 2}}),
                   counts);
    check_features(
        "steps apart",
        profile({{0, 0}, {0.7, 0}, {0.7, 0.3}, {2, 0.3}}, {{0, 2}, {1.2, 2}, {1.2, 1.6}, {2, 1.6}}), counts);
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.meshed > 3 * counts.refused);
}

TEST_CASE("round pockets, bosses and imprints on both ends are kept, alike, near each other and crossing")
{
    Counts counts;
    test::MembersToRun run(9); // four of 32
    const std::map<std::string, std::pair<Vec2, double>> uppers{
        {"the same", {{1, 1}, 0.5}},           {"a little off", {{1.03, 1.02}, 0.5}},
        {"a little larger", {{1, 1}, 0.55}},   {"larger", {{1, 1}, 0.75}},
        {"smaller and off", {{1.1, 1}, 0.25}}, {"crossing", {{1.3, 1.1}, 0.5}},
        {"crossing far", {{1.4, 1.35}, 0.4}},  {"beside", {{1.5, 1.5}, 0.3}},
    };
    for (const auto& [name, upper] : uppers) {
        for (const auto& [below, above] : {std::pair(0.0, 0.0), {0.0, -0.2}, {0.2, 0.0}, {-0.2, 0.2}}) {
            if (!run.next()) continue;
            // Walls that stand over each other at an angle are more than layers can bear.
            if (name.starts_with("crossing") && below != 0 && above != 0) continue;
            const bool beside = name == "beside";
            const Feature low{polygon(24, beside ? Vec2(0.6, 0.6) : Vec2(1, 1), beside ? 0.3 : 0.5), below,
                              false};
            const Feature high{polygon(24, upper.first, upper.second), above, false};
            check_features(name + ", rise " + std::to_string(below) + " below and " + std::to_string(above) +
                               " above",
                           block({low}, {high}), counts, 0.02, 0.1);
        }
    }
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.meshed > 10 * counts.refused);
}

TEST_CASE("edges between stacked walls lie on layers, level and slanted")
{
    Counts counts;
    check_features("one level", stacked({{0.7, 0.7, 0.7, 0.7}}), counts);
    check_features("two levels", stacked({{0.5, 0.5, 0.5, 0.5}, {1.6, 1.6, 1.6, 1.6}}), counts);
    check_features("slanted", stacked({{0.6, 0.9, 0.9, 0.6}, {1.4, 1.5, 1.7, 1.5}}), counts);
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.refused == 0);
}

TEST_CASE("patches of level and upright edges on a wall keep every edge, wherever they lie")
{
    Counts counts;
    for (const double low : {0.5, 0.9}) {
        for (const double wide : {0.3, 0.8}) {
            check_features("patch from " + std::to_string(low) + ", " + std::to_string(wide) + " wide",
                           patched_wall(0.6, low, 0.6 + wide, 1.4), counts);
        }
    }
    const std::vector<double> even{0, 0.6, 1.3, 2};
    check_features("on the source's rim", celled_wall(even, even, {"aba", "aaa", "aaa"}), counts);
    check_features("on the target's rim", celled_wall(even, even, {"aaa", "aaa", "aba"}), counts);
    check_features("in a corner", celled_wall(even, even, {"baa", "aaa", "aaa"}), counts);
    check_features("on a side", celled_wall(even, even, {"aaa", "baa", "aaa"}), counts);
    check_features("of an L", celled_wall(even, even, {"aaa", "aba", "abb"}), counts);
    check_features("of a T and a box",
                   celled_wall({0, 0.4, 0.8, 1.2, 2}, {0, 0.5, 1.1, 2}, {"aaac", "abac", "bbbd"}), counts);
    check_features("two above each other",
                   celled_wall({0, 0.6, 0.7, 1.2, 1.4, 2}, {0, 0.4, 0.9, 1.2, 1.7, 2},
                               {"aaaaa", "abbba", "aaaaa", "aaccca", "aaaaa"}),
                   counts);
    check_features("beside each other",
                   celled_wall({0, 0.4, 0.8, 1.2, 1.6, 2}, {0, 0.5, 0.6, 1.2, 1.5, 2},
                               {"aaaaa", "abaaa", "abaca", "aaaca", "aaaaa"}),
                   counts);
    check_features("a board", celled_wall(even, even, {"abc", "def", "ghi"}), counts);
    check_features("bricks", celled_wall({0, 0.5, 1, 1.5, 2}, even, {"aabb", "cdde", "ffgg"}), counts);
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.refused == 0);
}

TEST_CASE("patches on a wall that runs all round keep every edge")
{
    Counts counts;
    const std::string plain(24, 'a');
    const std::string one = "aaabbbbaaaaaaaaaaaaaaaaa", over_start = "bbaaaaaaaaaaaaaaaaaaaabb";
    const std::string two = "aaabbbbaaaaaaccccccaaaaa";
    for (const double lean : {0.0, 0.3}) {
        check_features("one", patched_tube({plain, one, one, plain, plain, plain}, lean), counts, 0.03);
        check_features("over the start", patched_tube({plain, over_start, over_start, plain}, lean), counts,
                       0.03);
        check_features("two", patched_tube({plain, one, two, plain, plain}, lean), counts, 0.03);
        check_features("on the rim", patched_tube({one, one, plain, plain}, lean), counts, 0.03);
        check_features("a belt with a patch below",
                       patched_tube({one, plain, std::string(24, 'c'), std::string(24, 'd')}, lean), counts,
                       0.03);
    }
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused");
    CHECK(counts.refused == 0);
}

TEST_CASE("edges of the walls that no layer and no column can follow are refused by name")
{
    sweep::SweepOptions options;
    options.layers.count = 8;
    options.size = [](const Vec3&) { return 0.25; };
    for (const int sides : {3, 5, 8, 24}) {
        try {
            sweep::sweep(patched_wall(polygon(sides, {1, 1.1}, 0.5)), options);
            FAIL_CHECK("a round patch in a wall was meshed over");
        } catch (const NotSweepable& error) {
            CAPTURE(sides);
            CAPTURE(std::string(error.what()));
            CHECK(error.code() == "surface.wall_edge");
            CHECK(std::string(error.what()).find("edge ") == 0);
            CHECK(std::string(error.what()).find("crosses the layers") != std::string::npos);
        }
    }
    options.layers.count = 2;
    try {
        sweep::sweep(stacked({{0.5, 0.5, 0.5, 0.5}, {1.6, 1.6, 1.6, 1.6}}), options);
        FAIL_CHECK("two rings share a layer");
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "surface.too_few_layers");
        CHECK(std::string(error.what()).find("layers = 3") != std::string::npos);
    }
}

TEST_CASE("ends of different shape are swept the way that bears it")
{
    const Outline l_shape{{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}};
    const Outline u_shape{{-1, -1}, {1, -1}, {1, 1}, {0.4, 1}, {0.4, -0.3}, {-0.4, -0.3}, {-0.4, 1}, {-1, 1}};
    const std::map<std::string, std::pair<Outline, Outline>> shapes{
        {"hexagon to L", {polygon(6, {0, 0}, 1), l_shape}},
        {"octagon to U", {polygon(8, {0, 0}, 1), u_shape}},
        {"square to circle", {polygon(4, {0, 0}, 1), polygon(32, {0, 0}, 1)}},
        {"hexagon to triangle", {polygon(6, {0, 0}, 1), polygon(3, {0, 0}, 1)}},
        {"hexagon to circle", {polygon(6, {0, 0}, 1), polygon(32, {0, 0}, 1)}},
        {"square to octagon", {polygon(4, {0, 0}, 1), polygon(8, {0, 0}, 1)}},
    };
    int meshed = 0, refused = 0;
    test::MembersToRun run(7); // six of 36
    for (const auto& [name, ends] : shapes) {
        for (const bool turned : {false, true}) {
            for (const double size : {0.4, 0.2, 0.1}) {
                if (!run.next()) continue;
                CAPTURE(name);
                CAPTURE(turned);
                CAPTURE(size);
                sweep::SweepOptions options;
                options.layers.count = 8;
                options.size = [size](const Vec3&) { return size; };
                try {
                    const OpenVolume volume = turned ? between(ends.second, ends.first)
                                                     : between(ends.first, ends.second);
                    const sweep::Swept swept = sweep::sweep(volume, options);
                    ++meshed;
                    test::check_valid(swept.mesh);
                    // Far ends as unlike as these are bridged by poor cells.
                    CHECK(swept.min_scaled_jacobian >= (name == "octagon to U" ? 0.05 : 0.2));
                } catch (const Error& error) {
                    ++refused;
                    const std::string where = name + (turned ? " turned" : "") + " at ";
                    MESSAGE(where << size << ": " << std::string(error.what()));
                }
            }
        }
    }
    MESSAGE(meshed << " meshed, " << refused << " refused");
    CHECK(refused == 0);
}

TEST_CASE("sharp corners of both ends that stand against smooth rims have cells that share the angle")
{
    const double right = std::numbers::pi / 2;
    const std::vector<std::pair<double, double>> left{{2 * right, 0.5}}, east{{0, 0.5}}, top{{right, 0.4}};
    const std::vector<std::pair<double, double>> wedge{{0.8 * right, 0.4}, {-0.8 * right, 0.4}};
    const std::vector<std::pair<double, double>> back{{1.2 * right, 0.4}, {-1.2 * right, 0.4}};
    const std::vector<std::pair<double, double>> square{
        {0, 0.7}, {right, 0.7}, {2 * right, 0.7}, {3 * right, 0.7}};
    const std::vector<std::pair<double, double>> diamond{
        {0.5 * right, 0.7}, {1.5 * right, 0.7}, {2.5 * right, 0.7}, {3.5 * right, 0.7}};
    const std::map<std::string, std::pair<Outline, Outline>> shapes{
        {"D to circle", {cut_circle(left), cut_circle({})}},
        {"D to D", {cut_circle(left), cut_circle(east)}},
        {"D to D a quarter on", {cut_circle(left), cut_circle(top)}},
        {"wedge to wedge", {cut_circle(wedge), cut_circle(back)}},
        {"square to diamond", {cut_circle(square), cut_circle(diamond)}},
        {"square to D", {cut_circle(square), cut_circle(east)}},
    };
    Counts counts;
    double worst = 1;
    test::MembersToRun run(7); // six of 36
    for (const auto& [name, ends] : shapes) {
        for (const bool turned : {false, true}) {
            for (const double size : {0.4, 0.2, 0.1}) {
                if (!run.next()) continue;
                CAPTURE(name);
                CAPTURE(turned);
                CAPTURE(size);
                sweep::SweepOptions options;
                options.layers.count = 8;
                options.size = [size](const Vec3&) { return size; };
                const OpenVolume volume = turned ? walled(ends.second, ends.first)
                                                 : walled(ends.first, ends.second);
                try {
                    const sweep::Swept swept = sweep::sweep(volume, options);
                    ++counts.meshed;
                    test::check_valid(swept.mesh);
                    if (swept.min_scaled_jacobian < 0.18) { // better meshes cut a crease of the wall
                        CHECK(std::ranges::any_of(swept.report, [](const std::string& line) {
                            return line.find("the skin of the mesh is") != std::string::npos;
                        }));
                        continue;
                    }
                    worst = std::min(worst, swept.min_scaled_jacobian);
                } catch (const NotSweepable& error) {
                    ++counts.refused; // a crease of the wall that runs out is cut by coarse quads
                    CHECK(error.code() == "sweep.deviation");
                    MESSAGE(name << " at " << size << ": " << std::string(error.what()));
                }
            }
        }
    }
    MESSAGE(counts.meshed << " meshed, " << counts.refused << " refused, scaled Jacobian " << worst
                          << " at least");
    CHECK(counts.meshed > 5 * counts.refused);
}

TEST_CASE("an end that goes on far up a tube is refused, not laid on the other at a vanishing size")
{
    test::MembersToRun run(2);
    for (const double depth : {8.0, 20.0}) { // radii
        if (!run.next()) continue;
        constexpr double kRadius = 0.4;
        const Outline rim = rectangle(0, 0, 2, 2), mouth = polygon(12, {1, 1}, kRadius);
        Faces faces;
        add_end(faces, rim, {}, 0, false);
        faces.plane(
            {rim, mouth}, [](const Vec2& p) { return Vec3(p.x(), p.y(), 2); }, faces.face(Role::target));
        const int tube = faces.face(Role::target);
        const auto rows = static_cast<int>(4 * depth);
        for (std::size_t i = 0; i < mouth.size(); ++i) {
            const auto at = [&](std::size_t j, int row) {
                const Vec2& p = mouth[j % mouth.size()];
                return Vec3(p.x(), p.y(), 2 + kRadius * row / 4);
            };
            for (int row = 0; row < rows; ++row)
                faces.quad(at(i, row), at(i + 1, row), at(i + 1, row + 1), at(i, row + 1), tube);
        }
        faces.plane(
            {mouth}, [&](const Vec2& p) { return Vec3(p.x(), p.y(), 2 + kRadius * depth); },
            faces.face(Role::target));
        for (std::size_t i = 0; i < rim.size(); ++i) {
            const Vec2 &a = rim[i], &b = rim[(i + 1) % rim.size()];
            faces.quad({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {b.x(), b.y(), 2}, {a.x(), a.y(), 2},
                       faces.face(Role::wall));
        }
        CAPTURE(depth);
        sweep::SweepOptions options;
        options.layers.count = 2;
        options.size = [](const Vec3&) { return 1.0; };
        try {
            (void)sweep::sweep(faces.volume(), options);
            FAIL("swept");
        } catch (const NotSweepable& error) {
            const std::string what = error.what();
            CAPTURE(what);
            CHECK(what.find("times smaller") != std::string::npos);
        }
    }
}
