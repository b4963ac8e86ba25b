// SPDX-License-Identifier: MIT
#include <lacuna/surface/quad_mesher.h>
