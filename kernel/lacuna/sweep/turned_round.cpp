// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/turned_round.h>

namespace lacuna::sweep {

using namespace topology;

OpenVolume turned_round(OpenVolume volume)
{
    for (Role& role : volume.role) {
        if (role != Role::wall) role = role == Role::source ? Role::target : Role::source;
    }
    volume.turned_round = !volume.turned_round;
    return volume;
}

} // namespace lacuna::sweep
