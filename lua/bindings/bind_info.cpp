// SPDX-License-Identifier: MIT
// What a model is made of, as a table and as text: faces and their sizes, free edges, gaps, cavities.
#include "bindings/faces.h"

#include <lacuna/closure/shared/model_facts.h>
#include <lacuna/core/shared/number_text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace lacuna::lua {

namespace {

/// Up to this number of faces, edges or gaps, the text lists each one; more are grouped or counted. A choice.
constexpr std::size_t kMostLines = 60;

using Info = closure::ModelFacts;

// --- text -----------------------------------------------------------------------------------------------

std::string number(double value) { return with_digits(value, 4); }

/// A point as text. Coordinates below 1e-9 times `scale` are rounding and are written as 0.
std::string place(const Vec3& p, double scale)
{
    std::string text;
    for (const double x : {p.x(), p.y(), p.z()})
        text += (text.empty() ? "(" : ", ") + number(std::abs(x) > 1e-9 * scale ? x : 0.0);
    return text + ")";
}

/// The tags of faces; of a long list the first `most` tags and the number of all.
std::string tags(const topology::Model& model, const std::vector<FaceId>& faces, std::size_t most)
{
    std::string text;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (i == most) return text + ", … (" + std::to_string(faces.size()) + " in all)";
        text += (i == 0 ? "" : ", ") + std::to_string(model[faces[i]].tag);
    }
    return text;
}

/// "cylinder of radius 3", "discrete, a cylinder of radius 3".
std::string shape(const topology::Model& model, const Info& info, std::size_t face)
{
    const std::string& kind = model.faces[face].kind;
    const auto& round = info.round[face];
    if (const auto& cone = info.cone[face]) {
        return (kind == "cone" ? kind : kind + ", a cone") + " of half angle " + number(cone->half_angle) +
               " degrees, radius " + number(cone->least_radius) + " to " + number(cone->largest_radius);
    }
    if (!round) return kind;
    const std::string fitted = round->is_sphere() ? "sphere" : "cylinder";
    return (kind == fitted || kind == "torus" ? kind : kind + ", a " + fitted) + " of radius " +
           number(round->radius);
}

void write_face(std::ostream& out, const topology::Model& model, const Info& info, std::size_t face)
{
    const FaceId id(face);
    const Vec3 normal = mean_normal(model, id);
    std::size_t edges = 0;
    for (const topology::Loop& loop : model[id].loops) edges += loop.uses.size();
    out << topology::name_of(model, id) << ": " << shape(model, info, face) << ", area "
        << number(topology::face_area(model, id)) << ", centre "
        << place(topology::face_centroid(model, id), model.diagonal);
    if (info.round[face] && info.round[face]->axis) out << ", axis " << place(*info.round[face]->axis, 1);
    if (info.cone[face]) out << ", axis " << place(info.cone[face]->axis, 1);
    if (normal.norm() > 0) out << ", normal " << place(normal, 1);
    out << ", box " << place(info.faces[face].box.min(), model.diagonal) << " to "
        << place(info.faces[face].box.max(), model.diagonal) << ", " << edges
        << (edges == 1 ? " edge in " : " edges in ") << model[id].loops.size()
        << (model[id].loops.size() == 1 ? " loop" : " loops");
    if (!info.faces[face].free_edges.empty()) out << ", " << info.faces[face].free_edges.size() << " free";
    if (!info.faces[face].neighbours.empty())
        out << ", beside " << tags(model, info.faces[face].neighbours, 12);
    out << "; " << closure::use_of(info, id) << '\n';
}

/// Write the faces with equal shape, size and use as one line.
void write_groups(std::ostream& out, const topology::Model& model, const Info& info)
{
    std::map<std::string, std::vector<FaceId>> groups;
    std::vector<std::string> order;
    for (std::size_t f = 0; f < info.faces.size(); ++f) {
        std::string like = shape(model, info, f) + ", area " + number(topology::face_area(model, FaceId(f)));
        if (!info.faces[f].free_edges.empty()) like += ", with free edges";
        if (!model.faces[f].name.empty()) like += ", \"" + model.faces[f].name + "\"";
        like += std::string("; ") + closure::use_of(info, FaceId(f));
        auto& group = groups[like];
        if (group.empty()) order.push_back(like);
        group.emplace_back(f);
    }
    for (const std::string& like : order) {
        const std::vector<FaceId>& faces = groups[like];
        out << (faces.size() == 1 ? "face " : std::to_string(faces.size()) + " faces ")
            << tags(model, faces, 12) << ": " << like << '\n';
    }
}

