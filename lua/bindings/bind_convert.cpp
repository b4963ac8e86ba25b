// SPDX-License-Identifier: MIT
// lacuna.convert: a mesh or deck from one format to another.
#include "bindings/classes.h"
#include "bindings/io_paths.h"
#include "bindings/lacuna_lua.h"
#include "bindings/options.h"
#include "bindings/write_mesh.h"

#include <lacuna/io/mesh_file.h>

namespace lacuna::lua {

namespace {

const Option<io::MeshFileOptions> kOptions[] = {
    {"version", msh_version<&io::MeshFileOptions::version>},
    {"binary", boolean<&io::MeshFileOptions::binary>},
    {"groups", word<&io::MeshFileOptions::all_groups, kMshGroups>}};

/// { nodes =, elements = } = lacuna.convert(from, to [, options])
int convert(lua_State* L)
{
    lua_settop(L, 3);
    const char* from = read_string(L, 1, {"convert", nullptr});
    const io::OutputPath& to = push_output_path(L, 2, "convert");
    auto& options = temporary<io::MeshFileOptions>(L);
    read_options(L, 3, "convert", kOptions, options);
    RunContext& context = push_context(L);
    const Host& lent = host(L);
    std::size_t nodes = 0, elements = 0;
    guard(L, [&] {
        check_input_path(lent, from);
        const io::Format& format = io::needed_mesh_format("convert", to.text(), true);
        const io::Deck deck = io::skin_as_sets(io::read_deck(from, context), format.deck);
        nodes = deck.points.size();
        for (const io::DeckBlock& block : deck.blocks) elements += block.count();
        io::write_deck(deck, format, to, context, options);
    });
    lua_createtable(L, 0, 2);
    set_field(L, "nodes", nodes);
    set_field(L, "elements", elements);
    return 1;
}

} // namespace

void bind_convert(lua_State* L) { set_functions(L, {{"convert", convert}}); }

} // namespace lacuna::lua
