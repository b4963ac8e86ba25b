// SPDX-License-Identifier: MIT
#include <lacuna/fill.h>

#include <lacuna/core/error.h>
#include <lacuna/healing/shared/add_facet.h>
#include <lacuna/io/shared/deck_facets.h>
#include <lacuna/sweep/shared/shell_quads.h>

#include <map>
#include <numeric>

namespace lacuna::fill {

FilledShell quads(const topology::Model& model, const std::vector<FaceId>& faces,
                  const sweep::SweepOptions& options, const RunContext& context)
{
    if (faces.empty())
        throw InvalidInput(
            Message("fill.no_faces", "quads: there are no faces to mesh").remedy("name one or more faces"));
    const topology::Model own = topology::extract(model, faces);
    sweep::ShellQuads mesh = sweep::shell_quads(own, options, context);
    FilledShell shell{{}, mesh.min_scaled_jacobian, mesh.mean_scaled_jacobian, mesh.area,
                      0,  std::move(mesh.report)};
    io::Deck& deck = shell.deck;
    deck.format = io::DeckFormat::msh;
    deck.version = 4.1;
    deck.points = std::move(mesh.nodes);
    deck.point_tags.resize(deck.points.size());
    std::iota(deck.point_tags.begin(), deck.point_tags.end(), io::DeckTag{1});
    std::map<std::string, Index> regions;
    std::map<std::string, std::vector<io::DeckTag>> sets;
    std::map<std::size_t, std::size_t> blocks; // for each number of nodes of a cell, the index of its block
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const topology::Face& face = own[mesh.face[q]];
        const std::string name = face.name.empty() ? formatted("face:{}", face.tag) : face.name;
        const auto region = regions.try_emplace(name, static_cast<Index>(deck.regions.size()));
        if (region.second) deck.regions.push_back({region.first->second + 1, name, {}});
        const std::size_t nodes = mesh.quads[q].count;
        const auto [block, fresh] = blocks.try_emplace(nodes, deck.blocks.size());
        if (fresh)
            deck.blocks.push_back({nodes == 3   ? io::DeckShape::tri3
                                   : nodes == 4 ? io::DeckShape::quad4
                                   : nodes == 8 ? io::DeckShape::quad8
                                                : io::DeckShape::quad9,
                                   ""});
        io::DeckBlock& into = deck.blocks[block->second];
        const auto all = mesh.quads[q].all();
        into.nodes.insert(into.nodes.end(), all.begin(), all.end());
        into.tags.push_back(static_cast<io::DeckTag>(q) + 1);
        into.regions.push_back(region.first->second);
        for (const std::string& group : face.groups)
            if (group != name) sets[group].push_back(into.tags.back());
    }
    for (auto& [name, members] : sets)
        deck.sets.push_back(
            {io::DeckSet::Kind::elements, static_cast<int>(deck.sets.size()) + 1, name, std::move(members)});
    for (const FaceId face : topology::all_faces(own)) shell.face_area += topology::face_area(own, face);
    const double share = shell.area / shell.face_area - 1;
    shell.report.push_back(
        formatted("area: {:.6g} of {:.6g} ({:+.2f} %)", shell.area, shell.face_area, 100 * share));
    if (std::abs(share) > options.volume_share && options.volume_share > 0)
        log_line(context, formatted("note: the quads have {:.2g} % {} area than the faces; use a smaller "
                                    "size, or a larger curvature",
                                    100 * std::abs(share), share < 0 ? "less" : "more"));
    return shell;
}

FilledShell measured_quads(const io::Deck& deck, const RunContext& context)
{
    sweep::SweepOptions options;
    options.quads = sweep::Quads::keep;
    const topology::Model model = healing::split_facets(io::facets_of(deck).soup, {}, context);
    return quads(model, topology::all_faces(model), options, context);
}

topology::Model model_of(const FilledShell& shell, const RunContext& context)
{
    healing::FacetSoup soup;
    soup.points = shell.deck.points;
    for (const io::DeckRegion& region : shell.deck.regions) soup.label_name.push_back(region.name);
    soup.label_keeps_nodes.assign(soup.label_name.size(), 1);
    for (const io::DeckBlock& block : shell.deck.blocks)
        for (std::size_t e = 0; e < block.count(); ++e)
            healing::add_facet(
                soup, block.element(e).first(static_cast<std::size_t>(io::shape_info(block.shape).corners)),
                block.regions[e]);
    return healing::split_facets(soup, {}, context);
}

} // namespace lacuna::fill
