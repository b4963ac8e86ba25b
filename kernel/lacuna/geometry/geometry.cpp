// SPDX-License-Identifier: MIT
#include <lacuna/geometry/exact.h>
