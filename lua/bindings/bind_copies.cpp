// SPDX-License-Identifier: MIT
// mesh:copy and mesh:pattern.
#include "bindings/classes.h"
#include "bindings/faces.h"
#include "bindings/options.h"
#include "bindings/sweep_to.h"

#include <optional>

namespace lacuna::lua {

namespace {

struct CopyArguments {
    /// Without alignment: Lua aligns its memory less than Eigen requires.
    std::optional<Eigen::Transform<double, 3, Eigen::Affine, Eigen::DontAlign>> by;
    const char* key = nullptr; ///< the option that gave the motion
    fill::PatternOptions pattern{.count = 0};
    std::string name;
};

void set_motion(lua_State* L, const Where& where, CopyArguments& arguments, const Eigen::Affine3d& by)
{
    if (arguments.key != nullptr)
        fail_option(L, where, "is one motion, and '%s' is another; give one of them", arguments.key);
    arguments.key = where.key;
    arguments.by.emplace(by);
}

void read_translate(lua_State* L, int index, const Where& where, CopyArguments& arguments)
{
    set_motion(L, where, arguments, Eigen::Affine3d(Eigen::Translation3d(read_vector(L, index, where))));
}

void read_rotate(lua_State* L, int index, const Where& where, CopyArguments& arguments)
{
    const auto [point, direction, angle] = read_turn(L, index, where);
    set_motion(L, where, arguments,
               Eigen::Translation3d(point) * Eigen::AngleAxisd(angle, direction.stableNormalized()) *
                   Eigen::Translation3d(-point));
}

void read_mirror(lua_State* L, int index, const Where& where, CopyArguments& arguments)
{
    const auto [point, across] = read_point_and_normal(L, index, where);
    const Vec3 normal = across.stableNormalized();
    Eigen::Affine3d by = Eigen::Affine3d::Identity();
    by.linear() -= 2 * normal * normal.transpose();
    by.translation() = 2 * normal.dot(point) * normal;
    set_motion(L, where, arguments, by);
}

const Option<CopyArguments> kCopyOptions[] = {{"translate", read_translate},
                                              {"rotate", read_rotate},
                                              {"mirror", read_mirror},
                                              {"name", plain_name<&CopyArguments::name>}};
const Option<CopyArguments> kPatternOptions[] = {
    {"translate", read_translate},
    {"rotate", read_rotate},
    {"count", count<&CopyArguments::pattern, &fill::PatternOptions::count>},
    {"numbered", boolean<&CopyArguments::pattern, &fill::PatternOptions::numbered>}};

template <std::size_t N>
CopyArguments& push_arguments(lua_State* L, const char* call, const Option<CopyArguments> (&table)[N],
                              const char* motions)
{
    lua_settop(L, 2);
    auto& arguments = temporary<CopyArguments>(L);
    read_options(L, 2, call, table, arguments);
    if (!arguments.by) fail(L, "%s: give %s", call, motions);
    return arguments;
}

/// mesh = mesh:copy { translate = | rotate = | mirror = [, name =] }
template <class State>
int copy(lua_State* L)
{
    const auto& arguments = push_arguments(L, "copy", kCopyOptions, "'translate', 'rotate' or 'mirror'");
    const State& state = hold<State>(L, 1);
    return push_swept(L, {}, "copy", nullptr, push_context(L), [&](const RunContext&) {
        return fill::Filled{{}, fill::moved(state, Eigen::Affine3d(*arguments.by), arguments.name)};
    });
}

/// mesh = mesh:pattern { translate = | rotate = , count = [, numbered =] }
template <class State>
int pattern(lua_State* L)
{
    const auto& arguments = push_arguments(L, "pattern", kPatternOptions, "'translate' or 'rotate'");
    if (arguments.pattern.count == 0)
        fail(L, "pattern: option 'count' is missing: the number of copies, "
                "including the mesh itself");
    const State& state = hold<State>(L, 1);
    RunContext& context = push_context(L);
    return push_swept(L, {}, "pattern", nullptr, context, [&](const RunContext& part) {
        return fill::Filled{
            {},
            fill::pattern(fill::as_parts(state), Eigen::Affine3d(*arguments.by), arguments.pattern, part)};
    });
}

template <class State>
void add_copies(lua_State* L)
{
    add_methods<State>(L, {{"copy", copy<State>}, {"pattern", pattern<State>}});
}

} // namespace

void bind_copies(lua_State* L)
{
    add_copies<MeshState>(L);
    add_copies<AssemblyMeshState>(L);
}

} // namespace lacuna::lua
