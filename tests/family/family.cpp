// SPDX-License-Identifier: MIT
#include "family/family.h"

#include "support/check_valid.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <algorithm>
#include <cmath>

namespace lacuna::test {

using namespace topology;

namespace {

constexpr double kSize = 0.4; ///< edge length of the quads; the section's radius is 1
constexpr int kLayers = 5;

/// Class II: one wall of four, four of nine, none of a hole of odd number; of circles the outer one's wall.
bool missing_in_class_two(const Member& member, const Part& part)
{
    if (member.edges > 1) return part.loop % 2 != 0 || part.side >= member.edges / 2;
    // One circle: a ring between the ends that touches neither.
    return member.loops == 1 ? part.row != 1 : part.loop > 0;
}

/// Class III: every other wall; of circles one half, or a ring between two that hang on the ends.
bool missing_in_class_three(const Member& member, const Part& part)
{
    if (member.edges > 1) return part.side % 2 != 0;
    return member.halved ? part.piece == 1 : part.row == 1;
}

/// The facets of all faces, or of the given ones, in one tree.
geometry::FacetTree tree_of(const Model& model, bool given_alone)
{
    std::vector<Triangle> all;
    for (const Face& face : model.faces) {
        if (!given_alone || face.origin == Origin::given)
            all.insert(all.end(), face.triangles.begin(), face.triangles.end());
    }
    return {model.points, all};
}

bool is_void(const mesh::SkinPatch& patch)
{
    return std::any_of(patch.groups.begin(), patch.groups.end(),
                       [](const std::string& group) { return group.starts_with("void:"); });
}

/// What lies between the mesh's skin and the facets. Nodes of given faces belong on their facets;
/// those of void faces, on the surface that the facets cut roughly, and the middles of quads stray by what a
/// side can on a curve: a quarter of its length. The distance times the area bounds the volume between.
void compare_with_facets(const OpenVolume& volume, const mesh::HexMesh& mesh,
                         std::vector<std::string>& faults)
{
    const geometry::FacetTree facets = tree_of(volume.model, false), given = tree_of(volume.model, true);
    double given_stray = 0, stray_of_side = 0, between = 0;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        const bool on_given = !is_void(mesh.patches[static_cast<std::size_t>(quad.patch)]);
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) p[k] = mesh.nodes[static_cast<std::size_t>(quad.nodes[k])];
        double stray = std::sqrt(facets.closest((p[0] + p[1] + p[2] + p[3]) / 4).distance2);
        double longest = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            if (on_given) given_stray = std::max(given_stray, std::sqrt(given.closest(p[k]).distance2));
            stray = std::max(stray, std::sqrt(facets.closest(p[k]).distance2));
            stray = std::max(stray, std::sqrt(facets.closest((p[k] + p[(k + 1) % 4]) / 2).distance2));
            longest = std::max(longest, (p[k] - p[(k + 1) % 4]).norm());
        }
        stray_of_side = std::max(stray_of_side, stray / longest);
        between += stray * (p[2] - p[0]).cross(p[3] - p[1]).norm() / 2;
    }
    const double off = std::abs(quality::measure(mesh).volume - closure::enclosed_volume(volume));
    if (given_stray > volume.model.tolerance)
        faults.push_back("a node of a given face is " + std::to_string(given_stray) + " off its facets");
    if (stray_of_side > 0.25)
        faults.push_back("a quad strays from the facets by " + std::to_string(stray_of_side) +
                         " of its longest side");
    // What lies between the places looked at is not in it.
    if (off > between + 1e-4)
        faults.push_back("the volume is off by " + std::to_string(off) + ", the skin's distance explains " +
                         std::to_string(between));
}

sweep::SweepOptions sweep_options()
{
    sweep::SweepOptions options;
    options.layers.count = kLayers;
    options.size = [](const Vec3&) { return kSize; };
    return options;
}

} // namespace

