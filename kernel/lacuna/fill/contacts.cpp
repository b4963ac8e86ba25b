// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/contacts.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/list_text.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace lacuna::fill {

namespace {

using sweep::AssemblyMember;

const std::string& region_of(const AssemblyMember& member)
{
    return member.whole.empty() ? member.region : member.whole;
}

bool is_of(const ContactRequest::Pair& pair, const std::string& a, const std::string& b)
{
    return pair.regions == std::array{a, b} || pair.regions == std::array{b, a};
}

const ContactRequest::Pair* asked(const ContactRequest& request, const std::string& a, const std::string& b)
{
    const auto found = std::ranges::find_if(
        request.pairs, [&](const ContactRequest::Pair& pair) { return is_of(pair, a, b); });
    return found != request.pairs.end() ? &*found : nullptr;
}

void check_regions(std::span<const AssemblyMember> members, const ContactRequest& request)
{
    std::vector<std::string> known;
    for (const AssemblyMember& member : members)
        if (std::ranges::find(known, region_of(member)) == known.end()) known.push_back(region_of(member));
    for (const ContactRequest::Pair& pair : request.pairs)
        for (const std::string& region : pair.regions)
            if (std::ranges::find(known, region) == known.end())
                throw InvalidInput(
                    Message("fill.contact_region", "contacts: there is no region \"{}\"", region)
                        .remedy("name two of {}", short_list(known, std::identity())));
}

/// One skin of the whole mesh, and for each of its patches the face on which the patch lies.
struct SkinOf {
    std::vector<mesh::SkinPatch>* patches;
    const std::vector<FaceId>* faces;
    const sweep::Fidelity* fidelity;
    std::vector<std::size_t> sides; ///< number of skin sides, by patch
};

std::vector<SkinOf> skins_of(FilledParts& mesh, std::size_t member)
{
    std::vector<SkinOf> skins;
    const auto add = [&](auto& part, const std::vector<FaceId>& faces, const sweep::Fidelity& fidelity,
                         std::size_t sides, const auto& patch) {
        SkinOf& skin = skins.emplace_back(SkinOf{&part.patches, &faces, &fidelity, {}});
        skin.sides.resize(part.patches.size());
        for (std::size_t i = 0; i < sides; ++i) ++skin.sides[index(patch(i))];
    };
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p)
        if (sweep::Swept& own = mesh.swept.parts[p]; mesh.swept.member[p] == member)
            add(own.mesh, own.faces, own.fidelity, own.mesh.skin_count(),
                [&](std::size_t i) { return mesh::skin_quad(own.mesh, i).patch; });
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        if (FilledTets& own = mesh.tets[t]; mesh.swept.unswept[t].member == member)
            add(own.mesh, own.faces, own.fidelity, own.mesh.skin.size(),
                [&](std::size_t i) { return own.mesh.skin_patch[i]; });
    return skins;
}

/// The patches on a face, and on the parts that were split off it for neighbours.
std::vector<std::size_t> patches_on(const SkinOf& skin, FaceId face, std::size_t faces_before)
{
    std::vector<std::size_t> found;
    const auto own = std::ranges::find(*skin.faces, face);
    if (own == skin.faces->end()) return found;
    const mesh::SkinPatch& patch = (*skin.patches)[static_cast<std::size_t>(own - skin.faces->begin())];
    for (std::size_t p = 0; p < skin.patches->size(); ++p) {
        const mesh::SkinPatch& other = (*skin.patches)[p];
        const bool is_new = (*skin.faces)[p].index() >= faces_before;
        if ((*skin.faces)[p] == face || (is_new && other.face == patch.face && other.groups == patch.groups))
            found.push_back(p);
    }
    return found;
}

} // namespace

