// SPDX-License-Identifier: MIT
#include <lacuna/sweep/layers.h>
