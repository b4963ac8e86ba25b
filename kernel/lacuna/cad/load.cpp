// SPDX-License-Identifier: MIT
#include <lacuna/cad/load.h>