std::vector<FoundContact> find_contacts(std::span<const AssemblyMember> members,
                                        const ContactRequest& request, const RunContext& context)
{
    check_regions(members, request);
    const bool glued = std::ranges::adjacent_find(members, std::ranges::not_equal_to(),
                                                  &AssemblyMember::glue) == members.end();
    if (glued && request.gap == 0 && request.pairs.empty()) return {};
    const auto pair_of = [&](std::size_t a, std::size_t b) {
        return asked(request, region_of(members[a]), region_of(members[b]));
    };
    const auto gap = [&](std::size_t a, std::size_t b) {
        const ContactRequest::Pair* const pair = pair_of(a, b);
        return pair != nullptr ? pair->gap : request.gap;
    };
    std::vector<FoundContact> all;
    for (sweep::FaceContact& face : sweep::faces_in_contact(members, gap, context)) {
        const AssemblyMember &a = members[face.a], &b = members[face.b];
        const std::array regions{region_of(a), region_of(b)};
        auto known = std::ranges::find_if(
            all, [&](const FoundContact& of) { return of.contact.regions == regions; });
        if (known == all.end()) {
            const ContactRequest::Pair* const pair = pair_of(face.a, face.b);
            Contact contact;
            contact.regions = regions;
            contact.gap = gap(face.a, face.b);
            contact.least = face.least;
            contact.pair.name = pair != nullptr && !pair->name.empty() ? pair->name
                                                                       : regions[0] + "_" + regions[1];
            contact.pair.tied = pair != nullptr ? pair->tied : request.tied;
            known = all.insert(known, {std::move(contact), {}});
        }
        Contact& contact = known->contact;
        const std::array tags{members[face.a].volume->model[face.face_a].tag,
                              members[face.b].volume->model[face.face_b].tag};
        if (std::ranges::find(contact.faces, tags) == contact.faces.end()) contact.faces.push_back(tags);
        contact.least = std::min(contact.least, face.least);
        contact.width = std::max(contact.width, face.width);
        contact.area += face.area;
        known->faces.push_back(face);
    }
    for (const ContactRequest::Pair& pair : request.pairs)
        if (std::ranges::none_of(all, [&](const FoundContact& of) {
                return is_of(pair, of.contact.regions[0], of.contact.regions[1]);
            }))
            throw InvalidInput(
                Message("fill.contact_none",
                        "contacts: no faces of {} and {} lie within {:.3g} without common nodes",
                        pair.regions[0], pair.regions[1], pair.gap)
                    .remedy("give a larger 'gap', or open one of them with glued = false"));
    std::set<std::string> names;
    for (const FoundContact& found : all)
        if (!names.insert(found.contact.pair.name).second)
            throw InvalidInput(
                Message("fill.contact_name", "contacts: two pairs are named \"{}\"", found.contact.pair.name)
                    .remedy("give one of them another 'name'"));
    return all;
}

std::vector<Contact> without_faces(std::vector<FoundContact> found)
{
    std::vector<Contact> all;
    for (FoundContact& one : found) all.push_back(std::move(one.contact));
    return all;
}

std::vector<Contact> contacts(const topology::Model& model, const ContactRequest& request,
                              const RunContext& context)
{
    std::map<std::string, std::vector<FaceId>> bodies;
    std::vector<FaceId> others;
    for (const FaceId face : topology::all_faces(model)) {
        for (const std::vector<std::string>& region : model[face].regions)
            bodies[region.front()].push_back(face);
        if (model[face].regions.empty()) others.push_back(face);
    }
    std::size_t number = 0;
    for (std::vector<FaceId>& part : topology::connected_parts(model, others))
        bodies[formatted("part_{}", ++number)] = std::move(part);
    if (bodies.size() < 2)
        throw InvalidInput(
            Message("fill.contact_bodies", "contacts: the model is one body, but a contact needs two")
                .remedy("load the files of both as one model: lacuna.load {{ a, b }}"));
    std::vector<topology::OpenVolume> volumes;
    for (const auto& [name, faces] : bodies)
        volumes.push_back(topology::open_volume(model, {{}, {}, faces}, context));
    std::vector<AssemblyMember> members;
    for (const auto& [name, faces] : bodies) {
        AssemblyMember& member = members.emplace_back();
        member.volume = &volumes[members.size() - 1];
        member.region = name;
        member.glue = members.size();
    }
    return without_faces(find_contacts(members, request, context));
}