std::string Member::name() const
{
    const char* ends[] = {"planar", "tilted", "bowed"};
    return "class " + std::string(to_string(value)) + ", loops " + std::to_string(loops) + ", " +
           ends[static_cast<int>(target)] + ", edges " + std::to_string(edges) + (halved ? " halved" : "") +
           ", twist " + std::to_string(twist);
}

std::vector<Member> members(VolumeClass value)
{
    std::vector<Member> all;
    for (const int loops : {1, 2, 5}) {
        for (const End target : {End::planar, End::tilted, End::bowed}) {
            for (const int edges : {1, 4, 9}) {
                for (const int twist : {0, 30, 90}) {
                    all.push_back({value, loops, target, edges, twist});
                    if (value == VolumeClass::III && edges == 1)
                        all.push_back({value, loops, target, edges, twist, true});
                }
            }
        }
    }
    return all;
}

PrismOptions options_of(const Member& member)
{
    PrismOptions o;
    o.sides = o.hole_sides = member.edges == 1 ? 0 : member.edges;
    o.holes = member.loops - 1;
    o.target = member.target;
    o.twist = member.twist;
    o.cuts = member.halved || member.edges == 9 ? 1 : 2;
    o.pieces = member.halved ? 2 : 1;
    o.feature_angle = 35; // a nonagon turns by 40° at each corner, a circle here by 15°
    const bool stack = member.edges == 1 && !member.halved &&
                       (member.value == VolumeClass::III ||
                        (member.value == VolumeClass::II && member.loops == 1));
    o.rows = stack ? 3 : 1;
    // Walls turn by 10° at most from one row of facets to the next.
    o.levels = std::max(1, member.twist / (10 * o.rows));
    o.drop = [member](const Part& part) {
        switch (member.value) {
        case VolumeClass::I:
            return part.role == Role::wall;
        case VolumeClass::II:
            return part.role == Role::wall && missing_in_class_two(member, part);
        case VolumeClass::III:
            return part.role == Role::wall && missing_in_class_three(member, part);
        case VolumeClass::IV:
            return part.role == Role::target;
        case VolumeClass::V:
            return part.role != Role::wall;
        case VolumeClass::zero:
        case VolumeClass::closed:
            break;
        }
        return false;
    };
    return o;
}

Ending run(const Member& member, closure::EdgeShape shape)
{
    const Prism whole = prism(options_of(member));
    Ending ending;
    try {
        const OpenVolume open = whole.open();
        const VolumeClass found = classify(open).value;
        if (found != member.value)
            ending.faults.push_back("taken for class " + std::string(to_string(found)));
        const bool ends = !open.faces(Role::source).empty() && !open.faces(Role::target).empty();
        const auto [volume, closed] = closure::close(open, ends ? matching::match(open) : matching::Match{},
                                                     {.edge_shape = shape});
        if (!closed.watertight || !closure::is_watertight(volume))
            ending.faults.push_back("closed, and not watertight");
        // Straight and parallel or tilted: what was left out is known. Elsewhere void faces may differ.
        const double off = std::abs(closure::enclosed_volume(volume) - whole.facet_volume);
        // A tilted circle is an ellipse; the facets between it and the circle below may join other points.
        const double known = member.edges == 1 && member.target == End::tilted ? 2e-3 : 1e-9;
        if (member.twist == 0 && member.target != End::bowed && off > known * whole.facet_volume)
            ending.faults.push_back("the closed volume is off by " + std::to_string(off));
        const sweep::Swept swept = sweep::sweep(volume, sweep_options());
        for (const std::string& fault : faults(swept.mesh)) ending.faults.push_back(fault);
        compare_with_facets(volume, swept.mesh, ending.faults);
        ending.code = "meshed";
    } catch (const Error& error) {
        ending.code = error.code();
        ending.message = error.what();
    }
    return ending;
}

} // namespace lacuna::test
