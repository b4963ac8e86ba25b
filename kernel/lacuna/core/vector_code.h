// SPDX-License-Identifier: MIT
#pragma once

/// What code needs that is compiled for more than one processor, the widest of which is chosen when it runs:
/// a body that is compiled into each caller, for the processor of that caller.
#if defined(__GNUC__)
#define LACUNA_INLINE [[gnu::always_inline]] inline
#else
#define LACUNA_INLINE inline
#endif
