// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>

#include <lacuna/core/shared/team.h>
#include <lacuna/io/whole_file.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

/// What `require "lacuna"` calls; leaves the module's table on the stack.
extern "C" __attribute__((visibility("default"))) int luaopen_lacuna(lua_State* L);

namespace lacuna::lua {

/// Services that the program around the interpreter provides to the bindings. A stock interpreter provides
/// none.
struct Host {
    const std::atomic<bool>* cancel = nullptr;              ///< set by the host to stop kernel work
    std::function<void(std::string_view)> log;              ///< notes of the kernel, a line each
    std::function<void(std::string_view, double)> progress; ///< stage, share in [0, 1]
    std::function<void()> ended;                            ///< called when the stage reported last has ended
    mutable bool in_stage = false;                          ///< a stage was reported and has not ended
    int threads = 0;                                        ///< default number of threads of a call; 0: all
                                                            ///< cores
    const Crew* crew = nullptr;                             ///< processes that help; null: there are none
    bool sandboxed = false;                                 ///< files are written below `output_folder` only
    std::shared_ptr<const io::Folder> output_folder;        ///< null with `sandboxed`: nothing is written
};

/// Give the state its host, which must live as long as the state. Call before luaopen_lacuna.
void set_host(lua_State* L, const Host* host);
/// The host of the state, or one that provides nothing.
const Host& host(lua_State* L);

/// Registry field that is true once the recipe has called lacuna.params().
inline constexpr const char* kUsedParams = "lacuna.used_params";

/// Chunk name of the Lua sources inside the binary; stack frames with it do not belong to the recipe.
inline constexpr const char* kEmbeddedSource = "=lacuna";

} // namespace lacuna::lua
