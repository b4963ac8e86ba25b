// SPDX-License-Identifier: MIT
#include <lacuna/io/msh.h>
