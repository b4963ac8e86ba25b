// SPDX-License-Identifier: MIT
#include "bindings/other_ways.h"

#include <algorithm>
#include <utility>

namespace lacuna::lua {

std::string ends_in_words(const topology::OpenVolume& volume)
{
    const auto list = [&](topology::Role role) {
        constexpr std::size_t kMost = 6; // what a person reads in a line
        const std::vector<FaceId> faces = volume.faces(role);
        std::string text = faces.empty() ? "what is missing" : "";
        for (std::size_t i = 0; i < std::min(kMost, faces.size()); ++i)
            text += (i == 0 ? "" : ", ") + topology::name_of(volume.model, faces[i]);
        return text + (faces.size() > kMost ? ", …" : "");
    };
    return "from " + list(topology::Role::source) + " to " + list(topology::Role::target);
}

void take_next_way(VolumeState& state, OtherWays& ways, const Error& why, const RunContext& context)
{
    if (!ways.first) {
        if (!state.others) throw;
        ways.first = std::current_exception();
        ways.before = state;
    }
    ways.failed.push_back("roles: swept " + ends_in_words(state.volume) + " it fails: " + why.what() + " [" +
                          why.code() + "]");
    log_line(context, ways.failed.back());
    const closure::OtherSweeps& others = *ways.before->others;
    if (ways.next == others.ways.size()) {
        const std::exception_ptr first = ways.first;
        const char* const busy = state.busy;
        state = std::move(*ways.before);
        state.busy = busy;
        std::rethrow_exception(first);
    }
    state.volume = closure::other_sweep(others, ways.next++);
    state.closure = others.closure;
    state.classification = topology::classify(state.volume);
    state.match.reset();
}

} // namespace lacuna::lua