std::string in_text(const topology::Model& model, const Info& info)
{
    std::ostringstream out;
    const std::size_t closed = static_cast<std::size_t>(
        std::count(info.part_closed.begin(), info.part_closed.end(), true));
    out << model.faces.size() << " faces in " << info.part_closed.size()
        << (info.part_closed.size() == 1 ? " part" : " parts") << ", " << closed
        << " of them closed; diagonal " << number(model.diagonal) << ", tolerance " << number(model.tolerance)
        << '\n';
    if (info.faces.size() <= kMostLines) {
        for (std::size_t f = 0; f < info.faces.size(); ++f) write_face(out, model, info, f);
    } else {
        write_groups(out, model, info);
    }
    std::size_t free = 0;
    for (const topology::FaceFacts& face : info.faces) free += face.free_edges.size();
    if (free > 0) out << "free edges: " << free << '\n';
    std::size_t lines = 0;
    for (std::size_t f = 0; f < info.faces.size() && lines < kMostLines; ++f) {
        for (const EdgeId edge : info.faces[f].free_edges) {
            if (++lines > kMostLines) break;
            out << "  " << topology::name_of(model, edge) << " of " << topology::name_of(model, FaceId(f))
                << ", length " << number(topology::edge_length(model, edge)) << '\n';
        }
    }
    if (free > kMostLines) out << "  …\n";
    for (std::size_t g = 0; g < std::min(info.gaps.size(), kMostLines); ++g) {
        const topology::Gap& gap = info.gaps[g];
        out << "gap: " << topology::name_of(model, gap.own) << " and " << topology::name_of(model, gap.other)
            << " lie at most " << number(gap.width)
            << " apart; lacuna.load(…, { tolerance = " << number(topology::sewing_tolerance(model, gap))
            << " }) sews them\n";
    }
    for (const closure::Cavity& cavity : info.cavities) {
        out << cavity.kind << ": open_volume{ faces = { " << tags(model, cavity.faces, cavity.faces.size())
            << " } }, likely class " << topology::to_string(cavity.value) << ", volume "
            << number(cavity.volume) << '\n';
    }
    return out.str();
}

// --- tables ---------------------------------------------------------------------------------------------

void push_box(lua_State* L, const Eigen::AlignedBox3d& box)
{
    push_array(L, std::array<Vec3, 2>{box.min(), box.max()}, [&](const Vec3& end) { push_vector(L, end); });
}

void push_face_info(lua_State* L, const topology::Model& model, const Info& info, std::size_t f)
{
    const FaceId id(f);
    const topology::Face& face = model[id];
    std::size_t edges = 0;
    for (const topology::Loop& loop : face.loops) edges += loop.uses.size();
    lua_createtable(L, 0, 24);
    set_whole(L, "tag", face.tag);
    set_string(L, "name", face.name.c_str());
    set_string(L, "kind", face.kind.c_str());
    set_number(L, "area", topology::face_area(model, id));
    set_vector(L, "normal", mean_normal(model, id));
    set_vector(L, "centroid", topology::face_centroid(model, id));
    push_box(L, info.faces[f].box);
    lua_setfield(L, -2, "box");
    set_count(L, "loops", face.loops.size());
    set_count(L, "edges", edges);
    set_boolean(L, "has_mesh", !face.given_quads.empty());
    set_tags(L, "neighbours", model, info.faces[f].neighbours);
    set_count(L, "free_edges", info.faces[f].free_edges.size());
    set_count(L, "part", info.faces[f].part + 1);
    set_string(L, "use", closure::use_of(info, id));
    if (info.cavity_of[f] < info.cavities.size()) set_count(L, "cavity", info.cavity_of[f] + 1);
    if (const auto& round = info.round[f]) {
        set_string(L, "fits", round->is_sphere() ? "sphere" : "cylinder");
        set_number(L, "radius", round->radius);
        set_vector(L, "centre", round->centre);
        if (round->axis) set_vector(L, "axis", *round->axis);
    }
    if (const auto& cone = info.cone[f]) {
        set_string(L, "fits", "cone");
        set_number(L, "half_angle", cone->half_angle);
        set_number(L, "least_radius", cone->least_radius);
        set_number(L, "largest_radius", cone->largest_radius);
        set_vector(L, "apex", cone->apex);
        set_vector(L, "axis", cone->axis);
    }
}

