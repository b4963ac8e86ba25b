// SPDX-License-Identifier: MIT
#include "bindings/classes.h"
#include "bindings/options.h"

#include <array>
#include <optional>

namespace lacuna::lua {

namespace {

using matching::MatchOptions;

const Word<matching::Method> kMatchingMethods[] = {{"aligned", matching::Method::aligned},
                                                   {"nearest", matching::Method::nearest}};

/// A pair of whole numbers from 1, each reduced by `Offset`.
template <int Offset>
std::pair<int, int> read_pair(lua_State* L, int index, const Where& where)
{
    if (array_length(L, index) != 2) fail_value(L, where, "a pair { source, target }", index);
    return {read_whole(L, push_element(L, index, 1), where, 1) - Offset,
            read_whole(L, push_element(L, index, 2), where, 1) - Offset};
}

template <auto Member, int Offset>
void read_pairs(lua_State* L, int index, const Where& where, MatchOptions& options)
{
    read_items(L, index, where, "an array of pairs { source, target }", options.*Member, read_pair<Offset>);
}

int read_loop(lua_State* L, int index, const Where& where) { return read_whole(L, index, where, 1) - 1; }

void read_flip(lua_State* L, int index, const Where& where, MatchOptions& options)
{
    read_items(L, index, where, "an array of numbers of source loops", options.flip, read_loop);
}

// Vertices are given by tag and loops by number. Loops are numbered from 1 here and from 0 in the kernel.
const Option<MatchOptions> kMatchOptions[] = {
    {"method", word<&MatchOptions::method, kMatchingMethods>},
    {"vertices", read_pairs<&MatchOptions::vertices, 0>},
    {"loops", read_pairs<&MatchOptions::loops, 1>},
    {"flip", read_flip},
};

void push_match(lua_State* L, const topology::Model& model, const matching::Match& match)
{
    lua_createtable(L, 0, 5);
    set_array(L, "loops", match.loops, [&](const auto& item) {
        lua_createtable(L, 0, 3);
        set_field(L, "source", item.source + 1);
        set_field(L, "target", item.target + 1);
        set_field(L, "flipped", item.flipped);
    });
    set_array(L, "vertices", match.vertices, [&](const auto& item) {
        push(L, std::array{model[item.first].tag, model[item.second].tag});
    });
    set_field(L, "method", match.method.c_str());
    set_field(L, "confidence", match.confidence);
    set_array(L, "notes", match.notes,
              [&](const Message& note) { push_text(L, [&] { return note.text(); }); });
}

/// { loops=, vertices=, method=, confidence= } = volume:match([options])
int match(lua_State* L)
{
    lua_settop(L, 2);
    auto& state = hold<VolumeState>(L, 1);
    const bool asked = has_options(L, 2, "match");
    auto& options = temporary<MatchOptions>(L);
    read_options(L, 2, "match", kMatchOptions, options);
    RunContext& context = push_context(L);
    auto& found = temporary<matching::Match>(L); // a copy: a finalizer may match anew while this one is
                                                 // pushed
    guard(L, [&] {
        const Busy busy(state, "match");
        state = fill::match(state, asked ? std::optional(options) : std::nullopt, context);
        found = *state.match;
    });
    push_match(L, state.volume.model, found);
    return 1;
}

} // namespace

void bind_matching(lua_State* L) { add_methods<VolumeState>(L, {{"match", match}}); }

} // namespace lacuna::lua
