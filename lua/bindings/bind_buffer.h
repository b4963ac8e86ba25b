// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/box.h"

#include <lacuna/core/types.h>

#include <cstddef>
#include <memory>

namespace lacuna::lua {

/// Numbers in rows, as they lie in memory. The memory belongs to `owner`, which may be a mesh.
struct BufferState {
    std::shared_ptr<const void> owner;
    const double* reals = nullptr;
    const Index* wholes = nullptr; ///< instead of `reals`
    std::size_t numbers = 0;       ///< rows × columns
    std::size_t columns = 1;

    [[nodiscard]] bool is_real() const { return wholes == nullptr; }
    [[nodiscard]] std::size_t rows() const { return numbers / columns; }
    [[nodiscard]] std::size_t size() const { return is_real() ? sizeof(double) : sizeof(Index); }
    [[nodiscard]] const void* data() const
    {
        return is_real() ? static_cast<const void*>(reals) : static_cast<const void*>(wholes);
    }
};

template <>
inline constexpr const char* kClassName<BufferState> = "Buffer";

void bind_buffer(lua_State* L);

} // namespace lacuna::lua