void push_cavities(lua_State* L, const topology::Model& model, const std::vector<closure::Cavity>& cavities)
{
    push_array(L, cavities, [&](const auto& item) {
        lua_createtable(L, 0, 4);
        set_string(L, "kind", item.kind.c_str());
        set_tags(L, "faces", model, item.faces);
        set_string(L, "class", std::string(topology::to_string(item.value)).c_str());
        set_number(L, "volume", item.volume);
    });
}

void push_free_edges(lua_State* L, const topology::Model& model, const Info& info)
{
    lua_newtable(L);
    std::size_t count = 0;
    for (std::size_t f = 0; f < info.faces.size(); ++f) {
        for (const EdgeId edge : info.faces[f].free_edges) {
            push_edge(L, model, edge);
            set_whole(L, "face", model.faces[f].tag);
            lua_rawseti(L, -2, to_lua(count++));
        }
    }
}

void push_gaps(lua_State* L, const topology::Model& model, const Info& info)
{
    push_array(L, info.gaps, [&](const auto& gap) {
        lua_createtable(L, 0, 4);
        set_count(L, "edge", static_cast<std::size_t>(model[gap.own].tag));
        set_count(L, "other", static_cast<std::size_t>(model[gap.other].tag));
        set_number(L, "width", gap.width);
        set_number(L, "tolerance", topology::sewing_tolerance(model, gap));
    });
}

/// { faces =, free_edges =, gaps =, cavities =, … } = model:info()
int info(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& found = temporary<Info>(L);
    auto& model = temporary<topology::Model>(L); // a copy: a finalizer may change the model meanwhile
    guard(L, [&] {
        model = state->model;
        found = closure::model_facts(model, context);
    });
    lua_createtable(L, 0, 9);
    set_string(L, "source", model.source.c_str());
    set_number(L, "diagonal", model.diagonal);
    set_number(L, "tolerance", model.tolerance);
    set_count(L, "parts", found.part_closed.size());
    set_count(L, "closed_parts",
              static_cast<std::size_t>(std::count(found.part_closed.begin(), found.part_closed.end(), true)));
    lua_createtable(L, static_cast<int>(found.faces.size()), 0);
    for (std::size_t f = 0; f < found.faces.size(); ++f) {
        push_face_info(L, model, found, f);
        lua_rawseti(L, -2, to_lua(f));
    }
    lua_setfield(L, -2, "faces");
    push_free_edges(L, model, found);
    lua_setfield(L, -2, "free_edges");
    push_gaps(L, model, found);
    lua_setfield(L, -2, "gaps");
    push_cavities(L, model, found.cavities);
    lua_setfield(L, -2, "cavities");
    return 1;
}

/// { { kind =, faces =, class =, volume = }, … } = model:cavities()
int cavities(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    auto& found = temporary<std::vector<closure::Cavity>>(L);
    auto& model = temporary<topology::Model>(L);
    guard(L, [&] {
        model = state->model;
        found = closure::cavities(model, context);
    });
    push_cavities(L, model, found);
    return 1;
}

/// text = model:describe()
int describe_model(lua_State* L)
{
    lua_settop(L, 1);
    const Box<ModelState>& state = hold_model(L, 1);
    RunContext& context = push_context(L);
    push_text(L, [&] { return in_text(state->model, closure::model_facts(state->model, context)); });
    return 1;
}

const luaL_Reg kInfoModelMethods[] = {
    {"info", info}, {"cavities", cavities}, {"describe", describe_model}, {nullptr, nullptr}};

} // namespace

void bind_info(lua_State* L) { add_methods(L, kClassName<ModelState>, kInfoModelMethods); }

} // namespace lacuna::lua
