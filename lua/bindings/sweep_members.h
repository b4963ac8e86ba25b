// SPDX-License-Identifier: MIT
#pragma once

// The members of an assembly: made of volumes, of the pieces of volumes and of meshes; and swept as one.

#include "bindings/fixed_members.h"
#include "bindings/sweep_arguments.h"

#include <memory>
#include <string>
#include <vector>

namespace lacuna::lua {

/// A member of an assembly: a volume with its options, or a mesh that stays as it is.
struct ToMesh {
    Box<VolumeState> volume;
    const SweepArguments* arguments = nullptr;
    std::unique_ptr<FixedMember> fixed;
    bool left_out = false;       ///< its faces may be named all the same
    Box<VolumeState> piece_of{}; ///< the volume that `volume` is a piece of; null: it is no piece
    std::string whole{};         ///< the name of that volume
};

/// A volume of an assembly with its options, or the pieces of one with branches or steps.
/// @param name   of regions; those of pieces have a number behind it.
/// @param whole  the group that the pieces' cells are in.
void add_members(std::vector<ToMesh>& members, const Box<VolumeState>& volume, const std::string& name,
                 const std::string& whole, const SweepArguments& arguments, const RunContext& context);

/// Do something to a volume of an assembly; where it fails and may be left out, say so.
/// @return  whether it was done.
template <class Do>
bool do_or_leave_out(std::vector<sweep::LeftOut>& left_out, const std::string& region,
                     const SweepArguments& arguments, const Do& what)
{
    if (arguments.options.fallback != sweep::Fallback::leave_out) {
        what();
        return true;
    }
    try {
        what();
        return true;
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        left_out.push_back({region, error.code(), region + ": " + error.what()});
        return false;
    }
}

/// Say in the report which faces of the file are missing in a volume, and what stands there.
void tell_left_out(const VolumeState& state, std::vector<std::string>& report);

/// Close the volumes and sweep the members as one. Layers asked for are those of the pieces that go from end
/// to end.
/// @param left_out  what was left out before, for the report.
/// @param alone     they are the pieces of one volume that is all there is.
/// @throw  as `sweep::sweep_assembly()`.
std::shared_ptr<AssemblyMeshState> sweep_members(const std::vector<ToMesh>& all,
                                                 std::vector<sweep::LeftOut> left_out, bool alone,
                                                 const RunContext& context);

} // namespace lacuna::lua