void add_contact(FilledParts& mesh, std::span<const AssemblyMember> members, const FoundContact& found,
                 const RunContext& context)
{
    struct Side {
        std::set<mesh::SkinPatch*> patches;
        std::set<std::pair<std::size_t, FaceId>> faces;
        double area = 0;
        double off = 0, off_in_contact = 0; ///< largest distance of the mesh from any face; from these faces
        std::size_t count = 0;
    };
    std::array<Side, 2> sides;
    std::map<std::size_t, std::vector<SkinOf>> skins; // by member
    double tolerance = 0;
    for (const sweep::FaceContact& face : found.faces)
        for (const std::size_t s : {0, 1}) {
            Side& side = sides[s];
            const std::size_t member = s == 0 ? face.a : face.b;
            const FaceId own = s == 0 ? face.face_a : face.face_b;
            if (!side.faces.emplace(member, own).second) continue;
            const topology::Model& model = members[member].volume->model;
            tolerance = std::max(tolerance, model.tolerance);
            side.area += topology::face_area(model, own);
            const auto [known, fresh] = skins.try_emplace(member);
            if (fresh) known->second = skins_of(mesh, member);
            for (const SkinOf& skin : known->second) {
                side.off = std::max(side.off, skin.fidelity->max_distance);
                for (const sweep::FaceFidelity& of : skin.fidelity->faces)
                    if (of.face == own && of.quads > 0)
                        side.off_in_contact = std::max(side.off_in_contact, of.max_distance);
                for (const std::size_t p : patches_on(skin, own, model.faces.size()))
                    if (side.patches.insert(&(*skin.patches)[p]).second) side.count += skin.sides[p];
            }
        }
    const auto& [a, b] = sides;
    if (a.count == 0 || b.count == 0) return; // a volume was left out
    // Equal curved faces with different facets have slightly different areas.
    const bool alike = std::abs(a.area - b.area) <= kAlikeSizes * std::max(a.area, b.area);
    const std::size_t slave = (alike ? a.count >= b.count : a.area < b.area) ? 0 : 1;
    Contact contact = found.contact;
    contact.pair.groups = {contact.pair.name + "_slave", contact.pair.name + "_master"};
    contact.pair.tolerance = contact.width + a.off + b.off + tolerance;
    for (const std::size_t s : {0, 1})
        for (mesh::SkinPatch* const patch : sides[s].patches)
            patch->groups.push_back(contact.pair.groups[s == slave ? 0 : 1]);
    mesh.swept.report.push_back(formatted("{}: {}, {} sides of {} on {} of {}, {:.3g} apart at most",
                                          contact.pair.tied ? "tie" : "contact", contact.pair.name,
                                          sides[slave].count, contact.regions[slave], sides[1 - slave].count,
                                          contact.regions[1 - slave], contact.width));
    const double off = a.off_in_contact + b.off_in_contact;
    if (!contact.pair.tied && off > std::max(contact.least, tolerance))
        log_line(
            context,
            formatted("note: contact {}: the faces come within {:.3g} of each other, but their meshes are "
                      "up to {:.3g} beside them, so the meshes may overlap before any load; give a "
                      "smaller 'size' or a larger 'curvature'",
                      contact.pair.name, contact.least, off));
    mesh.contacts.push_back(std::move(contact));
}

void append(FilledParts& whole, FilledParts part)
{
    if (whole.regions.empty() && whole.tets.empty()) {
        whole = std::move(part);
        return;
    }
    sweep::SweptAssembly &all = whole.swept, &own = part.swept;
    const std::size_t before = all.parts.size();
    const auto nodes = static_cast<Index>(all.nodes);
    for (mesh::NodeNumbers& numbers : own.numbering) {
        std::vector<std::pair<Index, Index>> known = numbers.known();
        for (auto& [node, number] : known) number += nodes;
        const std::size_t count = numbers.fresh() + known.size();
        all.numbering.emplace_back(numbers.first() + nodes, std::move(known), count);
    }
    for (mesh::PeriodicNodes& periodic : own.periodic)
        for (auto& pair : periodic.pairs)
            for (Index& node : pair) node += nodes;
    for (FilledTets& tets : part.tets)
        for (Index& node : tets.number) node += nodes;
    for (io::ColumnSet& columns : part.columns) columns.part += before;
    for (sweep::SharedFace& face : own.shared) face.a += before, face.b += before;
    for (sweep::NearMiss& miss : own.near_misses) {
        miss.a += before, miss.b += before;
        if (miss.edge) miss.edge_of += before;
    }
    all.nodes += own.nodes;
    const auto move_to = [](auto& into, auto& from, std::size_t at) {
        into.insert(into.begin() + static_cast<std::ptrdiff_t>(at), std::make_move_iterator(from.begin()),
                    std::make_move_iterator(from.end()));
    };
    const auto add = [&](auto& into, auto& from) { move_to(into, from, into.size()); };
    std::vector<std::string> of_parts(
        part.materials.begin(), part.materials.begin() + static_cast<std::ptrdiff_t>(part.regions.size()));
    part.materials.erase(part.materials.begin(),
                         part.materials.begin() + static_cast<std::ptrdiff_t>(part.regions.size()));
    move_to(whole.materials, of_parts, whole.regions.size());
    add(whole.materials, part.materials);
    add(whole.columns, part.columns);
    add(all.parts, own.parts);
    add(all.member, own.member);
    add(all.unswept, own.unswept);
    add(all.periodic, own.periodic);
    add(all.shared, own.shared);
    add(all.near_misses, own.near_misses);
    add(all.report, own.report);
    add(whole.regions, part.regions);
    add(whole.left_out, part.left_out);
    add(whole.tets, part.tets);
}

} // namespace lacuna::fill
