// SPDX-License-Identifier: MIT
#include <lacuna/fill/describe.h>

#include <lacuna/closure/shared/branches.h>
#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/list_text.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/topology/shared/left_out.h>
#include <lacuna/topology/shared/names_of.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace lacuna::fill {

using topology::Origin;
using topology::Role;

namespace {

/// Words for the kinds of geometry, in the order of `topology::Geometry`.
constexpr std::array kGeometries{"given",         "Newell",         "transfinite",
                                 "annular strip", "followed sides", "parallel to the other end"};

static_assert(kGeometries.size() == static_cast<std::size_t>(topology::Geometry::parallel) + 1);

const char* word(topology::Geometry geometry) { return kGeometries[static_cast<std::size_t>(geometry)]; }

const char* word(Role role)
{
    return role == Role::source ? "source" : role == Role::target ? "target" : "wall";
}

void list_faces(std::ostream& out, const char* title, const topology::OpenVolume& volume, Role role,
                Origin origin)
{
    std::vector<FaceId> faces = volume.faces(role);
    std::erase_if(faces, [&](FaceId face) { return volume.model[face].origin != origin; });
    const std::string names = full_list(faces,
                                        [&](FaceId face) { return topology::name_of(volume.model, face); });
    if (origin == Origin::given || !names.empty()) out << title << (names.empty() ? "none" : names) << '\n';
}

std::string faces_in_words(const topology::OpenVolume& volume)
{
    const topology::Model& model = volume.model;
    std::ostringstream out;
    out << "volume: " << model.faces.size() << " faces, " << model.edges.size() << " edges, "
        << model.vertices.size() << " vertices\n";
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const topology::Face& face = model.faces[f];
        out << "  " << topology::name_of(model, FaceId(f)) << ", " << word(volume.role[f]) << ": "
            << (face.origin == Origin::given ? face.kind : word(face.geometry)) << ", "
            << face.triangles.size() << " facets" << (face.surface ? ", exact surface" : "")
            << (face.given_quads.empty() ? "" : ", given mesh") << '\n';
        for (const topology::Loop& loop : face.loops) {
            out << "    loop of " << loop.uses.size() << '\n';
            for (const topology::EdgeUse use : loop.uses) {
                const topology::Edge& edge = model[use.edge];
                out << "      " << topology::name_of(model, use.edge) << (use.reversed ? ", reversed" : "")
                    << ": " << (edge.curve ? "exact curve" : "polyline") << " of " << edge.points.size() - 1
                    << ", from " << topology::name_of(model, edge.from) << " to "
                    << topology::name_of(model, edge.to) << '\n';
            }
        }
    }
    return out.str();
}

/// The pieces that a volume with branches or steps is cut into, and the faces that they share.
std::string pieces_in_words(const Volume& volume, const RunContext& context)
{
    if (volume.closure || !closure::has_pieces(volume.volume, context)) return "";
    auto cut = attempt([&] { return closure::cut_into_pieces(volume.volume, context); });
    if (!cut) return formatted("pieces: it is not cut: {}\n", cut.why->text());
    const std::vector<closure::StepPiece>& pieces = *cut;
    if (pieces.size() < 2) return "";
    std::vector<sweep::AssemblyMember> members;
    for (const closure::StepPiece& piece : pieces) {
        members.push_back(
            {&piece.volume,
             {},
             formatted("{}_{}", volume.name.empty() ? "piece" : volume.name, members.size() + 1)});
    }
    std::string text = formatted("pieces: {}\n", pieces.size());
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        text += formatted("  {}: class {}, level {}, {} faces\n", members[p].region,
                          topology::to_string(topology::classify(pieces[p].volume).value), pieces[p].level,
                          pieces[p].volume.model.faces.size());
    }
    for (const sweep::SharedFace& face : sweep::shared_faces(members, context)) {
        text += formatted("  {} and {} share {}\n", members[face.a].region, members[face.b].region,
                          entity_of(pieces[face.a].volume.model, face.face_a));
    }
    return text;
}

} // namespace

std::string ends_in_words(const topology::OpenVolume& volume)
{
    const auto list = [&](Role role) -> Argument {
        const std::vector<FaceId> faces = volume.faces(role);
        if (faces.empty()) return "a missing end";
        return topology::entities_of(volume.model, faces);
    };
    return formatted("from {} to {}", list(Role::source), list(Role::target));
}

std::string tree(const Volume& volume, const RunContext& context)
{
    return faces_in_words(volume.volume) + pieces_in_words(volume, context);
}

std::string describe(const Volume& volume)
{
    std::ostringstream out;
    list_faces(out, "source: ", volume.volume, Role::source, Origin::given);
    list_faces(out, "target: ", volume.volume, Role::target, Origin::given);
    list_faces(out, "walls:  ", volume.volume, Role::wall, Origin::given);
    if (!volume.role_reasons.empty()) out << "likely roles:\n";
    for (const std::string& reason : volume.role_reasons) out << "  " << reason << '\n';
    out << "class:  " << topology::to_string(volume.classification.value) << '\n';
    for (const std::string& reason : volume.classification.reasons) out << "  " << reason << '\n';
    if (volume.match) {
        out << "match:  " << volume.match->method << ", " << volume.match->loops.size() << " loops, "
            << volume.match->vertices.size() << " vertices, confidence " << volume.match->confidence << '\n';
        for (const Message& note : volume.match->notes) out << "  " << note.text() << '\n';
    }
    list_faces(out, "void source: ", volume.volume, Role::source, Origin::made_void);
    list_faces(out, "void target: ", volume.volume, Role::target, Origin::made_void);
    list_faces(out, "void walls:  ", volume.volume, Role::wall, Origin::made_void);
    if (volume.closure) {
        out << "sealed: " << volume.closure->void_edges.size() << " void edges, "
            << volume.closure->void_faces.size() << " void faces, "
            << (volume.closure->watertight ? "watertight" : "not watertight") << '\n';
        for (const std::string& algorithm : volume.closure->algorithms) out << "  " << algorithm << '\n';
        for (const Message& note : volume.closure->notes) out << "  " << note.text() << '\n';
    } else if (!volume.classification.free_loops.empty()) {
        out << "open:   " << topology::free_edges(volume.volume).size() << " free edges in "
            << volume.classification.free_loops.size()
            << (volume.classification.free_loops.size() == 1 ? " loop" : " loops")
            << "; close() seals them\n";
    }
    for (const std::string& missing : topology::left_out_in_words(volume.volume)) out << missing << '\n';
    return out.str();
}

} // namespace lacuna::fill
