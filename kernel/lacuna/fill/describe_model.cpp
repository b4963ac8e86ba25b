// SPDX-License-Identifier: MIT
#include <lacuna/fill/describe.h>

#include <lacuna/closure/shared/model_facts.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/core/shared/number_text.h>
#include <lacuna/topology/shared/bodies.h>
#include <lacuna/topology/shared/select_faces.h>

#include <algorithm>
#include <map>

namespace lacuna::fill {

namespace {

/// Up to this number of faces, edges or gaps, the text lists each of them. Larger numbers are grouped or only
/// counted. Not measured.
constexpr std::size_t kMostLines = 60;

using closure::ModelFacts;
using topology::Model;
using topology::name_of;

/// A point as text. Coordinates below 1e-9 times `scale` are rounding and are written as 0.
std::string place_text(const Vec3& p, double scale)
{
    return place_with_digits((p.array().abs() > 1e-9 * scale).select(p, 0), 4);
}

/// The tags of faces; of a long list the first `most` tags and the number of all.
std::string tags_text(const Model& model, const std::vector<FaceId>& faces, std::size_t most)
{
    std::string text;
    for (std::size_t i = 0; i < std::min(most, faces.size()); ++i)
        text += formatted("{}{}", i == 0 ? "" : ", ", model[faces[i]].tag);
    return faces.size() > most ? formatted("{}, … ({} in all)", text, faces.size()) : text;
}

/// "cylinder of radius 3", "discrete, a cylinder of radius 3".
std::string shape_text(const Model& model, const ModelFacts& facts, std::size_t face)
{
    const std::string& kind = model.faces[face].kind;
    const auto& round = facts.round[face];
    if (const auto& cone = facts.cone[face])
        return formatted("{}{} of half angle {:.4g} degrees, radius {:.4g} to {:.4g}", kind,
                         kind == "cone" ? "" : ", a cone", cone->half_angle, cone->least_radius,
                         cone->largest_radius);
    if (!round) return kind;
    const char* const fitted = round->is_sphere() ? "sphere" : "cylinder";
    return formatted("{}{} of radius {:.4g}", kind,
                     kind == fitted || kind == "torus" ? "" : formatted(", a {}", fitted), round->radius);
}

std::string line_of(const Model& model, const ModelFacts& facts, std::size_t face)
{
    const FaceId id(face);
    const topology::FaceFacts& own = facts.faces[face];
    const auto& round = facts.round[face];
    const auto& cone = facts.cone[face];
    std::string text = formatted("{}: {}, area {:.4g}, centre {}", name_of(model, id),
                                 shape_text(model, facts, face), topology::face_area(model, id),
                                 place_text(topology::face_centroid(model, id), model.diagonal));
    if (round && round->axis) text += ", axis " + place_text(*round->axis, 1);
    if (cone) text += ", axis " + place_text(cone->axis, 1);
    const Vec3 normal = topology::mean_normal(model, id);
    if (normal.norm() > 0) text += ", normal " + place_text(normal, 1);
    const std::size_t edges = topology::edge_count(model[id]), loops = model[id].loops.size();
    text += formatted(", box {} to {}, {} {} in {} {}", place_text(own.box.min(), model.diagonal),
                      place_text(own.box.max(), model.diagonal), edges, edges == 1 ? "edge" : "edges", loops,
                      loops == 1 ? "loop" : "loops");
    if (!own.free_edges.empty()) text += formatted(", {} free", own.free_edges.size());
    if (!own.neighbours.empty()) text += ", beside " + tags_text(model, own.neighbours, 12);
    return formatted("{}; {}\n", text, closure::use_of(facts, id));
}

/// The faces with equal shape, size and use in one line.
std::string groups_in_words(const Model& model, const ModelFacts& facts)
{
    std::map<std::string, std::vector<FaceId>> groups;
    std::vector<std::string> order;
    for (std::size_t f = 0; f < facts.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        const std::string like = formatted(
            "{}, area {:.4g}{}{}; {}", shape_text(model, facts, f), topology::face_area(model, FaceId(f)),
            facts.faces[f].free_edges.empty() ? "" : ", with free edges",
            name.empty() ? name : ", \"" + name + "\"", closure::use_of(facts, FaceId(f)));
        auto& group = groups[like];
        if (group.empty()) order.push_back(like);
        group.emplace_back(f);
    }
    std::string text;
    for (const std::string& like : order) {
        const std::vector<FaceId>& faces = groups[like];
        text += formatted("{} {}: {}\n", faces.size() == 1 ? "face" : formatted("{} faces", faces.size()),
                          tags_text(model, faces, 12), like);
    }
    return text;
}

std::string free_edges_in_words(const Model& model, const ModelFacts& facts)
{
    std::size_t free = 0;
    std::string lines;
    for (std::size_t f = 0; f < facts.faces.size(); ++f)
        for (const EdgeId edge : facts.faces[f].free_edges)
            if (++free <= kMostLines)
                lines += formatted("  {} of {}, length {:.4g}\n", name_of(model, edge),
                                   name_of(model, FaceId(f)), topology::edge_length(model, edge));
    if (free == 0) return "";
    return formatted("free edges: {}\n{}{}", free, lines, free > kMostLines ? "  …\n" : "");
}

} // namespace

std::string describe(const Model& model, const RunContext& context)
{
    const ModelFacts facts = closure::model_facts(model, context);
    const std::size_t parts = facts.part_closed.size();
    std::string text = formatted("{} faces in {} {}, {} of them closed; diagonal {:.4g}, tolerance {:.4g}\n",
                                 model.faces.size(), parts, parts == 1 ? "part" : "parts",
                                 std::ranges::count(facts.part_closed, true), model.diagonal,
                                 model.tolerance);
    if (facts.faces.size() <= kMostLines)
        for (std::size_t f = 0; f < facts.faces.size(); ++f) text += line_of(model, facts, f);
    else
        text += groups_in_words(model, facts);
    text += free_edges_in_words(model, facts);
    for (std::size_t g = 0; g < std::min(facts.gaps.size(), kMostLines); ++g) {
        const topology::Gap& gap = facts.gaps[g];
        text += formatted("gap: {} and {} lie at most {:.4g} apart; lacuna.load(…, {{ tolerance = {:.4g} }}) "
                          "sews them\n",
                          name_of(model, gap.own), name_of(model, gap.other), gap.width,
                          topology::sewing_tolerance(model, gap));
    }
    for (const closure::Cavity& cavity : facts.cavities)
        text += formatted("{}: open_volume{{ faces = {{ {} }} }}, likely class {}, volume {:.4g}\n",
                          cavity.kind, tags_text(model, cavity.faces, cavity.faces.size()),
                          topology::to_string(cavity.value), cavity.volume);
    const std::vector<topology::Body> bodies = topology::bodies(model, context);
    if (bodies.size() > 1)
        text += formatted(
            "{} bodies: {}; model:bodies() opens each, and faces = {{ region = \"{}\" }} are the "
            "faces of one\n",
            bodies.size(), short_list(bodies, [](const auto& body) { return body.name; }),
            bodies.front().name);
    return text;
}

} // namespace lacuna::fill
